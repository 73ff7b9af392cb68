"""A page that is ready to be painted: where everything stands, in units of 1/96 inch, y down, and its pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..drawing.shapes import Box
from ..marks.primitives import PointMark
from .bars import Bar
from .description import Figure
from .framing import Seen
from .words import Lettering, TextLines

if TYPE_CHECKING:
    from .shots import Shot


@dataclass(frozen=True)
class PanelLayout:
    """The places of the words, views, insets and colour bar of a panel.

    Attributes
    ----------
    parts
        What of a square picture each view shows; None for a view whose camera is to fit its box.
    """

    box: Box
    words: tuple[TextLines, ...]
    views: tuple[Box, ...]
    parts: tuple[Seen | None, ...]
    insets: tuple[Box, ...]
    bar: Bar | None


@dataclass(frozen=True)
class PageLayout:
    """The places of everything on a page.

    Attributes
    ----------
    scale
        Pixels per unit.
    page
        Size of the page in pixels.
    label
        Size of labels.
    shared_bar
        The colour bar of all panels.
    stroke
        Factor of the style's line widths.
    mark
        Width of marks.
    legend
        For each entry its mark, the mark's x and y, and its words.
    charts
        The places of the charts of each row.
    heads
        Headings of rows, and the letters of charts.
    """

    width: float
    height: float
    scale: float
    page: tuple[int, int]
    cells: tuple[PanelLayout, ...]
    label: float
    lettering: Lettering
    shared_bar: Bar | None
    stroke: float
    mark: float
    legend: tuple[tuple[PointMark, float, float, TextLines], ...] = ()
    charts: tuple[Box, ...] = ()
    heads: tuple[TextLines, ...] = ()

    @property
    def bars(self) -> list[Bar]:
        """All colour bars of the page."""
        return [bar for bar in (*(cell.bar for cell in self.cells), self.shared_bar) if bar]

    @property
    def smallest(self) -> float:
        """The size of the smallest words, in points."""
        texts = [words for cell in self.cells for words in cell.words]
        texts += [words for bar in self.bars for words in bar.texts]
        return 0.75 * min((each.size for each in texts if each.lines), default=self.label)


@dataclass(frozen=True, eq=False)
class ComposedPage:
    """A figure, its layout, and its pictures in the order in which they lie on each other.

    Attributes
    ----------
    is_opaque
        Whether the page's file has no transparency.
    """

    figure: Figure
    layout: PageLayout
    shots: list[Shot]
    is_opaque: bool = False

    def insets_of(self, panel: int) -> list[Shot]:
        """Return the insets of a panel."""
        return [shot for shot in self.shots if shot.panel == panel and shot.source is not None]
