"""Figures 4 and 5 are one experiment on different shapes: three distances, front and back, the source on the back."""

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..distances.distance import Distance
from ..distances.distance_types import Spec
from ..errors import SolverError
from ..progress import Progress, part, steps
from ..surface import Surface, vertex_normals
from .circles import BACK, PROTOCOL, gather_shared_circles
from .measures import FIELD_COLUMNS, deepest_minimum, field_row, kinked_edges, marks, over
from .parts import Parts
from .result import STATEMENTS, Cell, Chart, Claim, Gathered, Mark, Panel, Result, Table
from .shapes import DISTANCES, Shapes, distances_there, random_sources, spec_of

NEEDS = {1: ("diffusion t = 1",), 2: ("circles",), 3: ("biharmonic", "geodesic")}
"""The measurements that each of the three statements is judged by."""
ON_THE_BACK = -0.5
"""The cosine of normals with the direction of the view from the front, of points that are on the back."""
FIELDS, FIELDS_EACH, QUICK_FIELDS = 24, 8, 4
"""Random sources on a shape, on each of several, and of the quick version."""
SOURCE_COLUMNS = (
    *("shape", "source", "vertex", "deepest other minimum, biharmonic, %", "kinks, geodesic over biharmonic"),
    "kinks of geodesic, opposite over own half",
)


def compared(
    id: str, title: str, names: tuple[str, ...], shapes: Shapes, quick: bool, progress: Progress | None
) -> Result:
    """Compare three fields on each shape from a source on its back, with numbers from it and random sources."""
    count = QUICK_FIELDS if quick else (FIELDS if len(names) == 1 else FIELDS_EACH)
    found, parts = Gathered(), Parts()
    rows, sources, panels, charts = [], [], [], []
    for step, name in steps(progress, names):
        surface, laplacian = shapes[name], shapes.laplacian(name)
        pictured = shapes.pictured_source(name, "back")
        distances = distances_there(laplacian, parts, name)
        tried = {kind: parts.do(f"{kind} on {name}", d.from_source, pictured) for kind, d in distances.items()}
        fields = {kind: field for kind, field in tried.items() if field is not None}
        for kind in DISTANCES:
            heading = distances[kind].label if kind in distances else kind
            reason = parts.why(f"{kind} on {name}")
            spec = spec_of(kind) if kind in fields else None
            panels.append(_panel(surface, name, heading, pictured, fields.get(kind), reason, spec))
        distances = {kind: distances[kind] for kind in fields}
        if "biharmonic" not in fields and "diffusion t = 1" not in fields:
            continue
        if "geodesic" in fields:
            for kind, values in fields.items():
                rows.append(field_row(surface, name, "on the back", pictured, kind, values, fields["geodesic"]))
        for k, source in enumerate([pictured, *random_sources(surface, count)]):
            part(step, 0, 0.6)(k / count, f"{name}, vertex {source}")
            numbers = _of_source(surface, source, distances, found, id, not k)
            sources.append((name, f"random {k}" if k else "on the back", source, *numbers))
        if "diffusion t = 1" in distances:
            _minima_on_the_front(shapes, name, pictured, count, distances["diffusion t = 1"], found, id)
        part(step, 0.7, 1)(0.0, f"{name}, circles")
        circled = gather_shared_circles(found, parts, shapes, name, count, BACK, part(step, 0.7, 1))
        if circled is not None and np.isfinite(circled.ratios["biharmonic"][BACK]).all():
            charts.append(circled.chart(f"isotropy on {name}", BACK))
    if not sources:
        # No shape has what a statement needs: the pictures are what there is.
        reasons = parts.why(*(f"{kind} on {name}" for name in names for kind in DISTANCES))
        if not any(panel.field is not None for panel in panels):
            raise SolverError(reasons)
        note = f"Nothing was measured: {reasons}"
        unmeasured = tuple(Claim(f"{id}-{k}", failure=note) for k in NEEDS)
        surfaces = {name: shapes[name] for name in names}
        return Result(id, title, note, surfaces, tuple(panels), claims=unmeasured, not_done=tuple(parts.not_done))
    return Result(
        id,
        title,
        "The pictured source is on the back, at a fixed share of the width and height; numbers are also measured from "
        f"{count} random vertices of each shape, and minima on the front from as many on the back. The front, or the "
        "half opposite to a source, is where normals point away from the source's. Minima and maxima in the table "
        "have a persistence of at least 0.1 % of the field's range, marked ones of 1 %; raw counts are of all "
        "vertices lower or higher than their "
        "neighbours. " + PROTOCOL,
        {name: shapes[name] for name in names},
        tuple(panels),
        tuple(charts),
        tables=(
            *([Table("fields", FIELD_COLUMNS, tuple(rows))] if rows else []),
            Table("sources", SOURCE_COLUMNS, tuple(sources)),
        ),
        claims=tuple(
            found.claim(
                f"{id}-{k}",
                _note(k, charts),
                failure=parts.why(*(f"{what} on {name}" for name in names for what in needed)),
            )
            for k, needed in NEEDS.items()
        ),
        not_done=tuple(parts.not_done),
    )


def _of_source(
    surface: Surface, source: int, distances: dict[str, Distance], found: Gathered, id: str, is_pictured: bool
) -> tuple[Cell, Cell, Cell]:
    """Measure the depth of minima and the fraction of kinks from a source; None for what needs another distance."""
    if "biharmonic" not in distances:
        return None, None, None
    biharmonic = distances["biharmonic"].from_source(source)
    depth = deepest_minimum(surface, biharmonic, source)
    if "geodesic" not in distances:
        return 100 * depth, None, None
    geodesic = distances["geodesic"].from_source(source)
    share, kinked = kinked_edges(surface, geodesic, geodesic)
    more = over(share, kinked_edges(surface, biharmonic, geodesic)[0])
    opposite = _opposite(surface, source)
    x = surface.vertices[kinked]
    lengths = np.linalg.norm(x[:, 0] - x[:, 1], axis=1)
    there = opposite[kinked].all(axis=1)
    areas = surface.face_areas
    far = float(areas[opposite[surface.faces].all(axis=1)].sum() / areas.sum())
    # Lengths of kinks per area, in each of the two parts.
    denser = over(float(lengths[there].sum()) * (1 - far), float(lengths[~there].sum()) * far)
    names = STATEMENTS[f"{id}-3"].names
    for name, number in zip(names, (more, denser), strict=True):
        found.add(name, number, is_pictured)
    cells = [None if np.isnan(number) else number for number in (more, denser)]
    return 100 * depth, cells[0], cells[1]


def _minima_on_the_front(
    shapes: Shapes, name: str, pictured: int, count: int, diffusion: Distance, found: Gathered, id: str
) -> None:
    surface = shapes[name]
    on_the_back = vertex_normals(surface) @ shapes.axes[:, 2] <= ON_THE_BACK
    for k, source in enumerate([pictured, *random_sources(surface, count, on_the_back)]):
        depth = deepest_minimum(surface, diffusion.from_source(source), source, _opposite(surface, source))
        found.add(STATEMENTS[f"{id}-1"].names[0], depth, not k)


def _opposite(surface: Surface, source: int) -> BoolArray:
    """Return (n,) bool: where normals point against the source's."""
    normals = vertex_normals(surface)
    against: BoolArray = normals @ normals[source] < 0
    return against


def _note(k: int, charts: list[Chart]) -> str:
    if k != 2:
        return ""
    ranges = ("; ".join(f"{s.name} {s.y[0]:.3g} to {s.y[-1]:.3g}" for s in chart.series) for chart in charts)
    return "".join(
        f"From the largest to the smallest circle, {c.heading}: {t}. " for c, t in zip(charts, ranges, strict=True)
    )


def _panel(
    surface: Surface,
    name: str,
    heading: str,
    source: int,
    field: FloatArray | None,
    failure: str,
    spec: Spec | None,
) -> Panel:
    shown = (Mark(source, "source"),) if field is None else marks(surface, field, source)
    return Panel(heading, name, field, name, shown, ("front", "back"), failure=failure, distance=spec)
