"""What is marked on a surface: frozen, of vertices and faces, with no positions and no pixels."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray, IntArray

from .glyphs import DISC, Glyph
from .line_looks import SOURCE, LineLook


@dataclass(frozen=True)
class PointMark:
    """A vertex, or a place in a face with these corners and weights, of which the vertex is one.

    colour: such as "#1F7A3D", or a name that `Style.named` knows.  text: stands beside it; value: too, where values are
    asked for.  aside: behind the text, less loud.  number: stands in glyphs that have room for one.  name: in
    sentences, its vertex or its number if empty.  point: the name of the document's point that is there, if one is.
    is_handle: in the window it can be dragged, though it lies flat.
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
        """(3,) where it is on a surface with these vertices (n, 3)."""
        at: FloatArray = vertices[self.vertex]
        if self.corners:
            at = np.array(self.weights) @ vertices[list(self.corners)]
        return at


@dataclass(frozen=True, eq=False)
class LineMark:
    """A line on a surface through k places, whose neighbours share a face.

    corners (k, 3): vertices of a face that holds each; weights (k, 3): of these.  is_closed: the last joins the first.
    name: in sentences, if it is of a source.
    """

    corners: IntArray
    weights: FloatArray
    is_closed: bool = False
    look: LineLook = SOURCE
    name: str = ""

    def positions(self, vertices: FloatArray) -> FloatArray:
        """(k, 3) on a surface whose vertices are at (n, 3)."""
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
        """(k, 3) the vertices that have a weight, of a place on an edge or in a corner one of them twice or thrice."""
        has = self.weights > 0
        some = np.take_along_axis(self.corners, has.argmax(axis=1)[:, None], axis=1)
        spans: IntArray = np.where(has, self.corners, some)
        return spans


@dataclass(frozen=True, eq=False)
class AreaMark:
    """Vertices (k,) that stand out, with a rim around them and hatching in a colour such as "#1F7A3D"."""

    vertices: IntArray
    colour: str

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, AreaMark)
            and self.colour == other.colour
            and np.array_equal(self.vertices, other.vertices)
        )

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True)
class LegendRow:
    """What a glyph stands for, where it has no number of its own: said in the corner of a view in the window."""

    glyph: Glyph
    text: str


@dataclass(frozen=True)
class Remark:
    """A sentence on what cannot be marked."""

    text: str


@dataclass(frozen=True)
class Caption:
    """What stands at a panel besides its field.

    sentence: in place of the colour bar, and the same in fewer words, the first for which there is room.  value: at the
    bar while nothing is pointed at, with the words for its unit.  plain: the name of a surface that is shown as it is.
    """

    sentence: tuple[str, ...] = ()
    value: float | None = None
    unit: str = ""
    plain: str = ""


SurfaceMark = PointMark | LineMark | AreaMark | LegendRow | Remark | Caption
