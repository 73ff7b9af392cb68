"""Sources of all kinds in the window: typed, clicked and dragged, as places and sets, kept with sessions."""

import json

import numpy as np
import pytest

from bihdist_core import SourceSet, SurfacePoint
from bihdist_core.distances import distance_types
from tests.shapes import bumpy, grid

pytest.importorskip("qtpy")

from app.document.shared_parts.pins import Pins
from tests.qt.parts import parts
from tests.tools.source.sourcing import check_fields, click, ctrl_click, drag, typed, where


@pytest.fixture
def loaded(shared_screen):
    return shared_screen(bumpy(2000))


@pytest.fixture
def sheet(shared_screen):
    """A flat square, which has a boundary."""
    return shared_screen(grid(12, 12), source=84)


# ---------------------------------------------------------------------- words
@pytest.mark.parametrize("words", ["12", "12+40+7", "f31:0.25,0.5", "loop:0", "7+loop:0", "CURVE"])
def test_all_words_of_sources_can_be_typed(sheet, tmp_path, words, capsys):
    s = sheet
    if words == "CURVE":
        path = tmp_path / "c.json"
        path.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25]]}))
        words = str(path)
    typed(s, words)
    assert not parts(s.window).typed_source.box.wrong.isVisible()
    check_fields(s, words, tmp_path)
    shown = parts(s.window).typed_source.box.text()
    assert shown == (words if not words.endswith(".json") else "a curve of 2 points")
    s.session.undo()
    assert s.source == 84
    assert parts(s.window).typed_source.box.text() == "84"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("f31", "a place in a face has two weights"),
        ("f999:0.2,0.2", "has no face 999"),
        ("loop:3", "its only one is loop:0"),
        ("12+9999", "9999"),
        ("missing.json", "cannot be read"),
        ("banana", "is not a source"),
    ],
)
def test_words_of_no_source_are_refused_under_the_box(sheet, words, said):
    s = sheet
    typed(s, words)
    assert parts(s.window).typed_source.box.wrong.isVisible()
    assert said in parts(s.window).typed_source.box.wrong.text()
    assert s.source == 84


def test_a_short_sentence_after_a_long_one_has_a_low_box(sheet):
    box = parts(sheet.window).typed_source.box
    typed(sheet, "9999")
    low = box.wrong.height()
    typed(sheet, "banana")
    assert box.wrong.height() > low
    typed(sheet, "9999")
    assert box.wrong.height() == low


# ---------------------------------------------------------------------- places
def test_without_snapping_a_click_puts_the_source_into_the_face(loaded, tmp_path):
    from qtpy import QtCore

    s, view = loaded, loaded.panels[0].view
    s.window.actions_by_word["snap"].trigger()
    place = view.rect().center()
    hit = view.pick(place)
    click(s, place)
    at = s.source
    assert isinstance(at, SurfacePoint)
    assert at.face == hit.face
    assert np.abs(np.array(at.weights) - hit.weights).max() <= 1e-4
    check_fields(s, parts(s.window).typed_source.box.text(), tmp_path)
    corners = s.session.mesh().surface.faces[at.face]
    position = np.array(at.weights) @ s.session.mesh().surface.vertices[corners]
    for panel in s.panels:
        assert np.allclose(panel.view.handles[0], position), "its mark is there on all panels"
    s.window.actions_by_word["snap"].trigger()
    place += QtCore.QPoint(90, 0)
    click(s, place)
    assert s.source == view.pick(place).vertex


def test_without_snapping_the_mark_is_dragged_through_faces_and_is_exact_at_the_end(loaded, tmp_path, monkeypatch):
    from qtpy import QtCore

    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 0)  # as on a large mesh
    s, view = loaded, loaded.panels[1].view
    s.window.actions_by_word["snap"].trigger()
    start = view.rect().center()
    click(s, start, 1)
    before, labels, rates = s.source, [], []
    tell, rate = s.window.answer_changed, s.window.status.show_rate
    s.window.answer_changed = lambda id: (labels.append(s.session.shown[1].answer.label), tell(id))
    s.window.status.show_rate = lambda text: (rates.append(text), rate(text))
    drag(s, [start + QtCore.QPoint(4 * k, k) for k in range(30)], 1)
    assert "geodesic, approximate" in labels
    assert s.answers[1].label.startswith("geodesic, exact")
    assert any("fields a second" in text and "geodesic, approximate" in text for text in rates)
    assert rates[-1] == "", "nothing is said once it rests"
    assert isinstance(s.source, SurfacePoint)
    seen = view.place_of(view.handles[0]) - QtCore.QPointF(start + QtCore.QPoint(116, 29))
    assert abs(seen.x()) < 1.5
    assert abs(seen.y()) < 1.5
    check_fields(s, parts(s.window).typed_source.box.text(), tmp_path)
    s.session.undo()
    assert s.source == before, "the drag is one step"


# ---------------------------------------------------------------------- sets
def test_ctrl_click_makes_a_set_and_takes_from_it_and_undo_goes_back(loaded, tmp_path):
    from qtpy import QtCore

    s, view = loaded, loaded.panels[0].view
    middle = view.rect().center()
    first = view.pick(middle).vertex
    click(s, where(s, first))
    others = [view.pick(middle + QtCore.QPoint(*by)).vertex for by in ((70, 0), (0, 60))]
    for other in others:
        ctrl_click(s, where(s, other))
    assert s.source == SourceSet((first, *others))
    assert parts(s.window).typed_source.box.text() == "+".join(map(str, (first, *others)))
    check_fields(s, parts(s.window).typed_source.box.text(), tmp_path)
    assert len(view.handles) == 3
    ctrl_click(s, where(s, first))
    assert s.source == SourceSet(tuple(others))
    assert s.window.status.message.text.startswith("Source: ")
    s.session.undo()
    assert s.window.status.message.text == "", "what was said of it is no longer so"
    s.session.undo()
    assert s.source == SourceSet((first, others[0]))
    s.session.undo()
    assert s.source == first
    ctrl_click(s, where(s, first))
    assert s.source == first, "the last one stays"


def test_a_member_of_a_set_is_dragged_alone(loaded):
    from qtpy import QtCore

    s, view = loaded, loaded.panels[0].view
    middle = view.rect().center()
    one, two = (view.pick(middle + QtCore.QPoint(x, 0)).vertex for x in (0, 80))
    click(s, where(s, one))
    ctrl_click(s, where(s, two))
    start = where(s, two)
    drag(s, [start + QtCore.QPoint(0, 4 * k) for k in range(15)])
    members = s.source.members
    assert len(members) == 2
    assert members[0] == one
    assert members[1] not in (one, two)
    s.session.undo()
    assert s.source == SourceSet((one, two))


def test_the_walk_goes_through_sources_of_all_kinds_and_leaves_pins_alone(loaded):
    from app.document.shared_parts.pins import add_pins

    s = loaded
    for words in ("12+40", "f31:0.25,0.5"):
        typed(s, words)
    s.session.show(add_pins(s.document, [7]))
    s.window.actions_by_word["source before"].trigger()
    assert s.source == SourceSet((12, 40))
    s.window.actions_by_word["source before"].trigger()
    assert s.source == 5
    assert len(s.document[Pins].pins) == 1
    s.window.actions_by_word["source after"].trigger()
    assert s.source == SourceSet((12, 40))


def test_undo_redo_and_the_walk_go_through_all_kinds(sheet, tmp_path):
    s, do = sheet, sheet.window.actions_by_word
    path = tmp_path / "c.json"
    path.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25]]}))
    passed, texts = [s.source], ["84"]
    for words in ("12+40", "f31:0.25,0.5", "loop:0", str(path), f"7+{path}"):
        typed(s, words)
        passed.append(s.source)
        texts.append(parts(s.window).typed_source.box.text())
    assert len(set(passed)) == 6
    for back, on in (("undo", "redo"), ("source before", "source after")):
        for word, order in ((back, range(4, -1, -1)), (on, range(1, 6))):
            for k in order:
                do[word].trigger()
                s.until(lambda: s.session.is_complete)
                assert s.source == passed[k]
                assert parts(s.window).typed_source.box.text() == texts[k]
    assert s.refusals == []


def test_snapping_is_remembered_and_kept_with_a_session(application, screen, mesh_file, tmp_path, monkeypatch):
    from qtpy import QtTest

    from app.document.document import comparison
    from app.qt import preferences, remembered, start

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path)
    s = screen()
    s.window.context.remembers = True
    s.open(mesh_file(bumpy(400)), 5)
    s.activate()
    s.settle()
    snaps = s.window.actions_by_word["snap"]
    QtTest.QTest.keyClicks(s.panels[0].view, "v")
    assert not snaps.isChecked()
    assert not preferences.load().snap
    assert not s.session.can_undo, "it is no step"
    path = str(tmp_path / "s.json")
    parts(s.window).session_file.save(path)
    QtTest.QTest.keyClicks(s.panels[0].view, "v")
    assert snaps.isChecked()
    assert preferences.load().snap
    typed(s, "7")
    s.session.undo()
    assert snaps.isChecked(), "undo leaves it as it is"
    parts(s.window).files.open(path)
    s.until(lambda: s.session.is_complete and not snaps.isChecked())
    click(s, s.panels[0].view.rect().center())
    assert isinstance(s.source, SurfacePoint)
    s.window.context.remembers = False
    new = start.as_preferred(comparison(""), preferences.Preferences(snap=False))
    assert not new.snap


def test_all_kinds_come_back_with_a_session(sheet, tmp_path):
    s = sheet
    curve = tmp_path / "c.json"
    curve.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25], [60, 0.1, 0.2]], "closed": True}))
    kinds = ["12+40", "f31:0.25,0.5", "loop:0", str(curve), f"7+loop:0+{curve}"]
    for number, words in enumerate(kinds):
        typed(s, words)
        path = str(tmp_path / f"{number}-session.json")
        parts(s.window).session_file.save(path)
        before, fields = s.source, [answer.field for answer in s.answers]
        text = parts(s.window).typed_source.box.text()
        typed(s, "3")
        parts(s.window).files.open(path)
        s.until(lambda before=before: s.session.is_complete and s.source == before)
        assert parts(s.window).typed_source.box.text() == text
        for field, answer in zip(fields, s.answers, strict=True):
            assert np.array_equal(field, answer.field)
