"""Places on a surface: vertices, or points in faces given by barycentric weights."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import ParameterError
from ..sources.splitting import Split, split_at
from ..surface import Surface

Place = int | Sequence[float]
"""A vertex id, or (face, b0, b1): a point of a face by the weights of its first two corners; the third's is the
rest."""

ON_SIDE = 1e-12
"""A weight below this is 0: the place is on a side of its face, or in a corner."""

APART = 1e-9
"""Where a surface is split, weights below this are 0, and so places this near to each other are one."""


@dataclass(frozen=True, eq=False)
class Places:
    """k places on a surface: faces (k,), the ids of their corners (k, 3), and weights (k, 3), at least 0, of sum 1."""

    faces: np.ndarray
    corners: np.ndarray
    weights: np.ndarray

    @classmethod
    def of(cls, surface: Surface, places: Sequence[Place]) -> "Places":
        """Vertex ids and points in faces, checked.

        Raises VertexError for a bad vertex; ParameterError for a face that does not exist, or weights that are not
        three numbers of at least 0 and of sum 1.
        """
        if not len(places):
            raise ParameterError("No places were given; at least one is needed.")
        found = [_checked(surface, place) for place in places]
        faces = np.array([face for face, _ in found], np.int64)
        return cls(faces, surface.faces[faces], np.array([weights for _, weights in found]))

    def __len__(self) -> int:
        return len(self.faces)

    def split(self, surface: Surface) -> Split:
        """Their surface with vertices at them."""
        return split_at(surface, self.faces, self.weights, APART)

    def values(self, field: npt.ArrayLike) -> np.ndarray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, interpolated linearly."""
        return weighted(np.asarray(field), self.corners, self.weights)


def weighted(at: np.ndarray, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(k,) or (k, d): sums over corners (k, 3) of values `at` them; those of weight 0 do not count, finite or not."""
    w = weights.reshape(*weights.shape, *(1,) * (at.ndim - 1))
    return (w * np.where(w > 0, at[corners], 0)).sum(axis=1)


def _checked(surface: Surface, place: Place) -> tuple[int, np.ndarray]:
    if np.ndim(place) == 0:
        vertex = surface.check_vertex(place)  # type: ignore[arg-type]
        face = int(np.flatnonzero((surface.faces == vertex).any(axis=1))[0])
        return face, (surface.faces[face] == vertex).astype(np.float64)
    words = np.asarray(place, np.float64)
    m = len(surface.faces)
    if words.shape not in ((3,), (4,)) or not np.isfinite(words).all():
        raise ParameterError(f"{place!r} is no place; one is a vertex id, or (face, b0, b1), or (face, b0, b1, b2).")
    if not 0 <= words[0] < m or words[0] % 1:
        raise ParameterError(f"{surface.name} has no face {words[0]:g}; faces run from 0 to {m - 1}.")
    weights = words[1:] if len(words) == 4 else np.append(words[1:], 1 - words[1] - words[2])
    if (weights < -ON_SIDE).any() or abs(weights.sum() - 1) > 1e-9:
        raise ParameterError(
            f"The weights of a place in face {words[0]:g} are {', '.join(f'{w:g}' for w in weights)}; "
            "they must be at least 0, with the sum 1."
        )
    weights = np.where(weights <= ON_SIDE, 0, weights)
    return int(words[0]), weights / weights.sum()
