"""The controls of the line over a panel: what fits, what keys and the wheel do."""

from itertools import pairwise

import pytest
from qtpy import QtCore, QtGui, QtTest, QtWidgets

from app.document.quantities import quantity
from app.qt.look.look import LOOK
from tests.qt.events import turn_wheel
from tests.qt.heads import choose, entries, shown

SHOWN = (
    "biharmonic",
    "geodesic",
    "diffusion(t=1/4)",
    "power",
    "truncated",
    "biharmonic - geodesic",
    "raw diffusion - diffusion(t=1/4)",
    "power - truncated",
)


@pytest.mark.parametrize("text", SHOWN)
def test_nothing_overlaps_or_is_cut_at_any_width(head, text):
    h = head(text)
    for warning in ("", "only 3 % exact"):
        h.show_warning(warning)
        for width in range(120, 901, 7):
            h.resize(width, h.height())
            children = h.findChildren(QtWidgets.QWidget, options=QtCore.Qt.FindChildOption.FindDirectChildrenOnly)
            children = [child for child in children if child.isVisibleTo(h) and not child.isWindow()]
            places = sorted((child.geometry() for child in children), key=lambda place: place.left())
            for place, after in pairwise(places):
                assert place.right() < after.left(), width
            assert places[0].left() >= 0
            assert places[-1].right() < width
            for control in shown(h):
                button = getattr(control, "button", control)
                assert button.width() >= button.sizeHint().width(), width
                if button is not control and control.slider.isVisibleTo(h):
                    assert 72 <= control.slider.width() <= 88
                    assert width >= 440
            if h.name.width() < h.name.sizeHint().width():
                assert not shown(h), "the name is cut last"
                assert not h.info.isVisibleTo(h)


def test_words_leave_as_the_panel_becomes_narrower(head):
    h = head("power")

    def at(width):
        h.resize(width, h.height())
        sliders = [c.slider.isVisibleTo(h) for c in shown(h)]
        return len(shown(h)), any(sliders), h.info.isVisibleTo(h), h._about.isVisible()

    assert at(500) == (1, True, True, False)
    assert at(439) == (1, False, False, True)
    assert at(190) == (0, False, False, True)
    h.show_quantity(quantity("geodesic"))
    inner = entries(h.name.menu())["How it is computed: auto"].menu()
    {action.text(): action for action in inner.actions()}["heat"].trigger()
    assert str(h.choices[-1]) == "geodesic(method=heat)"


def test_a_hidden_number_opens_its_pop_up_from_the_name_s_menu(head, application):
    h = head("diffusion", 150)
    choose(h, "Diffusion time: 1.00…")
    QtTest.QTest.qWait(20)
    (control,) = h.controls
    assert control.pop_up.isVisible()
    control.pop_up.box.setText("2")
    QtTest.QTest.keyClick(control.pop_up.box, QtCore.Qt.Key.Key_Return)
    assert str(h.choices[-1]) == "diffusion(t=2)"


def test_the_wheel_turns_no_slider_that_has_no_focus(head):
    h = head("diffusion")
    slider = shown(h)[0].slider
    h.name.setFocus()
    turn_wheel(slider)
    assert h.choices == []
    h.window().activateWindow()
    slider.setFocus()
    assert QtTest.QTest.qWaitForWindowActive(h.window())
    turn_wheel(slider)
    assert len(h.choices) == 1


def test_the_window_s_shortcuts_are_not_taken_by_the_box(head):
    h = head("diffusion", 360)
    control = shown(h)[0]
    control.open_under(control)
    box = control.pop_up.box
    keys, modifiers = QtCore.Qt.Key, QtCore.Qt.KeyboardModifier

    def is_taken(key, modifier=modifiers.ControlModifier):
        event = QtGui.QKeyEvent(QtCore.QEvent.Type.ShortcutOverride, key, modifier, "")
        event.ignore()
        QtWidgets.QApplication.sendEvent(box, event)
        return event.isAccepted()

    for key in (keys.Key_E, keys.Key_S, keys.Key_O, keys.Key_Z):
        assert not is_taken(key)
    assert not is_taken(keys.Key_D, modifiers.AltModifier)
    QtWidgets.QApplication.clipboard().setText("7")
    for key in (keys.Key_A, keys.Key_C, keys.Key_V, keys.Key_X):
        assert is_taken(key)
    QtTest.QTest.keyClicks(box, "5")
    assert is_taken(keys.Key_Z), "there is something to take back"


def test_every_control_is_reached_by_tab_and_has_a_name(head):
    h = head("power")
    h.window().activateWindow()
    assert QtTest.QTest.qWaitForWindowActive(h.window())
    (alpha,) = shown(h)
    h.name.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
    reached = []
    for _ in range(5):
        reached.append(QtWidgets.QApplication.focusWidget())
        QtTest.QTest.keyClick(reached[-1], QtCore.Qt.Key.Key_Tab)
    assert reached == [h.name, alpha.slider, alpha.button, h.info, h.more]
    for widget in reached:
        assert widget.accessibleName()
        assert widget.toolTip()


@pytest.mark.parametrize("key", ["Key_Space", "Key_Return", "Key_Down"])
def test_menus_and_sheets_open_by_keyboard(head, key):
    h = head("geodesic")
    loaded = []
    for button in (h.name, shown(h)[0], h.more):
        menu = button.menu()
        menu.aboutToShow.connect(lambda menu=menu: loaded.append(menu) or QtCore.QTimer.singleShot(0, menu.close))
        QtTest.QTest.keyClick(button, getattr(QtCore.Qt.Key, key))
    assert loaded == [h.name.menu(), shown(h)[0].menu(), h.more.menu()]
    QtTest.QTest.keyClick(h.info, getattr(QtCore.Qt.Key, key))
    assert h._sheet.isVisible()
    h._sheet.close()


def test_the_focus_ring_is_there_by_keyboard_only(head):
    h = head()
    h.window().activateWindow()
    assert QtTest.QTest.qWaitForWindowActive(h.window())

    def ring():
        picture = h.name.grab().toImage()
        return picture.pixelColor(picture.width() // 2, 1).name().upper() == LOOK.theme.accent

    h.name.setFocus(QtCore.Qt.FocusReason.MouseFocusReason)
    assert not ring()
    h.name.clearFocus()
    h.name.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
    assert ring()


def test_lower_in_a_panel_with_little_height(head):
    h = head()
    assert h.height() == 36
    h.set_compact(True)
    assert h.height() == 32
    assert h.sizePolicy().horizontalPolicy() == QtWidgets.QSizePolicy.Policy.Ignored
    assert h.minimumSizeHint().width() <= 72


def test_a_double_click_on_a_number_opens_its_pop_up_once(head, application):
    h = head("diffusion", width=300)
    (control,) = h.controls
    QtTest.QTest.mouseClick(control.button, QtCore.Qt.MouseButton.LeftButton)
    assert control.pop_up.isVisible()
    above = control.pop_up.mapFromGlobal(control.button.mapToGlobal(control.button.rect().center()))
    left, none = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.KeyboardModifier.NoModifier
    kind = QtCore.QEvent.Type.MouseButtonDblClick
    where = QtCore.QPointF(above)
    event = QtGui.QMouseEvent(kind, where, where, where, left, left, none)
    application.sendEvent(control.pop_up, event)
    assert control.pop_up.isVisible()
    QtTest.QTest.mouseClick(control.pop_up, left, pos=above)
    assert not control.pop_up.isVisible()
