"""Figure 2: a flat domain, and five distance fields over it as heights.

The paper: diffusion distance "either possesses many local maxima or locally does not reflect the source point", the
geodesic field has a kink and isolines that are not aware of the shape far away; biharmonic distance balances the two.
"""

import numpy as np

from ..analysis.quality import small_radius
from ..applications.resizing import refined
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import ELONGATED, FIELD_COLUMNS, ISOTROPIC, KINK, field_row, inner_jumps, isotropy_chart, marks, span
from .result import Claim, Mark, Panel, Result, Table
from .shapes import SEEDS, Shapes, distance, start_vertex, vertex_at

TITLE = "Distances over a flat domain"
KINDS = ("diffusion t = 1", "diffusion t = 1/5", "diffusion t = 1/15", "geodesic", "biharmonic")


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Five fields from one source in the first corridor, and their numbers from it and five more (quick: one more)."""
    (name,) = shapes.names("domain")
    surface, laplacian = shapes[name], shapes.laplacian(name)
    flat = float(surface.vertices[:, 2].max() - surface.vertices[:, 2].min()) == 0
    source = vertex_at(surface, 0.12, 0.8)
    sources = {"pictured": source} | {seed: start_vertex(surface, seed) for seed in SEEDS[: 1 if quick else 5]}
    rows, fields = [], {}
    distances = {
        kind: distance(laplacian, kind, part(progress, 0.1 * k, 0.1 * k + 0.1)) for k, kind in enumerate(KINDS)
    }
    for k, (label, vertex) in enumerate(sources.items()):
        part(progress, 0.5, 1)(k / len(sources), label)
        geodesic = distances["geodesic"].from_source(vertex)
        for kind in KINDS:
            field = geodesic if kind == "geodesic" else distances[kind].from_source(vertex)
            rows.append(field_row(surface, name, label, vertex, kind, field, geodesic))
            if vertex == source:
                fields[kind] = field
    table = Table("fields", FIELD_COLUMNS, tuple(rows))

    part(progress, 0.95, 1)(0.0, "refined")
    kinks = _under_refinement(surface, source, {kind: fields[kind] for kind in ("geodesic", "biharmonic")})

    def numbers(column: str, kind: str) -> list[float]:
        return [float(v or 0) for v in table.values(column, distance=kind)]

    def count(kind: str) -> list[float]:
        pairs = zip(numbers("minima besides the source", kind), numbers("maxima", kind), strict=True)
        return [a + b for a, b in pairs]

    style = "height" if flat else "surface"
    short, long = "diffusion t = 1/15", "diffusion t = 1"
    return Result(
        "fig2",
        TITLE,
        "The pictured source is at 12 % of the width and 80 % of the height; the numbers are also taken from vertex 0 "
        "and four random vertices. Extrema persist over at least 0.1 % of the field's range; the source is not "
        "counted. A kink is an edge across which the gradient jumps by half its length, away from the source and the "
        f"boundary. The isotropy ratio is taken on a small geodesic circle: isotropic up to {ISOTROPIC:g}, elongated "
        f"from {ELONGATED:g} on.",
        {name: surface},
        (
            Panel("the domain", name, None, "fields", (Mark(source, "source"),)),
            *(
                Panel(kind, name, fields[kind], "fields", marks(surface, fields[kind], source), style=style)
                for kind in KINDS
            ),
        ),
        charts=(isotropy_chart(surface, source, KINDS, "isotropy", quick),),
        tables=(table, kinks),
        claims=(
            Claim(
                "Diffusion distance of small time has many local extrema far away.",
                f"Extrema besides the source, t = 1/15: {span(count(short))}; biharmonic: {span(count('biharmonic'))}.",
                max(count(short)) > max(count("biharmonic")),
            ),
            Claim(
                "Diffusion distance of large time does not reflect the source locally; biharmonic distance does.",
                f"Isotropy ratio, t = 1: {span(numbers('isotropy ratio', long))}; "
                f"biharmonic: {span(numbers('isotropy ratio', 'biharmonic'))}.",
                max(numbers("isotropy ratio", long)) >= ELONGATED
                and max(numbers("isotropy ratio", "biharmonic")) <= ISOTROPIC,
            ),
            Claim(
                "Geodesic distance has derivative singularities; biharmonic distance has none.",
                "Largest jump of the gradient over its length, away from source and boundary, on the mesh and on its "
                "refinement to four times as many faces (a kink's jump stays, a smooth field's halves): "
                + ", ".join(f"{kind} {a:.2f} and {b:.2f}" for kind, a, b in kinks.rows)
                + ".",
                kinks.value("refined", distance="geodesic") >= KINK > kinks.value("refined", distance="biharmonic"),
            ),
            Claim(
                "Biharmonic distance has no local minimum but the source.",
                f"Minima besides the source: {span(numbers('minima besides the source', 'biharmonic'))}.",
                max(numbers("minima besides the source", "biharmonic")) == 0,
            ),
        ),
    )


def _under_refinement(surface: Surface, source: int, fields: dict[str, np.ndarray]) -> Table:
    """The largest relative jump of the gradient of each field (n,), on this mesh and on a finer one."""
    radius = small_radius(surface)
    finer = refined(surface)
    laplacian = Laplacian(finer)
    method = "exact" if finer.is_manifold else "heat"
    finer_fields = {
        "geodesic": distance(laplacian, f"geodesic method = {method}").from_source(source),
        "biharmonic": distance(laplacian, "biharmonic").from_source(source),
    }
    rows = []
    for kind, field in fields.items():
        here = inner_jumps(surface, field, fields["geodesic"], radius).max(initial=0)
        there = inner_jumps(finer, finer_fields[kind], finer_fields["geodesic"], radius).max(initial=0)
        rows.append((kind, float(here), float(there)))
    return Table("kinks under refinement", ("distance", "this mesh", "refined"), tuple(rows))
