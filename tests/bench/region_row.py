"""Row 17: regions of the pins after one of them has moved, as the window divides them."""

from collections.abc import Iterator

import numpy as np

from bihdist_core.distances.distance_types import Spec
from tests.silent_view import SilentView

from .case import main_case
from .size import Size
from .table import Line, compared
from .timing import alternate
from .window_rows import PATIENCE, mesh_file

PINS = 12
MOVED_BOUND = 1.5
LABELLED = 1e-12
"""Shares of vertices with another label than by brute force; there are none."""


def regions(size: Size) -> Iterator[Line]:
    """One field, and the regions of all."""
    from app.document.document import MeshFile
    from app.session.loaded_mesh import open_mesh
    from app.tools.regions.division import Divided, Dividing, RegionsQuestion

    case, view = main_case(size), SilentView()
    dividing = Dividing(view.posted.put, lambda panel: None)
    with mesh_file(*case.arrays) as path:
        loaded = open_mesh(MeshFile("A", path))
    spec = Spec.of("biharmonic")
    places = iter(np.random.default_rng(2).permutation(len(case.arrays[0])).tolist())
    pins = [next(places) for _ in range(PINS)]

    def divided() -> Divided:
        pins[0] = next(places)
        dividing.ask({0: (RegionsQuestion(loaded.mesh, "voronoi", spec, tuple(pins)), loaded)})
        while not dividing.is_complete:
            view.posted.get(timeout=PATIENCE)()
        found = dividing.divided(0)
        assert found is not None
        return found

    try:
        divided()
        peer = case.heat_peer
        result = alternate(divided, lambda: peer.compute_distance(case.source), 3 * size.rounds, size.repeat)
    finally:
        dividing.close()
    found = result.answer
    brute = loaded.distances("voronoi").get(spec).from_sources(list(found.question.places)).argmin(axis=1)
    yield compared(
        17,
        f"regions of {PINS} pins after moving one, {case.count}",
        result,
        bound=MOVED_BOUND,
        error=float((found.regions.labels != brute).mean()),
        tolerance=LABELLED,
        note="exact boundaries and areas; peer: one potpourri3d heat solve",
    )
