"""Under the list of pins: how far they are from each other, by a distance that is chosen."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, Cancelled
from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document
from ...document.quantities import kind_name
from ...drawing.numbers import number, progress_words
from ...qt.context import Context
from ...qt.look.form import heading, in_column, in_row, quiet_label
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import add_entry, menu_button
from ...qt.panels.quantity_menu import offered_kinds
from ...scene.style import PINS
from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh
from .locations import LocatedPin
from .matrix import PinMatrix
from .part import PinsListing

SOURCES_PER_BLOCK = 8
"""Sources between two places where the work can be given up."""


@dataclass(frozen=True, eq=False)
class _Known:
    """The distances (k, k) among k places, and their unit."""

    places: tuple[Source, ...]
    matrix: FloatArray
    unit: str


@dataclass(frozen=True)
class _Request:
    loaded: LoadedMesh
    areas: str
    specs: tuple[Spec, ...]
    places: tuple[Source, ...]

    def has_operators_of(self, other: "_Request | None") -> bool:
        """Return whether another request is for the same surface and vertex areas."""
        return other is not None and (self.loaded, self.areas) == (other.loaded, other.areas)


class PairwiseDistances:
    """`changed()` is called, by `post`, when what is known of the latest request, or `progress`, is something new."""

    def __init__(self, post: Callable[[Callable[[], None]], None], changed: Callable[[], None]) -> None:
        self._post, self._changed = post, changed
        self._known: dict[Spec, _Known] = {}
        self._failures: dict[Spec, str] = {}
        self._asked: _Request | None = None
        self.progress: tuple[float, str] | None = None
        self._worker: LatestRequestWorker[_Request] = LatestRequestWorker("among", self._work, self._report, self._fail)

    def ask(self, loaded: LoadedMesh, areas: str, specs: Sequence[Spec], places: Sequence[Source]) -> None:
        """Ask for the distances among these places only, by the first of the specs first."""
        old, asked = self._asked, _Request(loaded, areas, tuple(dict.fromkeys(specs)), tuple(places))
        self._asked = asked
        if not asked.has_operators_of(old):
            self._known, self._failures = {}, {}
        missing = [spec for spec in asked.specs if spec not in self._failures and self.matrix(spec) is None]
        if not missing or len(places) < 2:
            self._worker.submit(None)
        elif old != asked or self.progress is None:
            self._worker.submit(asked)

    def matrix(self, spec: Spec) -> FloatArray | None:
        """Return the distances (k, k) among the k places, NaN between components; None as long as they are not
        known."""
        known = self._known.get(spec)
        if known is None or self._asked is None:
            return None
        rows = _rows_in(known.places, self._asked.places)
        return None if (rows < 0).any() else known.matrix[np.ix_(rows, rows)]

    def unit(self, spec: Spec) -> str:
        """Return the unit of the distances, "" as long as none are known."""
        known = self._known.get(spec)
        return "" if known is None else known.unit

    def failure(self, spec: Spec) -> str:
        """Return the reason why there are no distances, in a sentence, "" for none."""
        return self._failures.get(spec, "")

    def close(self) -> None:
        """Stop the work, and the thread."""
        self._worker.close()

    # ------------------------------------------------------------------ in the background
    def _work(self, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        progress = worker.progress(lambda latest: latest == request)
        for k, spec in enumerate(request.specs):
            known = self._known.get(spec) if request.has_operators_of(self._asked) else None
            share = part(progress, k / len(request.specs), (k + 1) / len(request.specs))
            try:
                distance = request.loaded.distances(request.areas).get(spec, part(share, 0, 0.5))
                matrix = distances_among(distance, request.places, known, part(share, 0.5, 1))
            except Cancelled:
                raise
            except (BihdistError, MemoryError) as error:
                self._post(partial(self._refuse, request, spec, error))
            else:
                self._post(partial(self._take, request, spec, _Known(request.places, matrix, distance.unit)))

    def _take(self, request: _Request, spec: Spec, found: _Known) -> None:
        if request.has_operators_of(self._asked):
            self._known[spec] = found
            self._changed()

    def _refuse(self, request: _Request, spec: Spec, error: Exception) -> None:
        if request.has_operators_of(self._asked):
            self._failures[spec] = failure_in_words(error)
            self._changed()

    def _fail(self, request: _Request, error: Exception) -> None:
        for spec in request.specs:
            self._post(partial(self._refuse, request, spec, error))

    def _report(self, fraction: float | None, text: str) -> None:
        def note() -> None:
            self.progress = None if fraction is None else (fraction, text)
            self._changed()

        self._post(note)


def distances_among(
    distance: Distance, places: Sequence[Source], known: _Known | None, progress: Progress
) -> FloatArray:
    """Return the distances (k, k) among places, without computing again what is known."""
    count = len(places)
    matrix, rows = np.full((count, count), np.nan), np.full(count, -1)
    if known is not None:
        rows = _rows_in(known.places, places)
        old = np.flatnonzero(rows >= 0)
        matrix[np.ix_(old, old)] = known.matrix[np.ix_(rows[old], rows[old])]
    new = np.flatnonzero(rows < 0)
    for start in range(0, len(new), SOURCES_PER_BLOCK):
        some = new[start : start + SOURCES_PER_BLOCK]
        step = part(progress, start / len(new), (start + len(some)) / len(new))

        def tell(share: float, _: str, step: Progress = step) -> None:
            step(share, f"{distance.label} among pins")

        tell(0, "")
        # Each with all that are known, and with the new ones up to itself.
        pairs = [(i, j) for i in some for j in range(count) if rows[j] >= 0 or j < i]
        if pairs:
            i, j = np.array(pairs).T
            matrix[i, j] = matrix[j, i] = distance.of_pairs([(places[a], places[b]) for a, b in pairs], tell)
    np.fill_diagonal(matrix, 0.0)
    return matrix


def _rows_in(known: Sequence[Source], places: Sequence[Source]) -> IntArray:
    """Return the rows (k,) of places among those that are known, -1 for others."""
    rows = {at: row for row, at in enumerate(known)}
    return np.array([rows.get(at, -1) for at in places], int)


PAD = 12
MAX_COMPARED_PINS = 40
"""Pins up to which the distances of all panels are computed, and not only those that are shown."""


class PinDistances(QtWidgets.QWidget):
    """The distances among pins, computed in the background; hidden unless there are two pins."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self._places: tuple[LocatedPin, ...] = ()
        self.spec = self._specs(context.document)[0]
        self._among = PairwiseDistances(context.post, self._show_among)
        self.distance = menu_button(self, self._fill_menu, "Which distance", quiet=True)
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
        self.line = quiet_label(wraps=True)
        self.line.setTextFormat(QtCore.Qt.TextFormat.RichText)
        self.line.setContentsMargins(PAD, 4, PAD, 8)
        head = in_row(heading("Distances among pins"), None, self.distance, margins=(PAD, 6, 8, 2))
        around = in_row(self._scroll, margins=(PAD - 6, 0, PAD, 0))
        in_column(head, (around, 1), self.line, of=self, spacing=0).addStretch(0)
        LOOK.follow(self, self._fit)

    def show_pins(self, document: Document, places: Sequence[LocatedPin]) -> None:
        """Show the distances among pins by the chosen distance, or by that of the first panel."""
        self._places = tuple(places)
        self.setVisible(len(self._places) > 1)
        self.spec = document[PinsListing].distance or self._specs(document)[0]
        at = [place.at for place in self._places]
        self._among.ask(self.context.session.mesh(), document.areas, self._compared, at)
        self._show_among()

    def end(self) -> None:
        """End the thread."""
        self._among.close()

    def matrix(self) -> FloatArray | None:
        """Return the matrix (k, k) that is shown, None as long as it is not known."""
        return self.known(self.spec)

    def _specs(self, document: Document) -> list[Spec]:
        """Return the distances of the panels, or all there are if they show none."""
        found = list(dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs))
        return found or [Spec.of(kind.word) for kind in offered_kinds()]

    def _fill_menu(self, menu: QtWidgets.QMenu) -> None:
        shown = self._specs(self.context.document)
        words = {spec.word for spec in shown}
        for spec in (*shown, None, *(Spec.of(kind.word) for kind in offered_kinds() if kind.word not in words)):
            if spec is None:
                menu.addSeparator()
                continue
            add_entry(menu, spec_name(spec, shown), partial(self.choose_distance, spec), spec == self.spec)

    def choose_distance(self, spec: Spec) -> None:
        """Choose the distance among pins."""
        self.context.session.apply(lambda document: document.with_changed(PinsListing, distance=spec))

    @property
    def _compared(self) -> list[Spec]:
        """The distance that is shown, and those of the panels."""
        others = self._specs(self.context.document) if len(self._places) <= MAX_COMPARED_PINS else []
        return list(dict.fromkeys([self.spec, *others]))

    def _show_among(self) -> None:
        matrix = self.known(self.spec)
        document = self.context.document
        self.distance.setText(spec_name(self.spec, self._specs(document)))
        self.distance.updateGeometry()
        pins = [(place.number, PINS[place.pin.colour]) for place in self._places]
        self.cells.show_matrix(pins, matrix)
        self._fit()
        self._say_pair(*self.cells.cell)

    def known(self, spec: Spec) -> FloatArray | None:
        """Return the distances (k, k) among the pins, None as long as they are not known."""
        return self._among.matrix(spec)

    def _say_pair(self, i: int, j: int) -> None:
        """Write the pair under the pointer in all distances that are known, or the unit, below the matrix."""
        places = self._places
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
        failure, progress = self._among.failure(self.spec), self._among.progress
        if failure:
            self.line.setText(escape(failure))
        elif self.known(self.spec) is None and progress is not None:
            self.line.setText(progress_words(*progress))
        else:
            unit = self._among.unit(self.spec)
            self.line.setText(f"in {unit}" if unit else "")

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.Resize:
            self._fit()
        return bool(super().eventFilter(watched, event))

    def _fit(self) -> None:
        """Make the cells as wide as there is room for, with the line close below them."""
        self.cells.fit_into(self._scroll.viewport().width())
        is_wide = self.cells.width() > self._scroll.viewport().width()
        bar = self._scroll.horizontalScrollBar().sizeHint().height() if is_wide else 0
        self._scroll.setMaximumHeight(max(self.cells.height() + bar, self._scroll.minimumHeight()))


def spec_name(spec: Spec, among: Sequence[Spec]) -> str:
    """Return the name of a distance, with its parameters only where another has the same."""
    return str(spec) if sum(other.word == spec.word for other in among) > 1 else kind_name(spec.distance_type)
