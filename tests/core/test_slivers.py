"""Faces of any flatness: the distances of the exact surface to 1e-6 of the maximum, and never worse than certified."""

from functools import cache

import numpy as np
import pytest
import scipy.linalg

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    PowerDistance,
    Surface,
    TruncatedBiharmonicDistance,
    eigenpairs,
)
from tests.dense_reference import full_spectrum, spectral
from tests.exact_reference import ExactReference, constrained_operators
from tests.shapes import bumpy, caps, folded, grid, needles, spike

HEIGHTS = [*(10.0**-k for k in range(3, 17)), 3e-10, 0.0]
RIGHT = 1e-6
SLIVERS = {"caps": caps, "needles": needles, "folded": folded}
every_kind = pytest.mark.parametrize("kind", SLIVERS)
EXACT = (BiharmonicDistance, CommuteTimeDistance)


def plain(shape: str) -> Surface:
    return {"bumpy": bumpy(60), "grid": grid(6, 5)}[shape]


@cache
def cases(kind: str, shape: str, height: float) -> tuple[Surface, tuple[tuple[int, int, float, float], ...]]:
    """A surface with slivers, and exact distances of some pairs: from an old vertex, and from new ones beside them."""
    s = plain(shape)
    surface = SLIVERS[kind](s, height, every=4)
    old, n = len(s.vertices), len(surface.vertices)
    reference = ExactReference(surface)
    beside = int(surface.faces[(surface.faces == n - 1).any(axis=1)][0][0])
    pairs = [(3, 17), (3, n - 1), (3, old), (n - 1, old), (n - 1, beside if beside != n - 1 else old + 1)]
    return surface, tuple((i, j, *reference.pair(i, j)) for i, j in pairs)


@every_kind
@pytest.mark.parametrize("shape", ["bumpy", "grid"])
@pytest.mark.parametrize("height", HEIGHTS, ids="{:.0e}".format)
def test_exact_distances_of_any_flatness(kind, shape, height):
    surface, pairs = cases(kind, shape, height)
    laplacian = Laplacian(surface)
    for index, make in enumerate(EXACT):
        distance = make(laplacian)
        for i, j, *exact in pairs:
            field = distance.from_source(i)
            allowed = field.max() * min(RIGHT, distance.accuracy)
            assert abs(field[j] - exact[index]) <= allowed, (distance.label, i, j)
            assert abs(distance.between(i, j) - exact[index]) <= allowed, (distance.label, i, j)


def test_every_face_with_a_flat_one_beside_it():
    s = bumpy(100)
    for height in (1e-5, 1e-7, 1e-9, 0.0):
        surface = caps(s, height, every=1)
        reference, laplacian = ExactReference(surface), Laplacian(surface)
        for index, make in enumerate(EXACT):
            distance = make(laplacian)
            field = distance.from_source(3)
            error = max(abs(field[j] - reference.pair(3, j)[index]) for j in (50, 120, 200))
            assert error <= field.max() * min(RIGHT, distance.accuracy)


@pytest.mark.parametrize("decimals", range(6, 18))
def test_closed_t_junctions_rounded_by_a_text_file(decimals):
    """As they come: with each number of digits the mesh has faces of another flatness, and the distances stay."""
    s = bumpy(60)
    whole = caps(s, 0.0, every=6, at=0.37)
    surface = Surface(np.round(whole.vertices, decimals), whole.faces)
    laplacian, reference = Laplacian(surface), ExactReference(surface)
    for index, make in enumerate(EXACT):
        distance = make(laplacian)
        field = distance.from_source(3)
        error = max(abs(field[j] - reference.pair(3, j)[index]) for j in (40, 60, 64))
        assert error <= field.max() * min(RIGHT, distance.accuracy)


@pytest.mark.parametrize("length", [1e5, 1e7, 1e9])
def test_a_spike_keeps_its_length(length):
    surface = spike(60, length)
    laplacian, exact = Laplacian(surface), ExactReference(surface).pair(3, 7)
    for index, make in enumerate(EXACT):
        distance = make(laplacian)
        assert distance.accuracy < 1e-4
        assert distance.from_source(3)[7] == pytest.approx(exact[index], rel=distance.accuracy)


def spectral_distances(surface: Surface) -> list:
    laplacian = Laplacian(surface)
    return [
        DiffusionDistance(laplacian, t=0.25),
        TruncatedBiharmonicDistance(laplacian, k=20),
        PowerDistance(laplacian, alpha=1.25),
    ]


def check_spectral(surface: Surface, values: np.ndarray, vectors: np.ndarray) -> None:
    first = np.arange(len(values))
    weights = [
        np.exp(-0.25 * values / values[0]),
        np.where(first < 20, values**-2.0, 0),
        values**-1.25,
    ]
    for distance, weight in zip(spectral_distances(surface), weights, strict=True):
        field, exact = distance.from_source(3), spectral(weight, vectors, np.array([3]))[:, 0]
        error = np.abs(field - exact).max() / exact.max()
        assert error <= min(RIGHT, distance.accuracy), distance.label
    assert eigenpairs(surface, 20).eigenvalues == pytest.approx(values[:20], rel=RIGHT)


@every_kind
@pytest.mark.parametrize("height", [1e-3, 1e-5])
def test_spectral_distances_of_thin_faces(kind, height):
    """A dense eigensolver keeps eps over the height of its digits."""
    surface = SLIVERS[kind](bumpy(60), height, every=4)
    check_spectral(surface, *full_spectrum(surface))


@pytest.mark.parametrize("height", [1e-8, 1e-10, 1e-13, 0.0])
def test_spectral_distances_of_flat_faces(height):
    """Against the limit: the apexes held to their feet, the degenerate faces left out; in it no number is large."""
    s = bumpy(60)
    surface = caps(s, height, every=4, at=0.4)
    old = len(s.vertices)
    flat = np.flatnonzero(caps(s, 0.0, every=4, at=0.4).face_heights < 1e-12)
    held = {int(f[2]): (int(f[0]), int(f[1]), 0.4) for f in surface.faces[flat]}
    assert len(held) == len(surface.vertices) - old
    t, stiff, areas = constrained_operators(Surface(surface.vertices, np.delete(surface.faces, flat, axis=0)), held)
    values, free = scipy.linalg.eigh(stiff, areas)
    check_spectral(surface, values[1:], t @ free[:, 1:])


@every_kind
def test_the_heat_method_does_not_feel_how_flat_a_face_is(kind):
    s = bumpy(60)
    fields = [
        GeodesicDistance(SLIVERS[kind](s, height, every=4), "heat").from_source(3) for height in (0.0, 1e-12, 1e-9)
    ]
    for field in fields[1:]:
        assert np.abs(field - fields[0]).max() < RIGHT * field.max()


def test_where_no_face_is_flat_nothing_is_done():
    s = bumpy(300)
    assert len(s.degenerate_faces) == 0
    thin = caps(s, 2e-7, every=50)
    assert len(thin.degenerate_faces) == 0
    assert len(caps(s, 0.5e-7, every=50).degenerate_faces) == 12


def test_a_certificate_knows_what_it_does_not_know(monkeypatch):
    """Where degenerate faces are left as they are the elimination loses digits, distances are wrong, and it says so."""
    surface, pairs = cases("caps", "bumpy", 1e-7)
    for module in ("surface", "degenerate_faces", "distances.accuracy", "distances.biharmonic_accuracy"):
        monkeypatch.setattr(f"bihdist_core.{module}.FLAT_RATIO", 1e-14)
    # Without the compiled kernel, whose limit is a constant.
    monkeypatch.setattr("bihdist_core.solver.elimination_tree.library", lambda: None)
    monkeypatch.setattr("bihdist_core.solver.plain.STIFF", 0.0)
    distance = BiharmonicDistance(Surface(surface.vertices, surface.faces))
    # As digits are lost some squares are below zero, which processors do not have in common.
    monkeypatch.setattr("bihdist_core.distances.squares.ROUNDING", 1.0)
    error = max(abs(distance.from_source(i)[j] - exact) for i, j, exact, _ in pairs) / distance.from_source(3).max()
    assert error > RIGHT
    assert distance.accuracy > error


def chain(count: int, height: float) -> Surface:
    """An edge divided into many on one side only, the other side closed by as many degenerate faces around one end."""
    t = np.linspace(0, 1, count + 2)
    inner = height * np.random.default_rng(1).random(count + 2) * (t * (1 - t) > 0)
    x = np.concatenate([np.stack([t, inner, 0 * t], 1), [[0.4, 1, 0], [0.6, -1, 0.3]]])
    c, d = count + 2, count + 3
    faces = [(i, i + 1, c) for i in range(count + 1)] + [(0, i + 1, i) for i in range(1, count + 1)]
    return Surface(x, [*faces, (0, d, count + 1)], "chain")


def fan(count: int, height: float) -> Surface:
    """Needles around one vertex, side by side, between two faces of usual shape."""
    angle = np.arange(count) * height
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    faces = [(0, i, i + 1) for i in range(1, count)]
    ends = [(0, count + 1, 1), (0, count, count + 2), (0, count + 2, count + 1)]
    return Surface(np.concatenate([[[0, 0, 0]], ring, [[0.3, -1, 0.2], [-1, 0.5, 0.1]]]), faces + ends, "fan")


@pytest.mark.parametrize("height", [1e-8, 1e-12, 0.0])
@pytest.mark.parametrize(("make", "count"), [(chain, 25), (chain, 80), (fan, 30), (fan, 60)])
def test_many_flat_faces_in_a_chain_are_never_worse_than_certified(make, count, height):
    """What their springs lack adds up, to more than 1e-6 in a long chain: then the accuracy says so."""
    surface = make(count, height)
    laplacian, reference = Laplacian(surface), ExactReference(surface)
    for index, kind in enumerate(EXACT):
        distance = kind(laplacian)
        for i, j in [(0, 5), (1, count), (5, count // 2), (count + 1, count + 2), (0, count + 1)]:
            field, exact = distance.from_source(i), reference.pair(i, j)[index]
            assert abs(field[j] - exact) <= field.max() * distance.accuracy, (distance.label, i, j)


def test_what_hangs_on_faces_of_no_area_costs_the_others_nothing():
    """A triangle of no area, and one in one place, each attached at a vertex."""
    s = bumpy(60)
    x, e = s.vertices[5], np.array([1.0, 0, 0])
    for more in ([x + e, x + 2 * e], [x, x]):
        surface = Surface(np.concatenate([s.vertices, more]), [*s.faces.tolist(), [5, 60, 61]])
        for make in (BiharmonicDistance, CommuteTimeDistance, DiffusionDistance):
            alone, distance = make(s).from_source(3), make(surface)
            assert np.abs(distance.from_source(3)[:60] - alone).max() <= RIGHT * alone.max()
            assert distance.accuracy < RIGHT


def test_a_component_of_faces_of_no_area_has_distances_by_convention():
    surface = Surface([[0, 0, 0], [1, 0, 0], [0.4, 0, 0]], [[0, 1, 2]])
    for make in (BiharmonicDistance, CommuteTimeDistance):
        assert (make(surface).from_source(0)[1:] > 0).all()
