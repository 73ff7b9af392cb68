"""Questions to distances: many pairs, many sources, their progress, and what is refused."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    ParameterError,
    PowerDistance,
    ShepardInterpolant,
    Surface,
    TruncatedBiharmonicDistance,
    VertexError,
    band,
    eigenpairs,
    extrema,
    farthest_points,
    isotropy_ratio,
    nearest,
    noisy,
    simplified,
    triangle_sample,
    triangle_violations,
    truncation_loss,
    with_holes,
)
from tests.core.every_distance import GEODESIC, QUADRATIC
from tests.shapes import bumpy, grid, two_pieces


def test_pairs_of_few_vertices_cost_a_field_each(monkeypatch):
    surface = bumpy(300)
    distance, solved = BiharmonicDistance(surface), []
    rng = np.random.default_rng(0)
    pairs = np.concatenate([np.column_stack([np.full(400, 12), rng.integers(300, size=400)]), [[5, 12], [7, 12]]])
    exact = distance.of_pairs(pairs, digits="all")
    solve = distance.laplacian.components[0].solve
    monkeypatch.setattr(distance.laplacian.components[0], "solve", lambda b, *rest: solved.append(b) or solve(b, *rest))
    found = distance.of_pairs(pairs)
    assert sum(b.shape[1] for b in solved) <= 17  # of the vertices nearest to it
    assert np.allclose(found, exact, rtol=1e-9)
    many = rng.integers(300, size=(5000, 2))
    assert np.allclose(distance.of_pairs(many), distance.pairwise(np.arange(300))[tuple(many.T)], rtol=1e-9)
    with pytest.raises(ParameterError, match="Digits of pairs are 'field' or 'all', not 'some'"):
        distance.of_pairs(pairs, digits="some")


def test_all_digits_of_near_pairs():
    flat = grid(30, 30)
    points = flat.vertices.copy()
    points[31:62] *= [1e-6, 1e-6, 1]
    points[31:62] += flat.vertices[31]
    distance = BiharmonicDistance(Surface(points, flat.faces))
    pairs = np.column_stack([np.full(300, 40), np.r_[31:40, 41:62, 600:870]])
    apart = np.array([distance.between(40, int(v)) for v in pairs[:30, 1]])
    assert np.allclose(distance.of_pairs(pairs, digits="all")[:30], apart, rtol=1e-12)


@pytest.mark.parametrize("surface", [bumpy(300), two_pieces()], ids=["one", "two"])
def test_fields_of_many_sources_go_where_they_are_to(surface, monkeypatch, tmp_path):
    monkeypatch.setattr("bihdist_core.distances.source_questions.BLOCK_VALUES", 1)
    distance, ids = BiharmonicDistance(surface), np.flatnonzero(surface.component_of_vertex >= 0)[::2]
    expected = np.column_stack([distance.from_source(int(v)) for v in ids])
    close = 1e-6 * np.nanmax(expected)
    single = distance.from_sources(ids, dtype=np.float32)
    assert single.dtype == np.float32
    assert np.allclose(single, expected, atol=close, equal_nan=True)
    mapped = np.lib.format.open_memmap(tmp_path / "a.npy", "w+", np.float64, expected.shape)
    assert distance.from_sources(ids, out=mapped) is mapped
    mapped.flush()
    assert np.allclose(np.load(tmp_path / "a.npy"), expected, atol=1e-3 * close, equal_nan=True)
    assert distance.from_sources([]).shape == (len(surface.vertices), 0)
    with pytest.raises(ParameterError, match="`out` has"):
        distance.from_sources(ids, out=mapped.T)
    for wrong, words in ((int, "float32 or float64, not int64"), ("text", "float32 or float64, not 'text'")):
        with pytest.raises(ParameterError, match=words):
            distance.from_sources(ids, dtype=wrong)
    mapped.flags.writeable = False
    with pytest.raises(ParameterError, match="`out`, which is read-only"):
        distance.from_sources(ids, out=mapped)
    with pytest.raises(ParameterError, match="written into an array, not into list"):
        distance.from_sources(ids, out=[0.0])


@pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})
@pytest.mark.parametrize("ask", ["from_sources", "pairwise", "of_pairs"])
def test_questions_report_progress_and_can_be_cancelled(make, ask, monkeypatch):
    surface = bumpy(300)
    monkeypatch.setattr("bihdist_core.solver.worker_threads.REPORT_SECONDS", 0)
    distance, said = make(surface), []
    asked = np.arange(200)
    asked = np.column_stack([asked, asked[::-1] + 50]) if ask == "of_pairs" else asked

    def stop(fraction, text):
        raise Cancelled("enough")

    with pytest.raises(Cancelled, match="enough"):
        getattr(distance, ask)(asked, stop)
    getattr(distance, ask)(asked, lambda fraction, text: said.append(fraction))
    assert said == sorted(said)
    assert 0 <= said[0] <= said[-1] <= 1


@pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})
@pytest.mark.parametrize("ask", ["from_sources", "pairwise", "of_pairs"])
def test_progress_grows_from_component_to_component_also_where_one_is_asked_first(make, ask):
    distance, said = make(two_pieces()), []
    asked = [(0, 3), (61, 62), (3, 61)] if ask == "of_pairs" else [0, 3, 61, 62]
    getattr(distance, ask)(asked, lambda fraction, text: said.append(fraction))
    assert said == sorted(said)
    assert said[-1] <= 1


@pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})
def test_between_takes_arrays_reports_and_can_be_cancelled(make):
    distance, said = make(bumpy(300)), []
    u, v = np.arange(40), np.arange(40)[::-1] + 100

    def stop(fraction, text):
        raise Cancelled("enough")

    found = distance.between(u, v, lambda fraction, text: said.append(fraction))
    assert np.array_equal(found, distance.of_pairs(np.column_stack([u, v])))
    assert said == sorted(said)
    assert distance.between(7, 132, lambda fraction, text: said.append(fraction)) == pytest.approx(found[7], rel=1e-9)
    assert np.array_equal(distance.between(u.tolist(), tuple(v)), found)
    for ends in ((u, v), (7, 132), ("7", 132), ("3+7", 132), (132, "3+7")):
        with pytest.raises(Cancelled, match="enough"):
            distance.between(*ends, stop)


def test_between_takes_as_many_points_on_both_sides():
    distance = BiharmonicDistance(two_pieces())
    places = ["f3:0.2,0.5", 12, "f9:0,1"]
    found = distance.between(places, [3, 4, 5])
    assert np.allclose(found, [distance.between(p, q) for p, q in zip(places, [3, 4, 5], strict=True)], rtol=1e-12)
    assert np.isnan(distance.between([0], [61]))
    assert distance.between(np.array(3), np.array(5)) == distance.between(3, 5)
    for u, v, words in (
        ([1, 2], [3], "not between 2 points and 1 points"),
        (1, [3], "not between 1 and 1 points"),
        ([[1, 2]], [[3, 4]], r"must have shape \(k, 2\), not \(1, 4\)"),
        ([1, [2]], [3, 4], "Vertices are not an array: their rows differ in length"),
    ):
        with pytest.raises(ParameterError, match=words):
            distance.between(u, v)


@pytest.mark.parametrize("source", [12.0, "twelve", None, np.float64(3)])
def test_what_is_no_vertex_is_refused_everywhere(source):
    distance = BiharmonicDistance(bumpy(60))
    for ask in (
        lambda: distance.from_source(source),
        lambda: distance.from_sources([source, 3]),
        lambda: distance.between(source, 3),
        lambda: distance.pairwise([source, 3]),
        lambda: distance.of_pairs([(source, 3)]),
        lambda: farthest_points(distance, source),
        lambda: nearest(distance, [source]),
    ):
        with pytest.raises((VertexError, ParameterError)):
            ask()
    for vertex in (np.array(12), np.uint8(12), "12"):
        assert np.array_equal(distance.from_source(vertex), distance.from_source(12))


def test_counts_beyond_the_mesh_are_refused_at_once():
    distance = BiharmonicDistance(bumpy(60))
    for ask in (
        lambda: nearest(distance, [1], k=61),
        lambda: farthest_points(distance, 0, 61),
        lambda: eigenpairs(distance.laplacian, 60),
        lambda: TruncatedBiharmonicDistance(distance.laplacian, k=60),
    ):
        with pytest.raises(ParameterError, match=r"6[01]"):
            ask()


@pytest.mark.parametrize("value", ["a", None, 1j, [0.5], True])
def test_what_is_no_number_is_refused_in_a_sentence(value):
    surface = bumpy(60)
    distance, field = BiharmonicDistance(surface), surface.vertices[:, 2]
    for ask in (
        lambda: DiffusionDistance(surface, t=value),
        lambda: PowerDistance(surface, alpha=value),
        lambda: GeodesicDistance(surface, radius=value),
        lambda: ShepardInterpolant(distance, [1], [1.0], exponent=value),
        lambda: ShepardInterpolant(distance, [1], [1.0], smoothness=value),
        lambda: band(surface, field, value),
        lambda: band(surface, field, 0, value),
        lambda: extrema(surface, field, value),
        lambda: isotropy_ratio(surface, field, field, value),
        lambda: nearest(distance, [1], memory=value),
        lambda: nearest(distance, [1], k=value),
        lambda: noisy(surface, value),
        lambda: simplified(surface, value),
        lambda: triangle_sample(distance, value),
        lambda: triangle_sample(distance, component=value),
        lambda: triangle_violations(np.zeros((5, 5)), value),
        lambda: truncation_loss(surface, 3, value),
        lambda: with_holes(surface, value),
        lambda: with_holes(surface, 1, value),
    ):
        with pytest.raises(ParameterError, match=r"number"):
            ask()


@pytest.mark.parametrize(
    ("vertices", "words"),
    [
        ([[1], [2, 3]], "vertex ids are one row, and these differ in length"),
        (np.array([1 + 0j, 2]), r"np.complex128\(1\+0j\) is not a vertex id"),
        (np.array([1.0, 2.0]), r"1.0\) is not a vertex id"),
        (np.array(["1", "b"]), r"'1'\) is not a vertex id"),
        (np.array([True, False]), r"np.True_ is not a vertex id"),
        ({1: 2}, r"\{1: 2\} is not a vertex id"),
        (np.array([[1, 2]]), r"\[1, 2\]\) is not a vertex id"),
        (np.array([3, 2**63 + 5], np.uint64), f"has no vertex {2**63 + 5}; ids run from 0 to 59"),
        (np.array([3, -1]), "has no vertex -1"),
    ],
)
def test_arrays_that_are_no_vertices_are_refused_in_a_sentence(vertices, words):
    distance = BiharmonicDistance(bumpy(60))
    for ask in (distance.from_sources, distance.pairwise, distance.surface.check_vertices):
        with pytest.raises(VertexError, match=words):
            ask(vertices)
    with pytest.raises((VertexError, ParameterError)):
        distance.of_pairs([vertices])


def test_operators_cannot_be_written_to():
    laplacian = Laplacian(bumpy(60))
    for array in (laplacian.areas, laplacian.stiffness.data):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
