"""The tour through the window."""

from types import SimpleNamespace

import pytest

pytest.importorskip("qtpy")


@pytest.fixture
def window(application):
    """A window with the parts the tour is about."""
    from qtpy import QtCore, QtWidgets

    window = QtWidgets.QMainWindow()
    window.resize(900, 600)
    window.tool_bar = window.addToolBar("Tools")
    export = QtWidgets.QToolButton(text="Export")
    window.tool_bar.addWidget(export)
    window.tools = {"export": export}
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

    return Tour(window, steps(window))


def target_of(tour):
    from qtpy.QtCore import QPoint, QRect

    target = tour.steps[tour.at].where()
    return QRect(target.mapTo(tour.window, QPoint(0, 0)), target.size())


def test_five_steps_forwards_and_back_with_the_card_inside_and_beside(tour, application):
    ends = []
    tour.ended.connect(lambda: ends.append(tour.at))
    tour.start()
    titles = []
    for k in range(5):
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


@pytest.mark.parametrize("way", ["escape", "cross"])
def test_the_tour_can_be_left(tour, application, way):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    ends = []
    tour.ended.connect(lambda: ends.append(1))
    tour.window.activateWindow()
    QTest.qWaitForWindowActive(tour.window)
    tour.start()
    if way == "escape":
        QTest.keyClick(tour.window, Qt.Key.Key_Escape)
    else:
        tour.card.close_button.click()
    assert ends == [1]
    assert not tour.card.isVisible()
    tour.end()
    assert ends == [1]


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


def test_a_part_that_is_hidden_or_absent_leaves_the_card_in_the_middle(tour, window, application):
    from app.qt.pages.tour import room_of, steps

    def is_in_the_middle():
        offset = tour.card.geometry().center() - room_of(window).center()
        return offset.manhattanLength() <= 3 and not tour.outline.isVisible()

    tour.start()
    assert not is_in_the_middle()
    window.grid.panels[0].view.hide()
    tour.place()
    assert is_in_the_middle()
    window.tool_bar.hide()
    tour.go(3)
    assert is_in_the_middle()
    window.grid, window.tools, window.tool_bar = None, None, None
    assert [step.where() for step in steps(window)] == [None] * 5
    for k in range(5):
        tour.go(k)
        assert is_in_the_middle()


def test_the_outline_lets_the_mouse_through(tour, application):
    from qtpy.QtCore import Qt

    tour.start()
    view = tour.window.grid.panels[0].view
    assert tour.outline.testAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
    centre = view.mapTo(tour.window, view.rect().center())
    assert tour.window.childAt(centre) is view


def test_without_room_beside_it_the_card_lies_in_a_corner(application):
    from qtpy.QtCore import QPoint, QRect, QSize

    from app.qt.pages.tour import beside

    room, card = QRect(8, 8, 884, 584), QSize(300, 150)
    assert beside(QRect(100, 20, 60, 30), card, room) == QPoint(8, 61)
    whole = QRect(QPoint(beside(room, card, room)), card)
    assert room.contains(whole)
    assert whole.center().x() > room.center().x()
    assert beside(QRect(0, 0, 10, 10), QSize(900, 700), room) == QPoint(8, 8)
