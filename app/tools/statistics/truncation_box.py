"""What a sum over the first k eigenpairs loses of the biharmonic distance, with k on a slider."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.truncation import TruncationLoss, truncation_loss
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...qt.look.look import LOOK
from ...qt.look.numbers import share
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import DistanceQuestion, Question

MOST = 200
"""Eigenpairs at most."""

FIRST = 50

MEAN, LARGEST = "accent", "text"
"""The colours of the curves, as fields of `Theme`."""

CURVES = 64
"""Height of the curves, in logical pixels."""


@dataclass(frozen=True)
class _Request:
    loaded: LoadedMesh
    areas: str
    source: Source


def _lost(request: _Request, progress: Progress) -> Iterator[TruncationLoss]:
    laplacian = request.loaded.distances(request.areas).laplacian
    yield truncation_loss(laplacian, request.source, MOST, progress=progress)


class TruncationBox(QtWidgets.QWidget):
    """Computes once it is asked to, and from then on with every source."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._request: _Request | None = None
        self._wanted: _Request | None = None
        self._is_on = False
        self.loss: TruncationLoss | None = None
        self.button = QtWidgets.QPushButton("Compute", autoDefault=False)
        self.button.clicked.connect(self.compute)
        self.hint = QtWidgets.QLabel(wordWrap=True)
        self.hint.setProperty("quiet", True)
        self.slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal)
        self.slider.setRange(1, MOST)
        self.slider.setValue(FIRST)
        self.slider.setAccessibleName("How many eigenpairs")
        self.slider.setToolTip("How many eigenpairs")
        self.slider.valueChanged.connect(self._show)
        self.curves = LossCurves()
        self.facts = FactTable()
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (self.hint, self.button, self.slider, self.curves, self.facts):
            column.addWidget(widget)
        self._background = context.background("truncation", _lost)
        self._background.answered.connect(self._take)
        self._background.failed.connect(self._refuse)
        self._background.progressed.connect(self._report)
        self._say("")

    def expect(self, loaded: LoadedMesh | None, question: Question | None) -> None:
        """The question of the panel that it is about."""
        self._wanted = None
        if loaded is None or not isinstance(question, DistanceQuestion) or question.spec.word != "biharmonic":
            self._rest("For a panel with the biharmonic distance.")
        elif question.at is None:
            self._rest("For a source that is there.")
        else:
            before, wanted = self._request, _Request(loaded, question.areas, question.at)
            same = before == wanted
            self._wanted = before if same else wanted
            if self._is_on and not same:
                self.compute()
            elif not self._is_on:
                self._say(f"How much is lost where only the first k of {MOST:,} eigenpairs are summed.")
            elif same:
                self._show()

    def compute(self) -> None:
        """Compute the error of truncation for growing numbers of eigenpairs."""
        if self._wanted is None:
            return
        self._is_on, self._request = True, self._wanted
        self._background.ask(self._request)
        if self.loss is None:
            self._say("Eigenpairs…")

    def _rest(self, words: str) -> None:
        self._background.ask(None)
        self._request = self.loss = None
        self._say(words)

    def _say(self, words: str) -> None:
        """Instead of numbers."""
        self.hint.setText(words)
        has_loss = self.loss is not None and not words
        self.hint.setVisible(bool(words))
        self.button.setVisible(self._wanted is not None and not self._is_on)
        for widget in (self.slider, self.curves, self.facts):
            widget.setVisible(has_loss)

    def _report(self, progress: tuple[float, str] | None) -> None:
        if self.loss is None and progress is not None:
            self.hint.setText(f"{progress[1][:1].upper()}{progress[1][1:]}, {progress[0]:.0%}".replace("%", " %"))

    def _refuse(self, request: object, sentence: str) -> None:
        self.loss = None
        self._say(sentence)

    def _take(self, request: _Request, loss: TruncationLoss) -> None:
        self.loss = loss
        self.slider.setMaximum(int(loss.counts[-1]))
        self._say("")
        self._show()

    def _show(self, *_: object) -> None:
        loss = self.loss
        if loss is None:
            return
        at = int(np.clip(np.searchsorted(loss.counts, self.slider.value()), 0, len(loss.counts) - 1))
        self.facts.show_facts(
            [
                ("eigenpairs", str(int(loss.counts[at]))),
                ("mean loss, by area", share_of_loss(float(loss.means[at]))),
                (f"largest, at vertex {int(loss.at[at])}", share_of_loss(float(loss.largest[at]))),
            ],
            {1: MEAN, 2: LARGEST},
        )
        self.curves.show_loss(loss, at)


def share_of_loss(value: float) -> str:
    """With enough digits for little."""
    return share(value) if value >= 0.01 else f"{100 * value:.3g} %"


class LossCurves(QtWidgets.QWidget):
    """The mean and the largest loss over k, each by its logarithm, and where k is."""

    def __init__(self) -> None:
        super().__init__()
        self._loss: TruncationLoss | None = None
        self._at = 0
        self.setFixedHeight(CURVES)
        self.setAccessibleName("Loss over the number of eigenpairs")
        self.setToolTip("Largest (above) and mean loss over the number of eigenpairs, on a logarithmic scale")
        LOOK.follow(self, self.update)

    def show_loss(self, loss: TruncationLoss, at: int) -> None:
        """Show the curves, and mark the number of eigenpairs `at`."""
        self._loss, self._at = loss, at
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        loss = self._loss
        if loss is None or len(loss.counts) < 2:
            return
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        logs = [np.log10(np.maximum(each, 1e-16)) for each in (loss.largest, loss.means)]
        low, high = min(each.min() for each in logs), max(each.max() for each in logs)
        area = QtCore.QRectF(self.rect()).adjusted(5, 5, -5, -5)
        x = area.left() + (loss.counts - loss.counts[0]) / (loss.counts[-1] - loss.counts[0]) * area.width()
        painter.fillRect(QtCore.QRectF(round(float(x[self._at])), 0, 1, self.height()), QtGui.QColor(theme.strong))
        for each, colour in zip(logs, (getattr(theme, LARGEST), getattr(theme, MEAN)), strict=True):
            y = area.bottom() - (each - low) / ((high - low) or 1) * area.height()
            line = QtGui.QPolygonF([QtCore.QPointF(*place) for place in zip(x.tolist(), y.tolist(), strict=True)])
            painter.setPen(QtGui.QPen(QtGui.QColor(colour), 1.5))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawPolyline(line)
            painter.setBrush(QtGui.QColor(colour))
            painter.drawEllipse(line[self._at], 3, 3)
