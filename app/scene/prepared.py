"""Data that the window's panels need of a surface, all made in the background when a mesh is loaded.

Without VTK at the top: the window opens before that is imported.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, FloatArray

from ..document.looks import AS_IT_IS, Shading

FITTED = 20_000
"""How many points the camera is fitted to."""

SAMPLES = 5_000
"""How many places tell what part of a view the surface covers."""


@dataclass(frozen=True, eq=False)
class Prepared:
    """Meshes to draw, a picker, and what the camera needs to know of a surface.

    Attributes
    ----------
    meshes
        By shading; the usual one is ready.
    points, bounds
        (k, 3) vertices of faces, to which the camera is fitted, and their bounds (x, x, y, y, z, z).
    samples
        (SAMPLES, 3) places on the faces, as many for equal areas.
    is_flat
        Whether it can become a height field.
    """

    meshes: "Meshes"
    picker: Any
    points: FloatArray
    bounds: tuple[float, ...]
    samples: FloatArray
    is_flat: bool


class Meshes:
    """The meshes of a surface by shading, each with its stand-in; the usual one and the last are kept.

    They are asked for and kept on the view's thread, and made on any.
    """

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        self.usual = self.made(AS_IT_IS)
        self.light: AnyArray | None = None
        """The share of the light that reaches each vertex (n,), if it was asked for."""
        self._last = self.usual

    def ready(self, shading: Shading) -> "Drawn | None":
        """Return the mesh for a shading, None if it has not been made."""
        key = _key(shading)
        return next((made for made in (self.usual, self._last) if made.shading == key), None)

    def make(self, shading: Shading) -> "Drawn":
        """Return the mesh for a shading, made now if it is not ready."""
        return self.ready(shading) or self.keep(self.made(shading))

    def keep(self, drawn: "Drawn") -> "Drawn":
        """Keep and return a mesh that was made elsewhere."""
        self._last = drawn
        return drawn

    def made(self, shading: Shading) -> "Drawn":
        """Make the mesh for a shading without keeping it."""
        from .drawable import drawable
        from .stand_in import stand_in

        mesh = drawable(self.surface, shading)
        return Drawn(_key(shading), mesh, stand_in(mesh))


@dataclass(frozen=True, eq=False)
class Drawn:
    """A mesh for VTK, and what is drawn instead of it while the camera moves, if it is large."""

    shading: Shading
    mesh: Any
    stand_in: Any


def _key(shading: Shading) -> Shading:
    from .drawable import normals_shading

    return normals_shading(shading)


def prepare(surface: Surface) -> Prepared:
    """Prepare a surface for the panels; on any thread."""
    from bihdist_core.analysis.first_view import is_flat

    from .picking import Picker

    shown = surface.vertices[surface.component_of_vertex >= 0]
    bounds = tuple(float(end) for x in shown.T for end in (x.min(), x.max()))
    # The camera is fitted on the window's thread: some of the points of a large mesh do as well.
    points = shown[:: max(1, len(shown) // FITTED)]
    picker = Picker(surface)
    _ = picker.blocks  # made here, and not at the first pick
    return Prepared(
        Meshes(surface), picker, points, bounds, _samples(surface.shape), surface.shape is surface and is_flat(shown)
    )


def _samples(surface: Surface) -> FloatArray:
    """Return places (SAMPLES, 3) on the faces."""
    random = np.random.default_rng(0)
    upto = np.cumsum(surface.face_areas)
    faces = np.searchsorted(upto, random.uniform(0, upto[-1], SAMPLES))
    weights = random.dirichlet(np.ones(3), SAMPLES)
    samples: FloatArray = np.einsum(
        "ij,ijk->ik", weights, surface.vertices[surface.faces[np.minimum(faces, len(upto) - 1)]]
    )
    return samples
