"""Extrema of a field away from its source, where a distance has none but those that the shape makes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..sources.pieces import pieces_of
from ..sources.source import Source
from ..surface import Surface
from .persistence import extrema


@dataclass(frozen=True, eq=False)
class OtherExtrema:
    """The extrema of a field away from its source, the most persistent first.

    minima, maxima: (k,) vertices.  minima_depth, maxima_height: (k,) their persistence over the field's range; no unit.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> found = bihdist.other_extrema(sphere, field, 0)
    >>> found.minima.tolist(), found.maxima.tolist(), found.maxima_height.tolist()
    ([], [2], [1.0])
    """

    minima: IntArray
    minima_depth: FloatArray
    maxima: IntArray
    maxima_height: FloatArray

    @property
    def vertices(self) -> IntArray:
        """(k,) vertices of all minima, then of all maxima.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
        >>> bihdist.other_extrema(sphere, field, 0).vertices.tolist()
        [2]
        """
        return np.concatenate([self.minima, self.maxima])


def other_extrema(surface: MeshLike, field: npt.ArrayLike, source: Source | None, share: float = 1e-3) -> OtherExtrema:
    """The extrema of a field (n,) away from its source that persist over at least `share` of its range.

    source: None for a field that starts nowhere, all extrema of which count.  Raises VertexError or ParameterError for
    a bad source, ParameterError for a field of another shape or with nothing but one value.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> # a height, with a bump at the side
    >>> field = sphere.points[:, 2] + 0.3 * (sphere.points[:, 0] > 0.9)
    >>> found = bihdist.other_extrema(sphere, field, None)
    >>> len(found.minima), len(found.maxima)
    (1, 2)
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    touched = np.empty(0, np.int64) if source is None else pieces_of(source, surface).touched
    found = extrema(surface, f, share)
    finite = f[np.isfinite(f)]
    if not len(finite) or not np.ptp(finite) > 0:
        raise ParameterError("The quality of a field needs values that differ.")
    span = float(np.ptp(finite))
    low, high = (~np.isin(ids, touched) for ids in (found.minima, found.maxima))
    return OtherExtrema(
        found.minima[low],
        found.minima_persistence[low] / span,
        found.maxima[high],
        found.maxima_persistence[high] / span,
    )
