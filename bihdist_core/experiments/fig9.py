"""Figure 9: Shepard interpolation from a few anchors on a four-legged shape, with five distances.

The paper: biharmonic distance gives a balanced interpolant; geodesic distance ridges and diagonal isolines; diffusion
of t = 1/4 an almost constant function in a leg without anchor, of t = 1 one insensitive to where the anchor on the
head is, of t = 4 spurious local extrema in the front legs.
"""

import numpy as np

from ..analysis.persistence import extrema
from ..applications.interpolation import ShepardInterpolant
from ..applications.tips import at_tips, tips
from ..arrays import BoolArray, IntArray
from ..distances.edge_geodesic import EdgeGeodesic
from ..progress import Progress, part
from ..surface import Surface
from ._stated_figures import AWAY, DEEP, FREE
from .measures import KINK, inner_jumps, over
from .result import STATEMENTS, Cell, Claim, Gathered, Mark, Panel, Result, Table
from .shapes import STARTS, Shapes, distance, spread_points, starts
from .verdicts import mean_estimate

TITLE = "Interpolation from anchors"
KINDS = ("biharmonic", "geodesic", "diffusion t = 1/4", "diffusion t = 1", "diffusion t = 4")
SPREAD = 3
"""Anchors by farthest-point sampling, beside the one on the head."""
LEG = 0.35
"""A leg is what lies below this share of the height, in its quarter of the ground plan."""
QUICK = 5
"""Starts of the quick version."""
TRIED = 20
"""Starts that are tried, at most, for each that is wanted: on a coarse mesh there may not be so many different ones."""
COLUMNS = (
    *("start", "distance", "extrema without anchor", "of these at tips", "raw extrema", "leg spread, %"),
    *("shift on the head, %", "edges in kinks, %"),
)


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compare interpolants from anchors spread from vertex 0 and from 24 random vertices (quick: four)."""
    (name,) = shapes.names("animal")
    surface, laplacian = shapes[name], shapes.laplacian(name)
    x = surface.vertices
    nose, poll = int(np.argmax(x[:, 0])), int(np.argmax(x[:, 1]))
    lengths = EdgeGeodesic(surface).distances([nose, poll])
    head = lengths.min(axis=1) <= lengths[poll, 0]
    legs = _legs(surface)
    ends = tips(laplacian)
    anchors_from = different_anchors(surface, QUICK if quick else STARTS, head, nose)
    every = np.unique(np.concatenate([*anchors_from.values(), [poll]]))
    interpolants, labels = {}, {}
    for k, kind in enumerate(KINDS):
        step = part(progress, 0.1 * k, 0.1 * k + 0.1)
        made = distance(laplacian, kind, part(step, 0, 0.5))
        labels[kind] = made.label
        # Most starts lead to some of the same anchors: the distances from all of them are computed once.
        interpolants[kind] = ShepardInterpolant(made, every, np.zeros(len(every)))
        interpolants[kind].evaluate(part(step, 0.5, 1))
    found = Gathered()
    rows: list[tuple[Cell, ...]] = []
    panels = []
    # Extrema of each kind, with and without those at tips, (starts,).
    counted: dict[str, list[int]] = {f"{which}, {kind}": [] for kind in KINDS for which in (FREE, AWAY)}
    edge_lengths = EdgeGeodesic(surface)
    for q, (seed, anchors) in enumerate(anchors_from.items()):
        part(progress, 0.5, 1)(q / len(anchors_from), seed)
        values = np.linspace(0, 1, len(anchors))
        near = edge_lengths.distances(anchors).min(axis=1)
        empty = [leg for leg in legs if not np.isin(anchors, np.flatnonzero(leg)).any()]
        ridges, leg, shift = {}, {}, {}
        for kind in KINDS:
            field = interpolants[kind].changed(anchors, values).evaluate()
            moved = interpolants[kind].changed(np.append(anchors[:-1], poll), values).evaluate()
            seen = extrema(surface, field, DEEP)
            free = np.setdiff1d(np.concatenate([seen.minima, seen.maxima]), anchors)
            inherent = at_tips(surface, free, ends)
            counted[f"{FREE}, {kind}"].append(len(free))
            counted[f"{AWAY}, {kind}"].append(int((~inherent).sum()))
            raw = seen.raw_minima + seen.raw_maxima
            if empty:
                leg[kind] = min(float(np.ptp(field[each])) for each in empty)
            shift[kind] = float(np.abs(moved - field)[head].mean())
            ridges[kind] = float((inner_jumps(surface, field, near) >= KINK).mean())
            rows.append(
                (
                    *(seed, kind, len(free), int(inherent.sum()), raw),
                    *(100 * leg[kind] if empty else None, 100 * shift[kind], 100 * ridges[kind]),
                )
            )
            if not q:
                known = zip(anchors.tolist(), values.tolist(), strict=True)
                spots = tuple(Mark(v, "anchor", f"anchor, value {value:.2g}") for v, value in known)
                spots += tuple(Mark(int(v), "minimum" if v in seen.minima else "maximum") for v in free)
                panels.append(Panel(labels[kind], name, field, "interpolant", spots, ("home-back", "home")))
        for which, counts in counted.items():
            found.add(which, counts[-1], not q)
        found.add(STATEMENTS["fig9-3"].names[0], over(ridges["geodesic"], ridges["biharmonic"]), not q)
        if empty:
            almost, beside = STATEMENTS["fig9-4"].names
            found.add(almost, leg["diffusion t = 1/4"], not q)
            found.add(beside, over(leg["diffusion t = 1/4"], leg["biharmonic"]), not q)
        found.add(STATEMENTS["fig9-5"].names[0], over(shift["diffusion t = 1"], shift["biharmonic"]), not q)
    table = Table("interpolants", COLUMNS, tuple(rows))
    more = {
        f"{which}, {kind} less biharmonic": mean_estimate(
            np.subtract(counted[f"{which}, {kind}"], counted[f"{which}, biharmonic"])
        )
        for kind in KINDS[1:]
        for which in (FREE, AWAY)
    }
    sums = ", ".join(
        f"{kind} {sum(counted[f'{FREE}, {kind}'])} and {sum(counted[f'{AWAY}, {kind}'])}" for kind in KINDS
    )
    return Result(
        "fig9",
        TITLE,
        f"The anchors are {SPREAD} farthest points from vertex 0 (and from {len(anchors_from) - 1} random vertices), "
        "not on the head, and the nose; their values go evenly from 0 to 1 in that order. Starts that lead to the "
        "same anchors count once. Extrema have a persistence of at least 1 % of the range, and are counted with and "
        "without those at the tips of limbs (within a tenth of the root of the area). A leg is what lies below 35 % "
        "of the height. Of the legs without anchor the one with the least range of values is taken; a leg inside one "
        "interlevel set, between two of twenty isolines, is almost constant. The anchor on the head moves from the "
        "nose to the top of the head, and the mean change there is measured.",
        {name: surface},
        tuple(panels),
        tables=(table,),
        claims=(
            found.claim(
                "fig9-1", f"Extrema without anchor, and those away from tips, over {len(anchors_from)} starts: {sums}."
            ),
            Claim("fig9-2", more),
            found.claim("fig9-3"),
            found.claim("fig9-4"),
            found.claim("fig9-5"),
            found.claim("fig9-6"),
        ),
    )


def different_anchors(surface: Surface, count: int, head: BoolArray, nose: int) -> dict[str, IntArray]:
    """Return (k,) anchors from each of the first `count` starts, by their names, that lead to different ones.

    On the `head` (n,) there are no anchors but the nose. A start on the head is no anchor itself, so that several of
    them may lead to the same tips. There are fewer than `count` where that many are not found.
    """
    found: dict[tuple[int, ...], str] = {}
    for seed in starts(TRIED * count):
        found.setdefault(tuple(_anchors(surface, seed, head, nose).tolist()), seed)
        if len(found) == count:
            break
    return {seed: np.array(anchors) for anchors, seed in found.items()}


def _anchors(surface: Surface, seed: str, head: BoolArray, nose: int) -> IntArray:
    """Return (k,) vertices spread from a start, and the nose: the head has one anchor only."""
    spread = [v for v in spread_points(surface, SPREAD + 3, seed) if not head[v]]
    return np.array([*spread[:SPREAD], nose])


def _legs(surface: Surface) -> list[BoolArray]:
    """Return (n,) bool for each of the four legs."""
    x = surface.vertices
    middle = (x.min(axis=0) + x.max(axis=0)) / 2
    low = x[:, 1] < x[:, 1].min() + LEG * np.ptp(x[:, 1])
    return [
        low & ((x[:, 0] > middle[0]) == right) & ((x[:, 2] > middle[2]) == front)
        for right in (True, False)
        for front in (True, False)
    ]
