"""A scatter as a picture: where its axes end, how many points lie in each cell of a grid, and what is selected."""

from collections.abc import Sequence

import numpy as np

from bihdist_core.analysis.field_scatter import FieldScatter
from bihdist_core.arrays import AnyArray, ByteArray

FAINTEST = 0.22
"""How dark the cell of a single point is where the fullest is 1."""

COARSE = ((3_000, 3), (60_000, 2))
"""Up to so many points a cell is so many pixels wide: few points are to be seen, too."""

SLACK = 0.03
"""Room beside the outermost points, as a share of the axis."""

RGB = tuple[int, int, int]


def cell_size(count: int) -> int:
    """Return the width of a cell in pixels for so many points."""
    return next((size for most, size in COARSE if count <= most), 1)


def density_picture(
    scatter: FieldScatter,
    grid: tuple[int, int, tuple[float, float], tuple[float, float]],
    ink: RGB,
    selections: Sequence[tuple[AnyArray, RGB]] = (),
) -> ByteArray:
    """Return a picture (rows, columns, 4) uint8, in which a cell is as dark as the logarithm of its number of points.

    Parameters
    ----------
    grid
        Columns, rows, and the ends of both axes.
    selections
        Vertices (k,), each with a colour for their cells, the last on top.
    """
    columns, rows = grid[:2]
    cell, there = scatter.cells(*grid)
    number = np.bincount(cell, minlength=columns * rows)
    shade = FAINTEST + (1 - FAINTEST) * np.log1p(number) / np.log1p(max(number.max(), 1))
    pixels = np.empty((rows * columns, 4), np.uint8)
    pixels[:, :3] = ink
    pixels[:, 3] = np.where(number > 0, 255 * shade, 0)
    ids = scatter.ids[there]
    for vertices, colour in selections:
        is_chosen = np.zeros(max(int(ids.max(initial=-1)), int(vertices.max(initial=-1))) + 1, bool)
        is_chosen[vertices] = True
        pixels[cell[is_chosen[ids]]] = *colour, 255
    return np.ascontiguousarray(pixels.reshape(rows, columns, 4)[::-1])


def axis_ends(scatter: FieldScatter, is_common: bool) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ends of both axes, with room beside the outermost points; with `is_common` the same for both."""
    across, up = scatter.ends
    if is_common:
        across = up = min(across[0], up[0]), max(across[1], up[1])
    return _with_room(*across), _with_room(*up)


def _with_room(low: float, high: float) -> tuple[float, float]:
    room = SLACK * ((high - low) or 1)
    return (low - room if low < 0 else low), high + room
