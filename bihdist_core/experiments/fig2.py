"""Figure 2: a flat domain, and five distance fields over it as heights.

The paper: diffusion distance "either possesses many local maxima or locally does not reflect the source point", the
geodesic field has a kink, and its isolines do not follow the shape far away; biharmonic distance balances the two.
"""

import numpy as np

from ..analysis.circles import small_radius
from ..analysis.persistence import extrema
from ..applications.resizing import refined
from ..arrays import FloatArray
from ..distances.distance import Distance
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from ._stated_figures import DEEP
from .circles import PROTOCOL, circles, gather_circles
from .measures import FIELD_COLUMNS, field_row, largest_jump, marks
from .result import STATEMENTS, Cell, Gathered, Mark, Panel, Result, Table
from .shapes import Shapes, distance, random_sources, spec_of

TITLE = "Distances over a flat domain"
SHORT, LONG = "diffusion t = 1/15", "diffusion t = 1"
KINDS = (LONG, "diffusion t = 1/5", SHORT, "geodesic", "biharmonic")
RANDOM, QUICK = 24, 4
"""Random sources."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compute five fields from a source in the first corridor, and numbers from it and 24 others (quick: four)."""
    (name,) = shapes.names("domain")
    surface, laplacian = shapes[name], shapes.laplacian(name)
    flat = float(surface.vertices[:, 2].max() - surface.vertices[:, 2].min()) == 0
    source = shapes.vertex_at(surface, 0.12, 0.8)
    sources = [source, *random_sources(surface, QUICK if quick else RANDOM)]
    distances = {
        kind: distance(laplacian, kind, part(progress, 0.04 * k, 0.04 * k + 0.04)) for k, kind in enumerate(KINDS)
    }
    fields = {kind: distances[kind].from_source(source) for kind in KINDS}
    rows = [field_row(surface, name, "pictured", source, kind, fields[kind], fields["geodesic"]) for kind in KINDS]
    found = Gathered()
    counts: list[tuple[Cell, ...]] = []
    for k, vertex in enumerate(sources):
        part(progress, 0.2, 0.4)(k / len(sources), f"extrema, vertex {vertex}")
        own, short = (distances[kind].from_source(vertex) for kind in ("biharmonic", SHORT))
        many, few = _extrema(surface, short, vertex), _extrema(surface, own, vertex)
        counts.append((f"random {k}" if k else "pictured", vertex, many, few))
        found.add(STATEMENTS["fig2-1"].names[0], many / max(few, 1), not k)
    circled = circles(surface, sources, ("biharmonic", LONG), part(progress, 0.4, 0.6))
    gather_circles(found, circled, 0, 1)
    kinks = _under_refinement(surface, sources, distances, found, part(progress, 0.6, 1))
    columns = ("source", "vertex", f"extrema, {SHORT}", "extrema, biharmonic")
    style = "height" if flat else "surface"
    return Result(
        "fig2",
        TITLE,
        "The pictured source is at 12 % of the width and 80 % of the height; numbers are also measured from "
        f"{len(sources) - 1} random vertices. An extremum counts, and is marked, if its persistence is at least 1 % of "
        "the field's range (0.1 % in the tables of fields); the source does not count. The jump of the gradient "
        "across an edge is relative to the gradient there, or to its median if that is larger, and is taken away from "
        "the source and the boundary. At a kink it stays the same when the mesh is refined to four times as many "
        "faces; where the field is "
        "smooth it halves. " + PROTOCOL,
        {name: surface},
        (
            Panel("the domain", name, None, "fields", (Mark(source, "source"),)),
            *(
                Panel(
                    kind,
                    name,
                    fields[kind],
                    "fields",
                    marks(surface, fields[kind], source),
                    style=style,
                    distance=spec_of(kind),
                )
                for kind, made in distances.items()
            ),
        ),
        charts=(circled.chart("isotropy"),) if np.isfinite(circled.ratios[LONG][0]).all() else (),
        tables=(Table("fields", FIELD_COLUMNS, tuple(rows)), Table("sources", columns, tuple(counts)), kinks),
        claims=tuple(found.claim(f"fig2-{k}") for k in range(1, 4)),
    )


def _extrema(surface: Surface, field: FloatArray, source: int) -> int:
    """Count the extrema of a field beside its source."""
    seen = extrema(surface, field, DEEP)
    return int((np.concatenate([seen.minima, seen.maxima]) != source).sum())


def _under_refinement(
    surface: Surface, sources: list[int], distances: dict[str, Distance], found: Gathered, progress: Progress
) -> Table:
    """Return the largest jump of the gradient from each of the sources, on this mesh and on a finer one."""
    radius = small_radius(surface)
    finer = refined(surface)
    laplacian = Laplacian(finer)
    there = {
        "geodesic": distance(laplacian, "geodesic"),
        "biharmonic": distance(laplacian, "biharmonic"),
    }
    smooth, kinked = STATEMENTS["fig2-3"].names
    rows: list[tuple[Cell, ...]] = []
    for k, source in enumerate(sources):
        progress(k / len(sources), f"refined, vertex {source}")
        before = {kind: distances[kind].from_source(source) for kind in there}
        after = {kind: made.from_source(source) for kind, made in there.items()}
        jumps = {}
        for kind in there:
            here = largest_jump(surface, before[kind], before["geodesic"], radius)
            jumps[kind] = here, largest_jump(finer, after[kind], after["geodesic"], radius)
            rows.append((f"random {k}" if k else "pictured", kind, *jumps[kind]))
        found.add(smooth, jumps["biharmonic"][1] / max(jumps["biharmonic"][0], 1e-12), not k)
        found.add(kinked, jumps["geodesic"][1], not k)
    return Table("kinks under refinement", ("source", "distance", "this mesh", "refined"), tuple(rows))
