"""The line at the bottom of the window: what is open, what the pointer is at, how far the work is."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import Surface

from ..document.page import Recipe
from ..drawing.style import Style


class ElidedLabel(QtWidgets.QLabel):
    """Words that must not make the window wider: what does not fit ends in dots, and all of it is in the tooltip."""

    def __init__(self) -> None:
        super().__init__()
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)

    def setText(self, text: str) -> None:
        super().setText(text)
        self.setToolTip(text)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        words = self.fontMetrics().elidedText(self.text(), QtCore.Qt.TextElideMode.ElideRight, self.width())
        QtGui.QPainter(self).drawText(self.rect(), QtCore.Qt.AlignmentFlag.AlignVCenter, words)


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
        self.message = ElidedLabel()
        self.pointer, self.doing = QtWidgets.QLabel(""), QtWidgets.QLabel("")
        self.progress = QtWidgets.QProgressBar(maximum=1000, textVisible=False)
        self.progress.setFixedWidth(180)
        self.cancel = QtWidgets.QPushButton("Cancel")
        self.cancel.clicked.connect(lambda: self.cancelled.emit())
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


def unseen(recipe: Recipe, style: Style) -> list[str]:
    """What a recipe has that panels do not show."""
    parts = {
        f"views but the first of {len(recipe.views)}": len(recipe.views) > 1,
        "outlines": style.outline,
    }
    words = [word for word, part in parts.items() if part]
    return [f"in figures only: {', '.join(words)}"] if words else []


def summary(surface: Surface) -> list[str]:
    """What the surface has, and what was repaired."""
    words = [f"{len(surface.vertices):,} vertices", f"{len(surface.faces):,} faces"]
    if surface.component_count > 1:
        words.append(f"{surface.component_count} components (grey: not connected to the source)")
    if surface.unreferenced_count:
        words.append(f"{surface.unreferenced_count:,} vertices without a face")
    return [*words, *surface.remarks]
