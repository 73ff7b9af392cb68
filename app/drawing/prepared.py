"""What the window's panels need of a surface, all made in the background when a mesh is loaded.

Without VTK at the top: the window opens before that is imported.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from bihdist_core import Surface

FITTED = 20_000
"""How many points the camera is fitted to."""


@dataclass(frozen=True, eq=False)
class Prepared:
    """A mesh to draw and a picker; of the vertices that have a face some points (k, 3) to fit the camera to, and the
    bounds (x, x, y, y, z, z)."""

    mesh: Any
    picker: Any
    points: np.ndarray
    bounds: tuple[float, ...]


def prepare(surface: Surface) -> Prepared:
    """What the panels need of the surface; on any thread."""
    from .picking import Picker
    from .scene import drawable

    shown = surface.vertices[surface.component_of_vertex >= 0]
    bounds = tuple(float(end) for x in shown.T for end in (x.min(), x.max()))
    # The camera is fitted on the window's thread: some of the points of a large mesh do as well.
    return Prepared(drawable(surface), Picker(surface), shown[:: max(1, len(shown) // FITTED)], bounds)
