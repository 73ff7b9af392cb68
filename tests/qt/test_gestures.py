"""What the pointer and the keys mean on a panel."""

from functools import partial

import numpy as np
import pytest
from qtpy import QtCore, QtTest, QtWidgets

from app.tools.robustness.perturbed_documents import perturb_mesh
from bihdist_core.applications.changes import Perturbation
from tests.qt.events import press
from tests.qt.parts import parts
from tests.shapes import bumpy


@pytest.fixture
def loaded(shared_screen):
    return shared_screen(bumpy(2000))


def front(s):
    """A vertex in the middle of what is seen."""
    view = s.panels[0].view
    return view.pick(view.rect().center()).vertex


def key(s, name, panel=0):
    press(s.panels[panel].view, name)
    s.settle(0.05)


def drawn(s):
    """How many pictures have been drawn, once all that is queued is done."""
    s.settle(0.1)
    return s.window.grid.offscreen.pictures


# ---------------------------------------------------------------------- one picture a change
def test_a_click_draws_each_panel_once_and_pointing_draws_nothing(loaded):
    s, view = loaded, loaded.panels[1].view
    place = s.point_of(s.panels[1], front(s))
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.LeftButton, pos=place)
    s.until(lambda: s.session.is_complete)
    s.session.undo()
    s.settle()
    before = drawn(s)
    # Known answers: the fields that the click before has found.
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.LeftButton, pos=place)
    s.until(lambda: s.session.is_complete)
    assert drawn(s) - before == 3
    before = drawn(s)
    for step in range(20):
        QtTest.QTest.mouseMove(view, place + QtCore.QPoint(3 * step, 2 * step))
        s.application.processEvents()
    QtTest.QTest.mouseMove(view, place)
    s.until(lambda: parts(s.window).gestures.hovered is not None)
    assert drawn(s) == before


def test_keys_come_before_the_pictures_of_the_other_views(loaded, monkeypatch):
    """Where drawing takes long, as by software."""
    from app.qt.panels import view as view_module

    s, order = loaded, []
    monkeypatch.setattr(view_module, "AT_ONCE", 0.0)
    for panel in s.panels:
        panel.view.drawn.connect(partial(order.append, "view"))
        # What comes while it is drawn.
        panel.view.drawn.connect(lambda: QtCore.QTimer.singleShot(0, partial(order.append, "key")))
    s.window.grid.redraw()
    painted = []
    s.window.grid.once_painted(lambda: painted.append(order.count("view")))
    s.until(lambda: painted)
    assert order[:5] == ["view", "key", "view", "key", "view"]
    assert painted == [3]


def test_nothing_is_drawn_before_there_is_a_mesh(screen):
    s = screen()
    s.settle(0.2)
    assert s.window.grid.offscreen.pictures == 0


# ---------------------------------------------------------------------- the camera
def test_the_wheel_keeps_what_is_under_the_pointer_there_and_the_value_fresh(loaded):
    s, view = loaded, loaded.panels[0].view
    place = QtCore.QPoint(round(0.6 * view.width()), round(0.45 * view.height()))
    hit, distance = view.pick(place), view.camera.GetDistance()
    view.zoom(2.0, place)
    s.settle(0.05)
    assert view.camera.GetDistance() == pytest.approx(distance / 2)
    now = view.place_of(hit.position)
    assert abs(now.x() - place.x() - 0.5) < 1
    assert abs(now.y() - place.y() - 0.5) < 1


def test_what_is_centred_comes_into_the_middle_and_is_turned_about(loaded):
    s, view = loaded, loaded.panels[0].view
    at = view.rect().center() + view.rect().center() / 8
    QtTest.QTest.mouseMove(view, at)
    s.settle(0.05)
    hit = view.pick(at)
    s.window.actions_by_word["centre"].trigger()
    for after in (None, "Left", "Up"):
        if after:
            key(s, after)
        place = view.place_of(hit.position)
        assert abs(place.x() - view.width() / 2) < 1
        assert abs(place.y() - view.height() / 2) < 1


def test_keys_turn_move_and_zoom_all_panels(loaded):
    s = loaded
    camera = s.window.grid.camera_controller.camera

    def state():
        return np.array([*camera.GetPosition(), *camera.GetFocalPoint()])

    for name, changes in {
        "Left": "position",
        "Up": "position",
        "Shift+Left": "both",
        "Shift+Down": "both",
        "+": "position",
        "-": "position",
    }.items():
        before = state()
        key(s, name)
        moved = np.abs(state() - before) > 1e-9
        assert moved[:3].any()
        assert moved[3:].any() == (changes == "both"), name
    assert len({id(panel.view.camera) for panel in s.panels}) == 1


def test_tab_goes_from_panel_to_panel_and_shows_where_the_keys_are(loaded):
    s = loaded
    s.activate()
    s.panels[0].view.setFocus()
    for panel in (1, 2, 0):
        key(s, "Tab", panel=(panel - 1) % 3)
        assert s.window.grid.active == s.panels[panel].id
        assert [each._accent.isVisible() for each in s.panels] == [k == panel for k in range(3)]
    key(s, "Shift+Tab")
    assert s.window.grid.active == s.panels[2].id


# ---------------------------------------------------------------------- the source
def test_the_source_goes_along_edges_where_the_keys_point(loaded):
    s = loaded
    begun = front(s)
    parts(s.window).typed_source.choose(begun)
    s.until(lambda: s.session.is_complete)
    s.panels[0].view.setFocus()
    for name, (right, up) in {"Ctrl+Left": (-1, 0), "Ctrl+Up": (0, 1), "Ctrl+Right": (1, 0)}.items():
        before = s.source
        key(s, name)
        faces = s.session.mesh().surface.faces
        assert s.source != before
        assert ((faces == before).any(axis=1) & (faces == s.source).any(axis=1)).any(), "an edge"
        way = s.point_of(s.panels[0], s.source) - s.point_of(s.panels[0], before)
        assert right * way.x() - up * way.y() > 0
    s.until(lambda: s.session.is_complete)
    s.session.undo()
    assert s.source == begun, "steps in a row are one of the history"


def test_steps_that_follow_fast_are_a_drag_that_ends_exact(loaded):
    s, live = loaded, []
    show = s.session.show
    s.session.show = lambda document, key="", live_=live, **how: (
        live_.append(how.get("live", False)),
        show(document, key, **how),
    )
    for _ in range(3):
        parts(s.window).sources.step(1, 0)
    assert live == [False, True, True]
    s.until(lambda: len(live) == 4)
    assert live[-1] is False
    s.until(lambda: s.session.is_complete)
    s.session.undo()
    assert s.source == 5


def test_a_held_key_lets_the_source_follow_and_a_tap_switches_that_on(loaded):
    s, view, live = loaded, loaded.panels[0].view, loaded.window.actions_by_word["live"]
    s.activate()
    view.setFocus()
    s.until(view.hasFocus)
    target, key = front(s), QtTest.QTest
    key.keyPress(view, "l")
    s.until(live.isChecked)
    key.mouseMove(view, s.point_of(s.panels[0], target))
    s.until(lambda: s.source == target)
    key.keyRelease(s.window.windowHandle(), "l")
    assert not live.isChecked()
    s.until(lambda: s.session.is_complete)
    assert s.source == target
    key.keyClick(view, "l")
    assert live.isChecked()
    key.keyClick(view, "l")
    assert not live.isChecked()
    key.mouseMove(view, view.rect().topLeft())  # where the next move is one


def test_a_live_source_follows_the_pointer_until_escape(loaded):
    s, view = loaded, loaded.panels[0].view
    s.window.actions_by_word["live"].trigger()
    target = front(s)
    QtTest.QTest.mouseMove(view, s.point_of(s.panels[0], target))
    s.until(lambda: s.source == target)
    s.window.context.actions["stop"].trigger()
    assert not s.window.actions_by_word["live"].isChecked()
    s.until(lambda: s.session.is_complete)
    QtTest.QTest.mouseMove(view, view.rect().center() + view.rect().center() / 6)
    s.settle()
    assert s.source == target
    s.session.undo()
    assert s.source == 5


# ---------------------------------------------------------------------- the menu
def test_the_menu_of_a_place_offers_what_can_be_done_there(loaded):
    s, view = loaded, loaded.panels[1].view
    target = front(s)
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.RightButton, pos=s.point_of(s.panels[1], target))
    s.settle()
    menu = s.application.activePopupWidget()
    offered = {action.text().partition("\t")[0]: action for action in menu.actions() if action.text()}
    assert [*offered] == [
        "Source here",
        "Add to the source",
        "Pin here",
        "Isoline through here",
        "Save isolines…",
        "Save field…",
        "Centre view here",
        "Zoom in here",
        f"Copy vertex id {target}",
        "Copy position",
        "Copy values",
    ]
    copied = QtWidgets.QApplication.clipboard()
    offered[f"Copy vertex id {target}"].trigger()
    assert copied.text() == str(target)
    offered["Copy position"].trigger()
    assert np.allclose([float(x) for x in copied.text().split()], s.session.mesh().surface.vertices[target])
    offered["Copy values"].trigger()
    lines = copied.text().splitlines()
    assert lines[0].startswith(f"vertex {target} at ")
    assert [line.partition(":")[0] for line in lines[1:]] == [answer.label for answer in s.answers]
    offered["Source here"].trigger()
    menu.close()
    s.until(lambda: s.source == target)


def test_a_live_source_that_rests_is_answered_everywhere_without_a_further_move(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(4000)), 5)
    s.window.actions_by_word["live"].trigger()
    view = s.panels[0].view
    for step in range(6):
        s.hover(view.rect().center() + view.rect().center() * (step / 40))
    assert parts(s.window).gestures.hovered not in (None, 5)
    s.until(lambda: not parts(s.window).dragging.is_on)
    s.until(lambda: s.session.is_complete)
    assert all(answer.is_final for answer in s.answers)
    assert [answer.label for answer in s.answers] == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    assert s.source not in (None, 5)


def test_the_button_of_views_follows_the_camera(loaded):
    s = loaded
    button = s.window.tool_bar.buttons["views"]
    assert button.accessibleDescription() == "Home"
    key(s, "Left")
    assert button.accessibleDescription() == "Free"
    parts(s.window).views.reset("top")
    assert button.accessibleDescription() == "Top"


def test_letters_typed_into_the_source_box_are_no_shortcuts(loaded):
    s = loaded
    s.activate()
    parts(s.window).typed_source.box.setFocus()
    parts(s.window).typed_source.box.selectAll()
    QtTest.QTest.keyClicks(parts(s.window).typed_source.box, "zl4c2")
    assert parts(s.window).typed_source.box.text() == "zl4c2"
    assert not parts(s.window).gestures.is_live


def test_views_before_and_after_are_offered_where_there_are_some(loaded):
    s = loaded
    before, after = (s.window.actions_by_word[word] for word in ("view before", "view after"))
    s.until(lambda: not parts(s.window).views._still.isActive())
    assert (before.isEnabled(), after.isEnabled()) == (False, False)
    key(s, "Left")
    assert (before.isEnabled(), after.isEnabled()) == (True, False)
    before.trigger()
    assert (before.isEnabled(), after.isEnabled()) == (False, True)
    after.trigger()
    assert (before.isEnabled(), after.isEnabled()) == (True, False)


def rings(s):
    return [panel.view.over.pointed is not None for panel in s.panels]


def test_the_ring_goes_with_the_pointer_also_if_it_came_by_a_menu(loaded):
    s, view = loaded, loaded.panels[0].view
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.RightButton, pos=s.point_of(s.panels[0], front(s)))
    assert all(rings(s))
    s.application.activePopupWidget().close()
    s.application.sendEvent(view, QtCore.QEvent(QtCore.QEvent.Type.Leave))
    assert not any(rings(s))
    assert not s.window.status.vertex.text


def test_the_ring_goes_from_all_meshes_where_one_of_them_is_made_anew(loaded):
    s = loaded
    s.session.apply(partial(perturb_mesh, change=Perturbation(noise=0.1)))
    s.until(lambda: s.session.is_complete and len(s.document.surfaces) == 2)
    s.settle()
    s.hover(s.point_of(s.panels[0], s.seen(1)[0]))
    assert any(rings(s))
    s.session.apply(partial(perturb_mesh, change=Perturbation(noise=0.2)))
    s.until(lambda: s.session.is_complete and not s.session.is_opening)
    s.application.sendEvent(s.panels[0].view, QtCore.QEvent(QtCore.QEvent.Type.Leave))
    assert not any(rings(s))


def test_a_double_click_centres_the_view_and_leaves_the_source(loaded):
    s, view = loaded, loaded.panels[0].view
    before, camera = s.source, s.document.camera
    target = next(vertex for vertex in s.seen(4) if vertex != before)
    left = QtCore.Qt.MouseButton.LeftButton

    def double_click():
        place = s.point_of(s.panels[0], target)
        QtTest.QTest.mouseClick(view, left, pos=place)
        QtTest.QTest.mouseDClick(view, left, pos=place)

    double_click()
    s.until(lambda: s.document.camera != camera)
    assert s.source == before
    assert (s.session.can_undo, s.session.can_redo) == (False, False)
    middle = QtCore.QPointF(view.width() / 2, view.height() / 2)
    assert (QtCore.QPointF(s.point_of(s.panels[0], target)) - middle).manhattanLength() < 12
    # On the mark of the source there is no click to be taken back.
    QtTest.QTest.mouseClick(view, left, pos=s.point_of(s.panels[0], target))
    s.until(lambda: s.source == target and s.session.is_complete)
    s.settle()
    double_click()
    assert s.source == target
