"""Kinks of a distance field: edges away from its source at which its gradient jumps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import IntArray
from ..surface import Surface
from .circles import small_radius
from .diagnostics import GradientJumps, gradient_jumps


def inner_jumps(
    surface: Surface, field: npt.ArrayLike, near: npt.ArrayLike, radius: float | None = None
) -> GradientJumps:
    """The jumps of a field's gradient across edges where `near` (n,), a distance, exceeds a radius at both ends, the
    small one by default.

    Every distance has a kink at its source, and at corners of the boundary the gradient of smooth fields is singular:
    so also a band along the boundary is left out.
    """
    # Not at the top: it would double what `import bihdist_core.analysis.kinks` takes.
    from scipy.spatial import cKDTree

    jumps = gradient_jumps(surface, field)
    radius = small_radius(surface) if radius is None else radius
    away = np.asarray(near) > radius
    rim = np.unique(surface.boundary_edges)
    if len(rim):
        away &= cKDTree(surface.vertices[rim]).query(surface.vertices)[0] > radius
    inner = away[jumps.edges].all(axis=1) & np.isfinite(jumps.jumps)
    return GradientJumps(jumps.edges[inner], jumps.jumps[inner], jumps.lengths[inner], jumps.slope)


@dataclass(frozen=True, eq=False)
class Kink:
    """The kinks of a field away from its source: see `FieldQuality`."""

    largest: float
    edge: IntArray
    length: float


def kinks(surface: Surface, field: npt.ArrayLike, near: npt.ArrayLike, radius: float | None = None) -> Kink:
    """How sharp a field (n,) is folded where `near` (n,), a distance from its source, exceeds a radius, the small one
    by default."""
    jumps = inner_jumps(surface, field, near, radius)
    # Around smooth extrema the gradient is short, and any jump long beside it.
    folds = jumps.jumps / np.maximum(jumps.lengths, jumps.slope) if jumps.slope > 0 else 0 * jumps.jumps
    ends = surface.vertices[jumps.edges]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    length = float(lengths[folds >= 1].sum() / np.sqrt(surface.face_areas.sum()))
    if not len(folds):
        return Kink(0.0, np.array([-1, -1]), length)
    worst = int(folds.argmax())
    return Kink(float(folds[worst]), jumps.edges[worst], length)
