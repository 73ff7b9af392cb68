"""Which panels show the regions of the pins, nearest to each by the panel's distance; pure edits of that."""

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass

from bihdist_core.errors import ParameterError

from ...document.document import Document
from ...document.on_surface import SurfaceItem
from ...document.panel_edits import PanelEdit
from ...document.part import Part
from ...document.quantities import quantity_name
from ...document.shared_parts.pins import Pins


@dataclass(frozen=True)
class DividedPanels(Part):
    """The panels that show regions.

    Attributes
    ----------
    regions
        The ids of the panels that show regions.
    """

    regions: tuple[int, ...] = ()

    def renumbered(self, numbers: Mapping[int, int]) -> "DividedPanels":
        return DividedPanels(tuple(numbers[id] for id in self.regions if id in numbers))

    def without_surfaces(self, document: Document, surfaces: Set[str]) -> Document:
        there = {panel.id for panel in document.panels if panel.surface in surfaces}
        return document.with_part(DividedPanels(tuple(id for id in self.regions if id not in there)))


def show_regions(document: Document, panel: int, is_shown: bool = True) -> Document:
    """Return whether a panel shows the regions of the pins by its distance."""
    others = tuple(id for id in document[DividedPanels].regions if id != panel)
    return document.with_part(DividedPanels((*others, panel) if is_shown else others))


def hide_regions(document: Document) -> Document:
    """Return the document with regions on no panel."""
    return document.with_part(DividedPanels())


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the borders of the regions, of all panels."""
    divided = document[DividedPanels].regions
    names = [quantity_name(panel.shows) for panel in document.panels if panel.id in divided]
    if any(can_divide(document, id) for id in divided):
        detail = names[0] if len(names) == 1 else f"in {len(names)} panels"
        about = "borders", "Borders of regions", detail, "line", hide_regions
        yield SurfaceItem(*about, dock="regions", is_by_product=True)


def can_divide(document: Document, panel: int) -> bool:
    """Return whether there are pins for a panel's distance to divide its surface among."""
    shown = document.panel(panel)
    return shown.shows.is_distance and any(
        document.point(name).surface == shown.surface for name in document[Pins].points
    )


def _turn(document: Document, panel: int) -> Document:
    return show_regions(document, panel, panel not in document[DividedPanels].regions)


PANEL_EDITS = (
    PanelEdit(
        "Regions of the pins",
        _turn,
        lambda document, panel: panel in document[DividedPanels].regions or can_divide(document, panel),
        synonyms="voronoi cells nearest",
        is_on=lambda document, panel: panel in document[DividedPanels].regions,
    ),
)
"""Show them or not, by the menu over a panel."""


def divide(document: Document, which: str | Sequence[int]) -> Document:
    """Let these panels, by their numbers from 1, and no others show the regions of the pins; "all" that can.

    ParameterError where there are no pins, no such panel, or one that shows no distance.
    """
    able = [k for k, panel in enumerate(document.panels, 1) if can_divide(document, panel.id)]
    numbers = able if isinstance(which, str) else which
    if isinstance(which, str) and which != "all":
        raise ParameterError(f"Regions are shown on panels 1,2,… or on all, not on {which!r}.")
    if not document[Pins].pins:
        raise ParameterError("There are no regions without pins; name some with --pins (in Python, pins=).")
    for number in numbers:
        if not 1 <= number <= len(document.panels):
            raise ParameterError(f"There is no panel {number}; they are numbered from 1 to {len(document.panels)}.")
        if number not in able:
            raise ParameterError(f"Panel {number} shows no distance from a point, so pins have no regions there.")
    return document.with_part(DividedPanels(tuple(document.panels[number - 1].id for number in dict.fromkeys(numbers))))


def divided_panels(document: Document) -> str | tuple[int, ...]:
    """Return the argument of `divide` for the regions that a document shows; empty if there are none."""
    able = [k for k, panel in enumerate(document.panels, 1) if can_divide(document, panel.id)]
    shown = tuple(k for k in able if document.panels[k - 1].id in document[DividedPanels].regions)
    return "all" if shown and len(shown) == len(able) else shown
