"""Under the list of pins: how far they are from each other, by a distance that is chosen."""

from collections.abc import Sequence
from dataclasses import replace
from html import escape

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.kinds import Spec
from bihdist_core.sources.source import Source

from ...document.document import Document
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.look.look import LOOK
from ...qt.look.numbers import number
from ...qt.panels.flat_button import FlatButton
from ...qt.panels.quantity_menu import offered_kinds
from ...scene.style import PINS
from .locations import LocatedPin
from .matrix import PinMatrix
from .pairwise_distances import PairwiseDistances
from .part import PinsListing

PAD = 12
MOST_COMPARED = 40
"""Pins up to which the distances of all panels are computed, and not only those that are shown."""


class PinDistances(QtWidgets.QWidget):
    """Computed in the background; hidden where there are not two pins."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self._places: tuple[LocatedPin, ...] = ()
        self.spec = self._specs(context.document)[0]
        self._among = PairwiseDistances(context.post, self._show_among)
        heading = QtWidgets.QLabel("Distances among pins")
        heading.setProperty("heading", True)
        self.distance = FlatButton(self, quiet=True)
        self.distance.setToolTip("Which distance")
        self.distance.setMenu(QtWidgets.QMenu(self))
        self.distance.menu().aboutToShow.connect(self._fill_menu)
        self.cells = PinMatrix()
        self.cells.hovered.connect(self._say_pair)
        self._scroll = QtWidgets.QScrollArea(frameShape=QtWidgets.QFrame.Shape.NoFrame)
        self._scroll.setWidget(self.cells)
        for widget in (self._scroll.viewport(), self.cells):
            widget.setAutoFillBackground(False)  # the dock's ground
        self._scroll.viewport().installEventFilter(self)
        self._scroll.setMinimumHeight(80)
        self._scroll.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Expanding)
        self._scroll.setCornerWidget(QtWidgets.QWidget())
        self.line = QtWidgets.QLabel(wordWrap=True)
        self.line.setProperty("quiet", True)
        self.line.setTextFormat(QtCore.Qt.TextFormat.RichText)
        self.line.setContentsMargins(PAD, 4, PAD, 8)
        head = QtWidgets.QHBoxLayout()
        head.setContentsMargins(PAD, 6, 8, 2)
        head.addWidget(heading)
        head.addStretch(1)
        head.addWidget(self.distance)
        around = QtWidgets.QHBoxLayout()
        around.setContentsMargins(PAD - 6, 0, PAD, 0)
        around.addWidget(self._scroll)
        column = QtWidgets.QVBoxLayout(self, spacing=0)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(head)
        column.addLayout(around, 1)
        column.addWidget(self.line)
        column.addStretch(0)
        LOOK.follow(self, self._fit)

    def show_pins(self, document: Document, places: Sequence[LocatedPin]) -> None:
        """By a distance of the panels unless another has been chosen."""
        self._places = tuple(places)
        self.setVisible(len(self._places) > 1)
        self.spec = document[PinsListing].distance or self._specs(document)[0]
        self._ask()

    def end(self) -> None:
        """End the thread."""
        self._among.close()

    @property
    def _at(self) -> list[Source]:
        return [place.at for place in self._places]

    @property
    def is_known(self) -> bool:
        """Whether the distances among the pins are there."""
        return self.matrix() is not None

    def matrix(self) -> FloatArray | None:
        """(k, k) what is shown; None as long as it is not known."""
        return self.known(self.spec)

    def _specs(self, document: Document) -> list[Spec]:
        """Those of the panels, and if there are none those that there are."""
        found = list(dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs))
        return found or [Spec.of(kind.word) for kind in offered_kinds()]

    def _fill_menu(self) -> None:
        menu = self.distance.menu()
        menu.clear()
        shown = self._specs(self.context.document)
        words = {spec.word for spec in shown}
        for spec in (*shown, None, *(Spec.of(kind.word) for kind in offered_kinds() if kind.word not in words)):
            if spec is None:
                menu.addSeparator()
                continue
            action = menu.addAction(spec_name(spec, shown))
            action.setCheckable(True)
            action.setChecked(spec == self.spec)
            action.triggered.connect(lambda *_, spec=spec: self.choose_distance(spec))

    def choose_distance(self, spec: Spec) -> None:
        """Whose distances among pins are shown."""
        session = self.context.session
        document = session.document
        session.show(document.with_part(replace(document[PinsListing], distance=spec)))

    @property
    def _compared(self) -> list[Spec]:
        """The one that is shown, and those of the panels."""
        others = self._specs(self.context.document) if len(self._at) <= MOST_COMPARED else []
        return list(dict.fromkeys([self.spec, *others]))

    def _ask(self) -> None:
        session = self.context.session
        self._among.ask(session.mesh(), session.document.areas, self._compared, self._at)
        self._show_among()

    def _show_among(self) -> None:
        matrix = self.known(self.spec)
        document = self.context.document
        self.distance.setText(spec_name(self.spec, self._specs(document)))
        self.distance.updateGeometry()
        pins = [(place.number, PINS[place.pin.colour]) for place in self._places]
        self.cells.show_matrix(pins, matrix)
        self._fit()
        self._say_pair(*self.cells.cell)

    def known(self, spec: Spec) -> AnyArray | None:
        """(k, k) the distances among the pins; None as long as they are not known."""
        session = self.context.session
        loaded = session.loaded()
        if loaded is None:
            return None
        return self._among.matrix(loaded, session.document.areas, spec, self._at)

    def _say_pair(self, i: int, j: int) -> None:
        """Under the matrix: the pair under the pointer in all distances that are known; otherwise the unit."""
        session = self.context.session
        loaded, areas = session.loaded(), session.document.areas
        places = self._places
        if loaded is None:
            return
        if i >= 0 and max(i, j) < len(places):
            parts = [f"{escape(places[i].name)} to {escape(places[j].name)}"]
            specs = self._compared
            for spec in specs:
                matrix = self.known(spec)
                if matrix is not None:
                    value = "not connected" if np.isnan(matrix[i, j]) else number(float(matrix[i, j]))
                    parts.append(f"{escape(spec_name(spec, specs).lower())}&nbsp;<b>{value}</b>")
            self.line.setText("&nbsp;&nbsp; ".join(parts))
            return
        failure, progress = self._among.failure(loaded, areas, self.spec), self._among.progress
        if failure:
            self.line.setText(escape(failure))
        elif self.known(self.spec) is None and progress is not None:
            self.line.setText(f"{progress[1][:1].upper()}{progress[1][1:]}, {progress[0]:.0%}".replace("%", " %"))
        else:
            unit = self._among.unit(loaded, areas, self.spec)
            self.line.setText(f"in {unit}" if unit else "")

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.Resize:
            self._fit()
        return bool(super().eventFilter(watched, event))

    def _fit(self) -> None:
        """Cells as wide as there is room for, and the line close under them."""
        self.cells.fit_into(self._scroll.viewport().width())
        is_wide = self.cells.width() > self._scroll.viewport().width()
        bar = self._scroll.horizontalScrollBar().sizeHint().height() if is_wide else 0
        self._scroll.setMaximumHeight(max(self.cells.height() + bar, self._scroll.minimumHeight()))


def spec_name(spec: Spec, among: Sequence[Spec]) -> str:
    """As short as it is told apart from the others."""
    return str(spec) if sum(other.word == spec.word for other in among) > 1 else kind_name(spec.kind)
