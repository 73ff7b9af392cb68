"""Figure 3: a raw surface with many boundaries, holes and missing parts.

The paper: the isolines of biharmonic distance "follow the shape indifferently to the missing parts and holes".
Measured against the intact surface, at the same points: on a scan (noise, ragged holes, a missing foot), and on the
intact surface with holes punched into it and nothing else.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..analysis.diagnostics import FieldChange
from ..applications.perturbation import punched
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import CHANGE_COLUMNS, INSENSITIVE, change_cells, changes, percent
from .result import Cell, Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, SEEDS, Shapes, distance, spread_points, start_vertex, vertex_at

TITLE = "A raw surface with holes"
HOLES, HOLE_RADIUS = 24, 0.045
"""Holes at the points spread along edges after the first, and their radius as a share of the root of the area."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """The fields on the scan and on the punched surface against the intact one; on the own surface, punched only."""
    (name,) = shapes.names("figure")
    intact = shapes[name]
    pictured = vertex_at(intact, 0.5, 0.72, "back")
    pairs = {f"{name}, punched": _with_holes(intact)}
    same = {f"{name}, punched": np.arange(len(intact.vertices))}
    if shapes.own is None:
        pairs = {"scan": shapes["scan"]} | pairs
        off, same["scan"] = cKDTree(intact.vertices).query(shapes["scan"].vertices)
        # A scanned point that left its place by more than an edge has no counterpart.
        same["scan"] = np.where(off < intact.mean_edge_length, same["scan"], -1)
    rows: list[tuple[Cell, ...]] = []
    panels: list[Panel] = []
    worst: dict[tuple[str, str], list[FieldChange]] = {}
    sources = {"pictured": pictured} | {seed: start_vertex(intact, seed) for seed in SEEDS[: 1 if quick else 5]}
    for q, (damage, surface) in enumerate(pairs.items()):
        laplacian = Laplacian(surface)
        there = same[damage]
        usable = np.flatnonzero((there >= 0) & (surface.component_of_vertex == 0))
        for k, (label, vertex) in enumerate(sources.items()):
            part(progress, q / len(pairs), (q + 1) / len(pairs))(k / len(sources), f"{damage}, {label}")
            # The source is the point of the damaged surface nearest to it.
            near = cKDTree(surface.vertices[usable]).query(intact.vertices[vertex])[1]
            source = int(usable[near])
            before, after = {}, {}
            for kind in DISTANCES:
                whole = distance(shapes.laplacian(name), kind).from_source(int(there[source]))
                after[kind] = distance(laplacian, kind).from_source(source)
                before[kind] = np.where(there >= 0, whole[there], np.nan)
                if label == "pictured":
                    mark = (Mark(int(there[source]), "source"),)
                    if not q:
                        panels.append(Panel(kind, name, whole, "intact", mark, ("front", "back")))
                    mark = (Mark(source, "source"),)
                    panels.append(Panel(kind, damage, after[kind], damage, mark, ("front", "back")))
            for kind, change in changes(before, after).items():
                rows.append((damage, label, kind, *change_cells(change)))
                worst.setdefault((damage, kind), []).append(change)
    claims = []
    for damage in pairs:
        means = {kind: max(c.normalised_mean for c in worst[damage, kind]) for kind in DISTANCES}
        claims.append(
            Claim(
                f"Biharmonic distance is largely insensitive to holes and missing parts ({damage}).",
                "Largest mean change over the sources, after division by the maximum: "
                + ", ".join(f"{kind} {percent(mean)}" for kind, mean in means.items())
                + f" (insensitive: at most {percent(INSENSITIVE)}).",
                means["biharmonic"] <= INSENSITIVE,
            )
        )
    return Result(
        "fig3",
        TITLE,
        f"Sources: the upper back, vertex 0 and four random vertices. The scan is compared at each of its points with "
        f"the nearest vertex of the intact surface; the punched surface has {HOLES} round holes of radius "
        f"{HOLE_RADIUS:g} roots of the area, at farthest points, and all other vertices in place.",
        {name: intact} | pairs,
        tuple(panels),
        tables=(Table("changes", ("surface", "source", "distance", *CHANGE_COLUMNS), tuple(rows)),),
        claims=tuple(claims),
    )


def _with_holes(surface: Surface) -> Surface:
    centres = spread_points(surface, HOLES + 1)[1:]
    component, ids = surface.component(0)
    lengths = np.full((len(surface.vertices), len(centres)), np.inf)
    lengths[ids] = EdgeGeodesic(component).distances(np.searchsorted(ids, centres))
    radius = HOLE_RADIUS * float(np.sqrt(surface.face_areas.sum()))
    return punched(surface, lengths, max(radius, 1.5 * surface.mean_edge_length))
