"""Figure 9: Shepard interpolation from a few anchors on a four-legged shape, with five distances.

The paper: biharmonic distance gives a balanced interpolant; geodesic distance ridges and diagonal isolines; diffusion
of t = 1/4 an almost constant function in a leg without anchor, of t = 1 one insensitive to where the anchor on the
head is, of t = 4 spurious local extrema in the front legs.
"""

import numpy as np

from ..analysis.persistence import extrema
from ..applications.interpolation import ShepardInterpolant
from ..distances.edge_geodesic import EdgeGeodesic
from ..progress import Progress, part
from ..surface import Surface
from .measures import KINK, inner_jumps, percent
from .result import Claim, Mark, Panel, Result, Table
from .shapes import SEEDS, Shapes, distance, spread_points

TITLE = "Interpolation from anchors"
KINDS = ("biharmonic", "geodesic", "diffusion t = 1/4", "diffusion t = 1", "diffusion t = 4")
SPREAD = 3
"""Anchors by farthest-point sampling, beside the one on the head."""
LEG = 0.35
"""A leg is what lies below this share of the height, in its quarter of the ground plan."""
COLUMNS = (
    "start",
    "distance",
    "extrema without anchor",
    "raw extrema",
    "leg spread, %",
    "shift on the head, %",
    "edges in kinks, %",
)


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Interpolants from anchors spread from vertex 0 and from four random vertices (quick: vertex 0 only)."""
    (name,) = shapes.names("animal")
    surface, laplacian = shapes[name], shapes.laplacian(name)
    x = surface.vertices
    nose, poll = int(np.argmax(x[:, 0])), int(np.argmax(x[:, 1]))
    lengths = EdgeGeodesic(surface).distances([nose, poll])
    head = lengths.min(axis=1) <= lengths[poll, 0]
    legs = _legs(surface)
    rows, panels = [], []
    seeds = SEEDS[: 1 if quick else 5]
    distances = {
        kind: distance(laplacian, kind, part(progress, 0.1 * k, 0.1 * k + 0.1)) for k, kind in enumerate(KINDS)
    }
    for q, seed in enumerate(seeds):
        part(progress, 0.5, 1)(q / len(seeds), seed)
        # The head has one anchor only.
        spread = [v for v in spread_points(surface, SPREAD + 3, seed) if not head[v]]
        anchors = np.array([*spread[:SPREAD], nose])
        values = np.linspace(0, 1, len(anchors))
        near = np.nanmin(distances["geodesic"].from_sources(anchors), axis=1)
        empty = [leg for leg in legs if not np.isin(anchors, np.flatnonzero(leg)).any()]
        for kind in KINDS:
            field = ShepardInterpolant(distances[kind], anchors, values).evaluate()
            moved = ShepardInterpolant(distances[kind], np.append(anchors[:-1], poll), values).evaluate()
            found = extrema(surface, field)
            free = np.setdiff1d(np.concatenate([found.minima, found.maxima]), anchors)
            raw = found.raw_minima + found.raw_maxima
            least = 100 * min(float(np.ptp(field[leg])) for leg in empty) if empty else None
            shift = 100 * float(np.abs(moved - field)[head].mean())
            kinks = 100 * float((inner_jumps(surface, field, near) >= KINK).mean())
            rows.append((seed, kind, len(free), raw, least, shift, kinks))
            if not q:
                spots = tuple(Mark(int(v), "anchor") for v in anchors)
                spots += tuple(Mark(int(v), "minimum" if v in found.minima else "maximum") for v in free)
                panels.append(Panel(distances[kind].label, name, field, "interpolant", spots, ("front", "back")))
    table = Table("interpolants", COLUMNS, tuple(rows))

    def numbers(column: str, kind: str) -> list[float]:
        return [float(v) for v in table.values(column, distance=kind) if v is not None]

    def said(column: str, unit: str = "") -> str:
        return ", ".join(f"{kind} {np.mean(numbers(column, kind)):.3g}{unit}" for kind in KINDS) + "."

    free_count = {kind: sum(numbers("extrema without anchor", kind)) for kind in KINDS}
    spreads = {kind: float(np.mean(numbers("leg spread, %", kind))) for kind in KINDS}
    shifts = {kind: float(np.mean(numbers("shift on the head, %", kind))) for kind in KINDS}
    ridges = {kind: float(np.mean(numbers("edges in kinks, %", kind))) for kind in KINDS}
    return Result(
        "fig9",
        TITLE,
        f"Anchors: {SPREAD} by farthest-point sampling from vertex 0 (and from four random vertices), points on the "
        "head left out, and the nose; values evenly from 0 to 1 in that order. A leg is what lies below 35 % of the "
        "height; counted is the least range of values on a leg without anchor. The anchor on the head moves from the "
        "nose to the top of the head; the shift is the mean change of the interpolant there. All are means over the "
        "starts.",
        {name: surface},
        tuple(panels),
        tables=(table,),
        claims=(
            Claim(
                "Biharmonic distance provides a well-behaved interpolant both close to the anchors and far away.",
                f"Its extrema that are no anchor, sum over the starts: {free_count['biharmonic']:g}.",
                free_count["biharmonic"] == 0,
            ),
            Claim(
                "It is the most balanced of the five.",
                "Extrema that are no anchor, sum over the starts: "
                + ", ".join(f"{kind} {count:g}" for kind, count in free_count.items())
                + ".",
                free_count["biharmonic"] == min(free_count.values()),
            ),
            Claim(
                "Ridges appear when geodesic distance is used.",
                "Edges in kinks away from the anchors: " + said("edges in kinks, %", " %"),
                ridges["geodesic"] > 2 * ridges["biharmonic"],
            ),
            Claim(
                "With t = 1/4 the interpolant is almost constant in a leg without anchor.",
                "Range of values in such a leg: " + said("leg spread, %", " %"),
                spreads["diffusion t = 1/4"] < 0.5 * spreads["biharmonic"],
            ),
            Claim(
                "With t = 1 the interpolant is insensitive to where the anchor on the head is.",
                "Mean change on the head when it moves: " + said("shift on the head, %", " %"),
                shifts["diffusion t = 1"] < 0.5 * shifts["biharmonic"],
            ),
            Claim(
                "With t = 4 the interpolant has unintuitive extrema.",
                f"Extrema that are no anchor, t = 4: {free_count['diffusion t = 4']:g}; "
                f"biharmonic: {free_count['biharmonic']:g}; an extremum counts from {percent(0.001)} of the range.",
                free_count["diffusion t = 4"] > free_count["biharmonic"],
            ),
        ),
    )


def _legs(surface: Surface) -> list[np.ndarray]:
    """(n,) bool for each of the four legs."""
    x = surface.vertices
    middle = (x.min(axis=0) + x.max(axis=0)) / 2
    low = x[:, 1] < x[:, 1].min() + LEG * np.ptp(x[:, 1])
    return [
        low & ((x[:, 0] > middle[0]) == right) & ((x[:, 2] > middle[2]) == front)
        for right in (True, False)
        for front in (True, False)
    ]
