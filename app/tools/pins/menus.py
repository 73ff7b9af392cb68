"""The menus of pins: of the whole list, and of the rows that are selected."""

from typing import TYPE_CHECKING

from qtpy import QtCore, QtGui, QtWidgets

from ...document.edits import move_source
from ...scene.style import PINS

if TYPE_CHECKING:
    from .dock import PinsDock

COLOURS = ("Green", "Orange", "Violet", "Olive", "Plum", "Slate", "Brown", "Teal", "Blue", "Ochre")


class PinMenu:
    """dock: that of pins, whose edits the menus call; whole: the menu in its head."""

    def __init__(self, dock: "PinsDock") -> None:
        self._dock = dock
        self.whole = QtWidgets.QMenu(dock)
        self.whole.aboutToShow.connect(self._fill_whole)
        self.rows = QtWidgets.QMenu(dock)

    def open_for_rows(self, where: QtCore.QPoint) -> None:
        """At a place of the screen."""
        self.rows.clear()
        self._add_edits(self.rows)
        self.rows.popup(where)

    def _fill_whole(self) -> None:
        dock, menu = self._dock, self.whole
        menu.clear()
        has_pins = bool(dock.places)
        menu.addAction("Read pins…", dock.files.choose_and_read)
        menu.addAction("Save pins…", dock.files.choose_and_save).setEnabled(has_pins)
        menu.addSeparator()
        menu.addAction("Copy the list", dock.copy_list).setEnabled(has_pins)
        menu.addAction("Copy the distances", dock.copy_matrix).setEnabled(len(dock.places) > 1)
        menu.addSeparator()
        positions = menu.addAction("Show positions")
        positions.setCheckable(True)
        positions.setChecked(dock.has_positions)
        positions.toggled.connect(dock.show_positions)
        if dock.table.points:
            menu.addSeparator()
            self._add_edits(menu)
        menu.addSeparator()
        menu.addAction("Remove all pins", self._remove_all).setEnabled(has_pins)

    def _add_edits(self, menu: QtWidgets.QMenu) -> None:
        """Of the rows that are selected."""
        dock = self._dock
        points = dock.table.points
        is_one = len(points) == 1
        menu.addAction("Source here", lambda: self._move_source(points)).setEnabled(is_one)
        menu.addAction("Rename\tF2", dock.table.rename).setEnabled(is_one)
        colours = menu.addMenu("Colour")
        for k, (name, colour) in enumerate(zip(COLOURS, PINS, strict=True)):
            colours.addAction(_disc(colour), name, lambda k=k: dock.recolour(k))
        menu.addAction("Move up\tAlt+Up", lambda: dock.move(-1)).setEnabled(is_one)
        menu.addAction("Move down\tAlt+Down", lambda: dock.move(1)).setEnabled(is_one)
        words = "Remove it\tDel" if is_one else f"Remove {len(points)} pins\tDel"
        menu.addAction(words, lambda: dock.remove(points))

    def _remove_all(self) -> None:
        self._dock.remove([place.point for place in self._dock.places])

    def _move_source(self, points: tuple[str, ...]) -> None:
        """To the one pin among these that is selected, if it is still there, in the active panel."""
        context = self._dock.context
        for place in self._dock.places:
            if points == (place.point,):
                context.edit(move_source(context.document, context.grid.active, place.at))


def _disc(colour: str) -> QtGui.QIcon:
    picture = QtGui.QPixmap(32, 32)
    picture.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(colour))
    painter.drawEllipse(4, 4, 24, 24)
    painter.end()
    return QtGui.QIcon(picture)
