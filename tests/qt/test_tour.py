"""The tour through the window."""

from types import SimpleNamespace

import pytest

from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")


@pytest.fixture
def window(application):
    """A window with the parts the tour is about."""
    from qtpy import QtCore, QtWidgets

    window = QtWidgets.QMainWindow()
    window.resize(900, 600)
    bar = window.addToolBar("Tools")
    bar.setObjectName("tools")
    bar.addWidget(QtWidgets.QToolButton(text="Export", objectName="export"))
    middle = QtWidgets.QWidget()
    row, panels = QtWidgets.QHBoxLayout(middle), []
    for _ in range(3):
        panel = SimpleNamespace(head=QtWidgets.QLabel("head"), view=QtWidgets.QFrame(), bar=QtWidgets.QLabel("bar"))
        column = QtWidgets.QVBoxLayout()
        panel.bar.setFixedHeight(60)
        panel.head.setFixedHeight(36)
        for widget in (panel.head, panel.view, panel.bar):
            column.addWidget(widget)
        row.addLayout(column)
        panels.append(panel)
    window.grid = SimpleNamespace(panels=panels)
    window.setCentralWidget(middle)
    window.statusBar().showMessage("ready")
    window.show()
    application.processEvents()
    yield window
    window.close()
    window.deleteLater()
    application.sendPostedEvents(window, QtCore.QEvent.Type.DeferredDelete)
    application.processEvents()


@pytest.fixture
def tour(window):
    from app.qt.pages.tour import Tour, steps

    return Tour(window, steps(window, lambda: window.grid.panels))


def target_of(tour):
    from qtpy.QtCore import QPoint, QRect

    target = tour.steps[tour.at].where()
    return QRect(target.mapTo(tour.window, QPoint(0, 0)), target.size())


def test_five_steps_forwards_and_back_with_the_card_in_one_place_beside_all_parts(tour, application):
    ends = []
    tour.ended.connect(lambda: ends.append(tour.at))
    tour.start()
    titles, place = [], tour.card.geometry()
    for k in range(5):
        assert tour.card.geometry() == place
        assert tour.card.count.text() == f"{k + 1} of 5"
        assert tour.card.next.text() == ("Done" if k == 4 else "Next")
        assert tour.card.back.isEnabled() == (k > 0)
        assert tour.window.rect().contains(tour.card.geometry())
        assert not tour.card.geometry().intersects(tour.window.statusBar().geometry())
        assert not tour.card.geometry().intersects(target_of(tour))
        assert tour.outline.geometry().contains(target_of(tour) & tour.window.rect())
        titles.append(tour.card.title.text())
        if k == 2:
            tour.card.back.click()
            assert tour.card.title.text() == titles[1]
            tour.card.next.click()
        tour.card.next.click()
    assert len(set(titles)) == 5
    assert ends == [4]
    assert not tour.is_on
    assert not tour.card.isVisible()
    assert not tour.outline.isVisible()
    tour.start()
    assert tour.card.title.text() == titles[0]


def test_the_tour_can_be_left_by_the_cross(tour):
    ends = []
    tour.ended.connect(lambda: ends.append(1))
    tour.start()
    tour.card.close_button.click()
    assert ends == [1]
    assert not tour.card.isVisible()
    tour.end()
    assert ends == [1]


def touring(s, mesh):
    """A window of a mesh with the tour, and the keys."""
    s.open(mesh, 5)
    s.activate()
    parts(s.window).guide.start_tour()
    return parts(s.window).guide.tour


@pytest.mark.parametrize("where", ["card", "view", "box"])
def test_escape_ends_the_tour_wherever_the_keys_are(screen, mesh_file, capfd, where):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    tour = touring(s, mesh_file(bumpy(100)))
    keys = {"card": tour.card.next, "view": s.panels[1].view, "box": parts(s.window).typed_source.box}[where]
    keys.setFocus()
    QTest.keyClick(keys, Qt.Key.Key_Escape)
    assert not tour.is_on
    assert not tour.card.isVisible()
    assert "mbiguous" not in capfd.readouterr().err


@pytest.mark.parametrize("where", ["card", "view"])
@pytest.mark.parametrize("key", ["Return", "Enter"])
def test_enter_goes_on_with_the_tour(screen, mesh_file, where, key):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    tour = touring(s, mesh_file(bumpy(100)))
    if where == "card":
        assert tour.card.next.hasFocus()
        QTest.mouseClick(tour.card.next, Qt.MouseButton.LeftButton)
        QTest.mouseClick(tour.card.back, Qt.MouseButton.LeftButton)  # the keys stay with Next
    else:
        s.panels[1].view.setFocus()
    for step in range(5):
        assert tour.at == step
        QTest.keyClick(s.application.focusWidget(), getattr(Qt.Key, f"Key_{key}"))
    assert not tour.is_on


def test_a_click_too_many_at_the_end_of_the_tour_does_not_move_the_source(screen, mesh_file):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    tour = touring(s, mesh_file(bumpy(100)))
    tour.go(4)
    view = s.panels[1].view
    at = s.point_of(s.panels[1], s.seen(1, panel=1)[0])
    tour.card.move(view.mapTo(s.window, at) - tour.card.next.geometry().center())  # over the surface
    place = tour.card.mapTo(s.window, tour.card.next.geometry().center())
    for _ in range(2):
        under = s.window.childAt(place)
        QTest.mouseClick(under, Qt.MouseButton.LeftButton, pos=under.mapFrom(s.window, place))
    assert not tour.is_on
    assert s.source == 5
    s.until(lambda: s.window.childAt(place) is view)
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=at)
    assert s.source != 5


def test_the_card_follows_its_part_when_the_window_or_the_parts_change(tour, application):
    from qtpy.QtTest import QTest

    tour.start()
    tour.go(1)
    tour.window.resize(700, 480)
    QTest.qWait(100)
    assert tour.window.rect().contains(tour.card.geometry())
    assert tour.outline.geometry().contains(target_of(tour))
    tour.window.grid.panels[0].head.setFixedHeight(90)
    tour.window.grid.panels.reverse()
    QTest.qWait(400)
    assert tour.outline.geometry().contains(target_of(tour))
    assert not tour.card.geometry().intersects(target_of(tour))


def test_without_its_part_a_step_has_no_outline_and_without_any_the_card_is_in_the_middle(tour, window, application):
    from qtpy import QtWidgets

    from app.qt.pages.tour import room_of, steps

    tour.start()
    assert tour.outline.isVisible()
    window.grid.panels[0].view.hide()
    tour.place()
    assert not tour.outline.isVisible()
    tour.go(3)
    assert tour.outline.isVisible()
    bar = window.findChild(QtWidgets.QToolBar, "tools")
    bar.hide()
    tour.place()
    assert not tour.outline.isVisible()
    window.removeToolBar(bar)
    bar.setParent(None)
    window.grid.panels.clear()
    assert [step.where() for step in steps(window, lambda: window.grid.panels)] == [None] * 5
    for k in range(5):
        tour.go(k)
        offset = tour.card.geometry().center() - room_of(window).center()
        assert offset.manhattanLength() <= 3
        assert not tour.outline.isVisible()


def test_the_outline_lets_the_mouse_through(tour, application):
    from qtpy.QtCore import Qt

    tour.start()
    view = tour.window.grid.panels[0].view
    assert tour.outline.testAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
    centre = view.mapTo(tour.window, view.rect().center())
    assert tour.window.childAt(centre) is view


def test_where_the_card_is_clear_of_all_parts_or_else_of_all_but_the_largest(application):
    from qtpy.QtCore import QPoint, QRect, QSize

    from app.qt.pages.tour import place_beside

    room, card = QRect(8, 8, 884, 584), QSize(300, 150)
    assert place_beside([QRect(100, 20, 60, 30)], card, room) == QPoint(8, 61)
    bar, view = QRect(0, 500, 900, 100), QRect(0, 40, 900, 460)
    place = QRect(place_beside([view, bar], card, room), card)
    assert view.contains(place)
    assert not place.intersects(bar)
    whole = QRect(place_beside([room], card, room), card)
    assert room.contains(whole)
    assert whole.center().x() > room.center().x()
    assert place_beside([QRect(0, 0, 10, 10)], QSize(900, 700), room) == QPoint(8, 8)
