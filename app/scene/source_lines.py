"""Sources that are lines, as lines: their pieces one after another."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.analysis.chains import chains
from bihdist_core.sources.pieces import Pieces

WIDTH, RIM = 3.5, 1.25
"""Pixels: of a line, and of its dark rim on both sides."""


@dataclass(frozen=True, eq=False)
class SourceLine:
    """Places (k) of a line, whose neighbours share a face.

    corners (k, 3): vertices of a face that holds each; weights (k, 3): of these.  is_closed: the last joins the first.
    name: in sentences, if it is of a source.
    """

    corners: np.ndarray
    weights: np.ndarray
    is_closed: bool
    name: str = ""

    def positions(self, vertices: np.ndarray) -> np.ndarray:
        """(k, 3) on a surface whose vertices are at (n, 3)."""
        return np.einsum("kc,kcx->kx", self.weights, vertices[self.corners])

    @property
    def spans(self) -> np.ndarray:
        """(k, 3) the vertices that have a weight, of a place on an edge or in a corner one of them twice or thrice."""
        has = self.weights > 0
        some = np.take_along_axis(self.corners, has.argmax(axis=1)[:, None], axis=1)
        return np.where(has, self.corners, some)


def source_lines(pieces: Pieces, name: str = "") -> list[SourceLine]:
    """The lines that the parts of lines among some pieces make; name: of each."""
    lines = pieces.lines
    corners = np.concatenate([lines.corners, lines.corners])
    weights = np.concatenate([lines.start, lines.stop])
    numbers: dict[tuple, int] = {}
    places: list[int] = []
    of = []
    for row, (ids, shares) in enumerate(zip(corners.tolist(), weights.tolist(), strict=True)):
        key = tuple(sorted((id, share) for id, share in zip(ids, shares, strict=True) if share > 0))
        if key not in numbers:
            numbers[key] = len(places)
            places.append(row)
        of.append(numbers[key])
    segments = np.array(of, np.int64).reshape(2, -1).T
    segments = segments[segments[:, 0] != segments[:, 1]]
    found = chains(segments) if len(segments) else []
    at = np.array(places, np.int64)
    return [SourceLine(corners[at[ids]], weights[at[ids]], closed, name) for ids, closed in found]
