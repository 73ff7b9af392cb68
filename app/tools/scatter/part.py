"""Which panels the chart shows against each other, and the selections in the list of what is on the surface."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

from bihdist_core.applications.changes import count_of
from bihdist_core.counts import counted

from ...document.document import Document
from ...document.on_surface import SurfaceItem
from ...document.part import Part
from ...document.shared_parts.selections import Selection, Selections, select_instead, without_selection


@dataclass(frozen=True)
class Scatter(Part):
    """One panel's field against another's.

    Attributes
    ----------
    across, up
        The panel's id; None for one of the first two panels.
    shares
        Whether fractions of the maxima are shown instead of values.
    """

    key = "scatter"

    across: int | None = None
    up: int | None = None
    shares: bool = True

    def renumbered(self, numbers: Mapping[int, int]) -> "Scatter":
        across, up = (None if id is None else numbers.get(id) for id in (self.across, self.up))
        return replace(self, across=across, up=up)


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the selections, as a group."""
    selections = document[Selections].selections
    if selections:
        about = "selections", "Selections", f"{len(selections):,}", "hatching", partial(select_instead, chosen=())
        yield SurfaceItem(*about, members=tuple(map(_item, selections)), dock="scatter", is_by_product=True)


def _item(selection: Selection) -> SurfaceItem:
    is_unnamed = re.fullmatch(r"selection( \d+)?", selection.name) is not None
    name = selection.name.capitalize() if is_unnamed else "Selection"
    detail = counted(count_of(selection.runs), "vertex", "vertices")
    return SurfaceItem(
        f"selections:{selection.name}",
        name,
        detail if is_unnamed else f"{selection.name}, {detail}",
        "hatching",
        partial(without_selection, name=selection.name),
        selection.colour,
    )
