"""Robustness in the window: the mesh changed by sliders, each distance before and after."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import add_panel
from app.document.file import read_recipe
from app.document.quantities import quantity
from app.figures.export import compute, figure_of, open_document
from app.session.array_store import ArrayStore
from bihdist_core import BiharmonicDistance, GeodesicDistance, Surface, read_surface
from bihdist_core.analysis.diagnostics import field_change
from bihdist_core.applications.changes import Perturbation
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore, QtGui, QtTest, QtWidgets

from app.tools.robustness.table import three_digits
from tests.qt.parts import parts
from tests.tools.robustness.changing import change_of, check, complete, dock_of, open_it, press, seen, type_in

LEFT, KEYS = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.Key
KINDS = (BiharmonicDistance, GeodesicDistance)


@pytest.fixture
def loaded(shared_screen):
    return open_it(shared_screen)


def test_noise_is_typed_and_each_distance_is_shown_before_and_after_with_its_numbers(loaded):
    s, dock = loaded, dock_of(loaded)
    before = s.document
    type_in(s, dock.noise.box, "0.3")
    after, ids = check(s, Perturbation(noise=0.3))
    s.until(lambda: len(dock.table.numbers) == 2)
    for name, kind in zip(("Biharmonic", "Geodesic"), KINDS, strict=True):
        old, new = (kind(x).from_source(s.source) for x in (s.session.mesh().surface, after))
        found, numbers = field_change(old[ids], new), dock.table.numbers[name]
        assert numbers.share_mean == pytest.approx(found.normalised_mean, rel=1e-9)
        assert numbers.share_largest == pytest.approx(found.normalised_largest, rel=1e-9)
        assert numbers.mean == pytest.approx(np.abs(new - old).mean(), rel=1e-9)
        assert numbers.largest == pytest.approx(np.abs(new - old).max(), rel=1e-9)
    assert dock.table.text().startswith("distance\tmean fraction")
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


def test_before_and_after_have_one_range(loaded):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.noise.box, "1")
    for first in (0, 3):
        tops = [s.panels[first + k].view.scene.field_actor.maximum for k in (0, 1)]
        largest = max(s.answers[first + k].maximum for k in (0, 1))
        assert tops == pytest.approx([largest, largest])
        assert s.answers[first].maximum != pytest.approx(s.answers[first + 1].maximum)


def test_a_slider_is_followed_and_is_one_step(loaded):
    s, slider = loaded, dock_of(loaded).noise.slider
    slider.setSliderDown(True)
    for step in (40, 90, 156):  # it is followed on its way
        before = change_of(s)
        slider.setValue(step)
        s.until(lambda before=before: change_of(s) not in (None, before))
    slider.setSliderDown(False)
    s.settle(0.1)
    complete(s)
    check(s, Perturbation(noise=dock_of(s).noise.value))
    s.session.undo()
    complete(s)
    assert change_of(s) is None
    assert [panel.shows for panel in s.document.panels] == [
        quantity(w) for w in ("biharmonic", "geodesic(method=exact)")
    ]


def test_a_mesh_is_never_seen_without_its_fields_while_a_slider_moves(loaded):
    s, dock = loaded, dock_of(loaded)
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


def test_simplified_to_a_count_and_whole_again(loaded):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.vertices.box, "250")
    check(s, Perturbation(simplify=250))
    type_in(s, dock.vertices.box, "3")
    assert dock.vertices.box.property("wrong")
    assert change_of(s) == Perturbation(simplify=250)
    type_in(s, dock.vertices.box, "400")
    assert change_of(s) is None


def test_holes_by_chance_are_of_the_seed(loaded):
    s, dock = loaded, dock_of(loaded)
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


def test_the_changed_mesh_is_saved(loaded, tmp_path, monkeypatch):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.noise.box, "0.3")
    path = str(tmp_path / "changed.off")
    monkeypatch.setattr("app.qt.files.saving.ask_path", lambda *_: path)
    press(s, dock.save_button)
    there = read_surface(path)
    assert np.array_equal(there.vertices, s.session.loaded("B").surface.vertices)
    assert np.array_equal(there.faces, s.session.loaded("B").surface.faces)


def test_a_session_of_it_is_opened_again_and_drawn(loaded, tmp_path, mesh_file):
    s, dock = loaded, dock_of(loaded)
    ball = bumpy(400)
    dock.take_pose(mesh_file(Surface(ball.vertices * (1, 1.4, 0.7), ball.faces), "pose.off"))
    complete(s)
    type_in(s, dock.noise.box, "0.1")
    path, fields = tmp_path / "session.json", [answer.field for answer in s.answers]
    parts(s.window).session_file.save(str(path))
    press(s, dock.remove_button)
    assert change_of(s) is None
    parts(s.window).session_file.open(str(path))
    complete(s)
    assert "robustness" in s.document.docks
    assert change_of(s).noise == 0.1
    for answer, field in zip(s.answers, fields, strict=True):
        assert answer.field == pytest.approx(field, nan_ok=True)
    recipe = read_recipe(str(path))
    document, surfaces = open_document(recipe, ArrayStore())
    answers = compute(document, surfaces)
    figure = figure_of(replace(recipe, document=document), surfaces, answers)
    assert figure.columns == 3
    assert figure.panels[0].maximum == figure.panels[1].maximum == max(a.maximum for a in answers[:2])
    assert "pose of pose.off, noise of 0.1 edges" in figure.panels[1].heading


def test_closing_the_dock_brings_the_old_panels_back(loaded):
    s, dock = loaded, dock_of(loaded)
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


def test_other_distances_are_shown_in_the_whole_row(loaded):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.noise.box, "0.3")
    parts(s.window).choices.choose(s.document.panels[1].id, quantity("commute-time", "source after"))
    complete(s)
    words = [str(panel.shows) for panel in s.document.panels]
    assert words[:3] == ["commute-time", "commute-time", "change of commute-time"]
    assert words[3] == "geodesic(method=exact)"
    parts(s.window).choices.add_panel()
    complete(s)
    assert len(s.document.panels) == 9
    assert [name for name, *_ in dock.table.facts][:2] == ["Commute-time", "Geodesic"]


def test_a_place_is_pointed_at_on_both_and_a_source_moves_on_both(loaded):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.vertices.box, "250")
    ids = s.session.loaded("B").ids
    vertex, at = seen(s, 1)
    s.window.grid.pointing.show(s.panels[1].id, vertex)
    position = s.panels[0].view.over.pointed.position
    assert np.array_equal(position, s.session.mesh().surface.vertices[ids[vertex]])
    QtTest.QTest.mouseClick(s.panels[1].view, LEFT, pos=at)
    complete(s)
    assert (s.document.point("source").at, s.document.point("source after").at) == (ids[vertex], vertex)


def test_a_second_mesh_has_to_go_first(loaded, mesh_file):
    s, dock = loaded, dock_of(loaded)
    s.session.open_second_mesh(mesh_file(bumpy(300), "second.off"))
    s.until(lambda: len(s.document.surfaces) == 2 and not s.session.is_opening)
    complete(s)
    assert not dock.noise.isEnabled()
    assert "Close the second mesh first" in dock.hint.text()
    assert dock.close_second.isVisible()
    dock.close_second.click()
    complete(s)
    assert len(s.document.surfaces) == 1
    assert dock.noise.isEnabled()
    assert not dock.close_second.isVisible()
    type_in(s, dock.noise.box, "0.3")
    s.session.open_second_mesh(mesh_file(bumpy(300), "second.off"))
    s.until(lambda: change_of(s) is None and not s.session.is_opening)
    complete(s)
    assert [panel.surface for panel in s.document.panels] == ["A", "A", "B", "B"]


def test_what_is_stopped_is_not_set(loaded):
    s, dock = loaded, dock_of(loaded)
    dock.noise.valued.emit(0.7, True)  # the slider is on its way
    assert dock.settings.noise == 0.7
    s.window.context.actions["stop"].trigger()
    s.settle(0.2)
    complete(s)
    assert change_of(s) is None
    assert dock.settings.noise == 0
    assert dock.noise.box.text() == "0"


def test_the_wheel_scrolls_the_dock_and_changes_nothing(loaded):
    s, dock = loaded, dock_of(loaded)
    for widget in (dock.noise.slider, dock.seed):
        widget.clearFocus()
        middle = widget.rect().center()
        event = QtGui.QWheelEvent(
            QtCore.QPointF(middle), QtCore.QPointF(widget.mapToGlobal(middle)), QtCore.QPoint(), QtCore.QPoint(0, 120),
            QtCore.Qt.MouseButton.NoButton, QtCore.Qt.KeyboardModifier.NoModifier,
            QtCore.Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QtWidgets.QApplication.sendEvent(widget, event)
    complete(s)
    assert (dock.noise.value, dock.seed.value()) == (0, 0)
    assert change_of(s) is None


def test_another_mesh_ends_it(loaded, mesh_file):
    s, dock = loaded, dock_of(loaded)
    type_in(s, dock.noise.box, "0.3")
    s.open(mesh_file(bumpy(300), "other.off"))
    complete(s)
    assert len(s.document.surfaces) == 1
    assert dock.settings.changes_nothing


def test_a_narrow_head_of_a_change_names_its_distance(loaded):
    s = loaded
    type_in(s, dock_of(s).noise.box, "0.1")
    head = s.panels[2].head
    assert head.name.text() == "Change of biharmonic"
    head.resize(150, head.height())
    assert head.name.text() == "Δ biharmonic"


@pytest.mark.parametrize(
    ("value", "words"),
    [(0, "0"), (0.0204, "0.0204"), (0.049, "0.0490"), (1, "1.00"), (999.4, "999"), (999.6, "999.6"), (1234, "1,234")],
)
def test_numbers_of_the_table_keep_their_zeros_and_have_no_power_of_ten(value, words):
    assert three_digits(value) == words
