"""The claim of section 1 that biharmonic distance is insensitive to topology, and its counterpart on tessellation."""

import numpy as np

from ..analysis.diagnostics import FieldChange
from ..analysis.persistence import extrema
from ..applications.perturbation import vertex_normals, welded, with_handle
from ..applications.resizing import simplified
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import CHANGE_COLUMNS, INSENSITIVE, change_cells, changes, percent
from .result import Cell, Claim, Mark, Panel, Table
from .shapes import DISTANCES, SEEDS, Shapes, distance, spread_points, start_vertex

CANDIDATES = 400
"""Points among which the pair to be welded is sought."""


def topology(
    shapes: Shapes, name: str, quick: bool, progress: Progress
) -> tuple[dict[str, Surface], list[Panel], list[Table], list[Claim]]:
    """Changes by a weld where two parts nearly touch, and by a thin handle between two tips."""
    surface = shapes[name]
    joins = {"thin handle": tips(surface)}
    edited = {"thin handle": with_handle(surface, *_faces_at(surface, joins["thin handle"]))}
    pair = nearly_touching(surface)
    if pair is not None:
        joins["weld"] = pair
        edited["weld"] = welded(surface, *_faces_at(surface, pair))
    n = len(surface.vertices)
    rows: list[tuple[Cell, ...]] = []
    panels: list[Panel] = []
    claims: list[Claim] = []
    seeds = SEEDS[: 2 if quick else 5]
    for k, (edit, other) in enumerate(edited.items()):
        laplacian = Laplacian(other)
        found: dict[str, list[FieldChange]] = {kind: [] for kind in DISTANCES}
        # A shortcut tells most from where it begins.
        sources = {"at the join": joins[edit][0]} | {seed: start_vertex(surface, seed) for seed in seeds}
        for q, (label, vertex) in enumerate(sources.items()):
            part(progress, k / 2, (k + 1) / 2)(q / len(sources), f"{edit}, {label}")
            source = _still_there(other, vertex)
            old, new = _fields(shapes.laplacian(name), source), _fields(laplacian, source)
            for kind, change in changes(old, {kind: field[:n] for kind, field in new.items()}).items():
                found[kind].append(change)
                rows.append((edit, label, kind, *change_cells(change)))
            if not q:
                for kind in DISTANCES:
                    mark = (Mark(source, "source"),)
                    if not k:
                        panels.append(Panel(kind, name, old[kind], "before", mark))
                    panels.append(Panel(kind, edit, new[kind], edit, mark))
        means = {kind: max(c.normalised_mean for c in found[kind]) for kind in DISTANCES}
        largest = {kind: max(c.largest for c in found[kind]) for kind in DISTANCES}
        claims.append(
            Claim(
                f"Biharmonic distance is insensitive to small changes of topology ({edit}), geodesic is not.",
                "Largest mean change over the sources, after division by the maximum (largest raw change in "
                "parentheses): "
                + ", ".join(f"{d} {percent(means[d])} ({percent(largest[d])})" for d in DISTANCES)
                + ".",
                means["biharmonic"] <= INSENSITIVE and means["biharmonic"] < means["geodesic"],
            )
        )
    table = Table("topology", ("change", "source", "distance", *CHANGE_COLUMNS), tuple(rows))
    return {name: surface} | edited, panels, [table], claims


def tessellation(shapes: Shapes, name: str, quick: bool, progress: Progress) -> tuple[list[Table], list[Claim]]:
    """Section 5.1: a smooth distance can be approximated by sub-sampling; measured at the vertices that stay."""
    surface = shapes[name]
    rows: list[tuple[Cell, ...]] = []
    shares = (2, 8) if quick else (2, 4, 8, 16)
    for k, share in enumerate(shares):
        progress(k / len(shares), f"simplified to 1/{share}")
        coarse, kept = simplified(surface, len(surface.vertices) // share)
        sources = [int(np.searchsorted(kept, kept[0])), len(kept) // 2]
        for kind in DISTANCES:
            fine, rough = distance(shapes.laplacian(name), kind), distance(Laplacian(coarse), kind)
            for source in sources:
                change = changes({kind: fine.from_source(int(kept[source]))[kept]}, {kind: rough.from_source(source)})
                rows.append((len(kept), int(kept[source]), kind, *change_cells(change[kind])))
    table = Table("simplification", ("vertices", "source", "distance", *CHANGE_COLUMNS), tuple(rows))
    last = len(surface.vertices) // shares[-1]
    mean = {}
    for kind in DISTANCES:
        means = [float(v or 0) for v in table.values("raw mean", vertices=last, distance=kind)]
        mean[kind] = float(np.mean(means))
    return [table], [
        Claim(
            "Biharmonic distance can be approximated by sub-sampling of the mesh, geodesic distance less well.",
            f"Mean raw change at the same points from {len(surface.vertices):,} to {last:,} vertices: "
            + ", ".join(f"{kind} {percent(v)}" for kind, v in mean.items())
            + ".",
            mean["biharmonic"] <= INSENSITIVE and mean["biharmonic"] < mean["geodesic"],
        )
    ]


def nearly_touching(surface: Surface) -> tuple[int, int] | None:
    """Two vertices far apart along the surface and close in space: the greatest ratio among spread points.

    None where no two points of the surface face each other, as on a convex one.
    """
    points = spread_points(surface, min(CANDIDATES, len(surface.vertices) // 4))
    component, ids = surface.component(0)
    along = EdgeGeodesic(component).distances(np.searchsorted(ids, points))[np.searchsorted(ids, points)]
    x = surface.vertices[points]
    straight = np.linalg.norm(x[:, None] - x, axis=2)
    # Not on both sides of a thin sheet: the straight way leaves the surface along its normals.
    outward = vertex_normals(surface)[points]
    way = (x[None] - x[:, None]) / np.where(straight > 0, straight, 1)[:, :, None]
    facing = np.einsum("ijk,ik->ij", way, outward) > 0.3
    ratio = np.where(facing & facing.T & (straight > 0), along / np.where(straight > 0, straight, 1), 0)
    i, j = np.unravel_index(np.argmax(ratio), ratio.shape)
    return (int(points[i]), int(points[j])) if ratio[i, j] > 0 else None


def tips(surface: Surface) -> tuple[int, int]:
    """The two most pronounced ends: maxima of edge distance from the start."""
    component, ids = surface.component(0)
    lengths = EdgeGeodesic(component).distances(int(np.searchsorted(ids, start_vertex(surface))))
    found = extrema(component, lengths).maxima
    others = found[1] if len(found) > 1 else np.searchsorted(ids, start_vertex(surface))
    return int(ids[found[0]]), int(ids[others])


def _faces_at(surface: Surface, vertices: tuple[int, int]) -> tuple[int, int]:
    first, second = (int(np.flatnonzero((surface.faces == v).any(axis=1))[0]) for v in vertices)
    return first, second


def _still_there(surface: Surface, vertex: int) -> int:
    if surface.component_of_vertex[vertex] == 0:
        return vertex
    left = np.flatnonzero(surface.component_of_vertex == 0)
    return int(left[np.linalg.norm(surface.vertices[left] - surface.vertices[vertex], axis=1).argmin()])


def _fields(laplacian: Laplacian, source: int) -> dict[str, np.ndarray]:
    return {kind: distance(laplacian, kind).from_source(source) for kind in DISTANCES}
