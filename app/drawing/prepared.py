"""What the window's panels need of a surface, all made in the background when a mesh is loaded.

Without VTK at the top: the window opens before that is imported.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from bihdist_core import Surface

FITTED = 20_000
"""How many points the camera is fitted to."""

SAMPLES = 5_000
"""How many places tell what part of a view the surface covers."""


@dataclass(frozen=True, eq=False)
class Prepared:
    """A mesh to draw and a picker.

    points: (k, 3) of the vertices that have a face, to fit the camera to, and their bounds (x, x, y, y, z, z).
    samples: (SAMPLES, 3) on the faces, as many for equal areas.  is_flat: whether it can become a relief.
    """

    mesh: Any
    picker: Any
    points: np.ndarray
    bounds: tuple[float, ...]
    samples: np.ndarray
    is_flat: bool


def prepare(surface: Surface) -> Prepared:
    """What the panels need of the surface; on any thread."""
    from .camera import is_flat
    from .picking import Picker
    from .scene import drawable

    shown = surface.vertices[surface.component_of_vertex >= 0]
    bounds = tuple(float(end) for x in shown.T for end in (x.min(), x.max()))
    # The camera is fitted on the window's thread: some of the points of a large mesh do as well.
    points = shown[:: max(1, len(shown) // FITTED)]
    return Prepared(drawable(surface), Picker(surface), points, bounds, _samples(surface), is_flat(shown))


def _samples(surface: Surface) -> np.ndarray:
    """(SAMPLES, 3) places on the faces."""
    random = np.random.default_rng(0)
    upto = np.cumsum(surface.face_areas)
    faces = np.searchsorted(upto, random.uniform(0, upto[-1], SAMPLES))
    weights = random.dirichlet(np.ones(3), SAMPLES)
    return np.einsum("ij,ijk->ik", weights, surface.vertices[surface.faces[np.minimum(faces, len(upto) - 1)]])
