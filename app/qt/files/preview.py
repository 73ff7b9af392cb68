"""Previews of figures, drawn by a process that stays alive, while the window goes on."""

import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.arrays import AnyArray
from bihdist_core.distances.answers import failure_in_words

from ...figures.worker import GONE, Worker
from ..look.look import LOOK

DIM = 0.35
"""Opacity of an outdated picture."""

SQUARE = 8
"""Side of the squares that show transparency, in pixels."""


class PreviewRenderer(QtCore.QObject):
    """Draws pictures one after the other in another process; of those that wait only the last of each kind is drawn.

    `answered` is emitted with the number of what was asked and the result, `refused` with it and a sentence; `dropped`
    with that of what nobody waits for any more.
    """

    dropped = QtCore.Signal(int)
    answered = QtCore.Signal(int, object)
    refused = QtCore.Signal(int, str)

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._asked: dict[str, tuple[int, Callable[..., Any], tuple[Any, ...]]] = {}
        self._number, self._is_closed = 0, False
        self._change = threading.Condition()
        self._worker: Worker | None = None
        self._thread: threading.Thread | None = None

    def ask(self, kind: str, function: Callable[..., Any], *arguments: Any) -> int:
        """Have a function called in the process, and return the number of the request.

        What was asked before of this kind, and has not begun, is dropped.
        """
        with self._change:
            if kind in self._asked:
                self.dropped.emit(self._asked[kind][0])
            self._number += 1
            self._asked[kind] = (self._number, function, arguments)
            if self._thread is None and not self._is_closed:
                self._thread = threading.Thread(target=self._work, name="preview", daemon=True)
                self._thread.start()
            self._change.notify()
            return self._number

    def close(self) -> None:
        """End the process, even while it draws."""
        with self._change:
            self._is_closed = True
            self._change.notify()
            worker = self._worker
        if worker is not None:
            worker.close()
        if self._thread is not None:
            self._thread.join(5)

    def _work(self) -> None:
        while True:
            with self._change:
                while not self._asked and not self._is_closed:
                    self._change.wait()
                if self._is_closed:
                    return
                number, function, arguments = self._asked.pop(next(iter(self._asked)))
            try:
                result, sentence = self._made(function, arguments), ""
            except BihdistError as error:
                result, sentence = None, str(error)
            except OSError as error:
                result, sentence = None, f"Cannot draw in the background: {error.strerror or error}."
            except Exception as error:
                result, sentence = None, failure_in_words(error)
            with self._change:
                if self._is_closed:
                    return
                with suppress(RuntimeError):  # the window is gone
                    if sentence:
                        self.refused.emit(number, sentence)
                    else:
                        self.answered.emit(number, result)

    def _made(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        with self._change:
            if self._worker is None:
                self._worker = Worker()
        try:
            return self._worker.ask(function, *arguments)
        except BihdistError as error:
            if str(error) == GONE:
                self._worker.close()
                self._worker = None  # the next question starts another one
            raise


class PreviewPane(QtWidgets.QWidget):
    """A picture in the middle of a ground, with a line under it, and a thin one above while a new one is drawn.

    `resized` is emitted when a picture of another size would fit.
    """

    resized = QtCore.Signal()
    MARGIN, LINE = 24, 40

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(260, 200)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Expanding)
        self.setAccessibleName("Preview of the figure")
        self.image = self._small = QtGui.QImage()
        self.caption, self.is_warning = "", False
        self.is_true = self.is_waiting = False  # the picture; whether another one is on its way
        LOOK.follow(self, self.update)

    def room(self) -> tuple[int, int]:
        """Return the largest size of a picture, in device pixels."""
        scale = self.devicePixelRatioF()
        width, height = self.width() - 2 * self.MARGIN, self.height() - 2 * self.MARGIN - self.LINE
        return max(round(width * scale), 64), max(round(height * scale), 64)

    def wait(self) -> None:
        """Show the picture as outdated."""
        self.is_true, self.is_waiting = False, True
        self.update()

    def show_late(self, pixels: AnyArray) -> None:
        """Show a picture of an earlier choice, while the next is drawn."""
        self.image, self._small = image_of(pixels), QtGui.QImage()
        self.say("", False)
        self.is_waiting = True

    def show_picture(self, pixels: AnyArray, caption: str, is_warning: bool) -> None:
        """Show pixels (height, width, 3) with a caption."""
        self.image, self.is_true = image_of(pixels), True
        self._small = QtGui.QImage()
        self.say(caption, is_warning)

    def say(self, caption: str, is_warning: bool) -> None:
        """Show another caption under the picture that is there."""
        self.caption, self.is_warning, self.is_waiting = caption, is_warning, False
        self.setAccessibleDescription(caption)
        self.update()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.resized.emit()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), QtGui.QColor(theme.hover))
        box = self._box()
        if not self.image.isNull():
            if self.image.hasAlphaChannel():
                _paint_squares(painter, box)
            painter.setOpacity(1.0 if self.is_true else DIM)
            painter.drawImage(box, self._smaller(box.size() * self.devicePixelRatioF()))
            painter.setOpacity(1.0)
        painter.setPen(QtGui.QColor(theme.warning if self.is_warning else theme.quiet))
        painter.setFont(LOOK.font(12.5))
        line = QtCore.QRect(self.MARGIN, box.bottom() + 10, self.width() - 2 * self.MARGIN, self.LINE + 12)
        words = self.caption or ("Drawing…" if self.is_waiting else "")
        flags = QtCore.Qt.AlignmentFlag.AlignHCenter | QtCore.Qt.AlignmentFlag.AlignTop
        painter.drawText(line, int(flags) | int(QtCore.Qt.TextFlag.TextWordWrap), words)
        if self.is_waiting:
            painter.fillRect(QtCore.QRect(0, 0, self.width(), 2), QtGui.QColor(theme.accent))

    def _smaller(self, size: QtCore.QSize) -> QtGui.QImage:
        """Return the picture scaled to a size in device pixels."""
        if self._small.size() != size:
            modes = QtCore.Qt
            self._small = self.image.scaled(
                size, modes.AspectRatioMode.IgnoreAspectRatio, modes.TransformationMode.SmoothTransformation
            )
        return self._small

    def _box(self) -> QtCore.QRect:
        """Return the rectangle of the picture, in logical pixels."""
        wide, high = (side / self.devicePixelRatioF() for side in self.room())
        if self.image.isNull():
            return QtCore.QRect(self.MARGIN, round((self.height() - self.LINE) / 2), round(wide), 0)
        share = min(wide / self.image.width(), high / self.image.height())
        width, height = round(self.image.width() * share), round(self.image.height() * share)
        return QtCore.QRect((self.width() - width) // 2, (self.height() - self.LINE - height) // 2, width, height)


def image_of(pixels: AnyArray) -> QtGui.QImage:
    """Return pixels (height, width, 3 or 4) uint8 as an image that owns its memory."""
    height, width, channels = pixels.shape
    kinds = QtGui.QImage.Format
    kind = kinds.Format_RGBA8888 if channels == 4 else kinds.Format_RGB888
    pixels = np.ascontiguousarray(pixels)
    return QtGui.QImage(pixels.data, width, height, channels * width, kind).copy()


def _paint_squares(painter: QtGui.QPainter, box: QtCore.QRect) -> None:
    painter.fillRect(box, QtGui.QColor("#FFFFFF"))
    painter.save()
    painter.setClipRect(box)
    for row, y in enumerate(range(box.top(), box.bottom() + 1, SQUARE)):
        for x in range(box.left() + SQUARE * (row % 2), box.right() + 1, 2 * SQUARE):
            painter.fillRect(x, y, SQUARE, SQUARE, QtGui.QColor("#E4E7EA"))
    painter.restore()
