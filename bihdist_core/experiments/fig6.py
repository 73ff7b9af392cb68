"""Figure 6: insensitivity to noise, tessellation and nearly isometric deformation.

The paper: isolines of biharmonic distance are "largely unchanged" by Gaussian noise of 400 % of the mean edge length,
"stable" as a mesh is simplified from 14K to 4K vertices, and insensitive to a change of pose.
"""

import numpy as np

from ..analysis.diagnostics import FieldChange
from ..applications.perturbation import noisy
from ..applications.resizing import simplified
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import CHANGE_COLUMNS, INSENSITIVE, change_cells, changes, percent
from .result import Cell, Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, SEEDS, Shapes, distance, start_vertex, vertex_at

TITLE = "Noise, tessellation, deformation"
NOISE = (0.1, 0.4, 1.0, 4.0)
"""Standard deviation on each coordinate, in mean edge lengths."""
FINE, COARSE = 14_000, 4_000


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Changes of three distances from each of six sources (quick: two, on meshes of 4,000 and 1,150 vertices)."""
    (name,) = shapes.names("figure")
    fine_count, coarse_count = (4_000, 1_150) if quick else (FINE, COARSE)
    part(progress, 0, 0.2)(0.0, "simplifying")
    fine = shapes.sized(name, fine_count, part(progress, 0, 0.1))
    coarse, kept = simplified(fine, coarse_count, part(progress, 0.1, 0.2))
    whole = fine if quick else shapes[name]
    # Each case: a surface, what became of it, and the vertices (k,) where both have the same points.
    everywhere = np.arange(len(whole.vertices))
    cases: dict[str, tuple[Surface, Surface, np.ndarray, np.ndarray]] = {
        f"noise of {percent(s)}": (whole, noisy(whole, s), everywhere, everywhere) for s in NOISE
    }
    cases[f"{fine_count:,} to {coarse_count:,} vertices"] = (fine, coarse, kept, np.arange(coarse_count))
    if shapes.own is None:
        same = np.arange(len(shapes[name].vertices))
        cases["another pose"] = (shapes[name], shapes["figure_pose2"], same, same)
    rows: list[tuple[Cell, ...]] = []
    panels: list[Panel] = []
    surfaces: dict[str, Surface] = {}
    found: dict[tuple[str, str], list[FieldChange]] = {}
    drawn: set[str] = set()
    for q, (case, (before, after, ids, images)) in enumerate(cases.items()):
        step = part(progress, 0.2 + 0.8 * q / len(cases), 0.2 + 0.8 * (q + 1) / len(cases))
        # The sources of the case are points that both surfaces have.
        sources = {"pictured": int(ids[_nearest(before, ids, vertex_at(before, 0.5, 0.72, "back"))])}
        sources |= {s: int(ids[_nearest(before, ids, start_vertex(before, s))]) for s in SEEDS[: 1 if quick else 5]}
        laplacians = (shapes.laplacian(name) if before is shapes[name] else Laplacian(before), Laplacian(after))
        distances = [{kind: distance(laplacian, kind) for kind in DISTANCES} for laplacian in laplacians]
        image = dict(zip(ids.tolist(), images.tolist(), strict=True))
        heading = f"{len(before.vertices):,} vertices"
        surfaces |= {heading: before, case: after}
        for k, (label, source) in enumerate(sources.items()):
            step(k / len(sources), f"{case}, {label}")
            one, two = (
                {kind: d.from_source(vertex) for kind, d in those.items()}
                for those, vertex in zip(distances, (source, image[source]), strict=True)
            )
            change = changes({k: f[ids] for k, f in one.items()}, {k: f[images] for k, f in two.items()})
            for kind in DISTANCES:
                rows.append((case, label, kind, *change_cells(change[kind])))
                found.setdefault((case, kind), []).append(change[kind])
            if label == "pictured":
                for kind in DISTANCES:
                    if heading not in drawn:
                        panels.append(Panel(heading, heading, one[kind], kind, (Mark(source, "source"),)))
                    panels.append(Panel(case, case, two[kind], kind, (Mark(image[source], "source"),)))
                drawn.add(heading)
    return Result(
        "fig6",
        TITLE,
        "Sources: the upper back, vertex 0 and four random vertices. Noise: independent normal numbers on each "
        "coordinate, their standard deviation a share of the mean edge length. Simplification draws edges together "
        "onto one of their ends, so the vertices that stay are at their old places and are where the fields are "
        "compared. The poses have the same triangles.",
        surfaces,
        tuple(panels),
        tables=(Table("changes", ("change", "source", "distance", *CHANGE_COLUMNS), tuple(rows)),),
        claims=tuple(_claim(case, {kind: found[case, kind] for kind in DISTANCES}) for case in cases),
    )


def _nearest(surface: Surface, ids: np.ndarray, vertex: int) -> int:
    return int(np.linalg.norm(surface.vertices[ids] - surface.vertices[vertex], axis=1).argmin())


def _claim(case: str, found: dict[str, list[FieldChange]]) -> Claim:
    means = {kind: max(c.normalised_mean for c in changes) for kind, changes in found.items()}
    raw = {kind: max(c.mean for c in changes) for kind, changes in found.items()}
    return Claim(
        f"Biharmonic distance is insensitive to {case}.",
        "Largest mean change over the sources, after division by the maximum (raw in parentheses): "
        + ", ".join(f"{kind} {percent(means[kind])} ({percent(raw[kind])})" for kind in found)
        + f" (insensitive: at most {percent(INSENSITIVE)}).",
        means["biharmonic"] <= INSENSITIVE,
    )
