"""A mesh about which there is much to say moves nothing in the window; its words are in the list of the chip."""

import shutil

import pytest
from qtpy import QtCore, QtTest, QtWidgets

from tests.bench.meshes import bumpy_sphere
from tests.qt.broken import with_fins
from tests.qt.parts import parts
from tests.qt.test_mouse import corner, run

pytestmark = pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")

COUNT = 2500
NAME = "scan of a very long name, " * 8 + "second try.off"


def places(window):
    """Where everything is that is seen, in the order it was made in."""
    widgets = [widget for widget in window.findChildren(QtWidgets.QWidget) if widget.isVisible()]
    inside = [widget for widget in widgets if widget.window() is window]
    return [(type(each).__name__, each.mapTo(window, QtCore.QPoint(0, 0)), each.size()) for each in inside]


def fits(window):
    return window.screen().geometry().contains(window.frameGeometry())


@pytest.fixture
def loaded(screen, tmp_path):
    path = tmp_path / NAME
    with_fins(*bumpy_sphere(4000), count=COUNT, path=path)
    s = screen()
    s.window.move(20, 20)
    s.settle(0.1)
    assert fits(s.window)
    s.open(path, 5)
    return s


def hover(s, count=24):
    """The pointer goes over everything in the window; how often it was over the surface."""
    hit = 0
    for k in range(count):
        panel = s.panels[k % len(s.panels)]
        x0, y0 = corner(panel)
        x, y = round(panel.view.width() * (0.1 + 0.8 * k / count)), round(panel.view.height() * (0.3 + 0.02 * k))
        run("mousemove", x0 + x, y0 + y)
        s.settle(0.03)
        hit += parts(s.window).gestures.hovered is not None
    for widget in (s.window.tool_bar, s.panels[0].head, s.panels[1].bar, s.window.status):
        middle = widget.mapToGlobal(widget.rect().center())
        run("mousemove", middle.x(), middle.y())
        s.settle(0.03)
    return hit


def test_many_edges_and_a_long_name_move_nothing_and_are_told_in_a_list(loaded):
    s, chip = loaded, loaded.window.status.notes
    s.until(lambda: NAME in s.window.windowTitle())
    assert s.session.mesh().surface.nonmanifold_edge_count == COUNT
    assert fits(s.window)
    assert s.window.minimumSizeHint().width() <= 640
    before = places(s.window)
    assert hover(s) >= 6
    assert places(s.window) == before
    assert fits(s.window)

    sentence = f"{COUNT:,} edges with more than two faces, for which there is the operator tufted"
    assert chip.words == "2 notes"
    assert chip.sentences[0] == sentence
    assert chip.isVisible()
    assert chip.width() >= chip.sizeHint().width(), "all its words"
    middle = chip.mapToGlobal(chip.rect().center())
    run("mousemove", middle.x(), middle.y(), "click", 1)
    s.until(lambda: isinstance(s.application.activePopupWidget(), QtWidgets.QMenu), 10)
    menu = s.application.activePopupWidget()
    assert sentence in [action.text() for action in menu.actions()]
    assert s.window.screen().geometry().contains(menu.geometry())
    run("key", "Escape")
    s.until(lambda: s.application.activePopupWidget() is None, 10)
    assert places(s.window) == before


def test_a_click_selects_the_vertex_that_is_met_there(loaded):
    s = loaded
    for panel, (x, y) in zip(s.panels, [(0.5, 0.5), (0.42, 0.6), (0.57, 0.41)], strict=True):
        x0, y0 = corner(panel)
        point = QtCore.QPoint(round(x * panel.view.width()), round(y * panel.view.height()))
        hit = panel.view.pick(point)
        run("mousemove", x0 + point.x(), y0 + point.y())
        s.until(lambda hit=hit: parts(s.window).gestures.hovered == hit.vertex, 10)
        assert s.source != hit.vertex
        run("click", 1)
        s.until(lambda hit=hit: s.session.is_complete and s.source == hit.vertex)
        assert parts(s.window).typed_source.box.text() == str(hit.vertex)
        QtTest.QTest.qWait(QtWidgets.QApplication.doubleClickInterval())


def test_a_very_long_list_moves_nothing_and_says_how_much_it_leaves_out(loaded):
    s, chip = loaded, loaded.window.status.notes
    view = s.panels[0].view
    before = view.geometry(), s.window.geometry()
    sentences = [f"{k}: component without any of the others, of which there is much to say, " * 4 for k in range(3000)]
    chip.show_lists([], sentences)
    s.settle(0.1)
    assert (view.geometry(), s.window.geometry()) == before
    assert chip.words == "3,000 notes"
    still = places(s.window)
    hover(s, 6)
    assert places(s.window) == still
    chip.click()
    menu = s.application.activePopupWidget()
    words = [action.text() for action in menu.actions() if action.text()]
    assert words[-2:] == ["and 2,980 more", "Copy"]
    assert s.window.screen().geometry().contains(menu.geometry())
    assert menu.width() <= 700
    menu.actions()[-1].trigger()
    menu.close()
    assert s.application.clipboard().text() == "\n".join(sentences)
    s.settle(0.05)
    assert fits(s.window)
