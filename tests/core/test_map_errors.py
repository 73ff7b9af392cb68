"""Errors of maps and their curves, against slow references; maps in files."""

import numpy as np
import pytest

from bihdist_core import (
    GeodesicDistance,
    ParameterError,
    Surface,
    VertexError,
    error_curve,
    map_errors,
    read_map,
    write_map,
)
from bihdist_core.applications.map_errors import LIMIT, MeanCurve
from bihdist_core.formats.vertex_maps import read_pairs
from tests.shapes import bumpy, components_apart, two_pieces


@pytest.fixture
def surface():
    return bumpy(150)


def test_errors_are_geodesic_distances_over_the_root_of_the_area(surface, monkeypatch):
    import bihdist_core.applications.map_errors as errors_of

    distance = GeodesicDistance(surface, "exact")
    random = np.random.default_rng(0)
    found, truth = random.integers(0, 150, (2, 60))
    all_distances = distance.pairwise(np.arange(150))
    unit = np.sqrt(surface.face_areas.sum())
    assert map_errors(distance, found, truth) == pytest.approx(all_distances[found, truth] / unit, abs=1e-9)
    heat = GeodesicDistance(surface, "heat")  # from the right answers: it is not quite symmetric
    fields = heat.from_sources(np.arange(150))
    for block in (7, 32):
        monkeypatch.setattr(errors_of, "BLOCK", block)
        assert map_errors(heat, found, truth) == pytest.approx(fields[found, truth] / unit, abs=1e-9)
    both = map_errors(distance, np.stack([found, truth], 1), truth)
    assert both[:, 0] == pytest.approx(all_distances[found, truth] / unit, abs=1e-9)
    assert (both[:, 1] == 0).all()


def test_a_symmetric_partner_counts_as_right(surface):
    distance = GeodesicDistance(surface, "dijkstra")
    partners = np.roll(np.arange(150), 75)
    truth = np.arange(0, 150, 3)
    assert (map_errors(distance, partners[truth], truth) > 0).all()
    assert (map_errors(distance, partners[truth], truth, partners) == 0).all()
    one = map_errors(distance, truth + 1, truth)
    either = map_errors(distance, truth + 1, truth, partners)
    other = map_errors(distance, truth + 1, partners[truth])
    assert either == pytest.approx(np.minimum(one, other))


def test_what_was_mapped_nowhere_is_infinitely_wrong_and_what_has_no_truth_is_left_out():
    s = two_pieces()
    large, small = components_apart(s)
    distance = GeodesicDistance(s, "dijkstra")
    found = [int(large[0]), -1, int(small[0]), int(large[3])]
    errors = map_errors(distance, found, [int(large[0]), int(large[1]), int(large[2]), -1])
    assert errors[0] == 0
    assert np.isposinf(errors[1:3]).all()
    assert np.isnan(errors[3])
    curve = error_curve(errors)
    assert len(curve.errors) == 3
    assert curve.fractions([0, 10]).tolist() == [1 / 3, 1 / 3]
    assert curve.mean == np.inf


def test_the_area_is_that_under_the_curve():
    curve = error_curve(np.random.default_rng(0).exponential(0.1, 500))
    at = np.linspace(0, 0.25, 200_001)
    assert curve.area == pytest.approx(np.trapezoid(curve.fractions(at), at) / 0.25, abs=1e-5)
    assert curve.fractions(curve.median) == pytest.approx(0.5, abs=0.01)
    assert error_curve(np.zeros(3)).area == 1
    assert error_curve([0.3, np.inf]).area == 0


def test_bad_maps_are_refused(surface):
    distance = GeodesicDistance(surface, "dijkstra")
    with pytest.raises(VertexError, match="150"):
        map_errors(distance, [150], [0])
    with pytest.raises(ParameterError, match="2 values, and the truth 1"):
        map_errors(distance, [1, 2], [0])
    with pytest.raises(ParameterError, match="float"):
        map_errors(distance, [1.5], [0])
    with pytest.raises(ParameterError, match="partners"):
        map_errors(distance, [1], [0], [3])
    with pytest.raises(ParameterError, match="o vertex has"):
        error_curve([np.nan])


@pytest.mark.parametrize("name", ["map.npy", "map.txt"])
def test_maps_are_read_as_they_were_written(surface, tmp_path, name):
    found = np.random.default_rng(0).integers(-1, 150, 150)
    write_map(tmp_path / name, found)
    assert (read_map(tmp_path / name, surface, surface) == found).all()


def test_identity_is_a_map_between_meshes_of_one_size(surface):
    assert (read_map("identity", surface, surface) == np.arange(150)).all()
    with pytest.raises(ParameterError, match="150 vertices and other 120"):
        read_map("identity", surface, Surface(bumpy(120).vertices, bumpy(120).faces, "other"))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("map.txt", "1\n2.5\n", r"map.txt, line 2: '2.5' is not a whole number"),
        ("map.txt", "0\n" * 149, r"maps 149 vertices, and bumpy has 150"),
        ("map.txt", "0\n" * 149 + "150\n", r"maps vertex 149 to 150, and bumpy has vertices 0 to 149"),
        ("map.txt", "\n".join(map(str, range(1, 151))), r"ids count from 0"),
        ("map.csv", "", "not a map"),
        ("map.npy", "nonsense", "cannot be read"),
        ("gone.txt", None, "No such file"),
    ],
)
def test_what_is_no_map_is_named(surface, tmp_path, name, content, words):
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(ParameterError, match=words):
        read_map(tmp_path / name, surface, surface)


def test_arrays_that_are_no_map_are_named(surface, tmp_path):
    np.save(tmp_path / "a.npy", np.zeros((150, 3), int))
    np.save(tmp_path / "b.npy", np.full(150, 0.5))
    np.save(tmp_path / "c.npy", np.arange(150.0)[:, None])
    with pytest.raises(ParameterError, match=r"\(150, 3\)"):
        read_map(tmp_path / "a.npy", surface, surface)
    with pytest.raises(ParameterError, match="float64"):
        read_map(tmp_path / "b.npy", surface, surface)
    assert (read_map(tmp_path / "c.npy", surface, surface) == np.arange(150)).all()


def test_pairs_are_read_with_and_without_a_header(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("a,b\n1,2\n\n3;4\n")
    assert read_pairs(path).tolist() == [[1, 2], [3, 4]]
    path.write_text("1:2\n3 4\n 5 , 6\n")
    assert read_pairs(path).tolist() == [[1, 2], [3, 4], [5, 6]]
    for text, said in (
        ("1,2\n3\n", "line 2: '3' is"),
        ("1.5,2\n", "line 1: '1.5,2' is"),
        ("-1,2\nx,3\n", "line 2: 'x,3'"),
    ):
        path.write_text(text)
        with pytest.raises(ParameterError, match=f"{said}.*pair"):
            read_pairs(path)


def test_maps_of_a_set_have_the_same_weight(surface):
    few, many = error_curve([0.0, 0.1]), error_curve(np.linspace(0, 0.2, 1001))
    both = MeanCurve((few, many))
    assert both.mean == pytest.approx((few.mean + many.mean) / 2)
    assert both.area == pytest.approx((few.area + many.area) / 2)
    thresholds = np.linspace(0, LIMIT, 77)
    np.testing.assert_allclose(both.fractions(thresholds), (few.fractions(thresholds) + many.fractions(thresholds)) / 2)
    assert both.fractions(both.median) >= 0.5 > both.fractions(both.median - 1e-9)
    assert MeanCurve((few,)).median == 0
    assert MeanCurve((error_curve([0.0, np.inf, np.inf]),)).median == np.inf
