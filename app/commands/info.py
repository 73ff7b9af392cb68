"""`bihdist info`: what a mesh file holds."""

import argparse
from typing import TYPE_CHECKING

from ..document.document import AREAS
from .mesh import found_mesh
from .options import add_areas
from .terminal import accuracy, progress_line

if TYPE_CHECKING:
    from bihdist_core import Surface

MOST_LOOPS = 4
"""So many boundary loops are described."""

WORDS = "what a mesh file holds and what would be repaired"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", help="mesh file, or the name of a sample")
    parser.add_argument(
        "--accuracy", action="store_true", help="how accurate its exact distances are; factors the mesh"
    )
    add_areas(parser)


def run(options: argparse.Namespace) -> None:
    from bihdist_core import read_surface

    s = read_surface(found_mesh(options.mesh))
    genus = s.genus
    rows = [
        ("vertices", len(s.vertices)),
        ("faces", len(s.faces)),
        ("components", s.component_count),
        ("boundary loops", _loops(s)),
        ("genus", "not defined (not manifold or not orientable)" if genus is None else genus),
        ("non-manifold edges", s.nonmanifold_edge_count),
        ("non-manifold vertices", s.nonmanifold_vertex_count),
        ("vertices without a face", s.unreferenced_count),
        ("flat faces", len(s.flat_faces)),
        ("mean edge length", f"{s.mean_edge_length:.6g}"),
        ("area", f"{s.face_areas.sum():.6g}"),
        ("repairs", "; ".join(s.remarks) or "none"),
    ]
    for name, value in rows:
        print(f"{name:<26}{value}")
    if options.accuracy:
        for label, text in _accuracies(s, options.areas or AREAS[0]):
            print(f"{label:<26}{text}")


def _loops(surface: "Surface") -> str:
    """How many, and the length of the first few, which is what their numbers go by."""
    import numpy as np

    from bihdist_core import BoundaryLoop
    from bihdist_core.sources.pieces import pieces_of

    count, said = surface.boundary_loop_count, []
    for number in range(min(count, MOST_LOOPS)):
        start, stop = pieces_of(BoundaryLoop(number), surface).positions(surface.vertices)
        said.append(f"loop:{number} {float(np.linalg.norm(stop - start, axis=1).sum()):.4g} long")
    if count > MOST_LOOPS:
        said.append("...")
    return f"{count} ({', '.join(said)})" if said else "0"


def _accuracies(surface, areas: str) -> list[tuple[str, str]]:
    """Label and words for each exact distance."""
    from bihdist_core import Laplacian, SolverError
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.kinds import Spec

    said = []
    with progress_line() as progress:
        distances = Distances(Laplacian(surface, areas))
        for word in ("biharmonic", "commute-time"):
            try:
                distance = distances.get(Spec.of(word), progress)
                said.append((distance.label, accuracy(distance, everywhere=True).removeprefix(", ")))
            except SolverError as error:
                said.append((f"{word}, exact", str(error)))
    return said
