"""A button that paints itself: whether the pointer is on it, and whether the keys are, and were brought by keyboard."""

from qtpy import QtCore, QtGui, QtWidgets


class BareButton(QtWidgets.QToolButton):
    """Reached by Tab; is_pointed, has_keys: what its painting asks."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._by_keyboard = False
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)

    @property
    def is_pointed(self) -> bool:
        """Whether the pointer is on it; while a menu is open Qt does not notice that it leaves."""
        return bool(self.underMouse() and self.rect().contains(self.mapFromGlobal(QtGui.QCursor.pos())))

    @property
    def has_keys(self) -> bool:
        """Whether the keys are here, and somebody who uses them has brought them."""
        return self._by_keyboard and self.hasFocus()

    def setMenu(self, menu: QtWidgets.QMenu) -> None:
        super().setMenu(menu)
        menu.aboutToHide.connect(self.update)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        reasons = QtCore.Qt.FocusReason
        # A menu or a window that closes gives the focus back, however it was opened.
        if event.reason() not in (reasons.PopupFocusReason, reasons.ActiveWindowFocusReason):
            self._by_keyboard = event.reason() != reasons.MouseFocusReason
        super().focusInEvent(event)
