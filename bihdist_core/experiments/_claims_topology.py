"""The claim of section 1 that biharmonic distance is insensitive to small changes of topology."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..analysis.diagnostics import FieldChange
from ..analysis.persistence import extrema
from ..applications.perturbation import face_at, welded, with_handle
from ..arrays import FloatArray
from ..distances.distance import Distance
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import ParameterError, SolverError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface, vertex_normals
from .measures import CHANGE_COLUMNS, by_source, change_cells, changes, over, percent
from .parts import Parts
from .result import Cell, Claim, Findings, Mark, Panel, Table
from .shapes import DISTANCES, Shapes, distances_there, spread_points, start_vertex, starts
from .verdicts import Numbers

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
Fields = dict[str, FloatArray]
Change = dict[str, FieldChange]
"""By the kinds of distances from the join, and under `WORST` the worst of biharmonic distance from all sources."""
WORST = "biharmonic, worst"
EDITS: dict[str, Callable[[Surface, int, int], Surface]] = {"thin handle": with_handle, "weld": welded}


@dataclass(frozen=True, eq=False)
class Joined:
    """Fields from where parts of a surface are joined, before and after, and their changes.

    They are by the kinds of distances that can be had. `every` has the changes of biharmonic distance from the join and
    from random sources, by their names.
    """

    source: int
    before: Fields
    after: Fields
    change: dict[str, FieldChange]
    every: dict[str, FieldChange]


def topology(shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress) -> Findings:
    """Measure changes by a thin handle between two tips, by a weld where two parts nearly touch, and by others."""
    surface = shapes[name]
    others = QUICK_OTHERS if quick else OTHERS
    sources = {seed: start_vertex(surface, seed) for seed in starts(QUICK_SOURCES if quick else SOURCES)}
    edited: dict[str, Surface] = {}
    rows: list[tuple[Cell, ...]] = []
    panels: list[Panel] = []
    claims: list[Claim] = []
    before = distances_there(shapes.laplacian(name), parts, name)
    if "biharmonic" not in before:
        raise SolverError(parts.why(f"biharmonic on {name}"))
    for k, (edit, join) in enumerate(EDITS.items()):
        step = part(progress, k / 2, (k + 1) / 2)
        pictured, random = _pairs(surface, edit, others, parts)
        first: Change | None = None
        found: list[Change] = []
        ways: list[float] = []
        for q, pair in enumerate([*pictured, *random]):
            is_pictured = q < len(pictured)
            label = f"{edit} {1 if is_pictured else len(found) + 2}"
            step(len(found) / (others + 1), f"{label} of {others + 1}")
            try:
                other = join(surface, face_at(surface, pair[0]), face_at(surface, pair[1]))
            except ParameterError as error:
                # Some random ends are too close, or of one face: there are more of them.
                if is_pictured:
                    parts.note(label, str(error))
                continue
            joined = parts.do(label, _joined, before, name, other, label, pair[0], sources, parts)
            if joined is None:
                continue
            rows += [(label, "at the join", kind, *change_cells(c)) for kind, c in joined.change.items()]
            rows += [(label, seed, "biharmonic", *change_cells(joined.every[seed])) for seed in sources]
            change = joined.change | {WORST: _worst(list(joined.every.values()))}
            if is_pictured:
                first = change
                edited[edit] = other
                panels += _panels(name, edit, joined)
            else:
                found.append(change)
                ways.append(_way_round(surface, pair))
            if len(found) == others:
                break
        labels = [f"{edit} {number}" for number in range(1, others + 2)]
        reason = parts.why(f"{edit}s", *labels, *(f"geodesic on {where}" for where in (name, *labels)))
        claims.append(_claim("claims-weld" if edit == "weld" else "claims-handle", first, found, ways, reason))
    tables = [Table("topology", ("change", "source", "distance", *CHANGE_COLUMNS), tuple(rows))] if rows else []
    return Findings({name: surface} | edited, panels, tables=tables, claims=claims)


def _pairs(surface: Surface, edit: str, others: int, parts: Parts) -> tuple[list[Pair], list[Pair]]:
    """Return the pictured pair, if there is one, and twice as many others as are wanted, as some cannot be joined."""
    if edit == "weld":
        touching = parts.do(f"{edit}s", nearly_touching, surface, 2 * others + 1) or []
        return touching[:1], touching[1:]
    ends = parts.do(f"{edit} 1", tips, surface)
    return [ends] if ends else [], parts.do(f"{edit}s", far_pairs, surface, 2 * others) or []


def _joined(
    had: dict[str, Distance], name: str, other: Surface, label: str, end: int, sources: dict[str, int], parts: Parts
) -> Joined:
    """Measure the changes from `end`, a vertex where the surface is joined, given the distances before.

    Raises SolverError if biharmonic distance cannot be had.
    """
    now, source = distances_there(Laplacian(other), parts, label), _still_there(other, end)
    if "biharmonic" not in now:
        raise SolverError(parts.why(f"biharmonic on {label}"))
    kinds = [kind for kind in had if kind in now]
    before, after = ({kind: each[kind].from_source(source) for kind in kinds} for each in (had, now))
    change = _cut_changes(before, after)
    every = {"at the join": change["biharmonic"]}
    for seed, vertex in sources.items():
        there = _still_there(other, vertex)
        one, two = ({"biharmonic": each["biharmonic"].from_source(there)} for each in (had, now))
        every[seed] = _cut_changes(one, two)["biharmonic"]
    return Joined(source, before, after, change, every)


def _claim(id: str, pictured: Change | None, others: list[Change], ways: list[float], reason: str) -> Claim:
    """Make the claim of a statement on joins.

    `ways` says of each of the other joins how many times longer than straight the way along the surface was, `reason`
    why some joins, or distances, are missing.
    """
    found = [*([pictured] if pictured else []), *others]
    if not found:
        return Claim(id, failure=reason or "No two parts of this surface nearly touch, so none can be joined so.")
    shown = len(found) - len(others)
    numbers: dict[str, Numbers] = {
        "mean change, biharmonic": by_source([change[WORST].normalised_mean for change in found], shown),
        "largest change, biharmonic": by_source([change[WORST].normalised_largest for change in found], shown),
    }
    ratios = [_ratio(change) if "geodesic" in change else None for change in found]
    known = [ratio for ratio in ratios if ratio is not None]
    if known:
        numbers["largest change, geodesic over biharmonic"] = by_source(
            known, sum(ratio is not None for ratio in ratios[:shown])
        )
    note = ""
    if pictured:
        changes_found = ", ".join(
            f"{kind} {percent(pictured[kind].normalised_mean)} and {percent(pictured[kind].normalised_largest)}"
            for kind in DISTANCES
            if kind in pictured
        )
        note = f"At the pictured join, from its own place, over the maximum, mean and largest change: {changes_found}. "
    along = [(ratio, way) for ratio, way in zip(ratios[shown:], ways, strict=True) if ratio is not None]
    is_whole = pictured is not None and len(known) == len(found)
    note += _shortcuts([ratio for ratio, _ in along], [way for _, way in along])
    return Claim(id, numbers, note, failure="" if is_whole else reason)


def _ratio(change: Change) -> float:
    return over(change["geodesic"].normalised_largest, change[WORST].normalised_largest)


def _shortcuts(ratios: list[float], ways: list[float]) -> str:
    """Describe those of the other joins that are shortcuts."""
    short = [ratio for ratio, way in zip(ratios, ways, strict=True) if way >= FAR_ROUND]
    sentence = f"Of the {len(ways)} other joins {len(short)} make the way between their ends at most half as long"
    if not short:
        return f"{sentence}."
    return (
        f"{sentence}; there geodesic distance changes {min(short):.2g} to {max(short):.2g} times as much as biharmonic."
    )


def _cut_changes(before: Fields, after: Fields) -> dict[str, FieldChange]:
    """Return the changes at the vertices that were there before, whose ids stay."""
    return changes(before, {kind: field[: len(before[kind])] for kind, field in after.items()})


def _worst(found: list[FieldChange]) -> FieldChange:
    return FieldChange(
        *(max(getattr(c, x) for c in found) for x in ("mean", "largest", "normalised_mean", "normalised_largest"))
    )


def _panels(name: str, edit: str, joined: Joined) -> list[Panel]:
    panels, mark = [], (Mark(joined.source, "source"),)
    for kind in joined.change:
        panels.append(Panel(f"{kind}, before", name, joined.before[kind], edit, mark, ("source",)))
        panels.append(Panel(f"{kind}, after", edit, joined.after[kind], edit, mark, ("source",)))
    return panels


def _way_round(surface: Surface, pair: Pair) -> float:
    """Return the way along edges between two vertices over the straight one."""
    return float(
        EdgeGeodesic(surface).distances(pair[0])[pair[1]] / np.linalg.norm(np.subtract(*surface.vertices[[*pair]]))
    )


def far_pairs(surface: Surface, count: int) -> list[Pair]:
    """Choose random pairs of spread points that are apart along edges."""
    points = spread_points(surface, min(6 * count, len(surface.vertices) // 4))
    component, ids = surface.component(0)
    along = EdgeGeodesic(component).distances(np.searchsorted(ids, points))[np.searchsorted(ids, points)]
    i, j = np.nonzero(np.triu(along > APART * _unit(surface)))
    chosen = np.random.default_rng(0).permutation(len(i))[:count]
    return [(int(points[i[k]]), int(points[j[k]])) for k in chosen]


def nearly_touching(surface: Surface, count: int = 1) -> list[Pair]:
    """Find pairs of spread vertices far apart along the surface and close in space, the greatest ratio first.

    No two are at the same place. There is none where no two points of the surface face each other, as on a convex one.
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
    """Return the two most pronounced ends: maxima of edge distance from the start."""
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
