"""The description of a figure as frozen data: panels in rows and columns, and their look."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.first_view import is_flat
from bihdist_core.arrays import AnyArray, FloatArray

from ..document.camera import View, checked_view
from ..document.document import Inset
from ..document.looks import AS_IT_IS, RANGES, TWENTY_STEPS, Clip, Isolines, Shading, one_of
from ..document.page import TITLES
from ..marks.primitives import AreaMark, LineMark, PointMark
from ..scene.style import PAPER, IsolineInk, Style
from ..session.base import Greys
from .chart_look import Chart
from .fonts import check_font
from .size import Size


@dataclass(frozen=True, eq=False)
class FigurePanel:
    """One panel: a surface with a field or the bare shape, and its words.

    Attributes
    ----------
    field
        (n,) values, NaN where undefined; None for the bare shape.
    heading, hint
        Words above the panel.
    label, unit
        Words at the colour bar.
    maximum
        The end of the colour bar, the field's own if None.
    through
        Values of further isolines, which stand out.
    views
        Pictures of the panel side by side, each a standard view or a camera.
    parts
        What of the surface each view shows, with the vertex ids of the whole; all of it if there are none.
    marks, lines, areas
        Marks on the surface.
    height
        Height of a height field whose maximum is this fraction of the surface's extent; 0 for none.
    failure
        Why there is no field, to be read on the bare shape.
    signed
        Whether the field has values on both sides of 0, so that its bar goes from -maximum to maximum.
    up
        The axis that is up in standard views.
    source
        The vertex that the view from the source looks at.
    is_parallel
        Whether the projection is parallel.
    axes
        Whether the directions of x, y and z are shown, unless they are in a panel before.
    scale_unit
        Unit of the scale bar; "" for no bar.
    colours
        (n, 3) colours of the surface's own, instead of a field, grey where they are NaN.
    base
        (n,) greys instead of the colours of the field, see `session.base.Greys`.
    has_coloured_isolines
        Whether isolines on these have the colours of the field.
    are_labels
        Whether the colours stand for labels, between which there are no others.
    largest
        How large a difference is and where, in words.
    clip
        The plane beyond which the surface is cut away; None for none.
    opacity
        Of the surface, more than 0 and at most 1.
    ground
        Whether there is a shadow on the ground, beneath what is not flat.
    feature_edges
        Whether there are lines along sharp edges, whatever the style and the shading.
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
    parts: tuple[Surface, ...] = ()
    marks: tuple[PointMark, ...] = ()
    insets: tuple[Inset, ...] = ()
    warp_factor: float = 0.0
    failure: str = ""
    signed: bool = False
    shading: Shading = AS_IT_IS
    up: str = "y"
    source: int | None = None
    is_parallel: bool = False
    axes: bool = False
    scale_unit: str = ""
    lines: tuple[LineMark, ...] = ()
    areas: tuple[AreaMark, ...] = ()
    colours: FloatArray | None = None
    base: Greys | None = None
    has_coloured_isolines: bool = True
    are_labels: bool = False
    largest: str = ""
    clip: Clip | None = None
    opacity: float = 1.0
    ground: bool = False
    feature_edges: bool = False

    def __post_init__(self) -> None:
        if isinstance(self.isolines, int):
            object.__setattr__(self, "isolines", Isolines(self.isolines))  # a number of steps does
        count = len(self.surface.vertices)
        if self.field is not None and np.shape(self.field) != (count,):
            raise ParameterError(f"The field has the shape {np.shape(self.field)}; the surface has {count:,} vertices.")
        if self.colours is not None and (self.field is not None or np.shape(self.colours) != (count, 3)):
            raise ParameterError(f"A panel has a field or a colour for each of its {count:,} vertices, not both.")
        if self.maximum is not None and not 0 < self.maximum < np.inf:
            raise ParameterError(f"A colour bar ends at a positive number, not at {self.maximum!r}.")
        if not self.views:
            raise ParameterError("A panel needs at least one view.")
        for view in self.views:
            checked_view(view)
        if self.warp_factor and not is_flat(self.surface.vertices[self.surface.component_of_vertex >= 0]):
            raise ParameterError("A height field needs a flat surface, with the same z everywhere.")
        if not 0 <= self.warp_factor <= 10:
            raise ParameterError(
                f"The warp factor of a height field is a fraction of the surface's extent, not {self.warp_factor:g}."
            )
        self.surface.check_vertices([*(mark.vertex for mark in self.marks), *(zoom.vertex for zoom in self.insets)])

    @property
    def upper_limit(self) -> float:
        """The end of the colour bar; 0 if there is no field, or none that is more than 0 anywhere."""
        return self.own_maximum if self.maximum is None else self.maximum

    @property
    def own_maximum(self) -> float:
        """The field's maximum, of its absolute values if it is signed."""
        if self.field is None:
            return 0.0
        return float(np.nanmax(np.abs(self.field) if self.signed else self.field, initial=0.0))


Entry = tuple[PointMark, str]
"""An entry of a legend: a mark, whose vertex does not matter, and what such marks stand for."""

USUAL = Size()
"""As the panels want it."""


@dataclass(frozen=True, eq=False)
class Figure:
    """Panels row by row.

    Attributes
    ----------
    columns
        Number of columns; None for as many as the page has room for.
    range
        Where colour bars end, one of RANGES: with "shared", panels of one unit end at their largest maximum, and with
        "fraction" each is drawn in fractions of its own.
    crop
        Whether the empty space around shapes and at the edges is left out.
    title
        Where panels have their names, one of TITLES.
    font
        Family, "" for the usual one.
    text
        Font size of labels in points, to which all others are in proportion; None for the usual one.
    is_moving
        Whether it is a frame of a movie, in all of which insets stand in the same places.
    is_of_set
        Whether other figures' colours end alike, so that its own maximum is said.
    remarks
        Sentences on what could not be shown.
    legend
        Entries under all panels, on a page whose height follows from them; in a movie the height is that without them.
    letters
        Whether panels have letters, (a), (b), (c).
    order
        Which of the document's panels they are, if there is a document.
    row_heads, column_heads
        Headings of rows and columns, in place of those of panels.
    charts
        Charts at the end of each row, one below the other.
    dashes_all
        Whether marks that the shape hides are dashed even if another view of their panel shows them.
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
    letters: bool = False
    order: tuple[int, ...] = ()
    row_heads: tuple[str, ...] = ()
    column_heads: tuple[str, ...] = ()
    charts: tuple[tuple[Chart, ...], ...] = ()

    def __post_init__(self) -> None:
        if not self.panels:
            raise ParameterError("A figure needs at least one panel.")
        if self.columns is not None and self.columns < 1:
            raise ParameterError(f"A figure has at least one column, not {self.columns}.")
        if self.legend and self.size.height is not None and not self.is_moving:
            raise ParameterError("The height of a page with a legend follows from what is on it; give its width only.")
        one_of(self.range, RANGES, "range")
        one_of(self.title, TITLES, "title")
        check_font(self.font)
        kinds = [kind for kind in map(_kind, self.panels) if kind]
        if self.range == "shared" and len(kinds) > 1 and len(set(kinds)) == len(kinds):
            units = ", ".join(sorted({unit or "none" for unit, _ in kinds}))
            raise ParameterError(
                f"Panels in different units ({units}) cannot share a range; "
                "with --clim fraction (in Python clim='fraction') they have one bar, in fractions of each maximum."
            )

    @property
    def grid(self) -> tuple[int, int]:
        """The number of rows and columns."""
        columns = min(self.columns or len(self.panels), len(self.panels))
        return -(-len(self.panels) // columns), columns

    @property
    def has_shadows(self) -> bool:
        """Whether shadows are drawn, on the shape or on the ground."""
        return self.style.occlusion > 0 or any(panel.ground for panel in self.panels)

    def upper_limits(self) -> list[float]:
        """Return the end of each panel's colours."""
        own = [p.upper_limit for p in self.panels]
        if self.range == "own":
            return own
        kinds = [_kind(p) for p in self.panels]
        return [
            own[k] if self.is_in_shares(k) else max(end for end, other in zip(own, kinds, strict=True) if other == kind)
            for k, kind in enumerate(kinds)
        ]

    def isoline_ink(self, panel: int, value: float, is_through: bool) -> IsolineInk:
        """Return the colours of a panel's isoline."""
        shown = self.panels[panel]
        on_base = shown.base is not None
        share = value / self.upper_limits()[panel] if on_base and shown.has_coloured_isolines else None
        return self.style.isoline_ink(shown.signed, value, is_through, on_base, share)

    def is_in_shares(self, panel: int) -> bool:
        """Return whether a bar shows fractions of its end; a difference keeps its unit, and ends as others of it do."""
        return self.range == "fraction" and not self.panels[panel].largest

    @property
    def has_one_bar(self) -> bool:
        """True if one colour bar serves all panels."""
        return self.range != "own" and len({kind for kind in map(self._bar_kind, range(len(self.panels))) if kind}) == 1

    def _bar_kind(self, panel: int) -> tuple[str, ...] | None:
        each = self.panels[panel]
        kind = _kind(each)
        return kind if kind is None or not self.is_in_shares(panel) else ("", *kind[1:])


def _kind(panel: FigurePanel) -> tuple[str, ...] | None:
    """Return the value that two panels share if one colour bar can serve both; None without a field."""
    if panel.field is None:
        return None
    return (panel.unit, "a difference" if panel.largest else "signed" if panel.signed else "")
