"""What spectral distances say of their accuracy, against dense spectra, for all pairs of vertices."""

from collections.abc import Iterator
from functools import cache, partial
from itertools import pairwise, product

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from bihdist_core import (
    BiharmonicDistance,
    Curve,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    SolverError,
    SourceSet,
    Surface,
    SurfacePoint,
    TruncatedBiharmonicDistance,
)
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.diffusion import EigenpairDiffusion
from bihdist_core.operators import stiffness
from bihdist_core.solver.spectrum import smallest_eigenpairs
from bihdist_core.sources.pieces import pieces_of
from tests.dense_reference import full_spectrum
from tests.shapes import bumpy, grid, needles, sphere, spike, torus


def stretched(s: Surface, by: tuple[float, float, float], name: str) -> Surface:
    return Surface(s.vertices * by, s.faces, name)


SHAPES = {
    "long": lambda: stretched(sphere(300), (3.9, 1, 1), "long"),
    "thin": lambda: stretched(sphere(250), (1, 1, 0.03), "thin"),
    "bumpy": lambda: bumpy(300),
    "torus": torus,
    "strip": lambda: grid(60, 3),
    "spike": lambda: spike(200, 6.0),
    "needles": lambda: needles(bumpy(120), 1e-2, every=4),
}
every_shape = pytest.mark.parametrize("name", SHAPES)
TIMES = (4, 2, 1, 1 / 2, 1 / 4, 1 / 8, 1 / 15)


@cache
def known(name: str) -> tuple[Laplacian, np.ndarray, np.ndarray]:
    """A shape, and its whole spectrum; eigenvalues from differences, which keep their digits."""
    surface = SHAPES[name]()
    _, vectors = full_spectrum(surface)
    up = stiffness(surface).tocoo()
    energy = np.zeros(vectors.shape[1])
    for i, j, weight in zip(up.row, up.col, up.data, strict=True):
        if i < j:
            energy -= weight * (vectors[i] - vectors[j]) ** 2
    return Laplacian(surface), energy, vectors


def worst(distance, points: np.ndarray) -> float:
    """The largest error of any distance, as a fraction of the maximum of the field it stands in."""
    exact = cdist(points, points)
    fields = distance.from_sources(np.arange(len(points)))
    return float((np.abs(fields - exact).max(axis=0) / exact.max(axis=0)).max())


def heat(values: np.ndarray, t: float) -> np.ndarray:
    return np.exp(-t / 2 * (values / values[0]))


@every_shape
def test_diffusion_is_as_accurate_as_it_says_between_all_vertices(name):
    laplacian, values, vectors = known(name)
    for t in TIMES:
        distance = DiffusionDistance(laplacian, t)
        # The reference comes from eigenvectors, too, and is itself no better than that.
        assert worst(distance, vectors * heat(values, t)) <= max(distance.accuracy, 1e-13) <= 1.01e-7, t


def test_vertices_that_few_eigenpairs_leave_together_are_told_apart():
    """Two eigenpairs have all the weight, and around a long body vertices differ by others only."""
    laplacian, values, vectors = known("long")
    exact = vectors * heat(values, 4)
    assert (heat(values, 4) ** 2 > 1e-8 * heat(values, 4)[0] ** 2).sum() == 2
    fields, of_two = cdist(exact, exact), cdist(exact[:, :2], exact[:, :2])
    off = np.abs(DiffusionDistance(laplacian, 4).from_sources(np.arange(300)) - fields).max(axis=0)
    assert (off <= 1e-7 * fields.max(axis=0)).all()
    assert np.abs(of_two - fields).max() > 2e-5 * fields.max()


@every_shape
def test_sums_are_as_accurate_as_they_say_or_refused(name):
    laplacian, values, vectors = known(name)
    for k in (1, 3, 10, 57):
        distance = TruncatedBiharmonicDistance(laplacian, k)
        assert worst(distance, vectors[:, :k] / values[:k]) <= distance.accuracy, k
        if values[k] - values[k - 1] < 1e-9 * values[k]:
            assert distance.accuracy > 1e-3
            with pytest.raises(SolverError, match=f"it is not clear which eigenpairs are the first {k}"):
                distance.error_estimate()
        else:
            assert distance.accuracy < 1e-7
        assert worst(distance, vectors / values) <= 1.001 * distance.beyond(), k


def sources_of(surface: Surface) -> Iterator[tuple[SurfacePoint | Curve | SourceSet, list]]:
    """Places in faces, on edges and beside corners, a curve, and sets, with the ends of the pieces of each."""
    random, faces, n = np.random.default_rng(1), surface.faces, len(surface.vertices)
    for near in (0.0, 0.5, 0.999):
        for weights in (*random.dirichlet([1, 1, 1], 4), np.array([0.5, 0.5, 0.0])):
            place = SurfacePoint.of(int(random.integers(len(faces))), *(near * np.eye(3)[0] + (1 - near) * weights)[:2])
            yield place, [(place, place)]
    some = [SurfacePoint.of(int(k), *random.dirichlet([1, 1, 1])[:2]) for k in random.integers(len(faces), size=5)]
    yield SourceSet(tuple(some)), [(place, place) for place in some]
    some = sorted(set(random.integers(n, size=n // 2).tolist()))
    yield SourceSet(tuple(some)), [(vertex, vertex) for vertex in some]
    ends = SurfacePoint.of(7, 0.2, 0.3), SurfacePoint.of(7, 0.6, 0.1)
    yield Curve(ends), [ends]


@every_shape
def test_it_covers_places_curves_and_sets(name):
    laplacian, values, vectors = known(name)
    surface = laplacian.surface

    def at(x, end):
        return x[end] if isinstance(end, int) else np.array(end.weights) @ x[surface.faces[end.face]]

    def distances(x, start, stop):
        start, way = at(x, start), at(x, stop) - at(x, start)
        share = np.clip((x - start) @ way / max(way @ way, 1e-300), 0, 1)
        return np.linalg.norm(x - start - share[:, None] * way, axis=1)

    diffusions = [(DiffusionDistance(laplacian, t), vectors * heat(values, t)) for t in (1, 1 / 4)]
    k = next(k for k in range(20, 60) if values[k] > 1.001 * values[k - 1])
    for distance, x in (*diffusions, (TruncatedBiharmonicDistance(laplacian, k), vectors[:, :k] / values[:k])):
        for source, ends in sources_of(surface):
            expected = np.min([distances(x, *each) for each in ends], axis=0)
            off, top = np.abs(distance.from_source(source) - expected), expected.max()
            said = distance.error_estimate(pieces=[pieces_of(source, surface)]).share
            # The reference itself is rounded.
            assert off.max() <= (said + 1e-12) * top
            assert said <= distance.accuracy
        places = [source for source, ends in sources_of(surface) if isinstance(source, SurfacePoint)]
        for u, v in pairwise(places):
            off = abs(distance.between(u, v) - np.linalg.norm(at(x, u) - at(x, v)))
            assert off <= (distance.accuracy + 1e-12) * distances(x, u, u).max()


def test_from_middles_of_a_cubes_edges_diffusion_is_further_off_than_from_its_vertices():
    x, faces = [list(corner) for corner in product(range(4), repeat=3)], []
    for axis, i, j, end in product(range(3), range(3), range(3), (0, 3)):
        corners = [[i + a, j + b] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        a, b, c, d = (x.index([*corner[:axis], end, *corner[axis:]]) for corner in corners)
        faces += [[a, b, c], [a, c, d]]
    used, faces = np.unique(faces, return_inverse=True)
    surface = Surface(np.array(x)[used], faces.reshape(-1, 3), "cube")
    values, vectors = full_spectrum(surface)
    exact, distance = vectors * heat(values, 1), EigenpairDiffusion(Laplacian(surface))
    from_vertices, off = distance.accuracy, []
    for face, corners in enumerate(surface.faces):
        expected = cdist(exact[corners[:2]].mean(axis=0, keepdims=True), exact)[0]
        off.append(np.abs(distance.from_source(SurfacePoint.of(face, 0.5, 0.5)) - expected).max() / expected.max())
        assert off[-1] <= distance.accuracy
    assert max(off) > 1.4 * from_vertices
    assert distance.accuracy < 3 * from_vertices


def test_an_answer_from_a_place_does_not_wait_for_its_bound(monkeypatch):
    surface, waited = bumpy(300), []
    lengths = EigenpairDiffusion._lengths_on
    monkeypatch.setattr(EigenpairDiffusion, "_lengths_on", lambda *given: (waited.append(1), lengths(*given))[1])
    distance = EigenpairDiffusion(surface)
    fields = [distance.from_source(f"f{k}:0.3,0.3") for k in range(3)]
    between = distance.between("f0:0.3,0.3", "f9:0.3,0.3")
    assert between > 0
    assert not waited
    assert np.all([field.max() > 0 for field in fields])
    assert distance.accuracy > 0
    assert waited
    # Not for ever, though: fields are kept for it meanwhile.
    distance = EigenpairDiffusion(surface)
    waited.clear()
    for k in range(20):
        distance.from_source(f"f{k}:0.3,0.3")
    assert waited


def test_words_say_what_the_accuracy_of_a_sum_is_of():
    surface = bumpy(300)
    distance = TruncatedBiharmonicDistance(surface, k=30)
    said, _, beyond = distance.error_estimate().text.rpartition(" ")
    assert said.endswith("of the maximum as a sum of 30 eigenpairs; all of them would change it by at most")
    exact = BiharmonicDistance(surface).from_sources(np.arange(300))
    fields = distance.from_sources(np.arange(300))
    off = (np.abs(fields - exact).max(axis=0) / fields.max(axis=0)).max()
    assert float(beyond) / 4 < off < float(beyond)
    whole = TruncatedBiharmonicDistance(surface, k=299)
    assert "sum" not in whole.error_estimate().text
    assert whole.beyond() < 1e-10
    assert DiffusionDistance(surface).error_estimate().text.endswith("of the maximum")


def test_eigenvectors_that_have_not_converged_are_told(monkeypatch):
    """With residuals of some percent, also of clusters: the sphere's eigenvalues come three, five, seven at a time."""
    surface = sphere(600)
    values, vectors = full_spectrum(surface)
    monkeypatch.setattr("bihdist_core.laplacian.smallest_eigenpairs", partial(smallest_eigenpairs, tolerance=0.05))
    laplacian = Laplacian(surface)
    found = laplacian.components[0].spectrum(60)
    assert found.residuals.max() > 1e-3
    for distance, points in (
        (DiffusionDistance(laplacian, t=2), vectors * heat(values, 2)),
        (TruncatedBiharmonicDistance(laplacian, k=48), vectors[:, :48] / values[:48]),
        (TruncatedBiharmonicDistance(laplacian, k=50), vectors[:, :50] / values[:50]),
    ):
        assert 1e-12 < worst(distance, points) <= distance.accuracy, distance.label


def test_methods_that_are_not_exact_say_so_and_what_is_made_of_them():
    surface = bumpy(150)
    dijkstra = GeodesicDistance(surface, "dijkstra").error_estimate()
    assert dijkstra.is_poor
    assert dijkstra.text.startswith("accurate to 10 % of the maximum typically, and worse on thin faces")
    assert GeodesicDistance(surface, "exact").error_estimate() == ErrorEstimate()
    nine = ErrorEstimate.of(9e-6)
    assert not nine.is_poor
    assert ErrorEstimate.of_difference(nine, dijkstra) == dijkstra
    assert ErrorEstimate.of_difference(ErrorEstimate(), nine) == ErrorEstimate()
    assert ErrorEstimate.of_difference(nine, ErrorEstimate.of(1e-3)).is_poor
