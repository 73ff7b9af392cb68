"""`bihdist info`: what a mesh file holds."""

import argparse
import json
from typing import TYPE_CHECKING, Any

from ..document.document import AREAS
from .mesh import each_mesh, found_mesh
from .options import add_areas
from .terminal import accuracy, progress_line

if TYPE_CHECKING:
    from bihdist_core import Surface

MOST_LOOPS = 4
"""So many boundary loops are described."""

WORDS = "what a mesh file holds and what would be repaired"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `info` to its parser."""
    parser.add_argument("meshes", nargs="*", metavar="MESH", help="mesh files, or the names of samples")
    parser.add_argument(
        "--accuracy", action="store_true", help="how accurate its exact distances are; factors the mesh"
    )
    parser.add_argument("--solver", action="store_true", help="whether the solver runs compiled; needs no mesh")
    parser.add_argument("--json", action="store_true", help="as JSON: a list with an object for each mesh")
    add_areas(parser)


def run(options: argparse.Namespace) -> int:
    """Print what is known of each mesh; the exit status is 1 if one could not be read."""
    if options.meshes:
        return each_mesh(options.meshes, lambda mesh: _facts(mesh, options), options.json, _print)
    if not options.solver:
        from bihdist_core.errors import ParameterError

        raise ParameterError("There is nothing to describe; name a mesh.")
    if options.json:
        print(json.dumps([_solver()], indent=2))
    else:
        _print_rows(_solver())
    return 0


def _facts(mesh: str, options: argparse.Namespace) -> dict[str, Any]:
    from bihdist_core import read_surface
    from bihdist_core.analysis.surface_notes import surface_notes

    s = read_surface(found_mesh(mesh))
    notes = surface_notes(s)
    facts: dict[str, Any] = {
        "mesh": s.name,
        "vertices": len(s.vertices),
        "faces": len(s.faces),
        "components": s.n_components,
        "boundary loops": s.boundary_loop_count if options.json else _loops(s),
        "genus": s.genus,
        "non-manifold edges": s.nonmanifold_edge_count,
        "non-manifold vertices": s.nonmanifold_vertex_count,
        "vertices without a face": s.unreferenced_count,
        "degenerate faces": len(s.degenerate_faces),
        "mean edge length": s.mean_edge_length,
        "area": float(s.face_areas.sum()),
        "facts": list(notes.facts),
        "repairs": list(notes.repairs),
        "warnings": list(notes.warnings),
    }
    if options.solver:
        facts |= _solver()
    if options.accuracy:
        facts |= dict(_accuracies(s, options.areas or AREAS[0]))
    return facts


def _print(facts: dict[str, Any], several: bool) -> None:
    shown = {
        **facts,
        "genus": "not defined (not manifold or not orientable)" if facts["genus"] is None else facts["genus"],
        "mean edge length": f"{facts['mean edge length']:.6g}",
        "area": f"{facts['area']:.6g}",
        **{name: "; ".join(facts[name]) or "none" for name in ("facts", "repairs", "warnings")},
    }
    if not several:
        del shown["mesh"]
    _print_rows(shown)
    if several:
        print()


def _print_rows(facts: dict[str, Any]) -> None:
    for name, value in facts.items():
        print(f"{name:<26}{f'{value:,}' if isinstance(value, int) else value}")


def _solver() -> dict[str, str]:
    from bihdist_core.kernel.library import description

    return {"solver": description()}


def _loops(surface: "Surface") -> str:
    """How many, and the length of the first few, which is what their numbers go by."""
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


def _accuracies(surface: "Surface", areas: str) -> list[tuple[str, str]]:
    """Label and words for each exact distance."""
    from bihdist_core import Laplacian, SolverError
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.kinds import Spec

    lines = []
    with progress_line() as progress:
        distances = Distances(Laplacian(surface, areas))
        for word in ("biharmonic", "commute-time"):
            try:
                distance = distances.get(Spec.of(word), progress)
                lines.append((distance.label, accuracy(distance, everywhere=True).removeprefix(", ")))
            except SolverError as error:
                lines.append((f"{word}, exact", str(error)))
    return lines
