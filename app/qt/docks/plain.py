"""Tables and scrolled contents that lie on a dock's own ground."""

from qtpy import QtCore, QtWidgets

SHEET = """
QTableWidget { background: transparent; border: none; }
QTableWidget::item { padding: 0px 6px 0px 0px; }
QHeaderView::section:horizontal { padding: 4px 6px 4px 2px; }
QHeaderView::section:vertical { padding: 4px 4px 4px 12px; border: none; }
"""


def lie_on_dock(table: QtWidgets.QTableWidget) -> None:
    """Nothing to type in, no lines, no ground of its own."""
    table.setEditTriggers(QtWidgets.QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setShowGrid(False)
    table.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
    table.setTabKeyNavigation(False)
    table.setStyleSheet(SHEET)
    for header in (table.horizontalHeader(), table.verticalHeader()):
        header.setHighlightSections(False)
        header.setTextElideMode(QtCore.Qt.TextElideMode.ElideRight)


def fill(dock: QtWidgets.QWidget, inside: QtWidgets.QWidget) -> None:
    """Let a widget fill a dock, scrolled where there is no room."""
    scrolled = QtWidgets.QScrollArea()
    scrolled.setWidgetResizable(True)
    scrolled.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    scrolled.setWidget(inside)
    for widget in (inside, scrolled.viewport()):
        widget.setAutoFillBackground(False)
    whole = QtWidgets.QVBoxLayout(dock)
    whole.setContentsMargins(0, 0, 0, 0)
    whole.addWidget(scrolled)
