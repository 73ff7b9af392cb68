"""Figure 10: candidate correspondences between two poses, from three known ones, by three distances.

The paper: "geodesic distance produces bad predictions far from the known correspondences, and diffusion distance
produces unintuitive result for small not-centered areas like the head"; with biharmonic distance candidates are good.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..applications.correspondence import correspondence_prediction
from ..distances.edge_geodesic import EdgeGeodesic
from ..progress import Progress, part
from ..surface import Surface
from .measures import percent
from .result import Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, SEEDS, Shapes, distance, spread_points

TITLE = "Correspondence between two poses"
TARGETS = 200
NEAR, CLUSTER = 0.15, 0.25
"""Distances along edges, in roots of the area: of the near target from a known point, and how far clustered known
points lie apart."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Predictions for 200 random points, from known points that are spread and clustered (quick: 40, one start)."""
    one, two = shapes["figure"], shapes["figure_pose2"]
    kinds = DISTANCES
    on_one = {kind: distance(shapes.laplacian("figure"), kind) for kind in kinds}
    on_two = {kind: distance(shapes.laplacian("figure_pose2"), kind) for kind in kinds}
    targets = np.random.default_rng(0).choice(len(one.vertices), 40 if quick else TARGETS, replace=False)
    mirrored = _mirror(one)[targets]
    unit = float(np.sqrt(two.face_areas.sum()))
    truth = distance(shapes.laplacian("figure_pose2"), "geodesic method = heat")
    part(progress, 0, 1)(0.05, "distances from the right answers")
    off = truth.from_sources(targets, part(progress, 0.05, 0.4)) / unit
    off_mirrored = np.minimum(off, truth.from_sources(mirrored, part(progress, 0.4, 0.7)) / unit)
    rows, panels = [], []
    seeds = SEEDS[: 1 if quick else 5]
    for q, seed in enumerate(seeds):
        for layout, known in (("spread", spread_points(one, 3, seed)), ("clustered", _clustered(one, seed))):
            part(progress, 0.7, 1)(q / len(seeds), f"{seed}, {layout}")
            pairs = np.stack([known, known], 1)
            for kind in kinds:
                prediction = correspondence_prediction(on_one[kind], on_two[kind], pairs, targets)
                best, column = prediction.argmin(axis=0), np.arange(len(targets))
                error, either = off[best, column], off_mirrored[best, column]
                quantiles = np.quantile(np.stack([error, either]), [0.5, 0.9], axis=1).T
                rows.append((layout, seed, kind, *quantiles.ravel().tolist()))
            if not q and layout == "spread":
                panels = _pictures(one, known, on_one, on_two)
    table = Table(
        "errors",
        ("known points", "start", "distance", "median", "90 %", "median, mirrored too", "90 %, mirrored too"),
        tuple(rows),
    )

    def mean(layout: str, kind: str, column: str = "median, mirrored too") -> float:
        return float(np.mean([float(v or 0) for v in table.values(column, known_points=layout, distance=kind)]))

    def said(layout: str) -> str:
        return ", ".join(
            f"{kind} {percent(mean(layout, kind))} and {percent(mean(layout, kind, '90 %, mirrored too'))} "
            f"(mirror image wrong: {percent(mean(layout, kind, 'median'))} and {percent(mean(layout, kind, '90 %'))})"
            for kind in kinds
        )

    claims = [
        Claim(
            f"Biharmonic distance predicts better than geodesic and diffusion distance, known points {layout}.",
            "Median and 90 % of the candidate's distance from the right place, in roots of the area, mean over the "
            f"starts: {said(layout)}.",
            mean(layout, "biharmonic") < min(mean(layout, kind) for kind in kinds if kind != "biharmonic"),
        )
        for layout in ("spread", "clustered")
    ]
    return Result(
        "fig10",
        TITLE,
        f"Known points: three by farthest-point sampling from vertex 0 (and four random vertices), over the whole "
        f"surface or within a disc around the start. {len(targets)} random targets; the candidate is the vertex of the "
        "least prediction; its error is the geodesic distance (heat method) on the second pose from the right vertex, "
        "or from the right vertex or its mirror image, as a distance cannot tell left from right. Prediction vectors "
        "are divided by their maximum.",
        {"figure": one, "figure_pose2": two},
        tuple(panels),
        tables=(table,),
        claims=tuple(claims),
    )


def _pictures(one: Surface, known: np.ndarray, on_one: dict, on_two: dict) -> list[Panel]:
    lengths = EdgeGeodesic(one).distances(known).min(axis=1)
    unit = float(np.sqrt(one.face_areas.sum()))
    targets = {"near": int(np.abs(lengths - NEAR * unit).argmin()), "far": int(lengths.argmax())}
    anchors = tuple(Mark(int(v), "anchor") for v in known)
    panels = []
    pairs, both = np.stack([known, known], 1), list(targets.values())
    fields = {kind: correspondence_prediction(on_one[kind], on_two[kind], pairs, both) for kind in on_one}
    for k, (row, x) in enumerate(targets.items()):
        panels.append(Panel(f"{row} point", "figure", None, row, (*anchors, Mark(x, "target"))))
        for kind in on_one:
            field = fields[kind][:, k]
            marks = (*anchors, Mark(int(field.argmin()), "target"))
            panels.append(Panel(kind, "figure_pose2", field, row, marks, exaggerate=0.5))
    return panels


def _clustered(surface: Surface, seed: str) -> np.ndarray:
    """(3,) vertices spread within a disc around the start."""
    lengths = EdgeGeodesic(surface)
    points = spread_points(surface, 1, seed)
    nearest = lengths.distances(points[0])
    disc = nearest <= CLUSTER * float(np.sqrt(surface.face_areas.sum()))
    for _ in range(2):
        points = np.append(points, np.argmax(np.where(disc, nearest, -1)))
        nearest = np.minimum(nearest, lengths.distances(points[-1]))
    return points


def _mirror(surface: Surface) -> np.ndarray:
    """(n,) for each vertex the one nearest to its mirror image, left and right exchanged."""
    x = surface.vertices
    image = x * [-1, 1, 1] + [x[:, 0].min() + x[:, 0].max(), 0, 0]
    return cKDTree(x).query(image)[1]
