"""Voronoi regions on a surface: of k fields, which is the least where, and the boundaries between.

The fields are linear on each face, so there the least of them is the lower envelope of k linear functions: regions are
convex polygons in each face, and their boundaries segments that meet in points.  All is exact but for rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..surface import Surface, with_faces
from .clipping import clipped, polygon_fractions

CHUNK = 1 << 18
"""Faces or segments treated at a time, over the number of fields, which bounds the memory."""

TIED = 1e-13
"""Below this fraction of its values in the face, a difference of fields along a segment is 0 but for rounding."""


@dataclass(frozen=True, eq=False)
class Regions:
    """Voronoi regions of k fields, numbered from 0; where fields are equal, the first counts as the least.

    Attributes
    ----------
    labels : (n,) int64 ndarray
        The region of each vertex, -1 where no field has a value.
    areas : (k,) float64 ndarray
        Areas of the regions, in the mesh's unit squared.
    segments : (s, 2, 3) float64 ndarray
        The ends of boundary segments, each in one face between two regions. A segment along an edge of the mesh is
        listed once, in one of the edge's faces.
    between : (s, 2) int64 ndarray
        The regions beside each segment, the smaller number first.
    faces : (s,) int64 ndarray
        The face of each segment.
    weights : (s, 2, 3) float64 ndarray
        Barycentric weights of the ends in that face.
    cut_by : (s, 2) int64 ndarray
        The third region that each end meets inside the face; -1 where the segment ends at the face's rim.
    meetings : (q, 3) float64 ndarray
        Points where three regions meet inside a face.
    of_meetings : (q, 3) int64 ndarray
        These regions, ascending.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
    >>> regions = bihdist.voronoi_regions(plane, fields)
    >>> regions.areas.round(6).tolist(), regions.lengths.sum().round(6).item()
    ([0.5, 0.5], 1.0)
    """

    labels: IntArray
    areas: FloatArray
    segments: FloatArray
    between: IntArray
    faces: IntArray
    weights: FloatArray
    cut_by: IntArray
    meetings: FloatArray
    of_meetings: IntArray

    @property
    def lengths(self) -> FloatArray:
        """Lengths (s,) of the boundary segments, in the mesh's unit.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
        >>> regions = bihdist.voronoi_regions(plane, fields)
        >>> print(f"{regions.lengths.sum():.3f} in {len(regions.lengths)} segments")
        1.000 in 15 segments
        """
        lengths: FloatArray = np.linalg.norm(self.segments[:, 1] - self.segments[:, 0], axis=1)
        return lengths


def voronoi_regions(surface: MeshLike, columns: npt.ArrayLike) -> Regions:
    """Divide a surface into the regions where each of several fields is the least.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    columns : (n, k) array_like
        Fields, linear on each face, such as the distances from k vertices. What is not finite is no value: there the
        other fields compete, and a face with a corner at which a field has none is not in that field's region.

    Returns
    -------
    Regions
        The regions, exact but for rounding.

    Raises
    ------
    ParameterError
        For fields of another shape, or none.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> fields = bihdist.BiharmonicDistance(sphere).from_sources([0, 1, 2])
    >>> regions = bihdist.voronoi_regions(sphere, fields)
    >>> regions.areas.round(2).tolist(), regions.labels[[0, 1, 2]].tolist()
    ([5.15, 3.13, 4.23], [0, 1, 2])
    """
    surface = with_faces(surface, "regions")
    f, labels = least_of(surface, columns)
    at_corner = labels[surface.faces]
    whole, mixed = whole_and_mixed(at_corner)
    # Of nothing, bincount gives whole numbers.
    areas = np.zeros(f.shape[1]) + np.bincount(at_corner[whole, 0], surface.face_areas[whole], minlength=f.shape[1])
    found = [_along_edges(f, surface)]
    for some in chunks(mixed, f.shape[1]):
        rivals = rivals_in(f, surface.faces[some])
        face, mine, polygons, sizes = region_polygons(f, surface.faces[some], rivals)
        parts = polygon_fractions(polygons, sizes) * surface.face_areas[some[face]]
        areas += np.bincount(mine, parts, minlength=f.shape[1])
        found += _segments(f, surface.faces[some], some, rivals)
    between, faces, weights, cut_by = (np.concatenate(each) for each in zip(*found, strict=True))
    points = np.einsum("sec,scx->sex", weights, surface.vertices[surface.faces[faces]])
    return Regions(labels, areas, points, between, faces, weights, cut_by, *_meetings(between, faces, points, cut_by))


def least_of(surface: Surface, columns: npt.ArrayLike) -> tuple[FloatArray, IntArray]:
    """Return the checked fields (n, k), infinite where they have no value, and (n,) which is the least, -1 for none."""
    f = real_numbers(columns, "Values of fields")
    n = len(surface.vertices)
    if f.ndim != 2 or len(f) != n or not f.shape[1]:
        raise ParameterError(f"Regions are those of fields (n, k) of {n:,} vertices, k at least 1, not {f.shape}.")
    f = np.where(np.isfinite(f), f, np.inf)
    return f, np.where(np.isfinite(f).any(axis=1), f.argmin(axis=1), -1)


def whole_and_mixed(labels: IntArray) -> tuple[IntArray, IntArray]:
    """Return the faces in one region, and those that may be in several, from the labels (m, 3) of their corners."""
    valued = (labels >= 0).all(axis=1)
    whole = valued & (labels == labels[:, :1]).all(axis=1)
    return np.flatnonzero(whole), np.flatnonzero(valued & ~whole)


Segments = tuple[IntArray, IntArray, FloatArray, IntArray]
"""Between which regions (s, 2), faces (s,), weights of the ends (s, 2, 3), and the third region that cut off each end
(s, 2), -1 for none."""


def chunks(faces: IntArray, fields: int) -> Iterator[IntArray]:
    """Yield faces (m,) in pieces that bound the memory for so many fields."""
    size = max(1, CHUNK // fields)
    for start in range(0, len(faces), size):
        yield faces[start : start + size]


def rivals_in(f: FloatArray, faces: IntArray) -> IntArray:
    """Return (m, r) the fields that are the least somewhere in each face, or might be, ascending, padded with -1.

    A field is left out if at all corners another is at most as large (of equal ones, a later number).
    """
    at = f[faces]
    # Nowhere is the least field above the least of the fields' greatest values.
    bound = np.where(np.isfinite(at), at, np.inf).max(axis=1).min(axis=1)
    possible = np.isfinite(at).all(axis=1) & (at.min(axis=1) <= bound[:, None])
    most = int(possible.sum(axis=1).max(initial=0))
    rows = np.arange(len(faces))[:, None]
    number = np.argsort(~possible, axis=1, kind="stable")[:, :most]
    there = np.take_along_axis(possible, number, axis=1)
    values = np.where(there[:, None, :], at[rows, :, number].transpose(0, 2, 1), np.inf)
    beaten = np.zeros_like(there)
    for a in range(most):
        for b in range(most):
            if a != b:
                mine, other = values[:, :, a], values[:, :, b]
                less = (other <= mine).all(axis=1)
                # Of two equal fields the first stays.
                beaten[:, a] |= there[:, b] & less & ((b < a) | (other < mine).any(axis=1))
    keep = there & ~beaten
    order = np.argsort(~keep, axis=1, kind="stable")[:, : int(keep.sum(axis=1).max(initial=0))]
    return np.where(np.take_along_axis(keep, order, axis=1), np.take_along_axis(number, order, axis=1), -1)


def region_polygons(
    f: FloatArray, corners: IntArray, rivals: IntArray
) -> tuple[IntArray, IntArray, FloatArray, IntArray]:
    """Divide faces into their parts in each region.

    Parameters
    ----------
    f : (n, k) ndarray
        Fields.
    corners : (m, 3) ndarray
        Vertices of the faces.
    rivals : (m, r) ndarray
        Fields that are the least somewhere in each face, padded with -1.

    Returns
    -------
    face, region : (p,) ndarray
        Of each part.
    polygons : (p, t, 3) ndarray
        The parts' corners as barycentric weights.
    sizes : (p,) ndarray
        How many corners each part has.
    """
    face, slot = np.nonzero(rivals >= 0)
    mine = rivals[face, slot]
    at = corners[face]
    polygons, sizes = np.broadcast_to(np.eye(3), (len(face), 3, 3)), np.full(len(face), 3)
    for other_slot in range(rivals.shape[1]):
        other = rivals[face, other_slot]
        cuts = (other >= 0) & (other != mine)
        values = np.where(cuts[:, None], f[at, other[:, None]] - f[at, mine[:, None]], 1.0)
        polygons, sizes = clipped(polygons, sizes, values)
    return face, mine, polygons, sizes


def _segments(f: FloatArray, corners: IntArray, faces: IntArray, rivals: IntArray) -> list[Segments]:
    """Return the segments inside some faces."""
    parts = []
    for a in range(rivals.shape[1]):
        for b in range(a + 1, rivals.shape[1]):
            both = np.flatnonzero(rivals[:, b] >= 0)
            i, j, at = rivals[both, a], rivals[both, b], corners[both]
            mine = f[at, i[:, None]]
            apart = f[at, j[:, None]] - mine
            ends, crossed = _crossing(apart)
            both, i, j, at, mine, apart = (x[crossed] for x in (both, i, j, at, mine, apart))
            low, high = np.zeros(len(both)), np.ones(len(both))
            cut_by = np.full((len(both), 2), -1)
            for c in range(rivals.shape[1]):
                third = rivals[both, c]
                there = (third >= 0) & (third != i) & (third != j)
                slack = np.where(there[:, None], f[at, third[:, None]] - mine, 1.0)
                u, v = np.einsum("sec,sc->se", ends, slack).T
                tied = np.flatnonzero(there & (np.maximum(np.abs(u), np.abs(v)) <= TIED * np.abs(slack).max(axis=1)))
                u[tied] = v[tied] = 0
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = u / (u - v)
                enters, leaves = (u < 0) & (v > 0), (u > 0) & (v < 0)
                cut_by[:, 0] = np.where(enters & (t >= low), third, cut_by[:, 0])
                low = np.where(enters, np.maximum(low, t), low)
                cut_by[:, 1] = np.where(leaves & (t <= high), third, cut_by[:, 1])
                high = np.where(leaves, np.minimum(high, t), high)
                outside = (u <= 0) & (v <= 0) & ((u < 0) | (v < 0))
                if len(tied):
                    # Equal to both all along the segment, it is less than the one or the other beside it, or between.
                    corner = np.abs(apart[tied]).argmax(axis=1)
                    fraction = slack[tied, corner] / apart[tied, corner]
                    outside[tied] = (fraction < 0) | (fraction > 1)
                high = np.where(outside, -1, high)
            proper = np.flatnonzero(high > low)
            t = np.stack([low, high], 1)[proper][..., None]
            weights = (1 - t) * ends[proper, :1] + t * ends[proper, 1:]
            parts.append((np.stack([i, j], 1)[proper], faces[both[proper]], weights, cut_by[proper]))
    return parts


def _along_edges(f: FloatArray, surface: Surface) -> Segments:
    """Return the segments along edges, where two fields are equal at both ends: each face then is on one side."""
    number = _different(f)
    tied = np.zeros(len(f), bool)
    for rows in chunks(np.arange(len(f)), len(number)):
        ordered = np.sort(f[rows][:, number], axis=1)
        tied[rows] = ((ordered[:, 1:] == ordered[:, :-1]) & np.isfinite(ordered[:, 1:])).any(axis=1)
    edges, of_side = surface._sides
    chosen = np.flatnonzero(tied[edges].all(axis=1) & (surface.faces_per_edge > 1))
    order = np.argsort(of_side, kind="stable") if len(chosen) else chosen
    first = np.searchsorted(of_side[order], [chosen, chosen + 1])
    between, faces, weights = [], [], []
    for edge, low, high in zip(chosen.tolist(), *first.tolist(), strict=True):
        ends = edges[edge]
        around = order[low:high] % len(surface.faces)
        beside = []
        for face in around:
            third = surface.faces[face][~np.isin(surface.faces[face], ends)][0]
            beside.append(f[third, number])
        for i, k in enumerate(number):
            same = np.flatnonzero((f[ends][:, number] == f[ends, k][:, None]).all(axis=0))
            if len(same) < 2 or same[0] != i or not np.isfinite(f[ends, k]).all():
                continue
            least = [int(number[same[values[same].argmin()]]) for values in beside]
            other = next((region for region in least if region != least[0]), None)
            slack = np.delete(f[ends][:, number], same, axis=1) - f[ends, k][:, None]
            start, stop = _positive(slack)
            if other is not None and stop > start:
                corners = surface.faces[around[0]]
                at = [np.where(corners == ends[0], 1 - t, np.where(corners == ends[1], t, 0)) for t in (start, stop)]
                between.append(sorted((least[0], other)))
                faces.append(around[0])
                weights.append(at)
    count = len(faces)
    return (
        np.array(between, np.int64).reshape(-1, 2),
        np.array(faces, np.int64),
        np.array(weights, np.float64).reshape(-1, 2, 3),
        np.full((count, 2), -1),
    )


def _different(f: FloatArray) -> IntArray:
    """Return the columns (q,) of f that are equal to none before them; the others have no region, hence no boundary."""
    some = f[np.linspace(0, len(f) - 1, 64).astype(np.int64)]
    alike: dict[bytes, list[int]] = {}
    for k in range(f.shape[1]):
        before = alike.setdefault(some[:, k].tobytes(), [])
        if not any(np.array_equal(f[:, k], f[:, j]) for j in before):
            before.append(k)
    return np.sort(np.concatenate([*alike.values()]))


def _positive(values: FloatArray) -> tuple[float, float]:
    """Return the part of 0 to 1 where linear functions with values (2, q) at its ends are all above 0."""
    start, stop = 0.0, 1.0
    for u, v in values.T.tolist():
        if u <= 0 and v <= 0:
            return 0.0, 0.0
        if u < 0 < v:
            start = max(start, u / (u - v))
        elif v < 0 < u:
            stop = min(stop, u / (u - v))
    return start, stop


def _crossing(g: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return (q, 2, 3) weights of the ends of the segments where linear functions with values g (p, 3) at the corners
    are 0, and (q,) which of the functions have one: those that are 0 in at least two points, and above and below
    elsewhere."""
    ends, count = np.zeros((len(g), 2, 3)), np.zeros(len(g), np.int64)
    has = (g.min(axis=1) < 0) & (g.max(axis=1) > 0)
    rows = np.arange(len(g))
    for k in range(3):
        zero = has & (g[:, k] == 0)
        ends[rows[zero], count[zero], k] = 1
        count += zero
        j = (k + 1) % 3
        turns = has & (np.sign(g[:, k]) * np.sign(g[:, j]) < 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = g[:, k] / (g[:, k] - g[:, j])
        ends[rows[turns], count[turns], k] = 1 - t[turns]
        ends[rows[turns], count[turns], j] = t[turns]
        count += turns
    found = np.flatnonzero(count == 2)
    return ends[found], found


def _meetings(between: IntArray, faces: IntArray, points: FloatArray, cut_by: IntArray) -> tuple[FloatArray, IntArray]:
    """Return (q, 3) the ends that a third region has cut off, each once, and (q, 3) the three regions."""
    segment, end = np.nonzero(cut_by >= 0)
    three = np.sort(np.concatenate([between[segment], cut_by[segment, end][:, None]], axis=1), axis=1)
    # Three linear functions are equal in one point of a face.
    _, first = np.unique(np.concatenate([faces[segment][:, None], three], axis=1), axis=0, return_index=True)
    return points[segment[first], end[first]], three[first]
