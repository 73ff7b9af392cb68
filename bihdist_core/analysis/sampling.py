"""Farthest-point sampling with any distance."""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt

from ..arrays import BoolArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..formats.field_output import write_array
from ..formats.pins import PIN_FORMATS, Pins, write_pins
from ..mesh_like import MeshLike
from ..progress import Progress, part, silent
from ..scalars import whole_number
from ..sources.pieces import pieces_of
from ..sources.source import Source
from ..sources.words import short_words_of
from ..surface import Surface

SAMPLE_FORMATS = (".txt", ".npy", *PIN_FORMATS)


def farthest_points(
    distance: Distance,
    start: npt.ArrayLike = 0,
    count: int = 10,
    progress: Progress | None = None,
    among: BoolArray | None = None,
) -> IntArray:
    """Choose vertices, each as far as can be from those before it.

    Parameters
    ----------
    distance : Distance
        The distance; costs a field for each point but the last.
    start : int or (s,) array_like
        The first vertex, or different vertices of one component, which come first.
    count : int
        How many vertices in all.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    among : (n,) bool ndarray, optional
        Which vertices the others are chosen from; all by default.

    Returns
    -------
    (count,) int64 ndarray
        Vertices of the start's component; of equally far ones, the one with the lowest id comes first.

    Raises
    ------
    VertexError
        If a start is not on the surface.
    ParameterError
        For starts on different components, the same twice, or more than `count`, and if the component has fewer
        different points than `count`.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> # from the middle of a square to its corners
    >>> bihdist.farthest_points(distance, start=40, count=5).tolist()
    [40, 0, 80, 8, 72]
    """
    if whole_number(count, "count") < 1:
        raise ParameterError(f"count is {count}; at least one point is needed.")
    points = distance.surface.check_vertices(start).tolist()
    if not 1 <= len(points) <= count:
        raise ParameterError(
            f"{len(points)} starts were given for {count:,} points; one is needed, and no more than that."
        )
    if len(set(points)) < len(points) or len(np.unique(distance.surface.component_of_vertex[points])) > 1:
        raise ParameterError(f"The starts {points} are not different vertices of one component.")
    component = distance.laplacian.component_of(points[0])
    if count > len(component.vertices):
        held = len(component.vertices)
        raise ParameterError(f"{count:,} points asked for; the component of vertex {points[0]} has {held:,} vertices.")
    report, start_count = progress or silent, len(points)
    nearest = np.full(len(distance.surface.vertices), np.nan)
    for k in range(count):
        if k >= start_count:
            farthest = int(np.nanargmax(nearest)) if np.isfinite(nearest).any() else points[0]
            if not nearest[farthest] > 0:
                raise ParameterError(f"{count:,} points asked for; the component of vertex {points[0]} has {k:,}.")
            points.append(farthest)
        if k + 1 < count:
            report(k / count, f"{k + 1:,} of {count:,} points")
            nearest = np.fmin(nearest, distance.from_source(points[k], part(progress, k / count, (k + 1) / count)))
            if among is not None:
                nearest[~among] = np.nan
    report(1.0, f"{count:,} points")
    return np.array(points)


def starts_of(source: Source, surface: Surface) -> IntArray:
    """Return (s,) the vertices of a source, from which samples start.

    Raises VertexError or ParameterError for a source that is not on the surface, or that is not made of vertices.
    """
    vertices = pieces_of(source, surface).vertices
    if vertices is None:
        raise ParameterError(f"Samples start from vertices, and {short_words_of(source)} is not a vertex; choose one.")
    return vertices


def write_samples(path: str | os.PathLike[str], surface: MeshLike, vertices: npt.ArrayLike) -> None:
    """Write vertices, in order, to a file.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .txt has an id on each line, .npy an array; others are those of `write_pins`.
    surface : MeshLike
        The mesh.
    vertices : (k,) array_like
        Vertex ids.

    Raises
    ------
    OutputError
        If the file cannot be written; what was there then stays.
    VertexError
        If a vertex is not on the surface.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> bihdist.write_samples("samples.txt", plane, [40, 0, 80])
    >>> Path("samples.txt").read_text().split()
    ['40', '0', '80']
    """
    surface = Surface.of(surface)
    ids = surface.check_vertices(vertices)
    extension = check_output(path, SAMPLE_FORMATS)
    if extension in PIN_FORMATS:
        write_pins(path, surface, Pins.of(surface, ids))
    elif extension == ".npy":
        write_array(path, ids)
    else:
        with atomic_write(path) as temporary:
            temporary.write_text("".join(f"{id}\n" for id in ids.tolist()), encoding="ascii")
