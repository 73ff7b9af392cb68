"""`bihdist info`: what a mesh file holds."""

import argparse
from typing import TYPE_CHECKING, Any

from bihdist_core.distances.distance_types import BUILT_IN, Spec
from bihdist_core.errors import ParameterError, SolverError

from ..document.document import AREAS
from .mesh import each_mesh, found_mesh
from .options import add_areas, repairs_of
from .terminal import Facts, Result, accuracy, distance_facts, facts_of, progress_line

if TYPE_CHECKING:
    from bihdist_core import Surface

MOST_LOOPS = 4
"""The number of boundary loops that are described."""
COUNTS = {
    "n_vertices": "vertices",
    "n_faces": "faces",
    "n_components": "components",
    "boundary_loop_count": "boundary loops",
    "genus": "genus",
    "nonmanifold_edge_count": "non-manifold edges",
    "nonmanifold_vertex_count": "non-manifold vertices",
    "unreferenced_count": "vertices without a face",
}
"""Attributes of a surface, and the words for them."""
ON_POINTS = {"vertices": "points", "vertices without a face": "points left out", "mean edge length": "mean spacing"}
"""What rows are called where there are points only."""
OF_SOLIDS = {"faces": "tetrahedra", "vertices without a face": "unused vertices", "area": "area of the boundary"}
"""What rows are called where there are tetrahedra."""
OF_FACES = ("faces", "boundary loops", "genus", "non-manifold edges", "non-manifold vertices", "degenerate faces")
"""Rows that are left out where there are no faces."""
SENTENCES = ("facts", "repairs", "warnings")

WORDS = "describe a mesh file, and what would be repaired"
EXAMPLES = (
    "bihdist info hand",
    "bihdist info scan.ply --accuracy",
    "bihdist info --solver",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `info` to its parser."""
    parser.add_argument("meshes", nargs="*", metavar="MESH", help="mesh files, or the names of samples")
    parser.add_argument(
        "--accuracy", action="store_true", help="report how accurate exact distances are; factors the mesh"
    )
    parser.add_argument("--solver", action="store_true", help="report whether the solver runs compiled; needs no mesh")
    add_areas(parser)


def run(options: argparse.Namespace) -> Result:
    """Print what is known of each mesh; the exit status is 2 if one of several could not be read."""
    from bihdist_core.kernel.library import description

    solver = {"solver": description()} if options.solver else {}
    if not (options.meshes or options.solver):
        raise ParameterError("There is nothing to describe; name a mesh.")
    if not options.meshes:
        _print_rows(solver)
        return Result({"meshes": [], "failures": [], **solver})
    done = each_mesh(options.meshes, lambda mesh: _described(mesh, options, solver))
    return Result({**done.facts, **solver}, done.status)


def _described(mesh: str, options: argparse.Namespace, solver: dict[str, str]) -> Facts:
    """Print what is known of a mesh, and give it in plain values."""
    from bihdist_core import TetrahedralMesh
    from bihdist_core.analysis.surface_notes import surface_notes

    from ..session.repaired_surface import read_repaired

    repairs = repairs_of(options, mesh)
    s = read_repaired(found_mesh(mesh), repairs)
    notes = surface_notes(s)
    facts = {
        "mesh": mesh,
        **facts_of(s, *COUNTS),
        "n_degenerate_faces": len(s.degenerate_faces),
        **facts_of(s, "mean_edge_length", "area", "bounds", "is_manifold"),
        **facts_of(notes, *SENTENCES),
    }
    solid = s if isinstance(s, TetrahedralMesh) else None
    facts |= {"n_tetrahedra": len(solid.tetrahedra), "volume": solid.volume} if solid else {}
    rows = {
        **({"mesh": s.name} if len(options.meshes) > 1 else {}),
        **{words: facts[name] for name, words in COUNTS.items()},
        "boundary loops": _loops(s),
        "genus": "not defined (not manifold or not orientable)" if s.genus is None else s.genus,
        "degenerate faces": len(s.degenerate_faces),
        "mean edge length": f"{s.mean_edge_length:.6g}",
        "area": f"{s.area:.6g}",
        **({"faces": len(solid.tetrahedra), "volume": f"{solid.volume:.6g}"} if solid else {}),
        **{name: "; ".join(facts[name]) or "none" for name in SENTENCES},
        **solver,
    }
    if not len(s.faces):
        names = OF_SOLIDS if solid else ON_POINTS
        renamed = {names.get(name, name): value for name, value in rows.items()}
        rows = {name: value for name, value in renamed.items() if name not in OF_FACES}
    if options.accuracy:
        facts["distances"] = _accuracies(s, options.areas or AREAS[0], repairs.operator)
        rows |= {each["label"]: each["failure"] or each["accuracy_text"] for each in facts["distances"]}
    _print_rows(rows)
    if len(options.meshes) > 1:
        print()
    return facts


def _print_rows(rows: dict[str, Any]) -> None:
    for name, value in rows.items():
        print(f"{name:<25} {f'{value:,}' if isinstance(value, int) else value}")


def _loops(surface: "Surface") -> str:
    """Describe the boundary loops: their number, and the lengths of the first few."""
    import numpy as np

    from bihdist_core import BoundaryLoop
    from bihdist_core.sources.pieces import pieces_of

    count, lines = surface.boundary_loop_count, []
    for number in range(min(count, MOST_LOOPS)):
        start, stop = pieces_of(BoundaryLoop(number), surface).positions(surface.vertices)
        lines.append(f"loop:{number} {float(np.linalg.norm(stop - start, axis=1).sum()):.4g} long")
    if count > MOST_LOOPS:
        lines.append("...")
    return f"{count} ({', '.join(lines)})" if lines else "0"


def _accuracies(surface: "Surface", areas: str, operator: str) -> list[Facts]:
    """Return the accuracy of each exact distance on all components, or why it is not given."""
    from bihdist_core import Laplacian
    from bihdist_core.distances.answers import Distances

    found = []
    with progress_line() as progress:
        distances = Distances(Laplacian(surface, areas, operator))
        for word in (each.word for each in BUILT_IN if each.is_complete):
            try:
                distance = distances.get(Spec.of(word), progress)
                accuracy(distance, everywhere=True)  # warns
                found.append({**distance_facts(distance, word, everywhere=True), "failure": ""})
            except SolverError as error:
                nothing = {"accuracy": None, "accuracy_text": "", "accuracy_sources": None, "failure": str(error)}
                found.append({"distance": word, "label": f"{word}, exact", "unit": "", **nothing})
    return found
