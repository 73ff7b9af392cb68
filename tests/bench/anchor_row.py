"""Row 20: the value of an anchor moved, as the window interpolates it."""

from collections.abc import Iterator

import numpy as np

from bihdist_core.applications.weights import INVERSE_DISTANCES
from bihdist_core.distances.distance_types import Spec

from .case import main_case
from .size import Size
from .table import Line, compared
from .timing import alternate
from .window_rows import mesh_file

ANCHORS = 20
SHARE_BOUND = 0.5
TOLERANCE = 1e-12
"""Against the formula, with no column kept."""


def anchor_moved(size: Size) -> Iterator[Line]:
    """The whole field with another value at one of the anchors, as a share of one column of distances."""
    from app.document.document import MeshFile
    from app.session.loaded_mesh import open_mesh
    from app.tools.interpolation.answers import InterpolantQuestion

    case = main_case(size)
    with mesh_file(*case.arrays) as path:
        loaded = open_mesh(MeshFile("A", path))
    spec = Spec.of("biharmonic")
    random = np.random.default_rng(2)
    vertices = random.choice(len(case.arrays[0]), ANCHORS, replace=False).tolist()
    values = np.linspace(0, 1, ANCHORS)
    distance = loaded.distances("voronoi").get(spec)

    def moved() -> np.ndarray:
        values[3] = random.random()
        anchors = tuple(zip(vertices, values.tolist(), strict=True))
        field = InterpolantQuestion(loaded.mesh, "voronoi", spec, anchors, INVERSE_DISTANCES).answer(loaded).field
        assert field is not None
        return field

    moved()
    result = alternate(moved, lambda: distance.from_source(case.source), 5 * size.rounds, size.repeat)
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = 1 / distance.from_sources(vertices)
        slow = weights @ values / weights.sum(axis=1)
    slow[vertices] = values
    yield compared(
        20,
        f"the value of one of {ANCHORS} anchors moved, {case.count}",
        result,
        bound=SHARE_BOUND,
        error=float(np.abs(result.answer - slow).max()),
        tolerance=TOLERANCE,
        note="the whole field again, no solve; peer: one column of our own",
    )
