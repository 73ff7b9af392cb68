"""Colour limits that are given, or taken from another figure, so that the two can be compared."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from bihdist_core import ParameterError
from bihdist_core.progress import Progress

from ..document.document import Document
from ..document.edits import with_ends, with_range
from ..document.file import read_recipe
from ..document.looks import RANGES
from ..document.page import Recipe
from ..session.array_store import ArrayStore
from .export import compute, figure_of, open_document


@dataclass(frozen=True)
class ColourLimit:
    """The end of a panel's colours; `shows` is its quantity in words."""

    shows: str
    end: float
    is_difference: bool = False


def limits_in(path: str | os.PathLike[str], progress: Progress | None = None) -> tuple[ColourLimit, ...]:
    """Compute the fields of a session or recipe, and return where its panels' colours end, 0 where there is no field.

    Raises BihdistError for a file that is none, or that cannot be drawn.
    """
    recipe = read_recipe(path)
    document, surfaces = open_document(recipe, ArrayStore.read(recipe))
    answers = compute(document, surfaces, progress)
    tops = figure_of(Recipe(document), surfaces, answers).upper_limits()
    return tuple(
        ColourLimit(
            str(panel.shows),
            top / answer.scale if answer.field is not None else 0.0,
            panel.shows.is_difference,
        )
        for panel, answer, top in zip(document.panels, answers, tops, strict=True)
    )


def with_limits(
    document: Document,
    limits: str | os.PathLike[str] | float | Sequence[float | None],
    progress: Progress | None = None,
) -> tuple[Document, str]:
    """Return the document with other colour limits, and a sentence on what was taken from a file, if it was.

    The limits are a word of RANGES; where all colour bars end, also as (0, end) or (-end, end), or one end for each
    panel with None for its field's own maximum; or the path of a session or recipe.
    """
    if isinstance(limits, str) and limits in RANGES:
        return with_range(document, limits), ""
    if isinstance(limits, str | os.PathLike):
        if not os.path.exists(limits):
            raise ParameterError(
                f"The colour limits {os.fspath(limits)!r} are not one of {', '.join(RANGES)}, a number, or an "
                "existing session or recipe."
            )
        return with_limits_of(document, limits_in(limits, progress), os.fspath(limits))
    ends: list[Any] = list(limits) if isinstance(limits, Sequence) else [limits]
    if len(ends) == 2 and None not in ends and ends[0] <= 0 < ends[1]:
        low, high = ends
        if low not in (0, -high):
            raise ParameterError(f"Colour bars start at 0, those of differences at minus their end, not at {low:g}.")
        ends = [high]
    count = len(document.panels)
    if len(ends) not in (1, count):
        raise ParameterError(f"There are {len(ends)} colour limits for {count} panels; give one, or one for each.")
    panels = [panel.id for panel in document.panels]
    return with_ends(document, dict(zip(panels, ends if len(ends) > 1 else ends * count, strict=True))), ""


def with_limits_of(document: Document, ends: Sequence[ColourLimit], name: str) -> tuple[Document, str]:
    """Return the document with colours that end as others do, and a sentence that says what was taken.

    A panel takes the end of the same quantity (the second such panel of the second), or, where there is none, of the
    panel in the same place, if both are differences or neither is.  ParameterError if there is nothing to take.
    """
    left = [(k, end) for k, end in enumerate(ends) if end.end > 0]
    taken: dict[int, tuple[int, ColourLimit]] = {}
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
        raise ParameterError(f"{name} has no panel whose colour limits fit.")
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
