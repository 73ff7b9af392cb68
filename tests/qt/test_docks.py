"""Where docks stand in the window, and what they do there with keys and room."""

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets

from app.document.shared_parts.pins import add_pins
from tests.qt.parts import parts
from tests.shapes import bumpy

WORDS = ("statistics", "quality", "regions", "pins", "scatter", "profile")


def places(s, area):
    """Of the open docks in an area: how many beside each other, as sets of tabs."""
    docks = parts(s.window).docks._docks
    there = [word for word, dock in docks.items() if not dock.isHidden() and s.window.dockWidgetArea(dock) == area]
    tabs = {word: {word, *(each.word for each in s.window.tabifiedDockWidgets(docks[word]))} for word in there}
    return {frozenset(tabs[word] & set(there)) for word in there}


def test_docks_that_have_been_alone_become_tabs_when_all_are_opened(screen, mesh_file):
    s = screen()
    s.window.resize(1400, 900)
    s.open(mesh_file(bumpy(200)), 5)
    for word in WORDS:
        parts(s.window).docks.toggle(word)
        s.settle(0.1)
        parts(s.window).docks.toggle(word)
    for word in WORDS:
        parts(s.window).docks.toggle(word)
        s.settle(0.1)
    areas = QtCore.Qt.DockWidgetArea
    assert len(places(s, areas.RightDockWidgetArea)) == 2
    assert sum(map(len, places(s, areas.RightDockWidgetArea))) == 4
    assert places(s, areas.BottomDockWidgetArea) == {frozenset(("scatter", "profile"))}


def test_a_narrow_window_has_room_for_pins_beside_a_profile(screen, mesh_file):
    s = screen()
    s.window.resize(900, 600)
    s.open(mesh_file(bumpy(200)), 5)
    s.session.show(add_pins(s.document, range(10, 70, 10)))
    for word in ("pins", "profile"):
        parts(s.window).docks.toggle(word)
    s.settle(0.5)
    pins, profile = (parts(s.window).docks._docks[word] for word in ("pins", "profile"))
    assert pins.width() >= 320
    assert profile.geometry().right() < pins.geometry().left()
    for button in (profile.head.close_button, profile.content.save):
        assert profile.rect().contains(QtCore.QRect(button.mapTo(profile, QtCore.QPoint()), button.size()))


def test_tabs_of_many_docks_in_a_narrow_window_keep_their_words(screen, mesh_file):
    s = screen()
    s.window.resize(900, 600)
    s.open(mesh_file(bumpy(200)), 5)
    for word in ("statistics", "quality", "regions", "pins", "inside", "robustness"):
        parts(s.window).docks.toggle(word)
    s.settle(0.5)
    (bar,) = (bar for bar in s.window.findChildren(QtWidgets.QTabBar) if bar.isVisible())
    assert bar.count() == 6
    for k in range(6):
        assert bar.tabRect(k).width() > bar.fontMetrics().horizontalAdvance(bar.tabText(k))
    assert bar.width() <= 400


@pytest.mark.parametrize("stays_open", [True, False])
def test_a_dock_that_has_been_widened_keeps_its_width_when_another_opens(shared_screen, stays_open):
    s = shared_screen(bumpy(200))
    docks = parts(s.window).docks
    docks.toggle("statistics")
    s.settle(0.1)
    first = docks._docks["statistics"]
    s.window.resizeDocks([first], [470], QtCore.Qt.Orientation.Horizontal)
    s.settle(0.1)
    assert first.width() == 470
    if not stays_open:
        docks.toggle("statistics")
        s.settle(0.1)
    docks.toggle("quality")
    s.settle(0.1)
    assert docks._docks["quality"].width() == 470


def test_a_profile_stays_on_the_panels_whatever_they_look_like(shared_screen):
    from app.qt.look.look import LOOK

    s = shared_screen(bumpy(200))
    s.session.show(add_pins(s.document, (7, 90)))
    parts(s.window).docks.toggle("profile")
    paths = [panel.view.over.lines for panel in s.panels]
    s.until(lambda: all(len(path.points) for path in paths))
    before = paths[0].points
    theme = LOOK.theme
    try:
        LOOK.choose("dark" if not theme.is_dark else "light")
        s.settle(0.2)
        assert all(np.array_equal(path.points, before) for path in paths)
        parts(s.window).choices.style("lines")
        s.settle(0.2)
        assert all(np.array_equal(path.points, before) for path in paths)
    finally:
        LOOK.choose("dark" if theme.is_dark else "light")


def test_the_quality_of_other_panels_comes_while_its_dock_is_closed(shared_screen):
    from app.document.edits import add_panel, remove_panel

    s = shared_screen(bumpy(200))
    for _ in range(2):
        parts(s.window).docks.toggle("quality")
        s.settle(0.1)
    shows = s.document.panels[0].shows
    s.session.show(add_panel(remove_panel(s.document, s.document.panels[1].id), shows))
    parts(s.window).quality.changed.emit()
    parts(s.window).docks.toggle("quality")
    s.until(lambda: s.session.is_complete)
    dock = parts(s.window).docks._docks["quality"].content
    assert dock.table.columnCount() == 3


def test_a_click_leaves_no_outline_on_a_button_of_a_dock(shared_screen):
    s = shared_screen(bumpy(200))
    for word in WORDS:
        parts(s.window).docks.toggle(word)
    clicks = QtCore.Qt.FocusPolicy.ClickFocus
    for dock in parts(s.window).docks._docks.values():
        for button in dock.content.findChildren(QtWidgets.QPushButton):
            assert not button.focusPolicy() & clicks
