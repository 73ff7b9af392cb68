"""Robustness in the window: the mesh changed by sliders, brush, picks and files, each distance before and after."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import add_panel
from app.document.file import read_recipe
from app.document.quantities import ChangeOf, quantity
from app.figures.export import compute, figure_of, open_document
from app.session.given import Given
from bihdist_core import BiharmonicDistance, GeodesicDistance, Surface, read_surface
from bihdist_core.analysis.diagnostics import field_change
from bihdist_core.applications.changes import Perturbation, count_of
from bihdist_core.applications.perturbation import perturbed
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore, QtGui, QtTest, QtWidgets

LEFT, KEYS = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.Key
KINDS = (BiharmonicDistance, GeodesicDistance)


@pytest.fixture
def opened(screen, mesh_file):
    s = screen((Spec.of("biharmonic"), Spec.of("geodesic", method="exact")))
    s.open(mesh_file(bumpy(400)))
    s.window.actions_by_word["dock robustness"].trigger()
    s.settle()
    return s


def dock_of(s):
    return s.window.docks._instrument("robustness")


def complete(s):
    s.until(lambda: not s.session.is_opening and s.session.is_complete and not s.session.progress)
    s.settle(0.05)


def type_in(s, box, text):
    box.setFocus()
    box.selectAll()
    QtTest.QTest.keyClicks(box, text)
    QtTest.QTest.keyClick(box, KEYS.Key_Return)
    s.settle(0.02)
    complete(s)


def press(s, widget):
    QtTest.QTest.mouseClick(widget, LEFT)
    s.settle(0.02)
    complete(s)


def change_of(s):
    return s.document.surfaces[1].change if len(s.document.surfaces) > 1 else None


def seen(s, panel=0):
    """A vertex near the middle of a panel's view, and where."""
    view = s.panels[panel].view
    at = QtCore.QPoint(view.width() // 2, view.height() // 2)
    return view.met_at(at).vertex, at


def check(s, expected):
    """The change is this, and the panels show it."""
    assert replace(change_of(s), pose_sha256="") == expected
    before = s.session.surface
    after, ids = perturbed(before, expected)
    assert np.array_equal(s.session.opened("B").surface.vertices, after.vertices)
    assert np.array_equal(s.session.opened("B").surface.faces, after.faces)
    start, there = s.document.point("source").at, s.document.point("source after").at
    assert ids[there] >= 0
    for row, kind in enumerate(KINDS):
        old, new = kind(before).from_source(start), kind(after).from_source(there)
        assert s.answers[3 * row].field == pytest.approx(old, rel=1e-9)
        assert s.answers[3 * row + 1].field == pytest.approx(new, rel=1e-9, nan_ok=True)
        assert isinstance(s.document.panels[3 * row + 2].shows, ChangeOf)
    return after, ids


def test_noise_is_typed_and_each_distance_is_shown_before_and_after_with_its_numbers(opened):
    s, dock = opened, dock_of(opened)
    before = s.document
    type_in(s, dock.noise.box, "0.3")
    after, ids = check(s, Perturbation(noise=0.3))
    s.until(lambda: len(dock.table.numbers) == 2)
    for name, kind in zip(("Biharmonic", "Geodesic"), KINDS, strict=True):
        old, new = (kind(x).from_source(s.source) for x in (s.session.surface, after))
        found, numbers = field_change(old[ids], new), dock.table.numbers[name]
        assert numbers.share_mean == pytest.approx(found.normalised_mean, rel=1e-9)
        assert numbers.share_largest == pytest.approx(found.normalised_largest, rel=1e-9)
        assert numbers.mean == pytest.approx(np.abs(new - old).mean(), rel=1e-9)
        assert numbers.largest == pytest.approx(np.abs(new - old).max(), rel=1e-9)
    assert dock.table.text().startswith("distance\tmean share")
    press(s, dock.along.buttons["normals"])
    check(s, Perturbation(noise=0.3, along="normals"))
    press(s, dock.another)
    check(s, Perturbation(noise=0.3, along="normals", seed=1))
    for _ in range(3):
        s.session.undo()
        complete(s)
    assert s.document.panels == before.panels
    assert s.document.surfaces == before.surfaces
    s.session.redo()
    complete(s)
    check(s, Perturbation(noise=0.3))
    assert dock.noise.box.text() == "0.3"


def test_before_and_after_have_one_range(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.noise.box, "1")
    for first in (0, 3):
        tops = [s.panels[first + k].view.scene.maximum for k in (0, 1)]
        largest = max(s.answers[first + k].maximum for k in (0, 1))
        assert tops == pytest.approx([largest, largest])
        assert s.answers[first].maximum != pytest.approx(s.answers[first + 1].maximum)


def test_a_slider_is_followed_and_is_one_step(opened):
    s, slider = opened, dock_of(opened).noise.slider
    steps = []
    slider.setSliderDown(True)
    for step in range(40, 160, 4):
        slider.setValue(step)
        s.settle(0.03)
        steps.append(change_of(s))
    slider.setSliderDown(False)
    s.settle(0.1)
    complete(s)
    assert len(set(steps)) > 2  # it was followed on its way
    check(s, Perturbation(noise=dock_of(s).noise.value))
    s.session.undo()
    complete(s)
    assert change_of(s) is None
    assert [panel.shows for panel in s.document.panels] == [
        quantity(w) for w in ("biharmonic", "geodesic(method=exact)")
    ]


def test_a_mesh_is_never_seen_without_its_fields_while_a_slider_moves(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.noise.box, "0.2")
    bare = []
    changed = s.window.document_changed

    def note(before):
        changed(before)
        QtCore.QTimer.singleShot(0, lambda: bare.append([panel.answer is None for panel in s.panels]))

    s.window.document_changed = note
    dock.noise.slider.setValue(120)
    s.settle(0.1)
    complete(s)
    assert bare
    assert not any(any(each) for each in bare)


def test_simplified_to_a_count_and_whole_again(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.vertices.box, "250")
    check(s, Perturbation(simplify=250))
    type_in(s, dock.vertices.box, "3")
    assert dock.vertices.box.property("wrong")
    assert change_of(s) == Perturbation(simplify=250)
    type_in(s, dock.vertices.box, "400")
    assert change_of(s) is None


def test_holes_by_chance_are_of_the_seed(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.holes.box, "1")
    assert "larger radius" in s.refusals[-1]  # as small as the faces
    assert dock.holes.box.text() == "0"
    type_in(s, dock.radius.box, "0.2")
    assert change_of(s) is None  # a radius alone makes no hole
    type_in(s, dock.holes.box, "2")
    first, _ = check(s, Perturbation(holes=2, radius=0.2))
    press(s, dock.another)
    second, _ = check(s, Perturbation(holes=2, radius=0.2, seed=1))
    assert not np.array_equal(first.faces, second.faces)
    type_in(s, dock.holes.box, "1.5")
    assert dock.holes.box.property("wrong")


def move(view, place, keys=QtCore.Qt.KeyboardModifier.NoModifier):
    event = QtGui.QMouseEvent(QtCore.QEvent.Type.MouseMove, QtCore.QPointF(place), LEFT, LEFT, keys)
    QtWidgets.QApplication.sendEvent(view, event)


def stroke(s, panel, start, stop):
    view = s.panels[panel].view
    QtTest.QTest.mousePress(view, LEFT, pos=start)
    for k in range(1, 6):
        move(view, start + (stop - start) * k / 5)
    s.settle(0.1)
    QtTest.QTest.mouseRelease(view, LEFT, pos=stop)
    s.settle(0.1)
    complete(s)


def test_faces_are_cut_out_by_brush_and_come_back(opened, monkeypatch):
    s, dock = opened, dock_of(opened)
    press(s, dock.cut.button)
    assert s.window.docks.brushing.cuts
    s.until(lambda: s.window.docks.brushing._brush is not None)
    _, middle = seen(s)
    stroke(s, 0, middle, middle + QtCore.QPoint(40, 0))
    cut = change_of(s).cut
    assert count_of(cut) > 2
    check(s, Perturbation(cut=cut))
    _, middle = seen(s, 3)
    stroke(s, 3, middle + QtCore.QPoint(0, 30), middle + QtCore.QPoint(30, 30))
    more = change_of(s).cut
    assert count_of(more) > count_of(cut)
    assert dock.cut.said.text() == f"{count_of(more)} faces"
    ctrl = QtCore.Qt.KeyboardModifier.ControlModifier
    monkeypatch.setattr(QtWidgets.QApplication, "keyboardModifiers", staticmethod(lambda: ctrl))
    stroke(s, 3, middle + QtCore.QPoint(0, 30), middle + QtCore.QPoint(30, 30))
    assert count_of(change_of(s).cut) < count_of(more)
    monkeypatch.undo()
    assert not s.document.selections
    s.window.actions_by_word["stop"].trigger()  # Esc
    assert not s.window.docks.brushing.cuts
    press(s, dock.cut.cross)
    assert change_of(s) is None


def test_two_places_are_picked_for_a_handle_and_a_weld(opened):
    s, dock = opened, dock_of(opened)
    view = s.panels[0].view
    places = [QtCore.QPoint(round(x * view.width()), view.height() // 2) for x in (0.3, 0.7)]
    vertices = [view.met_at(at).vertex for at in places]
    source = s.source
    for word, row in (("handle", dock.handle), ("weld", dock.weld)):
        press(s, row.button)
        view = s.panels[0].view
        places = [
            QtCore.QPoint(*map(round, (p.x(), p.y())))
            for p in map(s.panels[0].view.place_of, s.session.surface.vertices[vertices])
        ]
        for at in places:
            assert s.window.docks.picking.is_on
            QtTest.QTest.mouseClick(view, LEFT, pos=at)
            s.settle(0.05)
        complete(s)
        pair = getattr(change_of(s), word)
        assert len(set(pair)) == 2
        assert s.source == source  # a pick moves no source
        check(s, replace(Perturbation(), **{word: pair}))
        assert len(s.panels[0].view.over.ends) == 2
        press(s, row.cross)
        assert change_of(s) is None
    press(s, dock.weld.button)
    s.window.actions_by_word["stop"].trigger()  # Esc
    assert not s.window.docks.picking.is_on
    assert not dock.weld.button.isChecked()


def test_another_pose_is_read_and_what_is_none_is_refused(opened, mesh_file):
    s, dock = opened, dock_of(opened)
    ball = bumpy(400)
    pose = mesh_file(Surface(ball.vertices * (1, 1.4, 0.7), ball.faces), "pose.off")
    dock.take_pose(pose)
    complete(s)
    check(s, Perturbation(pose=pose))
    assert change_of(s).pose_sha256
    assert dock.pose.said.text() == "pose.off"
    dock.take_pose(mesh_file(bumpy(300), "other.off"))
    s.until(lambda: s.refusals)
    assert "300 vertices" in s.refusals[0]
    complete(s)
    assert change_of(s).pose == pose
    assert dock.settings.pose == pose
    press(s, dock.pose.cross)
    assert change_of(s) is None


def test_the_changed_mesh_is_saved(opened, tmp_path, monkeypatch):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.noise.box, "0.3")
    path = str(tmp_path / "changed.off")
    monkeypatch.setattr("app.qt.docks.saving.ask_path", lambda *_: path)
    press(s, dock.save_button)
    there = read_surface(path)
    assert np.array_equal(there.vertices, s.session.opened("B").surface.vertices)
    assert np.array_equal(there.faces, s.session.opened("B").surface.faces)


def test_a_session_of_it_is_opened_again_and_drawn(opened, tmp_path, mesh_file):
    s, dock = opened, dock_of(opened)
    ball = bumpy(400)
    dock.take_pose(mesh_file(Surface(ball.vertices * (1, 1.4, 0.7), ball.faces), "pose.off"))
    complete(s)
    type_in(s, dock.noise.box, "0.1")
    path, fields = tmp_path / "session.json", [answer.field for answer in s.answers]
    s.window.session_file.save(str(path))
    press(s, dock.remove_button)
    assert change_of(s) is None
    s.window.session_file.open(str(path))
    complete(s)
    assert "robustness" in s.document.docks
    assert change_of(s).noise == 0.1
    for answer, field in zip(s.answers, fields, strict=True):
        assert answer.field == pytest.approx(field, nan_ok=True)
    recipe = read_recipe(str(path))
    document, surfaces = open_document(recipe, Given())
    answers = compute(document, surfaces)
    figure = figure_of(replace(recipe, document=document), surfaces, answers)
    assert figure.columns == 3
    assert figure.panels[0].maximum == figure.panels[1].maximum == max(a.maximum for a in answers[:2])
    assert "pose of pose.off, noise of 0.1 edges" in figure.panels[1].heading


def test_closing_the_dock_brings_the_old_panels_back(opened):
    s, dock = opened, dock_of(opened)
    s.session.show(add_panel(s.document, quantity("biharmonic - geodesic")))
    complete(s)
    before = s.document
    type_in(s, dock.noise.box, "1")
    assert len(s.document.panels) == 7
    assert s.document.panels[-1].shows == before.panels[-1].shows
    s.window.actions_by_word["dock robustness"].trigger()
    complete(s)
    assert s.document.panels == before.panels
    assert not s.document.docks
    s.session.undo()
    complete(s)
    assert change_of(s).noise == 1


def test_other_distances_are_shown_in_the_whole_row(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.noise.box, "0.3")
    s.window.gestures.choose(s.document.panels[1].id, quantity("commute-time", "source after"))
    complete(s)
    words = [str(panel.shows) for panel in s.document.panels]
    assert words[:3] == ["commute-time", "commute-time", "change of commute-time"]
    assert words[3] == "geodesic(method=exact)"
    s.window.choices.add_panel()
    complete(s)
    assert len(s.document.panels) == 9
    assert [name for name, _ in dock.table.rows][:2] == ["Commute-time", "Geodesic"]


def test_a_place_is_pointed_at_on_both_and_a_source_moves_on_both(opened):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.vertices.box, "250")
    ids = s.session.opened("B").ids
    vertex, at = seen(s, 1)
    s.window.grid.pointing.show(s.panels[1].id, vertex)
    position = s.panels[0].view.over.pointed.position
    assert np.array_equal(position, s.session.surface.vertices[ids[vertex]])
    QtTest.QTest.mouseClick(s.panels[1].view, LEFT, pos=at)
    complete(s)
    assert (s.document.point("source").at, s.document.point("source after").at) == (ids[vertex], vertex)


def test_a_second_mesh_has_to_go_first(opened, mesh_file):
    s, dock = opened, dock_of(opened)
    s.session.open_beside(mesh_file(bumpy(300), "second.off"))
    s.until(lambda: len(s.document.surfaces) == 2 and not s.session.is_opening)
    complete(s)
    assert not dock.noise.isEnabled()
    assert "Close the mesh beside first" in dock.hint.text()
    s.session.close_beside()
    complete(s)
    assert dock.noise.isEnabled()
    type_in(s, dock.noise.box, "0.3")
    s.session.open_beside(mesh_file(bumpy(300), "second.off"))
    s.until(lambda: change_of(s) is None and not s.session.is_opening)
    complete(s)
    assert [panel.surface for panel in s.document.panels] == ["A", "A", "B", "B"]


def test_what_is_stopped_is_not_set(opened):
    s, dock = opened, dock_of(opened)
    dock.noise.chosen.emit(0.7, True)  # the slider is on its way
    assert dock.settings.noise == 0.7
    s.window.cancel()
    s.settle(0.2)
    complete(s)
    assert change_of(s) is None
    assert dock.settings.noise == 0
    assert dock.noise.box.text() == "0"


def test_the_wheel_scrolls_the_dock_and_changes_nothing(opened):
    s, dock = opened, dock_of(opened)
    for widget in (dock.noise.slider, dock.seed):
        widget.clearFocus()
        middle = widget.rect().center()
        event = QtGui.QWheelEvent(
            QtCore.QPointF(middle), QtCore.QPointF(widget.mapToGlobal(middle)), QtCore.QPoint(), QtCore.QPoint(0, 120),
            QtCore.Qt.MouseButtons(), QtCore.Qt.KeyboardModifier.NoModifier, QtCore.Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QtWidgets.QApplication.sendEvent(widget, event)
    complete(s)
    assert (dock.noise.value, dock.seed.value()) == (0, 0)
    assert change_of(s) is None


def test_another_mesh_ends_it(opened, mesh_file):
    s, dock = opened, dock_of(opened)
    type_in(s, dock.noise.box, "0.3")
    s.open(mesh_file(bumpy(300), "other.off"))
    complete(s)
    assert len(s.document.surfaces) == 1
    assert dock.settings.changes_nothing
