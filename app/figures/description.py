"""What a figure shows, as frozen data: panels in rows and columns, and how they look."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.first_view import is_flat
from bihdist_core.arrays import AnyArray, FloatArray

from ..document.camera import View, checked_view
from ..document.document import Zoom
from ..document.looks import AS_IT_IS, RANGES, TWENTY_STEPS, Isolines, Shading, one_of
from ..document.page import TITLES
from ..marks.primitives import AreaMark, LineMark, PointMark
from ..scene.style import PAPER, Style
from .fonts import check_font
from .size import Size


@dataclass(frozen=True, eq=False)
class FigurePanel:
    """One panel: a surface, a field (n,) on it with NaN where undefined, or None for the bare shape, and its words.

    label and unit stand at the colour bar, heading and hint above.  maximum: the end of the colour bar, the field's
    own if None.  through: values that have an isoline besides, which stands out.  views: pictures of the same side by
    side, each a standard one or a camera.  height: a flat surface becomes a height field, raised by the field so that
    its maximum is this share of the surface's extent.  failure: why there is no field, to be read on the bare shape.
    signed: the field has values on both sides of 0, and its colour bar goes from -maximum to maximum. up: which axis is
    up in standard views.  source: the vertex that the view from the source looks at.  is_parallel: nothing gets smaller
    with distance.  axes: where x, y and z point to is shown, unless it is in a panel before.  marks, lines, areas: what
    is marked on the surface.  colours: (n, 3) of the surface's own, instead of a field, grey where they are NaN.
    largest: of a difference, in words, how large it is and where.
    """

    surface: Surface
    field: AnyArray | None = None
    heading: str = ""
    hint: str = ""
    label: str = ""
    unit: str = ""
    maximum: float | None = None
    isolines: Isolines = TWENTY_STEPS
    through: tuple[float, ...] = ()
    views: tuple[View, ...] = ("home",)
    marks: tuple[PointMark, ...] = ()
    zooms: tuple[Zoom, ...] = ()
    height: float = 0.0
    failure: str = ""
    signed: bool = False
    shading: Shading = AS_IT_IS
    up: str = "y"
    source: int | None = None
    is_parallel: bool = False
    axes: bool = False
    lines: tuple[LineMark, ...] = ()
    areas: tuple[AreaMark, ...] = ()
    colours: FloatArray | None = None
    largest: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.isolines, int):
            object.__setattr__(self, "isolines", Isolines(self.isolines))  # a number of steps does
        count = len(self.surface.vertices)
        if self.field is not None and np.shape(self.field) != (count,):
            raise ParameterError(f"The field has the shape {np.shape(self.field)}; the surface has {count:,} vertices.")
        if self.colours is not None and (self.field is not None or np.shape(self.colours) != (count, 3)):
            raise ParameterError(f"{count:,} vertices have a colour each and no field, or a field.")
        if self.maximum is not None and not 0 < self.maximum < np.inf:
            raise ParameterError(f"A colour bar ends at a positive number, not at {self.maximum!r}.")
        if not self.views:
            raise ParameterError("A panel needs at least one view.")
        for view in self.views:
            checked_view(view)
        if self.height and not is_flat(self.surface.vertices[self.surface.component_of_vertex >= 0]):
            raise ParameterError("A height field needs a flat surface, with the same z everywhere.")
        if not 0 <= self.height <= 10:
            raise ParameterError(
                f"The height of a height field is a fraction of the surface's extent, not {self.height:g}."
            )
        self.surface.check_vertices([*(mark.vertex for mark in self.marks), *(zoom.vertex for zoom in self.zooms)])

    @property
    def top(self) -> float:
        """The end of the colour bar; 0 if there is no field, or none that is more than 0 anywhere."""
        return self.own_top if self.maximum is None else self.maximum

    @property
    def own_top(self) -> float:
        """The field's maximum, of its absolute values if it is signed."""
        if self.field is None:
            return 0.0
        return float(np.nanmax(np.abs(self.field) if self.signed else self.field, initial=0.0))


Entry = tuple[PointMark, str]
"""Of a legend: a mark, whose vertex does not matter, and what such marks stand for."""

USUAL = Size()
"""As the panels want it."""


@dataclass(frozen=True, eq=False)
class Figure:
    """Panels row by row, in as many columns as given (as many as the page has room for if None).

    range: where colour bars end, one of RANGES: with "shared", panels of one unit end at the largest maximum of them,
    and with "shares" each is drawn in shares of its own.  crop: without empty space around shapes and at the edges.
    title: where panels have their names, one of TITLES; font: a family, "" for the usual one; text: the size of labels
    in points, all other words in proportion, the usual one if None; is_moving: one of the pictures of a movie, in all
    of which insets stand in the same places; is_of_set: one of several figures whose colours end alike, so that its own
    maximum is said; remarks: sentences on what could not be shown.
    legend: under all panels, on a page whose height follows from them; dashes_all: marks that the shape hides are
    dashed even where another view of their panel shows them.
    """

    panels: tuple[FigurePanel, ...]
    columns: int | None = None
    size: Size = USUAL
    style: Style = PAPER
    range: str = "own"
    transparent: bool = False
    crop: bool = False
    title: str = "heading"
    font: str = ""
    text: float | None = None
    is_moving: bool = False
    is_of_set: bool = False
    remarks: tuple[str, ...] = ()
    legend: tuple[Entry, ...] = ()
    dashes_all: bool = True

    def __post_init__(self) -> None:
        if not self.panels:
            raise ParameterError("A figure needs at least one panel.")
        if self.columns is not None and self.columns < 1:
            raise ParameterError(f"A figure has at least one column, not {self.columns}.")
        if self.legend and self.size.height is not None:
            raise ParameterError("A page with a legend is as high as it needs to be: its size has no height.")
        one_of(self.range, RANGES, "range")
        one_of(self.title, TITLES, "title")
        check_font(self.font)
        kinds = [kind for kind in map(_kind, self.panels) if kind]
        if self.range == "shared" and len(kinds) > 1 and len(set(kinds)) == len(kinds):
            units = ", ".join(sorted({unit or "none" for unit, _ in kinds}))
            raise ParameterError(
                f"Panels in different units ({units}) cannot share a range; "
                "with --range shares (in Python range='shares') they have one bar, in fractions of each maximum."
            )

    @property
    def grid(self) -> tuple[int, int]:
        """Rows and columns."""
        columns = min(self.columns or len(self.panels), len(self.panels))
        return -(-len(self.panels) // columns), columns

    def tops(self) -> list[float]:
        """The end of each panel's colours."""
        own = [p.top for p in self.panels]
        if self.range == "own":
            return own
        kinds = [_kind(p) for p in self.panels]
        return [
            own[k] if self.is_in_shares(k) else max(end for end, other in zip(own, kinds, strict=True) if other == kind)
            for k, kind in enumerate(kinds)
        ]

    def is_in_shares(self, panel: int) -> bool:
        """Whether a bar reads shares of its end; a difference keeps its unit, and ends as others of it do."""
        return self.range == "shares" and not self.panels[panel].largest

    @property
    def has_one_bar(self) -> bool:
        """Whether one colour bar serves all panels."""
        return self.range != "own" and len({kind for kind in map(self._bar_kind, range(len(self.panels))) if kind}) == 1

    def _bar_kind(self, panel: int) -> tuple[str, ...] | None:
        each = self.panels[panel]
        kind = _kind(each)
        return kind if kind is None or not self.is_in_shares(panel) else ("", *kind[1:])


def _kind(panel: FigurePanel) -> tuple[str, ...] | None:
    """What two panels have alike if one colour bar can serve both; None without a field."""
    if panel.field is None:
        return None
    return (panel.unit, "a difference" if panel.largest else "signed" if panel.signed else "")
