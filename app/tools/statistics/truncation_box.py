"""The loss of a sum over the first k eigenpairs of the biharmonic distance, with k on a slider."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.truncation import TruncationLoss, truncation_loss
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ...drawing.chart import Axis, Plot
from ...drawing.numbers import progress_words, share
from ...drawing.painters.qt import box_of, paint, rgba_of
from ...drawing.shapes import Pen, disc
from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...qt.look.form import describe, in_column, push_button, quiet_label
from ...qt.look.look import LOOK, smooth_painter
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import DistanceQuestion, Question

MAX_EIGENPAIRS = 200
"""Eigenpairs at most."""

USUAL_EIGENPAIRS = 50

MEAN, LARGEST = "accent", "text"
"""The colours of the curves, as fields of `Theme`."""

CURVE_POINTS = 64
"""Height of the curves, in logical pixels."""


@dataclass(frozen=True)
class _Request:
    loaded: LoadedMesh
    areas: str
    source: Source


def _compute_loss(request: _Request, progress: Progress) -> Iterator[TruncationLoss]:
    laplacian = request.loaded.distances(request.areas).laplacian
    yield truncation_loss(laplacian, request.source, MAX_EIGENPAIRS, progress=progress)


class TruncationBox(QtWidgets.QWidget):
    """Computes once it is asked to, and from then on with every source."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._request: _Request | None = None
        self._wanted: _Request | None = None
        self._is_on = False
        self.loss: TruncationLoss | None = None
        self.button, self.hint = push_button("Compute", self.compute), quiet_label(wraps=True)
        self.slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal, minimum=1, maximum=MAX_EIGENPAIRS)
        self.slider.setValue(USUAL_EIGENPAIRS)
        describe(self.slider, "How many eigenpairs", "How many eigenpairs")
        self.slider.valueChanged.connect(self._show)
        self.curves = LossCurves()
        self.facts = FactTable()
        in_column(self.hint, self.button, self.slider, self.curves, self.facts, of=self, spacing=6)
        self._background = context.background("truncation", _compute_loss, self._take, self._refuse, self._report)
        self._say("")

    def expect(self, loaded: LoadedMesh | None, question: Question | None) -> None:
        """Set the question of the panel that the box is about."""
        self._wanted = None
        if loaded is None or not isinstance(question, DistanceQuestion) or question.spec.word != "biharmonic":
            self._rest("Needs a panel with the biharmonic distance.")
        elif question.at is None:
            self._rest("Needs a source.")
        else:
            before, wanted = self._request, _Request(loaded, question.areas, question.at)
            same = before == wanted
            self._wanted = before if same else wanted
            if self._is_on and not same:
                self.compute()
            elif not self._is_on:
                self._say(f"The loss when only the first k of {MAX_EIGENPAIRS:,} eigenpairs are summed.")
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
        """Show a sentence instead of numbers."""
        self.hint.setText(words)
        has_loss = self.loss is not None and not words
        self.hint.setVisible(bool(words))
        self.button.setVisible(self._wanted is not None and not self._is_on)
        for widget in (self.slider, self.curves, self.facts):
            widget.setVisible(has_loss)

    def _report(self, progress: tuple[float, str] | None) -> None:
        if self.loss is None and progress is not None:
            self.hint.setText(progress_words(*progress))

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
    """Return a fraction with enough digits for small losses."""
    return share(value) if value >= 0.01 else f"{100 * value:.3g} %"


class LossCurves(QtWidgets.QWidget):
    """The mean and the largest loss over k, each by its logarithm, and where k is."""

    def __init__(self) -> None:
        super().__init__()
        self._loss: TruncationLoss | None = None
        self._at = 0
        self.setFixedHeight(CURVE_POINTS)
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
        theme, painter = LOOK.theme, smooth_painter(self)
        logs = [np.log10(np.maximum(each, 1e-16)) for each in (loss.largest, loss.means)]
        low, high = min(each.min() for each in logs), max(each.max() for each in logs)
        across, up = Axis(float(loss.counts[0]), float(loss.counts[-1])), Axis(float(low), float(high))
        plot = Plot(box_of(self.rect().adjusted(5, 5, -5, -5)), across, up)
        x = float(plot.x(loss.counts[self._at]))
        painter.fillRect(QtCore.QRectF(round(x), 0, 1, self.height()), QtGui.QColor(theme.strong))
        for each, field in zip(logs, (LARGEST, MEAN), strict=True):
            colour = rgba_of(getattr(theme, field))
            curve = plot.curve(loss.counts, each, Pen(colour, 1.5))
            paint(painter, [*filter(None, [curve]), disc((x, float(plot.y(each[self._at]))), 3, colour)])
