"""Figures 4 and 5 are one experiment on different shapes: three distances, front and back, the source on the back."""

import numpy as np

from ..distances.distance import Distance
from ..errors import SolverError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import ELONGATED, FIELD_COLUMNS, ISOTROPIC, field_row, isotropy_chart, marks, shrinking, span
from .result import Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, SEEDS, Shapes, distance, start_vertex, vertex_at

BACK = {"figure": (0.5, 0.72), "figure_pose2": (0.5, 0.72), "animal": (0.5, 0.62), "hand": (0.5, 0.45)}
"""Where the pictured source is: shares of width and height; in the middle for other shapes."""


def compared(
    id: str, title: str, names: tuple[str, ...], shapes: Shapes, quick: bool, progress: Progress | None
) -> Result:
    """Three fields on each shape from a source on its back; numbers from it and five more sources (quick: one)."""
    rows, panels, charts = [], [], []
    failures: dict[str, str] = {}
    for q, name in enumerate(names):
        surface, laplacian = shapes[name], shapes.laplacian(name)
        pictured = vertex_at(surface, *BACK.get(name, (0.5, 0.5)), "back")
        sources = {"on the back": pictured}
        sources |= {seed: start_vertex(surface, seed) for seed in SEEDS[: 1 if quick else 5]}
        distances, missing = _distances(laplacian)
        failures |= missing
        if missing:
            shown = {kind: d.from_source(pictured) for kind, d in distances.items()}
            panels += [
                _panel(surface, name, kind, pictured, shown.get(kind), missing.get(kind, "")) for kind in DISTANCES
            ]
            continue
        for k, (label, source) in enumerate(sources.items()):
            part(progress, q / len(names), (q + 1) / len(names))(k / len(sources), f"{name}, {label}")
            geodesic = distances["geodesic"].from_source(source)
            fields = {k: geodesic if k == "geodesic" else d.from_source(source) for k, d in distances.items()}
            if label == "on the back":
                charts.append(isotropy_chart(surface, source, DISTANCES, f"isotropy on {name}", quick))
            for kind, field in fields.items():
                rows.append(field_row(surface, name, label, source, kind, field, geodesic))
                if label == "on the back":
                    panels.append(_panel(surface, name, distances[kind].label, source, field))
    table = Table("fields", FIELD_COLUMNS, tuple(rows))
    if not rows:
        # No shape has all three distances: the pictures are what there is.
        if not any(panel.field is not None for panel in panels):
            raise SolverError(" ".join(dict.fromkeys(failures.values())))
        said = "Nothing was measured: " + " ".join(dict.fromkeys(failures.values()))
        return Result(id, title, said, {name: shapes[name] for name in names}, tuple(panels))

    def numbers(column: str, kind: str) -> list[float]:
        return [float(v or 0) for v in table.values(column, distance=kind)]

    minima = {kind: numbers("minima besides the source", kind) for kind in DISTANCES}
    ratios = {kind: numbers("isotropy ratio", kind) for kind in DISTANCES}
    kinks = {kind: numbers("edges in kinks, %", kind) for kind in DISTANCES}
    depths = [float(v) for v in table.values("deepest of them, % of range", distance="biharmonic") if v is not None]
    on_back = table.values("minima besides the source", distance="diffusion t = 1", source="on the back")
    return Result(
        id,
        title,
        "Pictured source: on the back, at a fixed share of width and height. The numbers are also taken from vertex 0 "
        "and four random vertices. Minima and maxima persist over at least 0.1 % of the field's range; the raw counts "
        "are of vertices lower or higher than all their neighbours. The isotropy ratio is taken on the geodesic circle "
        f"of 4 % of the root of the area, at least four edges: isotropic up to {ISOTROPIC:g}, elongated from "
        f"{ELONGATED:g} on.",
        {name: shapes[name] for name in names},
        tuple(panels),
        tuple(charts),
        tables=(table,),
        claims=(
            Claim(
                "Biharmonic distance has no local minima, except at the source point.",
                f"Minima besides the source, in {len(rows) // 3} fields: {sum(minima['biharmonic']):g} in all"
                + (f"; the deepest by {max(depths):.3g} % of the range." if depths else "."),
                max(minima["biharmonic"]) == 0,
            ),
            Claim(
                "With the source on the back, a local minimum of diffusion distance (t = 1) appears on the front.",
                f"Minima besides the source: {', '.join(f'{n} {c}' for n, c in zip(names, on_back, strict=True))}; "
                f"over all sources {span(minima['diffusion t = 1'])}.",
                any(bool(c) for c in on_back),
            ),
            Claim(
                "Near the source isolines of biharmonic and geodesic distance are circles, of diffusion elongated.",
                "Isotropy ratio: "
                + ", ".join(f"{kind} {span(v)}" for kind, v in ratios.items())
                + "".join(f"; {chart.heading} {shrinking(chart)}" for chart in charts)
                + ".",
                max(*ratios["biharmonic"], *ratios["geodesic"]) <= ISOTROPIC
                and max(ratios["diffusion t = 1"]) >= ELONGATED,
            ),
            Claim(
                "Geodesic distance is not smooth: cusps and ridges, above all opposite to the source.",
                "Edges in kinks: "
                + ", ".join(f"{kind} {span(v)} %" for kind, v in kinks.items())
                + " (holds if geodesic has over twice biharmonic's share from every source).",
                all(g > 2 * b for g, b in zip(kinks["geodesic"], kinks["biharmonic"], strict=True)),
            ),
        ),
    )


def _distances(laplacian: Laplacian) -> tuple[dict[str, Distance], dict[str, str]]:
    """The distances that can be had, and of the others the reason why not."""
    distances, failures = {}, {}
    for kind in DISTANCES:
        try:
            distances[kind] = distance(laplacian, kind)
        except SolverError as error:
            failures[kind] = str(error)
    return distances, failures


def _panel(
    surface: Surface, name: str, heading: str, source: int, field: np.ndarray | None, failure: str = ""
) -> Panel:
    shown = (Mark(source, "source"),) if field is None else marks(surface, field, source)
    return Panel(heading, name, field, name, shown, ("front", "back"), failure=failure)
