"""How far maps of a document are from the truth, as the window finds it, against slow references."""

from dataclasses import replace

import numpy as np
import pytest

import app.tools.correspondence.map_errors as map_errors
from app.document.document import MeshFile, comparison
from app.document.page import Recipe
from app.document.second_mesh_edits import open_second_mesh
from app.drawing.glyphs import CANDIDATE, CROSS
from app.figures.draw import save_figure
from app.figures.export import compute, figure_of, open_document
from app.session.array_store import ArrayStore
from app.tools.correspondence.map_errors import MapErrorWorker, maps_of, partners_of, request_of, right_places, truth_of
from app.tools.correspondence.maps import MapFile, Maps, Truth, show_maps, with_truth
from app.tools.correspondence.pairs import Pairs, add_pairs, place_point
from app.tools.correspondence.quantity import predict
from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    Correspondence,
    GeodesicDistance,
    ParameterError,
    Surface,
    noisy,
    write_map,
    write_mesh,
)
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy

BIHARMONIC, GEODESIC = Spec.of("biharmonic"), Spec.of("geodesic")
PLACES = [(3, 3), (150, 150), (250, 250), (90, 90)]


@pytest.fixture
def loaded(tmp_path):
    """A document of a shape and the same with a little noise, with pairs, and both surfaces."""
    s = bumpy(300)
    write_mesh(tmp_path / "a.off", s)
    write_mesh(tmp_path / "b.off", noisy(s, 0.1))
    shown = open_second_mesh(
        comparison(str(tmp_path / "a.off"), (BIHARMONIC, GEODESIC)), MeshFile("", str(tmp_path / "b.off"))
    )
    document, surfaces = open_document(Recipe(predict(add_pairs(shown, PLACES))), ArrayStore())
    return document, surfaces["A"], surfaces["B"]


def last(worker, document, one, two):
    *_, found = worker.errors(request_of(document, one, two))
    return found


def slow(one, two, truth, ids):
    """Errors (m,) of the map by the biharmonic distance, from all geodesic distances."""
    found = Correspondence(BiharmonicDistance(one.surface), BiharmonicDistance(two.surface), PLACES).map()
    distances = GeodesicDistance(two.surface, "exact").pairwise(np.arange(len(two.surface.vertices)))
    return distances[truth[ids], found[ids]] / np.sqrt(two.surface.face_areas.sum())


def test_the_curve_is_that_of_a_slow_reference(loaded):
    document, one, two = loaded
    truth = np.arange(300)
    whole = last(MapErrorWorker(), document, one, two)
    assert (whole.known, whole.wanted, whole.vertices) == (300, 300, 300)
    assert whole.curves[BIHARMONIC].errors == pytest.approx(np.sort(slow(one, two, truth, truth)), abs=1e-6)
    assert whole.curves.keys() == {BIHARMONIC, GEODESIC}
    assert whole.method == "geodesic, exact"
    ids = np.unique(np.linspace(0, 299, 40).astype(int))
    sampled = last(MapErrorWorker(), document.with_part(Maps(truth=Truth(samples=40))), one, two)
    assert sampled.wanted == 40
    assert sampled.curves[BIHARMONIC].errors == pytest.approx(np.sort(slow(one, two, truth, ids)), abs=1e-6)


def test_it_comes_bit_by_bit_and_each_part_is_right(loaded, monkeypatch):
    document, one, two = loaded
    monkeypatch.setattr(map_errors, "ANSWER_INTERVAL_S", 0.0)
    document = document.with_part(Maps(truth=Truth(samples=40)))
    found = list(MapErrorWorker().errors(request_of(document, one, two)))
    assert [each.known for each in found] == [8, 16, 24, 32, 40]
    ids = np.random.default_rng(map_errors.ORDER_SEED).permutation(np.unique(np.linspace(0, 299, 40).astype(int)))
    expected = slow(one, two, np.arange(300), ids[:16])
    assert found[1].curves[BIHARMONIC].errors == pytest.approx(np.sort(expected), abs=1e-6)


def test_another_pair_costs_no_geodesic_distance(loaded):
    document, one, two = loaded
    document = document.with_part(Maps(truth=Truth(samples=40)))
    worker = MapErrorWorker()
    before = last(worker, document, one, two)
    asked = []
    kept = worker._kept.distance
    from_sources = kept.from_sources
    kept.from_sources = lambda *arguments: asked.append(arguments) or from_sources(*arguments)
    found = list(worker.errors(request_of(add_pairs(document, [(40, 40)]), one, two)))
    assert not asked
    assert [each.known for each in found] == [40]
    assert found[0].curves[BIHARMONIC].mean != before.curves[BIHARMONIC].mean


def test_what_is_kept_is_bounded(loaded, monkeypatch):
    document, one, two = loaded
    monkeypatch.setattr(map_errors, "MAX_KEPT_VALUES", 300 * 25)
    worker = MapErrorWorker()
    assert last(worker, document, one, two).wanted == 25
    worker._kept.find(range(100, 110))
    assert len(worker._kept._columns) == 25


def test_a_map_of_a_file_is_judged_beside_the_others(loaded, tmp_path):
    document, one, two = loaded
    write_map(tmp_path / "ours.txt", np.roll(np.arange(300), 7))
    document = document.with_part(Maps(maps=(MapFile(str(tmp_path / "ours.txt")),)))
    assert maps_of(document) == (BIHARMONIC, GEODESIC, document[Maps].maps[0])
    found = last(MapErrorWorker(), document, one, two)
    distances = GeodesicDistance(two.surface, "exact").pairwise(np.arange(300))
    errors = distances[np.arange(300), np.roll(np.arange(300), 7)] / np.sqrt(two.surface.face_areas.sum())
    assert found.curves[document[Maps].maps[0]].errors == pytest.approx(np.sort(errors), abs=1e-6)
    alone = last(MapErrorWorker(), document.with_part(Pairs(pairs=())), one, two)
    assert list(alone.curves) == [document[Maps].maps[0]]
    gone = document.with_part(Maps(maps=(MapFile(str(tmp_path / "gone.npy")),)))
    assert "gone.npy" in next(iter(last(MapErrorWorker(), gone, one, two).failures.values()))


def test_symmetric_partners_count_where_they_are_to(loaded, tmp_path):
    document, one, two = loaded
    partners = np.roll(np.arange(300), 150)
    write_map(tmp_path / "half.npy", partners)
    half = MapFile(str(tmp_path / "half.npy"))
    document = document.with_part(Maps(maps=(half,))).with_part(Pairs(pairs=()))
    without = last(MapErrorWorker(), with_truth(document, Truth(partners=half)), one, two)
    counted = last(MapErrorWorker(), with_truth(document, Truth(partners=half, mirror=True)), one, two)
    assert without.curves[half].mean > 0.1
    assert counted.curves[half].mean == 0


def test_same_ids_are_the_truth_where_the_faces_are_the_same(loaded, tmp_path):
    _, one, two = loaded
    assert np.array_equal(truth_of(Truth(), one.surface, two.surface), np.arange(300))
    assert truth_of(Truth("none"), one.surface, two.surface) is None
    assert truth_of(Truth(), one.surface, bumpy(200)) is None
    with pytest.raises(ParameterError, match="200"):
        truth_of(Truth("identity"), one.surface, bumpy(200))
    write_map(tmp_path / "t.npy", np.roll(np.arange(300), 1))
    there = Truth("file", MapFile(str(tmp_path / "t.npy")))
    assert np.array_equal(truth_of(there, one.surface, two.surface), np.roll(np.arange(300), 1))


def test_without_a_truth_there_is_nothing(loaded):
    document, one, two = loaded
    assert list(MapErrorWorker().errors(request_of(with_truth(document, Truth("none")), one, two))) == []
    assert list(MapErrorWorker().errors(request_of(replace(document, panels=()), one, two))) == []


def test_where_a_vertex_belongs_on_either_surface(loaded, tmp_path):
    _, one, two = loaded
    right, partners = np.roll(np.arange(300), 1), np.roll(np.arange(300), 150)
    right[5] = -1
    write_map(tmp_path / "t.npy", right)
    write_map(tmp_path / "half.npy", partners)
    truth = Truth("file", MapFile(str(tmp_path / "t.npy")), MapFile(str(tmp_path / "half.npy")))
    assert partners_of(truth, two.surface) is None
    both = replace(truth, mirror=True)
    surfaces = one.surface, two.surface
    assert right_places(truth, *surfaces, 7, True) == [6]
    assert right_places(both, *surfaces, 7, True) == [6, int(partners[6])]
    assert right_places(truth, *surfaces, 5, True) == []
    assert right_places(truth, *surfaces, 6, False) == [7]
    assert right_places(both, *surfaces, 6, False) == [7, int(np.flatnonzero(right == partners[6])[0])]
    assert right_places(truth, *surfaces, 4, False) == []
    assert right_places(Truth("none"), *surfaces, 4, False) == []


def test_it_stops_when_nobody_wants_it(loaded):
    document, one, two = loaded
    seen = []

    def cancelled(share, text):
        seen.append(share)
        if share > 0.4:
            raise Cancelled("enough")

    with pytest.raises(Cancelled):
        list(MapErrorWorker().errors(request_of(document, one, two), cancelled))
    assert seen == sorted(seen)


def test_maps_are_those_of_predictions_and_full_maps(loaded):
    document, _, _ = loaded
    assert maps_of(document) == maps_of(show_maps(document)) == (BIHARMONIC, GEODESIC)
    with pytest.raises(ParameterError, match="-1"):
        Truth(samples=-1)


def test_a_figure_has_a_cross_where_the_point_belongs_and_says_how_far_off_the_candidate_is(loaded, tmp_path):
    document, one, two = loaded
    document = place_point(document, "A", 170)
    surfaces = {"A": one, "B": two}
    answers = compute(document, surfaces)
    figure = figure_of(Recipe(document), surfaces, answers)
    assert not [mark for mark in figure.panels[0].marks if mark.glyph is CROSS]
    for panel, answer in zip(figure.panels[1:], answers[1:], strict=True):
        assert [mark.vertex for mark in panel.marks if mark.glyph is CROSS] == [170]
        best = int(answer.field.argmin())
        error = GeodesicDistance(two.surface, "exact").between(170, best) / np.sqrt(two.surface.face_areas.sum())
        candidates = [(mark.text, mark.aside) for mark in panel.marks if mark.glyph is CANDIDATE]
        assert (str(best), f"{100 * error:.1f} % off") in candidates
    unknown = figure_of(Recipe(with_truth(document, Truth("none"))), surfaces, answers)
    assert not [mark for panel in unknown.panels for mark in panel.marks if mark.glyph is CROSS]
    for drawn, name in ((figure, "with.png"), (unknown, "without.png")):
        save_figure(drawn, str(tmp_path / name))
    assert (tmp_path / "with.png").read_bytes() != (tmp_path / "without.png").read_bytes()


def test_vertices_of_no_face_are_left_out(tmp_path):
    s = bumpy(120)
    loose = Surface(np.concatenate([s.vertices[:60], [[9, 9, 9]], s.vertices[60:]]), s.faces + (s.faces >= 60))
    write_mesh(tmp_path / "a.off", loose)
    write_mesh(tmp_path / "b.off", s)
    write_map(tmp_path / "t.txt", np.concatenate([np.arange(60), [3], np.arange(60, 120)]))
    shown = open_second_mesh(comparison(str(tmp_path / "a.off"), (BIHARMONIC,)), MeshFile("", str(tmp_path / "b.off")))
    shown = with_truth(shown, Truth("file", MapFile(str(tmp_path / "t.txt"))))
    document, surfaces = open_document(Recipe(predict(add_pairs(shown, [(3, 3), (101, 100)]))), ArrayStore())
    found = last(MapErrorWorker(), document, surfaces["A"], surfaces["B"])
    assert (found.wanted, found.failures) == (120, {})
    assert len(found.curves[BIHARMONIC].errors) == 120
    back = replace(Truth("file", MapFile(str(tmp_path / "back.txt"))), samples=0)
    write_map(tmp_path / "back.txt", np.concatenate([np.arange(60), [60], np.arange(62, 121)]))
    there = truth_of(back, surfaces["B"].surface, surfaces["A"].surface)
    assert np.flatnonzero(there < 0).tolist() == [60]
