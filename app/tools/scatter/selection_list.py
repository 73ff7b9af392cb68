"""The list of a document's selections: renamed, coloured, saved and deleted in it."""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.selecting import SELECTION_WAYS, write_selection
from bihdist_core.applications.changes import count_of

from ...document.document import Document
from ...document.file_names import file_name
from ...document.runs import ids_of
from ...document.shared_parts.selections import Selection, Selections, change_selection, select
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.files.saving import save
from ...qt.look.look import LOOK
from ...qt.panels.badges import add_colours, disc_icon
from ...scene.style import PINS

WAYS = {"ids": "Save vertex ids…", "field": "Save as a field…", "mesh": "Save the cut-out mesh…"}


class SelectionList(QtWidgets.QTreeWidget):
    """`chosen` is emitted with the name of the selection that the user has clicked on."""

    chosen = QtCore.Signal(str)

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._shown: tuple[Selection, ...] = ()
        self._is_filling = False
        self.setColumnCount(2)
        self.setHeaderHidden(True)
        self.setRootIsDecorated(False)
        self.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        self.setAccessibleName("Selections")
        self.setToolTip("Double click to rename, right click to colour, save or delete")
        trigger = QtWidgets.QAbstractItemView.EditTrigger
        self.setEditTriggers(trigger.DoubleClicked | trigger.EditKeyPressed)
        header = self.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(24)
        header.setSectionResizeMode(0, QtWidgets.QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QtWidgets.QHeaderView.ResizeMode.ResizeToContents)
        self.setContextMenuPolicy(QtCore.Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._open_menu)
        self.itemChanged.connect(self._rename)
        self.currentItemChanged.connect(self._choose)

    # ------------------------------------------------------------------ what is shown
    def show_selections(self, selections: tuple[Selection, ...], current: str) -> None:
        """Show the selections, and which of them the brush changes."""
        self._is_filling = True
        if selections != self._shown:
            self._shown = selections
            self.clear()
            for each in selections:
                item = QtWidgets.QTreeWidgetItem([each.name, f"{count_of(each.runs):,}"])
                item.setData(0, QtCore.Qt.ItemDataRole.UserRole, each.name)
                item.setIcon(0, disc_icon(PINS[each.colour]))
                item.setFlags(item.flags() | QtCore.Qt.ItemFlag.ItemIsEditable)
                right = int(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
                item.setData(1, QtCore.Qt.ItemDataRole.TextAlignmentRole, right)
                item.setForeground(1, QtGui.QColor(LOOK.theme.quiet))
                self.addTopLevelItem(item)
        names = [each.name for each in selections]
        self.setCurrentItem(self.topLevelItem(names.index(current)) if current in names else None)
        self._is_filling = False

    @property
    def current(self) -> str:
        """The name of the chosen selection."""
        item = self.currentItem()
        return "" if item is None else item.data(0, QtCore.Qt.ItemDataRole.UserRole)

    # ------------------------------------------------------------------ what the user does
    def _choose(self, *_: object) -> None:
        if not self._is_filling:
            self.chosen.emit(self.current)

    def _rename(self, item: QtWidgets.QTreeWidgetItem, column: int) -> None:
        if self._is_filling:
            return
        old, new = item.data(0, QtCore.Qt.ItemDataRole.UserRole), item.text(0)
        document = self._document
        with self._context.errors_shown():
            document = change_selection(document, old, new_name=new)
        self._shown = ()  # what was typed is not what is shown
        # The editor is still closing.
        QtCore.QTimer.singleShot(0, lambda: self._show_renamed(document, new.strip()))

    def _show_renamed(self, document: Document, name: str) -> None:
        is_current = name in [each.name for each in document[Selections].selections]
        self._context[Brushing].choose(name if is_current else "")
        self._context.session.show(document)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in (QtCore.Qt.Key.Key_Delete, QtCore.Qt.Key.Key_Backspace) and self.current:
            self.delete()
        else:
            super().keyPressEvent(event)

    def delete(self) -> None:
        """Delete the chosen selection."""
        if self.current:
            self._context.session.show(select(self._document, self.current, np.empty(0, np.int64)))

    def recolour(self, colour: int) -> None:
        """Give the selection that the brush changes another colour."""
        if self.current:
            self._context.session.show(change_selection(self._document, self.current, colour=colour))

    def save(self, way: str, path: str = "") -> None:
        """Save the chosen selection as one of SELECTION_WAYS; ask for a path if there is none."""
        found = [each for each in self._document[Selections].selections if each.name == self.current]
        loaded = self._context.session.loaded()
        if not found or loaded is None:
            return
        (selection,) = found

        def write(path: str) -> None:
            write_selection(path, loaded.surface, ids_of(selection.runs), way, selection.name)

        name = file_name([loaded.surface.name], "selection", selection.name)
        save(self._context, WAYS[way].removesuffix("…"), name, SELECTION_WAYS[way], write, path)

    @property
    def _document(self) -> Document:
        return self._context.document

    def menu(self) -> QtWidgets.QMenu:
        """Return the menu of the chosen selection."""
        menu = QtWidgets.QMenu(self)
        for way, text in WAYS.items():
            menu.addAction(text, lambda way=way: self.save(way))
        menu.addSeparator()
        add_colours(menu, self.recolour)
        menu.addAction("Rename\tF2", lambda: self.editItem(self.currentItem(), 0))
        menu.addAction("Delete\tDel", self.delete)
        menu.aboutToHide.connect(menu.deleteLater)
        return menu

    def _open_menu(self, at: QtCore.QPoint) -> None:
        if self.itemAt(at) is not None:
            self.setCurrentItem(self.itemAt(at))
            self.menu().popup(self.viewport().mapToGlobal(at))
