"""The claim of section 1 that biharmonic distance is insensitive to small changes of topology."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..analysis.diagnostics import FieldChange
from ..analysis.persistence import extrema
from ..applications.perturbation import face_at, vertex_normals, welded, with_handle
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import ParameterError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import CHANGE_COLUMNS, by_source, change_cells, changes, percent
from .parts import Parts
from .result import Cell, Claim, Mark, Panel, Table
from .shapes import DISTANCES, Shapes, distance, spread_points, start_vertex, starts

CANDIDATES = 400
"""Points among which pairs to be welded are sought."""
OTHERS, QUICK_OTHERS = 9, 2
"""Joins beside the pictured one."""
SOURCES, QUICK_SOURCES = 5, 2
"""Random sources of biharmonic distance, beside the join."""
APART = 0.25
"""Of the two ends of a handle, along edges and in roots of the area; joins whose ends are both nearer to those of
another one than this are the same."""
FAR_ROUND = 2.0
"""Parts touch nearly if the way along the surface is longer than this many times the straight one."""
Pair = tuple[int, int]
Fields = dict[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class Joined:
    """Fields from where parts of a surface are joined, before and after, and their changes.

    every: how biharmonic distance changes from the join and from random sources, by their names.
    """

    source: int
    before: Fields
    after: Fields
    change: dict[str, FieldChange]
    every: dict[str, FieldChange]


def topology(
    shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress
) -> tuple[dict[str, Surface], list[Panel], list[Table], list[Claim]]:
    """Changes by a thin handle between two tips and by a weld where two parts nearly touch, and by others like them."""
    surface = shapes[name]
    others = QUICK_OTHERS if quick else OTHERS
    edits: dict[str, tuple[Callable[[Surface, int, int], Surface], list[Pair]]] = {
        "thin handle": (with_handle, [tips(surface), *far_pairs(surface, 2 * others)]),
        "weld": (welded, nearly_touching(surface, 2 * others + 1)),
    }
    sources = {seed: start_vertex(surface, seed) for seed in starts(QUICK_SOURCES if quick else SOURCES)}
    edited: dict[str, Surface] = {}
    rows: list[tuple[Cell, ...]] = []
    panels: list[Panel] = []
    claims: list[Claim] = []
    for k, (edit, (join, pairs)) in enumerate(edits.items()):
        step = part(progress, k / 2, (k + 1) / 2)
        found: list[dict[str, FieldChange]] = []
        ways: list[float] = []
        for pair in pairs:
            # Ends that are too close, or of one face, cannot be joined.
            try:
                other = join(surface, face_at(surface, pair[0]), face_at(surface, pair[1]))
            except ParameterError:
                continue
            label = f"{edit} {len(found) + 1}"
            step(len(found) / (others + 1), f"{label} of {others + 1}")
            joined = parts.do(label, _joined, shapes, name, other, pair[0], sources)
            if joined is None:
                continue
            if not found:
                edited[edit] = other
                panels += _panels(name, edit, joined)
            rows += [(label, "at the join", kind, *change_cells(c)) for kind, c in joined.change.items()]
            rows += [(label, seed, "biharmonic", *change_cells(joined.every[seed])) for seed in sources]
            found.append(joined.change | {"biharmonic, worst": _worst(list(joined.every.values()))})
            ways.append(_way_round(surface, pair))
            if len(found) > others:
                break
        claims.append(_claim("claims-weld" if edit == "weld" else "claims-handle", found, ways))
    tables = [Table("topology", ("change", "source", "distance", *CHANGE_COLUMNS), tuple(rows))] if rows else []
    return {name: surface} | edited, panels, tables, claims


def _joined(shapes: Shapes, name: str, other: Surface, end: int, sources: dict[str, int]) -> Joined:
    """end: a vertex where the surface is joined, from which all distances are measured."""
    laplacian, source = Laplacian(other), _still_there(other, end)
    before, after = (_fields(each, source) for each in (shapes.laplacian(name), laplacian))
    change = _cut_changes(before, after)
    every = {"at the join": change["biharmonic"]}
    for seed, vertex in sources.items():
        there = _still_there(other, vertex)
        was, now = (
            {"biharmonic": distance(each, "biharmonic").from_source(there)}
            for each in (shapes.laplacian(name), laplacian)
        )
        every[seed] = _cut_changes(was, now)["biharmonic"]
    return Joined(source, before, after, change, every)


def _claim(id: str, found: list[dict[str, FieldChange]], ways: list[float]) -> Claim:
    """ways: of each join, how many times longer than straight the way along the surface was."""
    if not found:
        return Claim(id, failure="No two parts of this surface could be joined so, and measured.")
    worst = [change["biharmonic, worst"] for change in found]
    ratios = [c["geodesic"].normalised_largest / w.normalised_largest for c, w in zip(found, worst, strict=True)]
    pictured = found[0]
    return Claim(
        id,
        {
            "mean change, biharmonic": by_source([w.normalised_mean for w in worst]),
            "largest change, biharmonic": by_source([w.normalised_largest for w in worst]),
            "largest change, geodesic over biharmonic": by_source(ratios),
        },
        "At the pictured join, from its own place, after division by the maximum, mean and largest change: "
        + ", ".join(
            f"{kind} {percent(pictured[kind].normalised_mean)} and {percent(pictured[kind].normalised_largest)}"
            for kind in DISTANCES
        )
        + f". {_shortcuts(ratios[1:], ways[1:])}",
    )


def _shortcuts(ratios: list[float], ways: list[float]) -> str:
    """Of the other joins, those that are shortcuts, in words."""
    short = [ratio for ratio, way in zip(ratios, ways, strict=True) if way >= FAR_ROUND]
    said = f"Of the {len(ways)} other joins {len(short)} make the way between their ends at most half as long"
    if not short:
        return f"{said}."
    return f"{said}; there geodesic distance changes {min(short):.2g} to {max(short):.2g} times as much as biharmonic."


def _cut_changes(before: Fields, after: Fields) -> dict[str, FieldChange]:
    """At the vertices of before, whose ids stay."""
    return changes(before, {kind: field[: len(before[kind])] for kind, field in after.items()})


def _worst(found: list[FieldChange]) -> FieldChange:
    return FieldChange(
        *(max(getattr(c, x) for c in found) for x in ("mean", "largest", "normalised_mean", "normalised_largest"))
    )


def _panels(name: str, edit: str, joined: Joined) -> list[Panel]:
    panels, mark = [], (Mark(joined.source, "source"),)
    for kind in DISTANCES:
        panels.append(Panel(f"{kind}, before", name, joined.before[kind], edit, mark, ("source",)))
        panels.append(Panel(f"{kind}, after", edit, joined.after[kind], edit, mark, ("source",)))
    return panels


def _way_round(surface: Surface, pair: Pair) -> float:
    """The way along edges between two vertices over the straight one."""
    return float(
        EdgeGeodesic(surface).distances(pair[0])[pair[1]] / np.linalg.norm(np.subtract(*surface.vertices[[*pair]]))
    )


def far_pairs(surface: Surface, count: int) -> list[Pair]:
    """Random pairs of spread points that are apart along edges."""
    points = spread_points(surface, min(6 * count, len(surface.vertices) // 4))
    component, ids = surface.component(0)
    along = EdgeGeodesic(component).distances(np.searchsorted(ids, points))[np.searchsorted(ids, points)]
    i, j = np.nonzero(np.triu(along > APART * _unit(surface)))
    chosen = np.random.default_rng(0).permutation(len(i))[:count]
    return [(int(points[i[k]]), int(points[j[k]])) for k in chosen]


def nearly_touching(surface: Surface, count: int = 1) -> list[Pair]:
    """Pairs of vertices far apart along the surface and close in space, the greatest ratio first, among spread points.

    No two are at the same place.  None where no two points of the surface face each other, as on a convex one.
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
    found: list[Pair] = []
    while len(found) < count and ratio.max() > FAR_ROUND:
        i, j = np.unravel_index(np.argmax(ratio), ratio.shape)
        found.append((int(points[i]), int(points[j])))
        near = along < APART * _unit(surface)
        ratio[np.outer(near[i], near[j]) | np.outer(near[j], near[i])] = 0
    return found


def tips(surface: Surface) -> tuple[int, int]:
    """The two most pronounced ends: maxima of edge distance from the start."""
    component, ids = surface.component(0)
    lengths = EdgeGeodesic(component).distances(int(np.searchsorted(ids, start_vertex(surface))))
    found = extrema(component, lengths).maxima
    others = found[1] if len(found) > 1 else np.searchsorted(ids, start_vertex(surface))
    return int(ids[found[0]]), int(ids[others])


def _unit(surface: Surface) -> float:
    return float(np.sqrt(surface.face_areas.sum()))


def _still_there(surface: Surface, vertex: int) -> int:
    if surface.component_of_vertex[vertex] == 0:
        return vertex
    left = np.flatnonzero(surface.component_of_vertex == 0)
    return int(left[np.linalg.norm(surface.vertices[left] - surface.vertices[vertex], axis=1).argmin()])


def _fields(laplacian: Laplacian, source: int) -> dict[str, np.ndarray]:
    return {kind: distance(laplacian, kind).from_source(source) for kind in DISTANCES}
