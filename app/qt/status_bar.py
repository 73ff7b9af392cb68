"""The line at the bottom of the window: what is open, what the pointer is at, how far the work is."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui, QtWidgets


class StatusBar(QtWidgets.QStatusBar):
    """Cheap to change: it is here that progress is shown, and not in the panels."""

    cancelled = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        if QtGui.QGuiApplication.platformName() == "xcb":
            # A native window of its own.  As a part of the main window, each change of a word in it would have OpenGL
            # put the whole window together anew: 15 ms in software, and 100 ms while the processors are busy.
            self.setAttribute(QtCore.Qt.WidgetAttribute.WA_DontCreateNativeAncestors)
            self.setAttribute(QtCore.Qt.WidgetAttribute.WA_NativeWindow)
        self.message, self.pointer, self.doing = (QtWidgets.QLabel("") for _ in range(3))
        self.progress = QtWidgets.QProgressBar(maximum=1000, textVisible=False)
        self.progress.setFixedWidth(180)
        self.cancel = QtWidgets.QPushButton("Cancel")
        self.cancel.clicked.connect(lambda: self.cancelled.emit())
        # Long words must not make the window wider; those that do not fit are in the tooltip.
        self.message.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        self.addWidget(self.message, 1)
        self.addWidget(self.pointer)
        for widget in (self.doing, self.progress, self.cancel):
            self.addPermanentWidget(widget)
        self.show_progress(())

    def show_progress(self, going: Sequence[tuple[float, str]]) -> None:
        """All that is going on, each as a share done and a text; the bar shows the mean."""
        self.progress.setVisible(bool(going))
        self.cancel.setVisible(bool(going))
        self.doing.setText("   ·   ".join(dict.fromkeys(f"{text} {fraction:.0%}" for fraction, text in going)))
        if going:
            # Painted at once it would be by itself, and the labels once more after it.
            self.progress.setUpdatesEnabled(False)
            self.progress.setValue(round(1000 * sum(fraction for fraction, _ in going) / len(going)))
            self.progress.setUpdatesEnabled(True)
