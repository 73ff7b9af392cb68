"""The ends of another figure's colour bars, so that two figures can be compared."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from bihdist_core import ParameterError
from bihdist_core.progress import Progress

from ..document.document import Document
from ..document.edits import with_ends, with_range
from ..document.file import read_recipe
from ..document.looks import RANGES
from ..session.array_store import ArrayStore
from .export import compute, figure_of, open_document


@dataclass(frozen=True)
class End:
    """Where the colour bar of a panel ends.  shows: its quantity in words."""

    shows: str
    end: float
    is_difference: bool = False


def ends_in(path: str | os.PathLike[str], progress: Progress | None = None) -> tuple[End, ...]:
    """Those of a session's or recipe's panels, in order, 0 where there is no field; its fields are computed.

    Raises BihdistError for a file that is none, or that cannot be drawn.
    """
    recipe = read_recipe(path)
    document, surfaces = open_document(recipe, ArrayStore.read(recipe))
    answers = compute(document, surfaces, progress)
    tops = figure_of(replace(recipe, document=document), surfaces, answers).tops()
    return tuple(
        End(
            str(panel.shows),
            top / answer.scale if answer.field is not None else 0.0,
            panel.shows.is_difference,
        )
        for panel, answer, top in zip(document.panels, answers, tops, strict=True)
    )


def ranged(
    document: Document,
    range: str | os.PathLike[str] | float | Sequence[float | None],
    progress: Progress | None = None,
) -> tuple[Document, str]:
    """The document with colour bars that end where it is said, and a sentence on what was taken from a file, if it was.

    range: a word of RANGES; a number for all panels, or one for each with None for its field's own maximum; or the path
    of a session or recipe.
    """
    if isinstance(range, str) and range in RANGES:
        return with_range(document, range), ""
    if isinstance(range, str | os.PathLike):
        if not os.path.exists(range):
            raise ParameterError(
                f"The range {os.fspath(range)!r} is none of {', '.join(RANGES)}, no number, and no session or recipe "
                "that is there."
            )
        return ended_as(document, ends_in(range, progress), os.fspath(range))
    ends: list[Any] = list(range) if isinstance(range, Sequence) else [range]
    count = len(document.panels)
    if len(ends) not in (1, count):
        raise ParameterError(f"There are {len(ends)} ends of colour bars for {count} panels; give one, or one each.")
    panels = [panel.id for panel in document.panels]
    return with_ends(document, dict(zip(panels, ends if len(ends) > 1 else ends * count, strict=True))), ""


def ended_as(document: Document, ends: Sequence[End], name: str) -> tuple[Document, str]:
    """The document with colour bars that end as others do, and a sentence that says what was taken.

    A panel takes the end of the same quantity (the second such panel of the second), or, where there is none, of the
    panel in the same place, if both are differences or neither is.  ParameterError if there is nothing to take.
    """
    left = [(k, end) for k, end in enumerate(ends) if end.end > 0]
    taken: dict[int, tuple[int, End]] = {}
    for panel in document.panels:
        found = next((each for each in left if each[1].shows == str(panel.shows)), None)
        if found is not None:
            taken[panel.id] = found
            left.remove(found)
    for place, panel in enumerate(document.panels):
        is_alike = place < len(ends) and ends[place].is_difference == panel.shows.is_difference
        if panel.id not in taken and is_alike and ends[place].end > 0:
            taken[panel.id] = (place, ends[place])
    if not taken:
        raise ParameterError(f"{name} has no panel whose colour bar could be taken.")
    words = []
    for panel in document.panels:
        if panel.id in taken:
            place, end = taken[panel.id]
            other = "" if end.shows == str(panel.shows) else f" (that of {end.shows}, panel {place + 1} there)"
            words.append(f"{panel.shows} {end.end:.4g}{other}")
        else:
            words.append(f"{panel.shows} its own")
    ended = with_ends(document, {id: end.end for id, (_, end) in taken.items()})
    return ended, f"Colour bars end as in {name}: {', '.join(words)}."
