"""What holds for every distance, on every kind of surface."""

import contextlib
import re

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    MeshError,
    ParameterError,
    PowerDistance,
    SolverError,
    Surface,
    TruncatedBiharmonicDistance,
    VertexError,
)
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.squares import root
from bihdist_core.kernel.library import library
from bihdist_core.laplacian import Component, as_laplacian, eigenpairs
from tests.shapes import bumpy, components_apart, fin, grid, slivers, spike, tetrahedron, torus, two_pieces


def pair_count(surface):
    """Thirty eigenpairs, or as many as there are."""
    return min(30, int(as_laplacian(surface).eigenpair_counts.max()))


DISTANCES = {
    "biharmonic": BiharmonicDistance,
    "commute-time": CommuteTimeDistance,
    "diffusion": lambda s: DiffusionDistance(s, t=0.5),
    "truncated": lambda s: TruncatedBiharmonicDistance(s, k=pair_count(s)),
    "power": lambda s: PowerDistance(s, alpha=1.5),
    "exact": lambda s: GeodesicDistance(s, "exact"),
    "heat": lambda s: GeodesicDistance(s, "heat"),
    "dijkstra": lambda s: GeodesicDistance(s, "dijkstra"),
}
every_distance = pytest.mark.parametrize("make", DISTANCES.values(), ids=DISTANCES)
SURFACES = [bumpy(150), grid(6, 4), torus(10, 6), tetrahedron(), slivers(), fin()]
every_surface = pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
FULL_METRICS = ["biharmonic", "commute-time", "exact", "dijkstra"]

SMALL = 1e-9  # rounding of sums of squares, against the largest distance


def all_pairs(make, surface):
    return make(surface).from_sources(np.arange(len(surface.vertices)))


@every_distance
@every_surface
def test_zero_at_the_source_finite_and_positive_elsewhere(make, surface):
    field = make(surface).from_source(2)
    assert field.shape == (len(surface.vertices),)
    assert field[2] == 0
    elsewhere = np.delete(field, 2)
    assert np.isfinite(elsewhere).all()
    # The heat method clips values next to the source that fall below it.
    assert (elsewhere >= 0).all() if make is DISTANCES["heat"] else (elsewhere > 0).all()


@pytest.mark.parametrize("name", FULL_METRICS)
@every_surface
def test_symmetry_and_triangle_inequality(name, surface):
    d = all_pairs(DISTANCES[name], surface)
    slack = SMALL * d.max()
    assert np.abs(d - d.T).max() <= slack
    assert (d[:, :, None] <= d[:, None, :] + d[None, :, :].swapaxes(1, 2) + slack).all()


@every_distance
def test_many_sources_equal_single_ones_and_pairs_equal_both(make):
    distance, sources = make(bumpy(150)), [3, 77, 9, 149, 3]
    fields = distance.from_sources(sources)
    assert fields.shape == (150, 5)
    slack = SMALL * fields.max()
    for k, source in enumerate(sources):
        assert np.abs(fields[:, k] - distance.from_source(source)).max() <= slack
    pairs = distance.pairwise(sources)
    symmetric = 0.05 if distance.label == "geodesic, heat method" else SMALL  # not symmetric by itself
    assert np.abs(pairs - fields[sources]).max() <= symmetric * fields.max()
    assert np.array_equal(pairs, pairs.T)
    assert distance.between(3, 77) == pytest.approx(pairs[0, 1], rel=1e-12)
    assert pairs[0, 4] == 0


@every_distance
def test_components_do_not_see_each_other(make):
    s = two_pieces()
    distance = make(s)
    large, small = components_apart(s)
    for here, there in [(large, small), (small, large)]:
        field = distance.from_source(here[0])
        assert np.isfinite(field[here]).all()
        assert np.isnan(field[there]).all()
        assert np.isnan(field[60])
        alone = make(s.component(s.component_of_vertex[here[0]])[0]).from_source(0)
        assert np.abs(field[here] - alone).max() <= SMALL * alone.max()
    mixed = distance.pairwise([large[0], small[0], small[1]])
    assert np.isnan(mixed[0, 1:]).all()
    assert mixed[1, 2] > 0
    assert np.isnan(distance.between(large[0], small[0]))
    fields = distance.from_sources([small[0], large[5]])
    assert np.isnan(fields[large, 0]).all()
    assert fields[large[5], 1] == 0


@every_distance
def test_scales_with_the_surface_as_it_says(make):
    s = bumpy(150)
    large = Surface(1000 * s.vertices, s.faces)
    distance, larger = make(s), make(large)
    expected = 1000**distance.length_power * distance.from_source(5)
    assert larger.from_source(5) == pytest.approx(expected, rel=1e-6, abs=1e-8 * expected.max())


@every_distance
@pytest.mark.parametrize("power", [-160, -60, 60, 160])
def test_a_power_of_two_changes_no_digit(make, power):
    s = bumpy(700)
    distance, scaled = make(s), make(Surface(2.0**power * s.vertices, s.faces))
    assert (scaled.from_source(5) == 2.0 ** (power * distance.length_power) * distance.from_source(5)).all()
    if distance.accuracy is not None:
        assert scaled.accuracy == distance.accuracy


@pytest.mark.parametrize("size", [1e-160, 1e-100, 1e-51, 1e51, 1e100, 1e160])
def test_a_surface_too_large_or_too_small_for_numbers_is_refused(size):
    s = bumpy(30)
    with pytest.raises(MeshError, match="have no numbers, so scale it"):
        BiharmonicDistance((size * s.vertices, s.faces))
    if 1e-150 < size < 1:  # as a component
        both = np.concatenate([s.vertices, size * s.vertices]), np.concatenate([s.faces, s.faces + 30])
        heat = GeodesicDistance(both, "heat")
        assert heat.from_source(3)[:30].max() > 0.1
        with pytest.raises(MeshError, match="have no numbers, so scale it up"):
            heat.from_source(31)


@every_distance
def test_does_not_depend_on_position_or_numbering(make):
    s = bumpy(150)
    rng = np.random.default_rng(1)
    turn, order = np.linalg.qr(rng.standard_normal((3, 3)))[0], rng.permutation(150)
    other = Surface(s.vertices[order] @ turn + [5, -3, 2], np.argsort(order)[s.faces])
    moved = make(other).from_source(int(np.argsort(order)[7]))
    expected = make(s).from_source(7)
    assert np.abs(moved - expected[order]).max() <= 1e-7 * expected.max()  # eigenpairs are found to 1e-8


@every_distance
@pytest.mark.parametrize("vertex", [65, -1, 60])
def test_a_bad_vertex_is_an_error_in_every_question(make, vertex):
    distance = make(two_pieces())
    for ask in (
        lambda: distance.from_source(vertex),
        lambda: distance.from_sources([0, vertex]),
        lambda: distance.between(0, vertex),
        lambda: distance.pairwise([0, vertex]),
    ):
        with pytest.raises(VertexError, match=f"vertex {vertex}"):
            ask()


@every_distance
def test_a_surface_stands_for_its_laplacian(make):
    s = bumpy(150)
    assert np.array_equal(make(s).from_source(3), make(Laplacian(s)).from_source(3))
    assert np.array_equal(make((s.vertices, s.faces)).from_source(3), make(s).from_source(3))
    with pytest.raises(ParameterError, match=r"A mesh is a path, .* not int"):
        make(12)


@pytest.mark.parametrize("name", ["biharmonic", "commute-time", "diffusion", "truncated", "power", "heat"])
def test_construction_reports_progress_and_can_be_cancelled(name):
    kinds = {
        "biharmonic": BiharmonicDistance,
        "commute-time": CommuteTimeDistance,
        "diffusion": DiffusionDistance,
        "truncated": TruncatedBiharmonicDistance,
        "power": PowerDistance,
        "heat": lambda s, progress: GeodesicDistance(s, "heat", progress),
    }
    laplacian, said = Laplacian(bumpy(400)), []

    def stop(fraction, text):
        raise Cancelled("enough")

    with pytest.raises(Cancelled, match="enough"):
        kinds[name](laplacian, progress=stop)
    distance = kinds[name](laplacian, progress=lambda fraction, text: said.append((fraction, text)))
    fractions = [fraction for fraction, _ in said]
    assert said
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] <= fractions[-1] <= 1
    assert np.isfinite(distance.from_source(0)).all()


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda s: DiffusionDistance(s, t=0), "time t is 0; it must be positive"),
        (lambda s: DiffusionDistance(s, t=1e308), "time t is 1e\\+308; it must be positive, and at most 700"),
        (lambda s: TruncatedBiharmonicDistance(s, k=0), "k is 0"),
        (lambda s: TruncatedBiharmonicDistance(s, k=2.5), "k is 2.5"),
        (lambda s: PowerDistance(s, alpha=1), "needs alpha > 1"),
        (lambda s: GeodesicDistance(s, "fast"), "no geodesic method 'fast'; choose one of auto"),
        (lambda s: Laplacian(s, "mixed"), "no 'mixed' vertex areas"),
    ],
)
def test_parameters_outside_their_meaning_are_refused(make, words):
    with pytest.raises(ParameterError, match=words):
        make(tetrahedron())


def test_labels_say_what_is_shown():
    s = bumpy(150)
    assert [make(s).label for make in DISTANCES.values()] == [
        "biharmonic, exact",
        "commute-time, exact",
        "diffusion, t = 0.5",
        "biharmonic, 30 eigenpairs",
        "1/λ^1.5, exact",
        "geodesic, exact",
        "geodesic, heat method",
        "geodesic, Dijkstra along edges",
    ]


def test_wrong_kinds_of_parameters_are_refused_in_a_sentence():
    s = tetrahedron()
    for make, words in [
        (lambda: DiffusionDistance(s, t="a"), "The diffusion time t is a number, not 'a'"),
        (lambda: PowerDistance(s, alpha="2"), "alpha is a number, not '2'"),
        (lambda: Laplacian(3), "A mesh is a path, .*, not int"),
    ]:
        with pytest.raises(ParameterError, match=words):
            make()


@pytest.mark.parametrize("make", [TruncatedBiharmonicDistance, lambda s, k: eigenpairs(s, k)])
@pytest.mark.parametrize("k", [60, 99_999])
def test_more_eigenpairs_than_there_are_are_refused_before_anything_is_factored(make, k, monkeypatch):
    monkeypatch.setattr(Component, "factor", lambda *_, **__: pytest.fail("it is factored"))
    with pytest.raises(
        ParameterError, match=f"has 59 eigenpairs besides the constant, and k is {k:,}; choose k from 1 to 59"
    ):
        make(bumpy(60), k=k)


def test_each_component_has_as_many_eigenpairs_as_it_can_give():
    distance = TruncatedBiharmonicDistance(two_pieces(), k=59)
    assert distance.label == "biharmonic, 59 eigenpairs"
    assert [distance.points(component).shape[1] for component in distance.laplacian.components] == [59, 3]
    with pytest.raises(ParameterError, match="two pieces has 59 eigenpairs besides the constant, and k is 60"):
        TruncatedBiharmonicDistance(two_pieces(), k=60)


def test_a_vertex_without_an_area_has_no_eigenpair():
    laplacian = Laplacian(two_pieces())
    laplacian.areas.flags.writeable = True
    laplacian.areas[3] = 0
    assert laplacian.eigenpair_counts.tolist() == [58, 3]


@pytest.mark.parametrize("length", [1e11, 1e13, 1e30])
@pytest.mark.parametrize("n", [60, 500])
def test_a_spike_without_end_gives_our_errors_or_an_accuracy(n, length):
    """Nothing else, and no warning: where the numbers end, the accuracy says so."""
    s = spike(n, length)
    for make in (
        BiharmonicDistance,
        CommuteTimeDistance,
        DiffusionDistance,
        lambda s: TruncatedBiharmonicDistance(s, k=20),
        lambda s: GeodesicDistance(s, "heat"),
    ):
        with contextlib.suppress(SolverError):
            distance = make(s)
            distance.from_source(3)
            distance.error_estimate()


def test_a_broken_operator_is_noticed():
    terms = np.array([1.0])
    assert root(np.array([-1e-9, 4.0]), terms).tolist() == [0.0, 2.0]  # rounding
    for squares in ([-1e-3, 1.0], [np.nan, 1.0]):
        with pytest.raises(SolverError, match=r"A squared distance came out as .*: the mesh is too badly shaped"):
            root(np.array(squares), terms)


def test_a_field_with_squares_below_zero_is_refused(monkeypatch):
    """The guard in `root` stands in the way of every exact field."""
    distance = CommuteTimeDistance(bumpy(60))
    component = distance.laplacian.components[0]
    monkeypatch.setattr(component, "green_diagonal", lambda progress=None: np.zeros(60))
    with pytest.raises(SolverError, match="A squared distance came out as -"):
        distance.from_source(3)


@every_distance
@every_surface
def test_every_distance_tells_its_accuracy_or_that_it_has_none(make, surface):
    distance = make(surface)
    if isinstance(distance, GeodesicDistance):
        assert distance.accuracy is None
        assert distance.error_estimate().is_poor == (distance.method != "exact")
        assert (distance.error_estimate().share is None) == (distance.method != "heat" or library() is None)
    else:
        assert 0 < distance.accuracy < 1e-2  # a cut between equal eigenvalues of a symmetric shape leaves much open


def test_a_certificate_in_words():
    distance = BiharmonicDistance(bumpy(150))
    assert re.fullmatch(r"accurate to \de-1[1-5] of the maximum", distance.error_estimate().text)
    assert not distance.error_estimate().is_poor
    assert ErrorEstimate.of(1.01e-6) == ErrorEstimate("accurate to 2e-06 of the maximum", False, 1.01e-6)
    assert ErrorEstimate.of(1.01e-3) == ErrorEstimate("accurate to 2e-03 of the maximum", True, 1.01e-3)
    assert ErrorEstimate.of(9.6e-11).text == "accurate to 1e-10 of the maximum"
    distance._accuracies[0] = 2e-3
    with pytest.raises(SolverError, match=r"biharmonic, exact on bumpy may be off by 2e-03 .* remeshing would help"):
        distance.error_estimate()


def test_a_cut_between_equal_eigenvalues_is_told_and_what_to_choose():
    """The first eigenvalues of the sphere are 2, 6 and 12, three, five and seven times; here nearly so."""
    distance = TruncatedBiharmonicDistance(torus(24, 12), k=1)
    with pytest.raises(
        SolverError, match=r"Eigenvalues 1 and 2 differ by .* it is not clear which eigenpairs are the first 1"
    ):
        distance.error_estimate()
    with pytest.raises(SolverError, match="choose another k, such as 2"):
        TruncatedBiharmonicDistance(torus(24, 12), k=3).error_estimate()


def test_accuracy_is_of_the_components_that_were_asked():
    s = two_pieces()
    distance = BiharmonicDistance(s)
    distance.from_source(61)
    assert list(distance._accuracies) == []
    assert distance.accuracy is not None
    assert list(distance._accuracies) == [1]


@every_distance
def test_pairs_equal_the_matrix_of_all(make):
    s = two_pieces()
    distance, rng = make(s), np.random.default_rng(0)
    pairs = np.array([p for p in rng.integers(0, 65, (150, 2)) if 60 not in p] + [(3, 3), (0, 62)])
    everyone = np.delete(np.arange(65), 60)
    expected = distance.pairwise(everyone)
    at = np.searchsorted(everyone, pairs)
    values = distance.of_pairs(pairs)
    assert np.array_equal(np.isnan(values), np.isnan(expected[tuple(at.T)]))
    assert np.nanmax(np.abs(values - expected[tuple(at.T)])) <= 1e-7 * np.nanmax(expected)
    assert values[-2] == 0
    few = distance.of_pairs(pairs[:5])
    assert np.allclose(few, values[:5], rtol=1e-9, equal_nan=True)
    for wrong in ([1, 2], [[1, 2, 3]]):
        with pytest.raises(ParameterError, match=r"must have shape \(k, 2\)"):
            distance.of_pairs(wrong)


def test_the_shortest_and_longest_times_are_computed():
    for t in (1e-300, 5e-324, 700):
        assert np.isfinite(DiffusionDistance(bumpy(150), t=t).from_source(3)).all()
