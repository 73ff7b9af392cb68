"""Figure 3: a raw surface with many boundaries, holes and missing parts.

The paper: the isolines of biharmonic distance "follow the shape indifferently to the missing parts and holes".
Two damaged surfaces are compared with the intact one at the same points: a scan (with noise, ragged holes and a missing
foot), and the intact surface with holes punched into it.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial import cKDTree

from ..analysis.diagnostics import FieldChange
from ..applications.perturbation import punched
from ..arrays import IntArray
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import SolverError
from ..laplacian import Laplacian
from ..progress import Progress, steps
from ..surface import Surface
from ._stated_figures import CHANGE, OF_GEODESIC
from .measures import CHANGE_COLUMNS, by_source, change_cells, changes, over, percent
from .parts import Parts
from .result import STATEMENTS, Cell, Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, UPPER_BACK, Shapes, distance, distances_there, random_sources, spec_of, spread_points
from .verdicts import Numbers

TITLE = "A raw surface with holes"
HOLES, REMOVED = 24, 0.15
"""Holes at the points spread along edges after the first, and the share of the area that they take."""
HOLE_RADIUS = 0.045
"""Of a hole on a shortest path, as a share of the root of the area."""
SOURCES, QUICK_SOURCES = 10, 4
"""Random sources beside the pictured one."""
PATHS, QUICK_PATHS = 6, 2
"""Of these, sources of shortest paths with a hole."""


@dataclass
class Found:
    """Measurements of a damaged surface, by distance; the pictured source comes first."""

    rows: list[tuple[Cell, ...]] = field(default_factory=list)
    panels: list[Panel] = field(default_factory=list)
    every: dict[str, list[FieldChange]] = field(default_factory=lambda: {kind: [] for kind in DISTANCES})


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compare fields on the scan and on the punched surface with the intact one; on the own surface, punched only."""
    (name,) = shapes.names("figure")
    intact, parts = shapes[name], Parts()
    sources = {"pictured": shapes.vertex_at(intact, *UPPER_BACK, "back")}
    random = random_sources(intact, QUICK_SOURCES if quick else SOURCES)
    sources |= {f"random {k}": source for k, source in enumerate(random, 1)}
    damaged: dict[str, tuple[Surface, IntArray]] = {}
    punched_name = f"{name}, punched"
    if shapes.own is None:
        scanned = parts.do("scan", _scanned, shapes, intact)
        if scanned is not None:
            damaged["scan"] = scanned
    holes = parts.do("holes", _with_holes, intact)
    if holes is not None:
        damaged[punched_name] = holes, np.arange(len(intact.vertices))
    found: dict[str, Found] = {}
    for step, (damage, (surface, there)) in steps(progress, damaged.items()):
        measured = parts.do(damage, _measured, shapes, name, damage, surface, there, sources, not found, parts, step)
        if measured is not None:
            found[damage] = measured
    paths = list(sources.values())[: 1 + (QUICK_PATHS if quick else PATHS)]
    on_paths = parts.do("holes on shortest paths", _holes_on_paths, shapes, name, paths)
    rows = tuple(row for each in found.values() for row in each.rows)
    removed = percent(1 - float(holes.face_areas.sum() / intact.face_areas.sum())) if holes is not None else ""
    return Result(
        "fig3",
        TITLE,
        f"The sources are on the upper back and at {len(random)} random vertices. Each point of the scan is compared "
        "with the nearest vertex of the intact surface, if that is within a mean edge length. The punched surface "
        f"has {HOLES} round holes of one radius at farthest points, which take {removed} of the area. A hole on a "
        f"shortest path has a radius of {HOLE_RADIUS:g} roots of the area and lies midway between the source and the "
        "point farthest from it; the largest change of the distances from the source counts.",
        {name: intact} | {damage: surface for damage, (surface, _) in damaged.items()},
        tuple(panel for each in found.values() for panel in each.panels),
        tables=(Table("changes", ("surface", "source", "distance", *CHANGE_COLUMNS), rows),) if rows else (),
        claims=(
            _claim("fig3-1", found.get("scan"), parts.why("scan") or "There is no scan of this mesh."),
            _claim("fig3-2", found.get(punched_name), parts.why("holes", punched_name)),
            _claim("fig3-3", found.get(punched_name), parts.why("holes", punched_name)),
            Claim("fig3-4", on_paths or {}, failure=parts.why("holes on shortest paths")),
        ),
        not_done=tuple(parts.not_done),
    )


def _measured(
    shapes: Shapes,
    name: str,
    damage: str,
    surface: Surface,
    there: IntArray,
    sources: dict[str, int],
    with_intact: bool,
    parts: Parts,
    progress: Progress,
) -> Found:
    """Measure a damaged surface; `there` (n,) are the vertices of the intact one that its vertices are, -1 for none."""
    found, intact, laplacian = Found(), shapes[name], Laplacian(surface)
    usable = np.flatnonzero((there >= 0) & (surface.component_of_vertex == 0))
    tree = cKDTree(surface.vertices[usable])
    before_it, after_it = (
        distances_there(each, parts, where) for each, where in ((shapes.laplacian(name), name), (laplacian, damage))
    )
    on = {kind: (each, after_it[kind]) for kind, each in before_it.items() if kind in after_it}
    if "biharmonic" not in on:
        raise SolverError(parts.why(f"biharmonic on {name}", f"biharmonic on {damage}"))
    for k, (label, vertex) in enumerate(sources.items()):
        progress(k / len(sources), f"{damage}, {label}")
        # The source is the point of the damaged surface nearest to it.
        source = int(usable[tree.query(intact.vertices[vertex])[1]])
        whole = {kind: before.from_source(int(there[source])) for kind, (before, _) in on.items()}
        after = {kind: now.from_source(source) for kind, (_, now) in on.items()}
        before = {kind: np.where(there >= 0, field[there], np.nan) for kind, field in whole.items()}
        for kind, change in changes(before, after).items():
            found.rows.append((damage, label, kind, *change_cells(change)))
            found.every[kind].append(change)
        if label == "pictured":
            marks = (Mark(int(there[source]), "source"),), (Mark(source, "source"),)
            views = ("front", "back")
            if with_intact:
                found.panels += [
                    Panel(k, name, field, "intact", marks[0], views, distance=spec_of(k)) for k, field in whole.items()
                ]
            found.panels += [
                Panel(k, damage, field, damage, marks[1], views, distance=spec_of(k)) for k, field in after.items()
            ]
    return found


def _claim(id: str, found: Found | None, reason: str) -> Claim:
    """Make the claim; `reason` says why nothing was found."""
    if found is None:
        return Claim(id, failure=reason)
    means = {kind: [change.normalised_mean for change in every] for kind, every in found.every.items()}
    said = ", ".join(
        f"{kind} {percent(values[0])} from the pictured source, {percent(float(np.median(values)))} in the median"
        for kind, values in means.items()
        if values
    )
    numbers: dict[str, Numbers] = {CHANGE.name: by_source(means["biharmonic"])}
    if id == "fig3-3":
        both = zip(means["geodesic"], means["biharmonic"], strict=False)
        numbers = {OF_GEODESIC: by_source([over(*pair) for pair in both])}
    return Claim(
        id,
        numbers,
        f"Mean change after division by the maximum: {said}.",
    )


def _scanned(shapes: Shapes, intact: Surface) -> tuple[Surface, IntArray]:
    """Return the scan, and (n,) the vertex of the intact surface that each of its points is, -1 for none."""
    scan = shapes["scan"]
    off, same = cKDTree(intact.vertices).query(scan.vertices)
    # A scanned point that left its place by more than an edge has no counterpart.
    return scan, np.where(off < intact.mean_edge_length, same, -1)


def _with_holes(surface: Surface) -> Surface:
    centres = spread_points(surface, HOLES + 1)[1:]
    component, ids = surface.component(0)
    lengths = np.full((len(surface.vertices), 1), np.inf)
    lengths[ids, 0] = EdgeGeodesic(component).distances(np.searchsorted(ids, centres)).min(axis=1)
    # A hole takes the faces with all three corners in it.
    farthest = lengths[surface.faces, 0].max(axis=1)
    order = np.argsort(farthest)
    taken = np.cumsum(surface.face_areas[order])
    return punched(surface, lengths, farthest[order[np.searchsorted(taken, REMOVED * taken[-1])]])


def _holes_on_paths(shapes: Shapes, name: str, sources: list[int]) -> dict[str, Numbers]:
    """Measure the largest change of distances from each source by a hole on its longest shortest path."""
    intact, kinds = shapes[name], DISTANCES[:2]
    had = {kind: distance(shapes.laplacian(name), kind) for kind in kinds}
    radius = HOLE_RADIUS * float(np.sqrt(intact.face_areas.sum()))
    changed: list[tuple[float, float]] = []
    for source in sources:
        before = {kind: had[kind].from_source(source) for kind in kinds}
        near = before["geodesic"]
        far = had["geodesic"].from_source(int(np.nanargmax(near)))
        midway = np.abs(near - far) < np.nanmax(near) / 10
        middle = int(np.argmin(np.where(midway, near + far, np.inf)))
        around = had["geodesic"].from_source(middle)
        holed = Laplacian(punched(intact, around[:, None], max(radius, 1.5 * intact.mean_edge_length)))
        change = changes(before, {kind: distance(holed, kind).from_source(source) for kind in kinds})
        changed.append((change["geodesic"].normalised_largest, change["biharmonic"].normalised_largest))
    numbers = [geodesic for geodesic, _ in changed], [over(*pair) for pair in changed]
    return dict(zip(STATEMENTS["fig3-4"].names, map(by_source, numbers), strict=True))
