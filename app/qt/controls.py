"""The controls over a panel: which distance, and the parameter it has."""

from dataclasses import replace

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core.distances.geodesic import METHODS

from ..state import DISTANCES, PAPER_TIMES, PanelState

NAMES = {
    "biharmonic": "Biharmonic",
    "truncated": "Biharmonic, truncated",
    "power": "1/λ^α family",
    "commute-time": "Commute-time",
    "diffusion": "Diffusion",
    "geodesic": "Geodesic",
}

STEPS = 240
"""Positions of the slider for t, equal in log t from the paper's smallest to its largest time."""


class PanelControls(QtWidgets.QWidget):
    """Emits `changed(PanelState)` for each choice."""

    changed = QtCore.Signal(object)

    def __init__(self, state: PanelState, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)
        self.state = state
        self.distance = QtWidgets.QComboBox(self)
        for word in DISTANCES:
            self.distance.addItem(NAMES[word], word)
        self.distance.setToolTip("The distance this panel shows")
        self.method = QtWidgets.QComboBox(self)
        for word in METHODS:
            self.method.addItem(word, word)
        self.method.setToolTip("How geodesic distance is computed; auto: exact up to 20,000 vertices, else heat")
        self.time = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal, self)
        self.time.setRange(0, STEPS)
        self.time.setToolTip("Diffusion time t, from the paper's 1/15 to 4")
        self.time_label = QtWidgets.QLabel(self)
        self.pairs = QtWidgets.QSpinBox(self)
        self.pairs.setRange(1, 2000)
        self.pairs.setPrefix("k = ")
        self.pairs.setKeyboardTracking(False)
        self.pairs.setToolTip("How many eigenpairs")
        self.alpha = QtWidgets.QDoubleSpinBox(self)
        self.alpha.setRange(1.05, 8)
        self.alpha.setSingleStep(0.25)
        self.alpha.setPrefix("α = ")
        self.alpha.setKeyboardTracking(False)
        self.alpha.setToolTip("The power of 1/λ")
        layout = QtWidgets.QHBoxLayout(self)
        layout.setContentsMargins(8, 6, 8, 2)
        layout.addWidget(self.distance)
        layout.addWidget(self.method)
        layout.addWidget(self.time, 1)
        layout.addWidget(self.time_label)
        layout.addWidget(self.pairs)
        layout.addWidget(self.alpha)
        layout.addStretch(0)
        self.show_state(state)
        self.distance.currentIndexChanged.connect(lambda: self._choose(distance=self.distance.currentData()))
        self.method.currentIndexChanged.connect(lambda: self._choose(method=self.method.currentData()))
        self.time.valueChanged.connect(lambda step: self._choose(t=time_of_step(step)))
        self.pairs.valueChanged.connect(lambda k: self._choose(k=k))
        self.alpha.valueChanged.connect(lambda alpha: self._choose(alpha=alpha))

    def show_state(self, state: PanelState) -> None:
        """Make the controls say what the state says, without emitting."""
        self.state = state
        for widget, index in [
            (self.distance, self.distance.findData(state.distance)),
            (self.method, self.method.findData(state.method)),
        ]:
            with QtCore.QSignalBlocker(widget):
                widget.setCurrentIndex(index)
        for widget, value in [(self.time, step_of_time(state.t)), (self.pairs, state.k), (self.alpha, state.alpha)]:
            with QtCore.QSignalBlocker(widget):
                widget.setValue(value)
        self.time_label.setText(f"t = {_plain(state.t)}")
        self.method.setVisible(state.distance == "geodesic")
        for widget in (self.time, self.time_label):
            widget.setVisible(state.distance == "diffusion")
        self.pairs.setVisible(state.distance in ("truncated", "power"))
        self.alpha.setVisible(state.distance == "power")

    def _choose(self, **choice: object) -> None:
        self.show_state(replace(self.state, **choice))
        self.changed.emit(self.state)


def time_of_step(step: int) -> float:
    """The time at a slider position; the paper's own times where they are within half a step."""
    low, high = np.log(PAPER_TIMES[0]), np.log(PAPER_TIMES[-1])
    for t in PAPER_TIMES:
        if step_of_time(t) == step:
            return t
    return float(f"{np.exp(low + (high - low) * step / STEPS):.3g}")


def step_of_time(t: float) -> int:
    low, high = np.log(PAPER_TIMES[0]), np.log(PAPER_TIMES[-1])
    return round(STEPS * (np.log(t) - low) / (high - low))


def _plain(t: float) -> str:
    """The paper's times as it writes them."""
    return next((f"1/{n}" for n in (15, 8, 4) if abs(t - 1 / n) < 1e-12), f"{t:.3g}")
