"""Farthest points: how many, by the active panel's distance from its source; pinned, or saved."""

from collections.abc import Callable

from qtpy import QtWidgets

from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.sampling import SAMPLE_FORMATS, write_samples
from bihdist_core.arrays import AnyArray, IntArray

from ...document.document import Panel
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ...document.shared_parts.pins import add_pins
from ...qt.context import Context
from ...qt.files.saving import save, written
from ...session.farthest_points import Sampled, SamplesQuestion, Sampling

USUAL, MOST = 10, 10_000
"""Points at first, and at most."""


class Sampler(QtWidgets.QWidget):
    """Their number, two buttons, and by which distance they would be."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._then: Callable[[AnyArray], None] = lambda vertices: None
        self._sampling = Sampling(context.post, self._sampled, self._show_going)
        self.count = QtWidgets.QSpinBox()
        self.count.setRange(1, MOST)
        self.count.setValue(USUAL)
        self.count.setAccessibleName("How many farthest points")
        self.count.setToolTip("The source is the first of them")
        self.pin = QtWidgets.QPushButton("Pin them", autoDefault=False)
        self.pin.setToolTip("Each point is the farthest from the source and those before it, and becomes a pin")
        self.pin.clicked.connect(lambda *_: self.pin_them())
        self.save = QtWidgets.QPushButton("Save…", autoDefault=False)
        self.save.setToolTip("Their vertex ids as text or an array, or as a file of pins")
        self.save.clicked.connect(lambda *_: self._save())
        self.words = QtWidgets.QLabel()
        self.words.setProperty("quiet", True)
        self.words.setProperty("small", True)
        self.words.setWordWrap(True)
        heading = QtWidgets.QLabel("Farthest points")
        heading.setProperty("heading", True)
        row = QtWidgets.QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.count)
        row.addWidget(self.pin)
        row.addWidget(self.save)
        row.addStretch(1)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addWidget(heading)
        column.addLayout(row)
        column.addWidget(self.words)
        context.grid.activated.connect(lambda *_: self.show_state())

    # ------------------------------------------------------------------ what is told
    def show_state(self) -> None:
        """By which distance they would be."""
        if self._sampling.is_going:
            return
        panel = self._panel
        for button in (self.pin, self.save):
            button.setEnabled(panel is not None)
        if panel is None:
            self._say("Choose a panel that shows a distance.")
        else:
            name = quantity_name(panel.shows)
            self._say(f"By the active panel's distance: {name[0].lower()}{name[1:]}")

    def end(self) -> None:
        """End the thread."""
        self._sampling.close()

    # ------------------------------------------------------------------ what is done
    def pin_them(self) -> None:
        """Look for farthest points, and put pins there."""
        self._ask(self._pin)

    def save_to(self, path: str) -> None:
        """Write them to a file once they are found."""
        surface = self._surface

        def write(vertices: IntArray) -> None:
            written(self._context, path, lambda path: write_samples(path, surface, vertices))

        self._ask(write)

    def _save(self) -> None:
        surface, shown = self._surface, "" if self._panel is None else str(self._panel.shows)

        def ask(vertices: IntArray) -> None:
            save(
                self._context,
                "Save farthest points",
                file_name([surface.name], "samples", shown),
                SAMPLE_FORMATS,
                lambda path: write_samples(path, surface, vertices),
            )

        self._ask(ask)

    def _pin(self, vertices: IntArray) -> None:
        session = self._context.session
        try:
            session.show(add_pins(session.document, vertices.tolist(), self._name))
        except BihdistError as error:
            self._say(str(error), is_error=True)

    def _ask(self, then: Callable[[AnyArray], None]) -> None:
        session, panel = self._context.session, self._panel
        loaded = session.loaded(panel.surface) if panel is not None else None
        document = session.document
        at = document.point(panel.shows.points[0]).at if panel is not None else None
        if panel is None or loaded is None or at is None:
            return
        self._then = then
        spec = panel.shows.specs[0]
        self._sampling.ask(
            SamplesQuestion(document.mesh(panel.surface), document.areas, spec, at, self.count.value()), loaded
        )

    def _sampled(self, sampled: Sampled) -> None:
        self.show_state()
        if sampled.vertices is None:
            self._say(sampled.failure, is_error=True)
        elif self._name and self._context.document.mesh(self._name) == sampled.question.mesh:
            self._then(sampled.vertices)

    def _show_going(self, fraction: float | None, text: str) -> None:
        if fraction is not None and self._sampling.is_going:
            self._say(f"{text}, {fraction:.0%}".replace("%", " %"))

    @property
    def _name(self) -> str:
        """Of the panel's surface in the document; "" where there is no such panel."""
        return "" if self._panel is None else self._panel.surface

    @property
    def _surface(self) -> Surface:
        return self._context.session.mesh(self._name or None).surface

    @property
    def _panel(self) -> Panel | None:
        """The active one, or the first of those that show a distance."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return panels[0] if panels and panels[0].shows.is_distance else None

    def _say(self, text: str, is_error: bool = False) -> None:
        self.words.setText(text)
        if bool(self.words.property("error")) != is_error:
            self.words.setProperty("error", is_error)
            self.words.setProperty("quiet", not is_error)
            self.words.style().unpolish(self.words)
            self.words.style().polish(self.words)
