"""Notes on a surface, in sentences: facts, repairs and warnings."""

from dataclasses import dataclass

import numpy as np

from ..counts import counted
from ..surface import FLAT_RATIO, Surface
from ..tetrahedra import SolidBoundary

COARSE = 1e-4
"""Coordinates that are rounded by more than this fraction of the mean edge are warned of."""

THIN = 0.01
"""Faces that are less high, as a share of their longest side, have weights against which others hardly count."""

TUFTED, DELAUNAY = (f"for which there is the operator {name}" for name in ("tufted", "intrinsic-delaunay"))

HELD = f"of almost no area, treated as {FLAT_RATIO:.0e} of the longest side high".replace("e-0", "e-")


@dataclass(frozen=True)
class SurfaceNotes:
    """Sentences on a surface, with counts.

    `facts` say what the mesh is, such as quads that were divided into triangles, or a boundary; `repairs` what was
    dropped or changed to make a surface of it; `warnings` what makes distances undefined or less certain somewhere.
    """

    facts: tuple[str, ...] = ()
    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def surface_notes(surface: Surface) -> SurfaceNotes:
    """Return the notes of a surface; those on large meshes take a moment the first time."""
    parts, heights = surface.n_components, surface.face_heights
    thin = (heights < THIN) & (heights >= FLAT_RATIO)
    facts = [
        (surface.boundary_loop_count, "boundary loop", ""),
        (surface.unreferenced_count if len(surface.faces) else 0, "vertex without a face", "vertices without a face"),
    ]
    warnings = [
        (
            surface.nonmanifold_edge_count,
            f"edge with more than two faces, {TUFTED}",
            f"edges with more than two faces, {TUFTED}",
        ),
        (
            surface.nonmanifold_vertex_count,
            "vertex where faces touch in a point",
            "vertices where faces touch in a point",
        ),
        (int(thin.sum()), f"thin face, {DELAUNAY}", f"thin faces, {DELAUNAY}"),
        (len(surface.degenerate_faces), f"face {HELD}", f"faces {HELD}"),
        (parts if parts > 1 else 0, "", "components, with no distance from one to another (grey, NaN)"),
    ]
    if isinstance(surface, SolidBoundary):  # distances run through its tetrahedra
        facts, warnings = [], []
    sentences, warned = ([counted(*each) for each in some if each[0]] for some in (facts, warnings))
    step = coordinate_step(surface)
    if 0 < COARSE * surface.mean_edge_length < step:
        largest, of_edge = np.abs(surface.bounds).max(), step / surface.mean_edge_length
        warned.append(
            f"coordinates up to {largest:.3g} are rounded to steps of {step:.2g}, {of_edge:.2g} of the mean edge; what "
            "is lost shows in distances (write the mesh nearer to the origin, or with more digits)"
        )
    return SurfaceNotes((*surface.facts, *sentences), tuple(surface.repairs), tuple(warned))


def coordinate_step(surface: Surface) -> float:
    """Return the spacing of the numbers that the largest coordinates are given in; 0 where these look exact.

    Coordinates are single precision where they fit it. Whole numbers and others that end in zeros look exact.
    """
    x = surface.vertices[surface.component_of_vertex >= 0]
    with np.errstate(over="ignore", under="ignore"):
        single = x.astype(np.float32)
    largest = x[np.abs(x) > np.abs(x).max() / 2]
    if (single == x).all():
        largest = largest.astype(np.float32)
    bits = largest.view(f"i{largest.itemsize}")
    return float(np.spacing(np.abs(largest)).max()) if (bits & 1).any() else 0.0
