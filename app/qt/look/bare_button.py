"""The base of buttons that paint themselves."""

from qtpy import QtCore, QtGui, QtWidgets


class BareButton(QtWidgets.QToolButton):
    """A button that is reached by Tab and knows whether to show the pointer and the keyboard focus."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._by_keyboard = False
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)

    @property
    def is_pointed(self) -> bool:
        """Whether the pointer is on it, also while a menu is open, when Qt does not notice that it leaves."""
        return bool(self.underMouse() and self.rect().contains(self.mapFromGlobal(QtGui.QCursor.pos())))

    @property
    def has_keys(self) -> bool:
        """Whether it has the keyboard focus, and got it by the keyboard."""
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
