"""Which axis of a surface points up, guessed from its shape and from what files of its format usually have.

What stands has most of its outline's ground under its lowest parts, its weight above these and low, is symmetric
sideways and not upside down, and has its openings below (Fu et al., Upright orientation of man-made objects, 2008,
go by the first three).  Each of the six directions gets the sum of these, as fractions, with the weights below.
"""

import numpy as np

from ..arrays import FloatArray, IntArray
from ..formats.mesh_names import FORMATS, MeshFormat
from ..progress import Progress, part, silent
from ..surface import Surface

WORDS = "guessing which way is up"
"""The text of progress reports."""

DIRECTIONS = ("y", "z", "x", "-y", "-z", "-x")
"""The most frequent in files comes first, and wins ties."""

SAMPLES = 8_000
"""Places on the faces that stand for the whole."""

LOW = (0.03, 0.1)
"""Shares of the height that count as the lowest parts: what hangs lower than the feet spoils the first alone."""

STANDS, BALANCED, UNLIKE, LOW_WEIGHT, OPEN_BELOW = 5.0, 1.5, 2.0, 3.5, 2.0
"""Of what is added up.  Found by logistic regression over 30 meshes, and rounded.

Of each mesh, judged by weights found from the others and without its format, 24 of 30 were right.
"""

SELDOM = 4.0
"""What directions other than y and z have to be better by, since files hardly ever have them."""

THIN = 0.1
"""Nothing stands on a ground that is narrower than this fraction of its height."""

SYMMETRIC = 0.02
"""Misfits of a mirror image that are all below this fraction of the diagonal say little."""

FACING, LYING = 0.6, 0.3
"""A sheet most of whose area faces one way, and is so thin, is a landscape; a plate, which has two sides, is none."""

FRONTS = {"y": "z", "-y": "z", "x": "z", "-x": "z", "z": "-y", "-z": "y"}
"""Where the front is, by which way is up: what a quarter turn of the usual shape makes of its front."""


def guess_up(surface: Surface, file_format: str = "", progress: Progress | None = None) -> str:
    """Guess which of "x", "-x", "y", "-y", "z" and "-z" points up.

    `file_format` is what `mesh_format` says of the file that the surface is from, "" for none. A surface in a plane of
    constant z has y up. `progress` is called between the steps, the longest of which goes over all faces.
    """
    report, surface = progress or silent, surface.shape
    report(0.0, WORDS)
    points = surface.vertices[surface.component_of_vertex >= 0]
    # Of a large mesh some do as well.
    points = points[:: max(1, len(points) // 50_000)]
    extents = np.ptp(points, axis=0)
    landscape = _landscape(surface, extents)
    if extents.min() <= 1e-6 * extents.max():
        return landscape if landscape and landscape[-1] != "z" else "y"
    if landscape:
        return landscape
    scores = _scores(surface, points, extents, part(report, 0.1, 1))
    bonus = FORMATS[file_format].y_bonus if file_format in FORMATS else MeshFormat.y_bonus
    usual = {"y": 0.0, "z": -bonus}
    return max(DIRECTIONS, key=lambda name: scores[name] + usual.get(name, -SELDOM))


def axis_of(up: str) -> FloatArray:
    """Return (3,) the unit vector of a direction's name."""
    axis = np.zeros(3)
    axis["xyz".index(up[-1])] = -1.0 if up.startswith("-") else 1.0
    return axis


def axes_of(up: str) -> FloatArray:
    """Return (3, 3) the unit vectors, as columns, to the right, up and to the front, where this direction is up."""
    upright, front = axis_of(up), axis_of(FRONTS[up])
    return np.stack([np.cross(upright, front), upright, front], axis=1)


def scattered(surface: Surface, count: int) -> tuple[FloatArray, IntArray]:
    """Return (count, 3) places on the faces, as many for equal areas, and (count,) their faces."""
    random, upto = np.random.default_rng(0), np.cumsum(surface.face_areas)
    faces = np.searchsorted(upto, (np.arange(count) + 0.5) / count * upto[-1])
    faces = np.minimum(faces, len(upto) - 1)
    weights = random.dirichlet(np.ones(3), count)
    return np.einsum("ij,ijk->ik", weights, surface.vertices[surface.faces[faces]]), faces


def _landscape(surface: Surface, extents: FloatArray) -> str:
    """Return the direction to which a thin sheet turns its outside; "" if it is none."""
    _, b, c = surface.sides()
    facing = np.cross(b, c, axis=0).sum(axis=1) / 2 / max(float(surface.face_areas.sum()), 1e-300)
    k = int(np.abs(facing).argmax())
    is_thin = extents[k] <= LYING * np.delete(extents, k).min()
    return "-" * bool(facing[k] < 0) + "xyz"[k] if abs(facing[k]) >= FACING and is_thin else ""


def _scores(surface: Surface, points: FloatArray, extents: FloatArray, progress: Progress) -> dict[str, float]:
    """Return for each direction how much speaks for it."""
    progress(0.0, WORDS)
    (samples, _), diagonal = scattered(surface, SAMPLES), float(np.linalg.norm(extents))
    centre, lowest = samples.mean(axis=0), points.min(axis=0)
    misfits = _mirror_misfits(samples, centre, part(progress, 0, 0.4)) / diagonal
    unlike = misfits / max(float(misfits.max()), SYMMETRIC)
    heights = (samples.mean(axis=0) - lowest) / extents
    progress(0.4, WORDS)
    rims, rim_fraction = _rims(surface, diagonal)
    rim_heights = (rims - lowest) / extents
    scores = {}
    for number, name in enumerate(DIRECTIONS):
        progress(0.5 + number / 12, WORDS)
        k, is_down = "xyz".index(name[-1]), name.startswith("-")
        across = [axis for axis in range(3) if axis != k]

        def up(height: float, is_down: bool = is_down) -> float:
            return 1 - height if is_down else height

        height = (points[:, k] - lowest[k]) / extents[k]
        outline = float(np.prod(extents[across]))
        lowest_parts = [points[(1 - height if is_down else height) <= low][:, across] for low in LOW]
        ground, margin = np.array([_ground(feet, centre[across]) for feet in lowest_parts]).T
        stands = np.sqrt(ground / outline).mean() if extents[across].min() >= THIN * extents[k] else 0.0
        scores[name] = float(
            STANDS * stands
            + BALANCED * np.clip(margin / np.sqrt(outline), -0.3, 0.3).mean()
            + UNLIKE * unlike[k]
            + LOW_WEIGHT * (0.5 - up(heights[k]))
            + OPEN_BELOW * rim_fraction * (0.5 - up(rim_heights[k]))
        )
    return scores


def _mirror_misfits(samples: FloatArray, centre: FloatArray, progress: Progress) -> FloatArray:
    """Return (3,) the mean distance from places that are mirrored along each axis to the nearest other place."""
    from scipy.spatial import cKDTree

    tree, some = cKDTree(samples), samples[::8]
    found = []
    for k in range(3):
        progress(k / 3, WORDS)
        mirrored = some.copy()
        mirrored[:, k] = 2 * centre[k] - mirrored[:, k]
        found.append(tree.query(mirrored)[0].mean())
    return np.array(found)


def _ground(feet: FloatArray, centre: FloatArray) -> tuple[float, float]:
    """Return the area of the convex hull of points (k, 2), and how far the centre (2,) is inside, negative outside."""
    # Not at the top: the window opens before this is needed.
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(feet)
    except (QhullError, ValueError):  # too few, or in a line
        return 0.0, -float(np.linalg.norm(feet.mean(axis=0) - centre))
    return float(hull.volume), -float((hull.equations[:, :2] @ centre + hull.equations[:, 2]).max())


def _rims(surface: Surface, diagonal: float) -> tuple[FloatArray, float]:
    """Return (3,) the middle of all boundary edges, and their length as a fraction of the diagonal, at most 1."""
    ends = surface.vertices[surface.boundary_edges]
    if not len(ends):
        return surface.vertices.mean(axis=0), 0.0
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    total = float(lengths.sum())
    if total <= 0:
        return ends.mean(axis=(0, 1)), 0.0
    return np.average(ends.mean(axis=1), axis=0, weights=lengths), min(1.0, total / diagonal)
