"""Slivers, scales, renumberings and rigid motions: errors beside the estimates that distances make of them."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

from bihdist_core import (
    BiharmonicDistance,
    BihdistError,
    CommuteTimeDistance,
    DiffusionDistance,
    Laplacian,
    PowerDistance,
    Surface,
    TruncatedBiharmonicDistance,
)
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from tests.core.nasty_meshes import nasty_mesh
from tests.exact_reference import ExactReference
from tests.shapes import bumpy, caps, fin, folded, grid, needles, spike, torus, two_pieces

from .laws import LEAST, ROUNDING, Found
from .outcome import OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "slivers, scales 1e-8 to 1e8, renumberings and rigid motions"
SEEDS, BLOCK, SECONDS = 40, 100, 120.0
SLIVERS = {"caps": caps, "needles": needles, "folded": folded}
AGAINST_REFERENCE = 0.1
"""The share of cases against decimal arithmetic, which takes a second."""
MOTIONS = ("scaled", "renumbered", "moved")


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A random surface, against exact distances or against itself in another place, order or size."""
    rng = np.random.default_rng([seed, number])
    found = Found()
    words = (_against_reference if rng.random() < AGAINST_REFERENCE else _against_itself)(rng, found)
    faults = [fault for message in found.refusals if (fault := fault_of(message))]
    if found.broken or faults:
        return Outcome(WRONG, f"{words}: {found.broken or faults[0]}", found.ratio)
    return Outcome(REFUSED if found.refusals and not found.ratio else OPENED, ratio=found.ratio)


# ---------------------------------------------------------------------- exact distances
@cache
def _reference(kind: str, shape: str, height: float) -> tuple[Surface, ExactReference]:
    s = bumpy(24) if shape == "bumpy" else grid(4, 3)
    surface = SLIVERS[kind](s, height, every=5)
    return surface, ExactReference(surface)


def _against_reference(rng: np.random.Generator, found: Found) -> str:
    kind, shape = str(rng.choice(list(SLIVERS))), str(rng.choice(["bumpy", "grid"]))
    height = float(rng.choice([*(10.0 ** -rng.uniform(1, 16, 3)), 0.0]))
    surface, reference = _reference(kind, shape, height)
    laplacian = Laplacian(surface)
    for index, make in enumerate((BiharmonicDistance, CommuteTimeDistance)):
        distance = make(laplacian)
        i, j = (int(v) for v in rng.choice(len(surface.vertices), 2, replace=False))
        field, exact = distance.from_source(i), reference.pair(i, j)[index]
        allowed = max(distance.accuracy, LEAST) * float(field.max())
        found.differ(field[j], exact, allowed, f"{distance.label} from {i} to {j}")
        found.differ(distance.between(i, j), exact, allowed, f"{distance.label} between {i} and {j}")
    return f"{kind} of height {height:g} on {shape}"


# ---------------------------------------------------------------------- the same surface in another way
def _surface(rng: np.random.Generator) -> Surface:
    n = int(rng.integers(20, 120))
    s = bumpy(n, int(rng.integers(9)))
    height = 10.0 ** rng.uniform(-14, -1)
    choices = [
        lambda: s,
        lambda: grid(n // 8, 7),
        lambda: torus(n // 7 + 3, 7),
        two_pieces,
        fin,
        lambda: spike(n, 10.0 ** rng.uniform(1, 6)),
        lambda: SLIVERS[str(rng.choice(list(SLIVERS)))](s, height, every=int(rng.integers(1, 9))),
        lambda: Surface(*nasty_mesh(int(rng.integers(10**6)), 60), "nasty"),
    ]
    return choices[rng.integers(len(choices))]()


def _against_itself(rng: np.random.Generator, found: Found) -> str:
    surface, motion = _surface(rng), str(rng.choice(MOTIONS))
    n, scale = len(surface.vertices), 1.0
    x, order, faces = surface.vertices, np.arange(n), surface.faces
    if motion == "scaled":
        scale = 10.0 ** rng.uniform(-8, 8)
        x = x * scale
    elif motion == "moved":
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        x = x @ turn + rng.normal(size=3) * np.ptp(x)
    else:
        order = rng.permutation(n)
        faces = rng.permutation(np.roll(np.argsort(order)[faces], rng.integers(3), axis=1))
        x = x[order]
    other = Surface(x, faces, f"{surface.name}, {motion}")
    used = np.flatnonzero(surface.component_of_vertex == 0)
    source = int(rng.choice(used))
    there = int(np.flatnonzero(order == source)[0])
    # Coordinates are rounded again where all of them change, by which thin faces are other faces.
    rounding = 0.0 if motion == "renumbered" else _rounded(surface)
    for make in _distances(surface, rng):
        try:
            one, two = make(Laplacian(surface)), make(Laplacian(other))
            field, again = one.from_source(source), two.from_source(there)
            estimates = [distance.error_estimate().share for distance in (one, two)]
        except BihdistError as error:
            found.refusals.append(str(error))
            continue
        expected = field[order][order_in := np.isfinite(field[order])] * scale**one.length_power
        found.expect(bool((np.isfinite(again) == order_in).all()), f"{one.label}: numbers in other places")
        if not found.broken:
            allowed = max(sum(estimates) + rounding, LEAST) * float(expected.max(initial=0.0))
            found.differ(again[order_in], expected, allowed, f"{one.label} {motion}, {scale:g}")
    try:
        one_way, other_way = ExactGeodesic(surface).distances(source), ExactGeodesic(other).distances(there)
    except BihdistError as error:
        found.refusals.append(str(error))
    else:
        inside = np.isfinite(one_way[order])
        expected = one_way[order][inside] * scale
        found.expect(bool((np.isfinite(other_way) == inside).all()), "geodesic: numbers in other places")
        if not found.broken:
            allowed = (ROUNDING + 1e-15 * n) * max(float(expected.max(initial=0.0)), float(np.abs(x).max()))
            found.differ(other_way[inside], expected, allowed, f"geodesic {motion}, {scale:g}")
    return f"{surface.name} of {n} vertices {motion}"


def _distances(surface: Surface, rng: np.random.Generator) -> list[Callable[[Laplacian], Distance]]:
    makes: list[Callable[[Laplacian], Distance]] = [BiharmonicDistance, CommuteTimeDistance]
    k, t = int((surface.component_of_vertex == 0).sum()) // 3, float(rng.choice([0.25, 1.0, 4.0]))
    if k > 3:
        makes.append(lambda laplacian: DiffusionDistance(laplacian, t=t))
        makes.append(lambda laplacian: TruncatedBiharmonicDistance(laplacian, k=k))
        makes.append(lambda laplacian: PowerDistance(laplacian, alpha=1.5))
    return makes


def _rounded(surface: Surface) -> float:
    """How much of a distance roundings of all coordinates may change, as a fraction: a few of them, over the flattest
    face that is taken as it is."""
    heights = surface.face_heights
    thin = heights[heights > 0]
    return 1e-14 / float(thin.min(initial=1.0))
