"""Marks on a surface: frozen, of vertices and faces, with no positions and no pixels."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.counts import counted

from ..drawing.glyphs import DISC, SOURCE, Glyph, LineLook


@dataclass(frozen=True)
class PointMark:
    """A mark at a vertex, or at a place in a face with these corners and weights, of which the vertex is one.

    Attributes
    ----------
    colour
        Such as "#1F7A3D", or a name that `Style.named` knows.
    text, aside
        Words beside the mark, and quieter ones after them.
    value
        The value or name to write where these are asked for.
    number
        Stands in glyphs that have room for one.
    name
        In sentences; its vertex or its number if empty.
    point
        The name of the document's point at this place, if there is one.
    is_handle
        Whether it can be dragged in the window though it lies flat.
    """

    vertex: int
    glyph: Glyph = DISC
    colour: str = "source"
    text: str = ""
    number: int | None = None
    corners: tuple[int, ...] = ()
    weights: tuple[float, ...] = ()
    name: str = ""
    value: str = ""
    aside: str = ""
    point: str = ""
    is_handle: bool = False

    def on(self, vertices: FloatArray) -> FloatArray:
        """Return the mark's position (3,) on a surface with vertices (n, 3)."""
        at: FloatArray = vertices[self.vertex]
        if self.corners:
            at = np.array(self.weights) @ vertices[list(self.corners)]
        return at

    @property
    def title(self) -> str:
        """What sentences call the mark."""
        return self.name or (f"Pin {self.number}" if self.number is not None else f"Vertex {self.vertex}")


def cut_away_words(marks: Sequence[PointMark], lines: Sequence[str] = ()) -> str:
    """Return a sentence on marks and named lines that are cut away, one or more; it names pins last."""
    titles = [*lines, *(mark.title for mark in sorted(marks, key=lambda mark: mark.number is not None))]
    others = f" and {counted(len(titles) - 1, 'other mark')} are" if len(titles) > 1 else " is"
    return f"{titles[0]}{others} cut away by the clip plane."


@dataclass(frozen=True, eq=False)
class LineMark:
    """A line on a surface through k places, whose neighbours share a face.

    Attributes
    ----------
    corners, weights
        (k, 3) vertices of a face that holds each place, and its barycentric weights.
    is_closed
        Whether the last place joins the first.
    name
        In sentences, if it belongs to a source.
    """

    corners: IntArray
    weights: FloatArray
    is_closed: bool = False
    look: LineLook = SOURCE
    name: str = ""

    def positions(self, vertices: FloatArray) -> FloatArray:
        """Return the line's places (k, 3) on a surface with vertices (n, 3)."""
        at: FloatArray = np.einsum("kc,kcx->kx", self.weights, vertices[self.corners])
        return at

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, LineMark)
            and (self.is_closed, self.look, self.name) == (other.is_closed, other.look, other.name)
            and np.array_equal(self.corners, other.corners)
            and np.array_equal(self.weights, other.weights)
        )

    __hash__ = None  # type: ignore[assignment]

    @property
    def spans(self) -> IntArray:
        """The vertices (k, 3) that have a weight; on an edge or in a corner, one of them twice or three times."""
        has = self.weights > 0
        some = np.take_along_axis(self.corners, has.argmax(axis=1)[:, None], axis=1)
        spans: IntArray = np.where(has, self.corners, some)
        return spans


@dataclass(frozen=True, eq=False)
class AreaMark:
    """Vertices (k,) that stand out, with a rim around them and hatching.

    Attributes
    ----------
    colour
        Such as "#1F7A3D".
    name
        Name of the selection.
    """

    vertices: IntArray
    colour: str
    name: str = ""

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, AreaMark)
            and (self.colour, self.name) == (other.colour, other.name)
            and np.array_equal(self.vertices, other.vertices)
        )

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True)
class LegendRow:
    """The meaning of a glyph without a number of its own, for the corner of a view in the window.

    Attributes
    ----------
    colour
        Of the mark, as `PointMark` has it; "" for a glyph in quiet lines.
    """

    glyph: Glyph
    text: str
    colour: str = ""


@dataclass(frozen=True)
class Remark:
    """A sentence on what cannot be marked."""

    text: str


@dataclass(frozen=True)
class Caption:
    """Words at a panel besides its field.

    Attributes
    ----------
    sentence
        A sentence in place of the colour bar, and the same in fewer words, the first for which there is room.
    value, unit
        The value at the bar while nothing is pointed at, and the words for its unit.
    plain
        The name of a surface that is shown without a field.
    """

    sentence: tuple[str, ...] = ()
    value: float | None = None
    unit: str = ""
    plain: str = ""


SurfaceMark = PointMark | LineMark | AreaMark | LegendRow | Remark | Caption
