"""Light from many directions on a surface, some of which it keeps from itself: ambient occlusion, and soft shadows."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import BihdistError
from ..kernel.library import library, why_plain

DIRECTIONS = 192
"""From where light comes."""

SIDE = 512
"""Pixels along each side of the depth map of a direction."""

LIFT = 1.5
"""Pixels of these maps from a face to where light must arrive: the face itself takes some."""

PARTS = 4
"""Of the directions, summed apart whatever the number of cores: sums are then equal on all machines."""


def nearest_faces(faces: IntArray, at: FloatArray, width: int, height: int) -> tuple[AnyArray, AnyArray]:
    """Return which face is nearest at the middle of each pixel, (height, width) int32, -1 for none, and how near.

    Parameters
    ----------
    faces
        (m, 3) vertices.
    at
        (n, 3) x and y in pixels, y down, and nearness, which is linear in the picture; NaN for what is not in it.

    Raises
    ------
    BihdistError
        Without the compiled kernel.
    """
    kernel = _kernel()
    face, near = np.full((height, width), -1, np.int32), np.full((height, width), -np.inf, np.float32)
    at, faces = (np.ascontiguousarray(array, kind) for array, kind in ((at, float), (faces, np.int64)))
    kernel.bih_nearest_faces(len(faces), faces, at, width, height, near, face)
    return face, near


def light_reached(
    vertices: FloatArray,
    faces: IntArray,
    places: tuple[AnyArray, AnyArray, AnyArray],
    brightness: Callable[[FloatArray], FloatArray],
) -> FloatArray:
    """Return the share (k,) of the light that reaches places, 1 where nothing of the surface keeps any away.

    Parameters
    ----------
    vertices, faces
        (n, 3) and (m, 3), what light cannot pass.
    places
        Points, their normals and those of the faces that they lie on, on the side that is looked at, (k, 3) each.
    brightness
        How bright it is in directions (d, 3).
    """
    kernel = _kernel()
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    radius = float(np.linalg.norm(vertices - centre, axis=1).max(initial=1e-300))
    directions = sphere(DIRECTIONS)
    weights, points = brightness(directions), places[0] - centre
    vertex, face = np.ascontiguousarray(vertices - centre, float), np.ascontiguousarray(faces, np.int64)
    point, normal, facing = (np.ascontiguousarray(each, np.float32) for each in (points, *places[1:]))

    def sums(first: int) -> AnyArray:
        total, at = np.zeros((2, len(point)), np.float32), np.empty_like(vertex)
        near = np.empty((SIDE, SIDE), np.float32)
        for to, weight in zip(directions[first::PARTS], weights[first::PARTS], strict=True):
            across = np.cross(to, np.eye(3)[np.abs(to).argmin()])
            across /= np.linalg.norm(across)
            scale = (SIDE - 2) / 2 / radius
            frame = np.stack([scale * across, scale * np.cross(to, across), to])
            put = np.column_stack([frame, [SIDE / 2, SIDE / 2, 0.0]])
            near[:] = -np.inf
            kernel.bih_place(len(vertex), vertex, put, at)
            kernel.bih_nearest_faces(len(face), face, at, SIDE, SIDE, near, None)
            kernel.bih_add_light(
                len(point), point, normal, facing, put, weight, LIFT / scale, SIDE, near, total[0], total[1]
            )
        return total

    with ThreadPoolExecutor() as pool:
        reached, whole = np.sum(list(pool.map(sums, range(PARTS))), axis=0)
    share: FloatArray = np.divide(reached, whole, out=np.ones(len(point), np.float32), where=whole > 0)
    return share


def _kernel() -> Any:
    """Return the compiled kernel; BihdistError without one."""
    if (kernel := library()) is None:
        raise BihdistError(f"Shadows need the compiled kernel: {why_plain()}.")
    return kernel


def sphere(count: int) -> FloatArray:
    """Return directions (count, 3) all round, as many for equal solid angles."""
    k = np.arange(count) + 0.5
    height, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.cos(turn), across * np.sin(turn), height], axis=1)
