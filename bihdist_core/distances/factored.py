"""Distances that one factorization gives, with nothing else to choose."""

from __future__ import annotations

import numpy.typing as npt

from ..laplacian import Laplacian
from ..mesh_like import MeshLike, Rows
from ..progress import Progress
from .distance import Distance


class FactoredDistance(Distance):
    """A distance by the factor of the Laplacian.

    laplacian: a Laplacian, or a mesh of any kind that `Surface.of` takes, of which vertices (n, 3) may be followed by
    their faces (m, 3).
    """

    is_quadratic = True

    def __init__(
        self,
        laplacian: Laplacian | MeshLike | Rows,
        faces: npt.ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None:
        super().__init__(laplacian, faces)
        self.prepare(self.laplacian.components[0], progress)
