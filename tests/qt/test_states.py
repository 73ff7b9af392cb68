"""Controls show where the pointer and the keys are, and what is drawn by hand follows the theme and the letters."""

import pytest
from qtpy import QtCore, QtGui, QtWidgets

from app.qt.look.look import LOOK
from app.qt.look.theme import DARK, LIGHT
from tests.qt.parts import parts
from tests.shapes import bumpy


@pytest.fixture
def window(shared_screen):
    s = shared_screen(bumpy(300), source=None)
    s.activate()
    return s


@pytest.fixture(autouse=True)
def light_afterwards(application):
    LOOK.choose("light")
    yield
    LOOK.choose("light")


def colour_at(widget, x, y):
    return widget.grab().toImage().pixelColor(x, y).name().upper()


def test_the_active_panel_s_line_has_the_accent_of_each_theme(window):
    panel = window.panels[window.window.grid.active]
    for theme in (DARK, LIGHT, DARK):
        LOOK.choose(theme.word)
        window.settle(0.05)
        assert colour_at(panel, panel.width() // 2, 0) == theme.accent


def test_a_button_whose_menu_closes_elsewhere_loses_the_colour_of_the_pointer(window):
    for button in (window.window.tool_bar.buttons["open"], window.panels[0].head.more):
        inside, menu = button.rect().center(), button.menu()
        edge = QtCore.QPoint(button.width() // 2, 4)

        def is_grey(button=button, edge=edge):
            return colour_at(button, edge.x(), edge.y()) == LIGHT.hover

        QtGui.QCursor.setPos(button.mapToGlobal(inside))
        window.until(is_grey)
        beside = window.panels[1].view.mapToGlobal(QtCore.QPoint(40, 200))
        QtCore.QTimer.singleShot(200, lambda beside=beside: QtGui.QCursor.setPos(beside))
        QtCore.QTimer.singleShot(400, menu.close)
        button.showMenu()  # until it is closed
        window.settle(0.1)
        assert not is_grey()


def test_keys_of_what_is_hidden_or_disabled_go_to_the_panels_and_not_to_the_tool_bar(window):
    docks, grid = parts(window.window).docks, window.window.grid
    docks.toggle("pins")
    window.settle(0.1)
    box = docks._docks["pins"].content.box
    box.setFocus(QtCore.Qt.FocusReason.MouseFocusReason)
    assert QtWidgets.QApplication.focusWidget() is box
    docks.close("pins")
    window.settle(0.1)
    assert QtWidgets.QApplication.focusWidget() is grid.panel(grid.active).view
    parts(window.window).typed_source.box.ask()
    parts(window.window).typed_source.box.setEnabled(False)
    assert QtWidgets.QApplication.focusWidget() is grid.panel(grid.active).view


def test_a_window_that_becomes_active_shows_no_ring_on_its_first_button(window):
    button = window.window.tool_bar.buttons["open"]
    button.setFocus(QtCore.Qt.FocusReason.ActiveWindowFocusReason)
    assert button.hasFocus()
    assert not button.has_keys
    button.clearFocus()
    button.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
    assert button.has_keys


def test_on_the_full_screen_of_a_talk_all_words_of_a_head_are_larger(window):
    (exact,) = window.panels[0].head.controls
    before = exact.fontMetrics().height()
    name = window.panels[0].head.name
    assert exact.font().pixelSize() == LOOK.font().pixelSize()
    LOOK.enlarge(1.35)
    try:
        assert exact.font().pixelSize() == LOOK.font().pixelSize() > 13
        assert exact.fontMetrics().height() > 1.2 * before
        assert exact.geometry().right() < name.parent().width()
    finally:
        LOOK.enlarge(1.0)


def test_letters_keep_their_size_in_every_theme_and_all_grow_on_the_full_screen_of_a_talk(window):
    bar, box = window.window.menuBar(), parts(window.window).typed_source.box
    word = window.window.status.marks
    wide, high = box.width(), box.height()

    def sizes():
        return {each.font().pixelSize() for each in (bar, box, word)}

    assert sizes() == {13}
    LOOK.choose("dark")
    window.settle(0.05)
    assert sizes() == {13}
    LOOK.enlarge(1.35)
    try:
        assert sizes() == {18}
        assert box.width() == round(1.35 * wide)
    finally:
        LOOK.enlarge(1.0)
    assert sizes() == {13}
    assert (box.width(), box.height()) == (wide, high)


def test_a_low_panel_says_what_it_waits_for_beside_its_shape(window):
    s = window
    s.window.resize(700, 560)
    panel = s.panels[0]
    s.until(lambda: panel.height() < 360)
    panel.show_waiting((0.3, "Eigenpairs"))
    s.settle(0.05)
    view, bar = panel.view.geometry(), panel.bar.geometry()
    assert not panel.waiting.geometry().intersects(view)
    assert bar.contains(panel.waiting.geometry())
    assert panel.waiting.geometry().contains(panel.waiting.stop.geometry().translated(panel.waiting.pos()))
    panel.show_waiting((0.3, "Checking the accuracy"), is_old=False)
    s.settle(0.05)
    # The bar has a field: only a line lies over the view, and the cross in its corner.
    assert panel.waiting.geometry().top() == view.top()
    grab = panel.waiting.grab(QtCore.QRect(0, 2, 120, panel.waiting.height() - 2)).toImage()
    words = {grab.pixel(x, y) for x in range(grab.width()) for y in range(grab.height())}
    assert len(words) == 1
    s.window.resize(1000, 900)
    s.until(lambda: panel.height() > 400)
    assert panel.waiting.geometry().top() == panel.view.geometry().top()
    panel.show_waiting(None)
