"""Flat surfaces as reliefs of a field."""

from collections.abc import Sequence

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray


def warp_by_scalar(surface: Surface, field: FloatArray, top: float, up: float) -> Surface:
    """A flat surface raised along z by a field (n,), by `up` where that is `top` or more; not where it is NaN."""
    x = surface.vertices
    share = np.clip(np.nan_to_num(field / top), -1, 1) if top > 0 else np.zeros(len(x))
    return Surface(np.column_stack([x[:, :2], x[:, 2] + up * share]), surface.faces, surface.name)


def rise(bounds: Sequence[float], height: float) -> float:
    """How far up a height field goes: `height` of the longest side of the surface's bounds (x, x, y, y, z, z)."""
    return height * max(high - low for low, high in zip(bounds[::2], bounds[1::2], strict=True))
