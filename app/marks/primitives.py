"""What tools say is to be seen on a surface: frozen, of vertices and faces, with no positions and no pixels."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray

from .glyphs import DISC, Glyph


@dataclass(frozen=True)
class PointMark:
    """A vertex, or a place in a face with these corners and weights, of which the vertex is one.

    colour: such as "#1F7A3D", or a name that `Style.named` knows.  text: stands beside it.  number: stands in glyphs
    that have room for one.  name: in sentences, its vertex or its number if empty.
    """

    vertex: int
    glyph: Glyph = DISC
    colour: str = "source"
    text: str = ""
    number: int | None = None
    corners: tuple[int, ...] = ()
    weights: tuple[float, ...] = ()
    name: str = ""

    def on(self, vertices: FloatArray) -> FloatArray:
        """(3,) where it is on a surface with these vertices (n, 3)."""
        at: FloatArray = vertices[self.vertex]
        if self.corners:
            at = np.array(self.weights) @ vertices[list(self.corners)]
        return at
