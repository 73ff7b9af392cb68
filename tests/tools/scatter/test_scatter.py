"""One panel's field against another's in the window: numbers, the lasso, the brush, and what becomes of selections."""

import shutil
import time

import numpy as np
import pytest

from app.document.file import read_recipe, recipe_text
from app.document.page import Page, Recipe
from app.document.runs import ids_of
from app.document.shared_parts.selections import Selections
from app.tools.scatter.part import Scatter
from bihdist_core import field_agreement
from bihdist_core.distances.distance_types import Spec
from tests.qt.events import send_mouse
from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")


@pytest.fixture
def loaded(shared_screen):
    s = shared_screen(bumpy(2000), [Spec.of("biharmonic"), Spec.of("diffusion")], 5, (1200, 900))
    s.window.move(20, 40)
    s.window.actions_by_word["dock scatter"].trigger()
    s.dock = parts(s.window).docks._docks["scatter"].content
    s.until(lambda: len(s.dock.facts.facts) > 3)
    s.settle(0.3)
    return s


def lasso(s, corners, keys=None):
    """With the mouse, through places given as shares of the plot from its left top corner."""
    from qtpy import QtCore

    chart, plot = s.dock.chart, s.dock.chart.plot
    left, none = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.MouseButton.NoButton
    keys = QtCore.Qt.KeyboardModifier.NoModifier if keys is None else keys
    kinds = QtCore.QEvent.Type
    places = [QtCore.QPointF(plot.left() + x * plot.width(), plot.top() + y * plot.height()) for x, y in corners]
    steps = [(kinds.MouseButtonPress, places[0], left, left)]
    steps += [(kinds.MouseMove, place, none, left) for place in places[1:]]
    steps += [(kinds.MouseButtonRelease, places[-1], left, none)]
    for kind, place, button, buttons in steps:
        send_mouse(chart, place.toPoint(), button, buttons, keys, kind)
    s.settle(0.1)
    return [(p.x(), p.y()) for p in (place.toPoint() for place in places)]


def selected(s, name):
    return ids_of(next(each.runs for each in s.document[Selections].selections if each.name == name))


def test_the_numbers_are_those_of_python(loaded):
    s = loaded
    a, b = (answer.field for answer in s.answers)
    found = field_agreement(s.session.mesh().surface, a, b, normalised=True)
    facts = dict(s.dock.facts.facts)
    assert facts["rank correlation"] == f"{found.spearman:.4f}"
    assert facts["mean deviation, by area"] == f"{100 * found.mean:.1f} %"
    sign = "+" if a[found.largest_at] / a.max() > b[found.largest_at] / b.max() else "−"
    assert facts[f"largest, at vertex {found.largest_at}"] == f"{sign}{100 * found.largest:.1f} %"
    assert np.array_equal(s.dock.chart.scatter.x, a / a.max())


def test_a_lasso_selects_what_lies_in_it_on_all_panels_and_is_undone(loaded):
    from qtpy import QtCore

    s, chart = loaded, loaded.dock.chart
    before = s.pictures()
    # The right half of the plot.
    lasso(s, [(0.5, -0.02), (1.02, -0.02), (1.02, 1.02), (0.5, 1.02)])
    (selection,) = s.document[Selections].selections
    a = s.answers[0].field
    edge = chart.values(QtCore.QPointF(round(chart.plot.left() + 0.5 * chart.plot.width()), 0))[0]
    right = np.flatnonzero(a / a.max() > edge)
    assert 100 < len(right) < 1900
    assert ids_of(selection.runs).tolist() == right.tolist()
    assert all((x != y).mean() > 0.01 for x, y in zip(before, s.pictures(), strict=True))
    # With Ctrl some are taken away again, with Shift added.
    lasso(s, [(0.8, -0.02), (1.02, -0.02), (1.02, 1.02), (0.8, 1.02)], QtCore.Qt.KeyboardModifier.ControlModifier)
    less = selected(s, "selection")
    assert 0 < len(less) < len(right)
    assert np.isin(less, right).all()
    lasso(s, [(0.8, -0.02), (1.02, -0.02), (1.02, 1.02), (0.8, 1.02)], QtCore.Qt.KeyboardModifier.ShiftModifier)
    assert selected(s, "selection").tolist() == right.tolist()
    for _ in range(3):
        s.session.undo()
    s.settle(0.2)
    assert not s.document[Selections].selections
    assert all((x == y).all() for x, y in zip(before, s.pictures(), strict=True))


@pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")
def test_with_the_key_held_a_drag_paints_a_selection_and_not_the_view(loaded):
    from qtpy import QtCore

    from tests.qt.test_mouse import corner, run

    s, panel = loaded, loaded.panels[1]
    x0, y0 = corner(panel)
    middle = panel.view.rect().center()
    at = x0 + middle.x(), y0 + middle.y()
    camera = panel.view.camera.GetPosition()
    panel.view.setFocus()
    run("mousemove", *at)
    run("keydown", "b")
    s.settle(0.3)
    assert panel.view.brush is not None
    run("mousedown", 1)
    for step in range(1, 9):
        run("mousemove", at[0] + 5 * step, at[1] + step)
        time.sleep(0.02)
        s.settle(0.03)
    run("mouseup", 1)
    run("keyup", "b")
    s.until(lambda: s.document[Selections].selections)
    s.settle(0.3)
    assert panel.view.brush is None
    assert panel.view.camera.GetPosition() == camera
    painted = selected(s, "selection")
    # Every vertex that is seen along the way is in it.
    for step in (0, 20, 40):
        hit = panel.view.pick(middle + QtCore.QPoint(step, step // 5))
        assert hit.vertex in painted
    assert len(painted) < 1000
    assert s.source == 5


def test_the_key_for_the_brush_is_heard_wherever_the_focus_is_but_in_text(loaded):
    from qtpy import QtCore, QtWidgets
    from qtpy.QtTest import QTest

    s, key = loaded, QtCore.Qt.Key.Key_B
    pointers = [panel.view for panel in s.panels]
    parts(s.window).docks.toggle("anchors")
    dock = parts(s.window).docks._docks["anchors"]
    spin = dock.content.findChild(QtWidgets.QSpinBox)
    for keys in (s.panels[0].view, s.window.tool_bar.buttons["open"], s.panels[1].head.name, spin):
        keys.setFocus()
        assert s.window.focusWidget() is keys
        QTest.keyPress(s.window.windowHandle(), key)
        assert all(pointer.brush is not None for pointer in pointers)
        s.panels[0].view.setFocus()  # as by the click that begins a stroke
        assert all(pointer.brush is not None for pointer in pointers)
        QTest.keyRelease(s.window.windowHandle(), key)
        assert all(pointer.brush is None for pointer in pointers)
    parts(s.window).typed_source.box.setFocus()
    QTest.keyPress(s.window.windowHandle(), key)
    assert pointers[0].brush is None
    QTest.keyRelease(s.window.windowHandle(), key)
    dock.setFloating(True)
    s.settle(0.1)
    spin.setFocus()
    QTest.keyPress(dock.windowHandle(), key)
    assert pointers[0].brush is not None
    QTest.keyRelease(dock.windowHandle(), key)
    assert pointers[0].brush is None
    dock.setFloating(False)


def test_selections_are_renamed_coloured_saved_deleted_and_kept(loaded, tmp_path):
    from qtpy import QtCore, QtTest, QtWidgets

    s, rows = loaded, loaded.dock.list
    lasso(s, [(0.4, -0.02), (1.02, -0.02), (1.02, 1.02), (0.4, 1.02)])
    lasso(s, [(0.02, 1.02), (0.2, 1.02), (0.2, 0.1), (0.02, 0.1)])
    assert [each.name for each in s.document[Selections].selections] == ["selection", "selection 2"]
    rows.setCurrentItem(rows.topLevelItem(0))
    rows.setFocus()
    rows.editItem(rows.topLevelItem(0), 0)
    editor = rows.findChild(QtWidgets.QLineEdit)
    editor.selectAll()
    QtTest.QTest.keyClicks(editor, "far away")
    QtTest.QTest.keyClick(editor, QtCore.Qt.Key.Key_Return)
    s.settle(0.2)
    assert [each.name for each in s.document[Selections].selections] == ["far away", "selection 2"]
    rows.recolour(4)
    assert s.document[Selections].selections[0].colour == 4
    rows.save("ids", str(tmp_path / "far.txt"))
    assert np.loadtxt(tmp_path / "far.txt", dtype=int).tolist() == selected(s, "far away").tolist()
    rows.save("mesh", str(tmp_path / "far.ply"))
    assert (tmp_path / "far.ply").stat().st_size > 1000
    kept = recipe_text(Recipe(s.document, Page()), "1")
    assert '"far away"' in kept
    rows.setCurrentItem(rows.topLevelItem(1))
    QtTest.QTest.keyClick(rows, QtCore.Qt.Key.Key_Delete)
    s.settle(0.1)
    assert [each.name for each in s.document[Selections].selections] == ["far away"]
    # A name that another has is refused, and the old one stays.
    s.session.undo()
    s.settle(0.1)
    rows.topLevelItem(0).setText(0, "selection 2")
    s.settle(0.1)
    assert [each.name for each in s.document[Selections].selections] == ["far away", "selection 2"]
    assert "two selections" in s.refusals[-1]
    assert rows.topLevelItem(0).text(0) == "far away"


def test_the_panels_and_the_values_are_chosen_in_the_head(loaded):
    s, dock = loaded, loaded.dock
    ids = [panel.id for panel in s.document.panels]
    dock.choose_panel("across", ids[1])
    s.until(lambda: np.array_equal(dock.chart.scatter.y, s.answers[0].field / s.answers[0].field.max()))
    assert (s.document[Scatter].across, s.document[Scatter].up) == (ids[1], ids[0])
    dock.shares.buttons["value"].click()
    s.until(lambda: np.array_equal(dock.chart.scatter.y, s.answers[0].field))
    # These have other units, so that their difference would mean nothing.
    s.until(lambda: not any("largest" in fact[0] for fact in dock.facts.facts))
    s.session.undo()
    s.until(lambda: any("largest" in fact[0] for fact in dock.facts.facts))


def test_no_figure_is_saved_of_nothing(loaded, tmp_path):
    loaded.dock.chart.show_nothing("No field.")
    loaded.dock.save_figure(path=str(tmp_path / "scatter.pdf"))
    assert "wait until both panels have a field" in loaded.refusals[-1]
    assert not list(tmp_path.glob("*.pdf"))


def test_the_source_moves_and_the_scatter_follows(loaded):
    from app.document.edits import move_source

    s = loaded
    s.session.show(move_source(s.document, 0, 900))
    s.until(lambda: s.session.is_complete and s.dock.chart.scatter.x[900] == 0)


def test_a_session_has_its_selections_and_its_dock_again(loaded, screen, tmp_path):
    s = loaded
    lasso(s, [(0.5, -0.02), (1.02, -0.02), (1.02, 1.02), (0.5, 1.02)])
    file = tmp_path / "session.json"
    file.write_text(recipe_text(Recipe(s.document, Page()), "1"))
    kept = read_recipe(file)
    other = screen([Spec.of("biharmonic")])
    other.window.resize(1200, 900)
    other.window.show_document(kept.document)
    other.until(lambda: other.session.is_complete)
    other.settle(0.3)
    assert other.document[Selections].selections == s.document[Selections].selections
    dock = parts(other.window).docks._docks["scatter"].content
    assert dock.isVisible()
    assert dock.list.topLevelItemCount() == 1
    green = np.array([0x1F, 0x7A, 0x3D])
    assert all((np.abs(picture.astype(int) - green).max(axis=2) < 3).sum() > 30 for picture in other.pictures())


def test_the_scatter_is_saved_as_a_figure_and_as_numbers(loaded, tmp_path):
    s, dock = loaded, loaded.dock
    lasso(s, [(0.5, -0.02), (1.02, -0.02), (1.02, 1.02), (0.5, 1.02)])
    assert dock.list.current == "selection"
    dock.save_figure(path=str(tmp_path / "it.svg"))
    s.until((tmp_path / "it.svg").exists)
    text = (tmp_path / "it.svg").read_text()
    count = len(selected(s, "selection"))
    assert f"selection ({count:,})" in text
    assert f"rank correlation {dict(dock.facts.facts)['rank correlation']}" in text
    dock.save_numbers(path=str(tmp_path / "it.csv"))
    rows = np.genfromtxt(tmp_path / "it.csv", delimiter=",", skip_header=1)
    a, b = (answer.field for answer in s.answers)
    assert np.array_equal(rows[:, :3], np.column_stack([np.arange(len(a)), a / a.max(), b / b.max()]))
    assert np.flatnonzero(rows[:, 3]).tolist() == selected(s, "selection").tolist()
    assert (tmp_path / "it.csv").read_text().startswith("vertex,Biharmonic,Diffusion,selection\n")
