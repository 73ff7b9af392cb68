"""What is to be known of a surface, in sentences: facts, repairs and warnings."""

from dataclasses import dataclass

from ..counts import counted
from ..surface import FLAT, Surface

HELD = f"of (nearly) no area held in shape as if {FLAT:g} of the longest side high"


@dataclass(frozen=True)
class SurfaceNotes:
    """Sentences with counts.

    facts: what the mesh is, such as quads that were divided into triangles, or a boundary.  repairs: what was dropped
    or changed to make a surface of it.  warnings: what makes distances undefined or less certain somewhere.
    """

    facts: tuple[str, ...] = ()
    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def surface_notes(surface: Surface) -> SurfaceNotes:
    """The notes of a surface; those on large meshes take a moment the first time."""
    parts = surface.n_components
    facts = [
        (surface.boundary_loop_count, "boundary loop", ""),
        (surface.unreferenced_count, "vertex without a face", "vertices without a face"),
    ]
    warnings = [
        (surface.nonmanifold_edge_count, "edge with more than two faces", "edges with more than two faces"),
        (
            surface.nonmanifold_vertex_count,
            "vertex where faces touch in a point",
            "vertices where faces touch in a point",
        ),
        (len(surface.degenerate_faces), f"face {HELD}", f"faces {HELD}"),
        (parts if parts > 1 else 0, "", "components, with no distance from one to another (grey, NaN)"),
    ]
    sentences, warned = ([counted(*each) for each in some if each[0]] for some in (facts, warnings))
    return SurfaceNotes((*surface.facts, *sentences), tuple(surface.repairs), tuple(warned))
