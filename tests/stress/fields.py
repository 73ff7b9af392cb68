"""All fields of small meshes on which distances lose digits, against extended precision."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from bihdist_core import (
    BiharmonicDistance,
    BihdistError,
    CommuteTimeDistance,
    Curve,
    Laplacian,
    SourceSet,
    Surface,
    SurfacePoint,
)
from tests.extended_reference import HAS_DIGITS, ExtendedReference
from tests.shapes import bumpy, caps, folded, graded, grid, needles, plate, torus

from .laws import Found
from .outcome import OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "all fields of small meshes of seven kinds, against arithmetic of 19 digits"
SEEDS, BLOCK, SECONDS = 200, 100, 120.0


def case(seed: int, number: int, folder: Path) -> Outcome:
    """Fields from all vertices of a random mesh, and from a place, a segment and a set."""
    if not HAS_DIGITS:
        return Outcome(REFUSED)
    rng = np.random.default_rng([seed, number])
    kind = str(rng.choice(list(KINDS)))
    surface, found = KINDS[kind](rng), Found()
    try:
        if surface.n_components == 1:
            _check(surface, rng, found)
    except BihdistError as error:
        found.refusals.append(str(error))
    faults = [fault for message in found.refusals if (fault := fault_of(message))]
    if found.broken or faults:
        return Outcome(WRONG, f"{kind}: {found.broken or faults[0]}", found.ratio)
    return Outcome(REFUSED if found.refusals else OPENED, ratio=found.ratio)


def _check(surface: Surface, rng: np.random.Generator, found: Found) -> None:
    reference, laplacian, n = ExtendedReference(surface), Laplacian(surface), len(surface.vertices)
    for make, exact in ((BiharmonicDistance, reference.biharmonic()), (CommuteTimeDistance, reference.commute_time())):
        distance = make(laplacian)
        share = distance.error_estimate().share
        fields, top = distance.from_sources(np.arange(n)), exact.max(axis=0)
        found.differ(fields / top, exact / top, share, f"{distance.label}: fields from vertices")
        if make is CommuteTimeDistance:
            continue
        face = int(rng.integers(len(surface.faces)))
        start, end = (rng.dirichlet((0.3, 0.3, 0.3)) for _ in range(2))
        ends = [SurfacePoint(face, (float(a), float(b), 1 - float(a) - float(b))) for a, b, _ in (start, end)]
        segment = reference.biharmonic_from_segment(surface.faces[face], ends[0].weights, ends[1].weights)
        place = reference.biharmonic_from_segment(surface.faces[face], ends[0].weights, ends[0].weights)
        several = rng.choice(n, 3, replace=False)
        for name, source, field in (
            ("a place", ends[0], place),
            ("a segment", Curve(tuple(ends)), segment),
            ("a set", SourceSet(tuple(several.tolist())), exact[:, several].min(axis=1)),
        ):
            found.differ(distance.from_source(source), field, share * float(field.max()), f"{distance.label}: {name}")


# ---------------------------------------------------------------------- the meshes
def _plate(rng: np.random.Generator) -> Surface:
    return plate(int(rng.integers(4, 11)), int(rng.integers(4, 11)), 10 ** -rng.uniform(1, 5))


def _graded(rng: np.random.Generator) -> Surface:
    return graded(int(rng.integers(5, 11)), rng.uniform(0.2, 0.7), rng.uniform(0, 0.3))


def _needles(rng: np.random.Generator) -> Surface:
    return needles(_bumpy(rng, 110), 10 ** -rng.uniform(1, 7), int(rng.integers(2, 20)))


def _anisotropic(rng: np.random.Generator) -> Surface:
    columns, rows = rng.integers(5, 12, 2)
    choices = [lambda: grid(columns, rows), lambda: torus(columns + 4, rows), lambda: _bumpy(rng, 150)]
    s = choices[rng.integers(3)]()
    return Surface(s.vertices * (1, 10 ** -rng.uniform(0, 4), 10 ** -rng.uniform(0, 2)), s.faces, "anisotropic")


def _slivers(rng: np.random.Generator) -> Surface:
    kind = (caps, folded)[rng.integers(2)]
    return kind(_bumpy(rng, 100), 10 ** -rng.uniform(1, 10), int(rng.integers(2, 20)))


def _soup(rng: np.random.Generator) -> Surface:
    """Faces that join vertices at random, each vertex with two earlier ones at least."""
    n = int(rng.integers(20, 120))
    faces = [[0, 1, 2], *([*rng.choice(v, 2, replace=False), v] for v in range(3, n))]
    faces += [rng.choice(n, 3, replace=False) for _ in range(int(n * rng.uniform(0.2, 1.5)))]
    return Surface(rng.standard_normal((n, 3)), np.array(faces), "soup")


def _bumpy(rng: np.random.Generator, most: int = 180) -> Surface:
    return bumpy(int(rng.integers(30, most)), int(rng.integers(1000)))


KINDS: dict[str, Callable[[np.random.Generator], Surface]] = {
    "plate": _plate,
    "graded": _graded,
    "needles": _needles,
    "anisotropic": _anisotropic,
    "slivers": _slivers,
    "soup": _soup,
    "bumpy": _bumpy,
}
