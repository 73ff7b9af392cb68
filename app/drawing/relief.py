"""Flat surfaces as reliefs of a field."""

import numpy as np

from bihdist_core import Surface


def relief(surface: Surface, field: np.ndarray, top: float, height: float) -> Surface:
    """A flat surface raised along z by a field (n,), by `height` of its extent where that is `top`; not where NaN."""
    x = surface.vertices
    share = np.nan_to_num(field / top) if top > 0 else np.zeros(len(x))
    return Surface(np.column_stack([x[:, :2], x[:, 2] + rise(surface, height) * share]), surface.faces, surface.name)


def rise(surface: Surface, height: float) -> float:
    """How far up a relief goes."""
    used = surface.vertices[surface.component_of_vertex >= 0]
    return height * float(np.ptp(used, axis=0).max())
