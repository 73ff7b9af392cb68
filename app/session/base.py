"""The scalars in grey under isolines, as shares from light to dark."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.analysis.curvature import mean_curvature
from bihdist_core.arrays import FloatArray
from bihdist_core.errors import ParameterError
from bihdist_core.surface import Surface

from ..document.document import Document, Panel
from ..document.looks import Base
from ..document.quantities import OwnField

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh

SMOOTHED, MOST_ROUNDS = 0.025, 20
"""The share of the shape's diagonal over which curvature is smoothed, and the most rounds of averages over neighbours:
FreeSurfer takes ten at 1 mm."""

OUTLIERS = 2.0
"""Percent of the vertices at either end beyond which greys no longer change."""


@dataclass(frozen=True, eq=False)
class Greys:
    """A grey for each vertex.

    Attributes
    ----------
    shares
        (n,) from 0, light, to 1, dark.
    are_two
        Whether all below one half is light and all above dark.
    """

    shares: FloatArray
    are_two: bool


def no_scalars(name: str) -> str:
    """Return a sentence on a field that cannot be a base."""
    return f"{name} has labels; a base has values, such as curvature."


class BaseGreys:
    """The greys of a surface's base that was asked for last, on any thread."""

    def __init__(self) -> None:
        self._last: tuple[object, Greys | None] = (None, None)

    def keep(self, areas: str, wanted: object) -> None:
        """Keep them: they depend on no distance."""

    def greys(self, document: Document, panel: Panel, loaded: LoadedMesh) -> Greys | None:
        """Return the greys of a panel; None without a base, with that of another surface, and where it is the field."""
        base = document.base
        field = next((each for each in document.fields if each.name == base.scalars), None)
        if not base.scalars or (field is not None and field.surface != panel.surface):
            return None
        if panel.shows == OwnField(base.scalars):
            return None
        key = base.gradual, field and field.sha256, document.areas
        if self._last[0] != key:
            laplacian = loaded.distances(document.areas).laplacian
            curvature = _smoothed(mean_curvature(laplacian), loaded.surface)
            values = curvature if field is None else loaded.own_field(field).field
            if values is None:
                raise ParameterError(no_scalars(base.scalars))
            self._last = key, _greys(base, values, curvature, laplacian.areas)
        return self._last[1]


def _smoothed(values: FloatArray, surface: Surface) -> FloatArray:
    """Return values (n,) averaged over neighbours, as often as it takes to reach SMOOTHED: noise has no sulci."""
    edges, x = surface.edges, surface.vertices[surface.component_of_vertex >= 0]
    reach = SMOOTHED * float(np.linalg.norm(np.ptp(x, axis=0))) / surface.mean_edge_length
    count = np.bincount(edges.ravel(), minlength=len(values)) + 1
    for _ in range(int(np.clip(round(reach**2), 1, MOST_ROUNDS))):
        ends = [np.bincount(edges[:, k], values[edges[:, 1 - k]], len(values)) for k in (0, 1)]
        values = (values + ends[0] + ends[1]) / count
    return values


def _greys(base: Base, values: FloatArray, curvature: FloatArray, areas: FloatArray) -> Greys:
    """Return values as greys; those of what is concave are dark, whichever sign a file gives to sulci."""
    known = np.isfinite(values) & np.isfinite(curvature)
    weights = areas[known] * np.clip(curvature[known], *np.percentile(curvature[known], (OUTLIERS, 100 - OUTLIERS)))
    two = not base.gradual and bool(np.nanmin(values) < 0 < np.nanmax(values))
    middle = 0.0 if two else float(np.average(values[known], weights=areas[known]))
    rises = float((values[known] - middle) @ weights) > 0
    low, high = np.percentile(values[known], (OUTLIERS, 100 - OUTLIERS))
    scale = float(max(high, -low) if two else high - low) or 1.0
    shares = 0.5 + values / scale if two else (values - low) / scale
    shares = 1 - shares if rises else shares
    return Greys(np.nan_to_num(shares if two else np.clip(shares, 0, 1)), two)
