"""Errors of predictions and full maps in the window: curves, the truth, how far a candidate is off, the full map."""

import numpy as np
import pytest

from app.document.file import read_recipe
from app.drawing.glyphs import CANDIDATE, CROSS
from app.figures.export import compute, open_document
from app.session.array_store import ArrayStore
from app.tools.correspondence import map_errors as map_errors_module
from app.tools.correspondence.maps import MapColours, MapFile
from app.tools.correspondence.pairs import add_pairs, place_point
from app.tools.correspondence.quantity import predicts
from bihdist_core import (
    BiharmonicDistance,
    Correspondence,
    GeodesicDistance,
    Surface,
    error_curve,
    map_errors,
    read_map,
    write_map,
)
from bihdist_core.applications.correspondence import carried_back, position_colours
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid

pytest.importorskip("qtpy")
from qtpy import QtCore, QtTest, QtWidgets

from app.qt.docks.docks import WIDTH
from app.tools.correspondence.maps import Maps
from tests.qt.parts import parts

LEFT = QtCore.Qt.MouseButton.LeftButton
BIHARMONIC, GEODESIC = Spec.of("biharmonic"), Spec.of("geodesic")
COUNT = 120
PLACES = [(3, 3), (50, 50), (110, 110), (90, 90)]


@pytest.fixture
def make(screen, mesh_file, tmp_path, monkeypatch):
    """A window of two meshes with the tool: a ball, and another mesh."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))

    def made(other):
        s = screen((BIHARMONIC, GEODESIC))
        s.open(mesh_file(bumpy(COUNT), "first.off"))
        s.session.open_second_mesh(mesh_file(other, "second.off"))
        s.until(lambda: len(s.document.surfaces) == 2 and not s.session.is_opening)
        s.window.actions_by_word["dock pairs"].trigger()
        complete(s)
        return s

    return made


@pytest.fixture
def two(make):
    """Two shapes with the same faces, and pairs."""
    ball = bumpy(COUNT)
    s = make(Surface(2 * ball.vertices * (1, 1.2, 0.9), ball.faces))
    s.session.show(add_pairs(s.document, PLACES))
    complete(s)
    s.until(lambda: whole(s))
    return s


def complete(s):
    s.until(lambda: s.session.is_complete)
    s.settle(0.05)


def section(s):
    return parts(s.window).docks._instrument("pairs").errors


def whole(s):
    """Whether errors are found for the pairs that there are."""
    return section(s).is_whole


def surfaces(s):
    return [s.session.loaded(name).surface for name in "AB"]


def expected(s, kind, pairs, truth=None, partners=None):
    """The curve over all vertices, all at once."""
    one, two = surfaces(s)
    found = Correspondence(kind(one), kind(two), pairs).map()
    truth = np.arange(COUNT) if truth is None else truth
    return error_curve(map_errors(GeodesicDistance(two, "exact"), found, truth, partners))


def numbers(s):
    return {name: tuple(numbers) for name, *numbers in section(s).table.facts}


def text(curve):
    return f"{curve.mean:.4g}"


# ---------------------------------------------------------------------- curves
def test_the_curves_are_those_of_the_pairs_by_each_distance(two):
    s = two
    for name, kind in (("Biharmonic", BiharmonicDistance), ("Geodesic", GeodesicDistance)):
        curve = expected(s, kind, PLACES)
        found = section(s).named_curves()[name]
        assert (found.mean, found.median, found.area) == pytest.approx((curve.mean, curve.median, curve.area), abs=1e-6)
        assert float(numbers(s)[name][0]) == pytest.approx(curve.mean, rel=1e-3)
    assert section(s).note.text() == f"over {COUNT:,} vertices; geodesic, exact"
    assert section(s).truth.button.text() == "truth: same ids"


def test_another_pair_gives_other_curves_and_undo_those_of_before(two):
    s, before = two, numbers(two)
    s.session.show(add_pairs(s.document, [(40, 40)]))
    s.until(lambda: whole(s) and numbers(s) != before)
    curve = expected(s, BiharmonicDistance, [*PLACES, (40, 40)])
    assert section(s).named_curves()["Biharmonic"].mean == pytest.approx(curve.mean, abs=1e-6)
    s.session.undo()
    s.until(lambda: whole(s) and numbers(s) == before)


def test_a_stale_answer_is_dropped(two):
    s = two
    shown = section(s).errors
    old = section(s).asked
    s.session.show(add_pairs(s.document, [(40, 40), (20, 20)]))
    section(s)._background._arrive(old, "of other pairs")
    assert section(s).errors is shown
    s.until(lambda: whole(s) and section(s).errors is not shown)


def test_the_chart_says_the_shares_at_the_pointer(two):
    s, chart = two, section(two).chart
    at = chart.plot.center().toPoint()
    QtTest.QTest.mouseMove(chart, at)
    chart.pointed.emit(chart.values(QtCore.QPointF(at)))
    assert chart.at == pytest.approx(0.125, abs=0.005)
    share = section(s).named_curves()["Biharmonic"].fractions(chart.at)
    assert chart.lines[0].numbers == (f"{100 * share:.1f} %",)
    QtTest.QTest.keyClick(chart, QtCore.Qt.Key.Key_Right)
    QtTest.QTest.keyClick(chart, QtCore.Qt.Key.Key_Right, QtCore.Qt.KeyboardModifier.ShiftModifier)
    assert chart.at == pytest.approx(at_of(chart, at) + 11 * 0.0025)
    QtTest.QTest.keyClick(chart, QtCore.Qt.Key.Key_Escape)
    assert chart.at is None


def at_of(chart, at):
    return chart.values(QtCore.QPointF(at))[0]


def test_heads_have_dots_in_the_colours_of_the_curves(two):
    s = two
    colours = [curve.colour for curve in section(s).chart.curves]
    assert [panel.head._dot for panel in s.panels] == ["", *colours]
    s.window.actions_by_word["dock pairs"].trigger()
    assert [panel.head._dot for panel in s.panels] == ["", "", ""]


# ---------------------------------------------------------------------- the truth
def test_without_a_truth_the_section_says_so(make):
    s = make(grid(9, 7))
    s.session.show(add_pairs(s.document, [(3, 3), (60, 20)]))
    complete(s)
    assert section(s).truth.button.text() == "truth: not known"
    assert "same ids" in section(s).note.text()
    assert not section(s).chart.isVisible()
    assert not section(s).mirror.isEnabled()
    assert section(s).full.isEnabled()
    section(s).truth.button.menu().aboutToShow.emit()
    ids = next(action for action in section(s).truth.button.menu().actions() if action.text() == "Same ids")
    assert not ids.isEnabled()


def test_the_truth_of_a_file_counts_and_a_wrong_one_is_refused(two, tmp_path):
    s, before = two, numbers(two)
    truth = np.roll(np.arange(COUNT), 31)
    write_map(tmp_path / "right.txt", truth)
    section(s).truth.take(str(tmp_path / "right.txt"))
    s.until(lambda: whole(s) and numbers(s) != before)
    curve = expected(s, BiharmonicDistance, PLACES, truth)
    assert section(s).named_curves()["Biharmonic"].mean == pytest.approx(curve.mean, abs=1e-6)
    assert section(s).truth.button.text() == "truth: right"
    (tmp_path / "wrong.txt").write_text("1\n2\n")
    said = []
    s.window.context.failed.connect(said.append)
    section(s).truth.take(str(tmp_path / "wrong.txt"))
    assert "2 vertices" in said[0]
    assert section(s).truth.button.text() == "truth: right"
    s.session.undo()
    s.until(lambda: whole(s) and numbers(s) == before)


def test_symmetric_partners_count_when_ticked(two, tmp_path, monkeypatch):
    s, partners, asked = two, np.roll(np.arange(COUNT), COUNT // 2), []
    write_map(tmp_path / "half.npy", partners)
    # What is right is the partner of what is predicted.
    section(s).truth.take(str(tmp_path / "half.npy"))
    s.until(lambda: whole(s))
    before = numbers(s)
    monkeypatch.setattr(
        QtWidgets.QFileDialog, "getOpenFileName", lambda *a: asked.append(a) or (str(tmp_path / "half.npy"), "")
    )
    QtTest.QTest.mouseClick(section(s).mirror, LEFT, pos=QtCore.QPoint(8, section(s).mirror.height() // 2))
    assert len(asked) == 1
    s.until(lambda: whole(s) and numbers(s) != before)
    assert section(s).mirror.isChecked()
    curve = expected(s, BiharmonicDistance, PLACES, partners, partners)
    assert section(s).named_curves()["Biharmonic"].mean == pytest.approx(curve.mean, abs=1e-6)
    QtTest.QTest.mouseClick(section(s).mirror, LEFT, pos=QtCore.QPoint(8, section(s).mirror.height() // 2))
    s.until(lambda: whole(s) and numbers(s) == before)
    assert s.document[Maps].truth.partners is not None
    assert len(asked) == 1


def test_partners_that_nobody_names_do_not_count(two, monkeypatch):
    s = two
    monkeypatch.setattr(QtWidgets.QFileDialog, "getOpenFileName", lambda *a: ("", ""))
    QtTest.QTest.mouseClick(section(s).mirror, LEFT, pos=QtCore.QPoint(8, section(s).mirror.height() // 2))
    assert not section(s).mirror.isChecked()
    assert s.document[Maps].truth.partners is None


# ---------------------------------------------------------------------- the candidate
def judged(s):
    return parts(s.window).pairs.errors.found


def truth_in(panel):
    """(k, 3) where crosses are."""
    found = [each.position for each in panel.view.over.points.placed("pairs") if each.mark.glyph is CROSS]
    return np.array(found).reshape(-1, 3)


def test_the_truth_is_a_cross_and_the_candidate_says_how_far_it_is_off(two):
    s = two
    s.session.show(place_point(s.document, "A", 70))
    complete(s)
    s.until(lambda: judged(s) is not None and judged(s).errors)
    other = surfaces(s)[1]
    for panel in s.panels[1:]:
        assert np.array_equal(truth_in(panel), other.vertices[[70]])
        assert [row.text for row in panel.view.over.legend] == ["truth", "candidate"]
        field = panel.answer.field
        error = GeodesicDistance(other, "exact").between(70, int(field.argmin())) / np.sqrt(other.face_areas.sum())
        assert judged(s).errors[panel.id] == pytest.approx(error, abs=1e-6)
        asides = [each.mark.aside for each in panel.view.over.points.placed("pairs") if each.mark.glyph is CANDIDATE]
        assert asides == [f"{100 * error:.1f} % off"]
    assert len(truth_in(s.panels[0])) == 0
    s.session.undo()
    complete(s)
    assert not any(len(truth_in(panel)) for panel in s.panels)


def test_a_point_of_the_second_mesh_belongs_on_the_first(two, tmp_path):
    s = two
    write_map(tmp_path / "right.npy", np.roll(np.arange(COUNT), 31))
    section(s).truth.take(str(tmp_path / "right.npy"))
    s.session.show(place_point(s.document, "B", 70))
    complete(s)
    s.until(lambda: judged(s) is not None and judged(s).errors)
    assert judged(s).places == (101,)
    assert np.array_equal(truth_in(s.panels[0]), surfaces(s)[0].vertices[[101]])
    assert len(truth_in(s.panels[1])) == 0


# ---------------------------------------------------------------------- the full map
def test_the_full_map_is_shown_in_colours_and_saved(two, tmp_path):
    s = two
    QtTest.QTest.mouseClick(section(s).full, LEFT)
    complete(s)
    assert [str(panel.shows) for panel in s.document.panels] == [
        "position colours",
        "map by biharmonic",
        "map by geodesic",
    ]
    one, other = surfaces(s)
    found = Correspondence(BiharmonicDistance(one), BiharmonicDistance(other), PLACES).map()
    assert np.array_equal(s.panels[1].answer.leads_to, found)
    assert np.array_equal(s.panels[1].answer.colours, carried_back(position_colours(other), found))
    assert len(np.unique(s.pictures()[1].reshape(-1, 3), axis=0)) > 1000
    assert section(s).minimumSizeHint().width() <= WIDTH, "no wider than its dock, with the button to save maps"
    section(s).save.menu().aboutToShow.emit()
    assert len(section(s).save.menu().actions()) == 2
    write_map(tmp_path / "map.txt", section(s)._full_maps()[BIHARMONIC])
    assert np.array_equal(read_map(tmp_path / "map.txt", one, other), found)
    s.until(lambda: whole(s))
    QtTest.QTest.mouseClick(section(s).full, LEFT)
    complete(s)
    assert predicts(s.document)


def test_pointing_at_a_map_marks_where_it_leads(two):
    s = two
    QtTest.QTest.mouseClick(section(s).full, LEFT)
    complete(s)
    positions, full = s.panels[0], s.panels[1]
    vertex = 40
    s.window.grid.pointing.show(full.id, vertex)
    image = int(full.answer.leads_to[vertex])
    assert full.view.over.pointed.value == f"→ {image}"
    assert np.array_equal(positions.view.over.pointed.position, surfaces(s)[1].vertices[image])
    assert np.array_equal(s.panels[2].view.over.pointed.position, surfaces(s)[0].vertices[vertex])
    s.window.grid.pointing.show(positions.id, 7)
    assert full.view.over.pointed is None


def test_another_pair_makes_another_map(two):
    s = two
    QtTest.QTest.mouseClick(section(s).full, LEFT)
    complete(s)
    s.session.show(add_pairs(s.document, [(40, 40)]))
    complete(s)
    one, other = surfaces(s)
    found = Correspondence(BiharmonicDistance(one), BiharmonicDistance(other), [*PLACES, (40, 40)]).map()
    assert np.array_equal(s.panels[1].answer.leads_to, found)


def test_a_map_of_a_file_is_shown_and_judged(two, tmp_path):
    s = two
    ours = np.roll(np.arange(COUNT), 5)
    write_map(tmp_path / "ours.txt", ours)
    section(s).truth.take_map(str(tmp_path / "ours.txt"))
    complete(s)
    s.until(lambda: whole(s) and "ours" in numbers(s))
    assert s.document.panels[-1].shows == MapColours(str(tmp_path / "ours.txt"))
    assert np.array_equal(s.panels[-1].answer.leads_to, ours)
    curve = error_curve(map_errors(GeodesicDistance(surfaces(s)[1], "exact"), ours, np.arange(COUNT)))
    assert section(s).named_curves()["ours"].mean == pytest.approx(curve.mean, abs=1e-6)
    (tmp_path / "none.txt").write_text("no\n")
    said = []
    s.window.context.failed.connect(said.append)
    section(s).truth.take_map(str(tmp_path / "none.txt"))
    assert "no" in said[0]
    assert isinstance(s.document[Maps].maps[0], MapFile)


# ---------------------------------------------------------------------- kept
def test_a_session_of_it_is_the_same_again_and_drawn(two, tmp_path, screen):
    s = two
    write_map(tmp_path / "ours.txt", np.roll(np.arange(COUNT), 5))
    section(s).truth.take_map(str(tmp_path / "ours.txt"))
    complete(s)
    s.until(lambda: whole(s) and "ours" in numbers(s))
    path = tmp_path / "session.json"
    parts(s.window).session_file.save(str(path))
    recipe = read_recipe(path)
    document, loaded = open_document(recipe, ArrayStore())
    drawn = compute(document, loaded)
    for panel, answer in zip(s.panels, drawn, strict=True):
        assert np.array_equal(panel.answer.colours, answer.colours)
    again = screen((BIHARMONIC,))
    parts(again.window).session_file.open(str(path))
    again.until(lambda: again.session.loaded() is not None and again.session.is_complete)
    again.until(lambda: whole(again))
    assert again.document.panels == s.document.panels
    assert numbers(again) == numbers(s)


def test_the_curves_are_saved_as_numbers_and_as_a_figure(two, tmp_path, monkeypatch):
    import app.tools.correspondence.error_section as errors
    from app.qt.files.saving import written

    s = two
    monkeypatch.setattr(
        errors, "save", lambda window, title, name, formats, write: written(window, str(tmp_path / "e.csv"), write)
    )
    section(s).truth.save_numbers()
    assert (tmp_path / "e.csv").read_text().startswith("error,Biharmonic,Geodesic\n")
    section(s).truth.save_figure(str(tmp_path / "e.pdf"))
    s.until(lambda: (tmp_path / "e.pdf").exists())
    assert (tmp_path / "e.pdf").read_bytes().startswith(b"%PDF")


def test_over_how_many_vertices_is_said_while_they_are_judged(two, monkeypatch):
    s = two
    section(s).truth._choose(samples=100)
    s.until(lambda: whole(s) and section(s).errors.wanted == 100)
    assert section(s).note.text() == "over 100 sampled vertices; geodesic, exact"
    monkeypatch.setattr(map_errors_module, "ANSWER_INTERVAL_S", 0.0)
    section(s)._worker._kept = None
    shown = []
    section(s)._background.answered.connect(lambda asked, judged: shown.append(section(s).note.text()))
    section(s).truth._choose(samples=0)
    s.until(lambda: whole(s) and section(s).errors.wanted == COUNT)
    assert any(f" of {COUNT:,} vertices" in words for words in shown)
