"""Farthest points: how many, by the active panel's distance from its source; pinned, or saved."""

from collections.abc import Callable
from functools import partial

from qtpy import QtWidgets

from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.sampling import SAMPLE_FORMATS, write_samples
from bihdist_core.arrays import AnyArray, IntArray

from ...document.document import Panel
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ...document.shared_parts.pins import add_pins
from ...drawing.numbers import progress_words
from ...qt.context import Context
from ...qt.files.saving import save
from ...qt.look.form import describe, error_label
from ...qt.look.layouts import heading, in_column, in_row, push_button, quiet_label
from ...session.farthest_points import SamplesRequest, find_samples

USUAL_POINTS, MAX_POINTS = 10, 10_000
"""Points at first, and at most."""


class Sampler(QtWidgets.QWidget):
    """Their number, two buttons, and by which distance they would be."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._then: Callable[[AnyArray], None] | None = None  # what is done with the points that are looked for
        self._background = context.background("samples", find_samples, self._take, self._refuse, self._show_progress)
        self.count = QtWidgets.QSpinBox(minimum=1, maximum=MAX_POINTS, value=USUAL_POINTS)
        describe(self.count, "How many farthest points", "The source is the first of them")
        tip = "Each point is the farthest from the source and those before it, and becomes a pin"
        self.pin = push_button("Pin them", self.pin_them, tip)
        tip = "Their vertex ids as text or an array, or as a file of pins"
        self.save = push_button("Save…", lambda: self.save_to(), tip)
        self.words, self.wrong = quiet_label(wraps=True), error_label()
        for label in (self.words, self.wrong):
            label.setProperty("small", True)
        buttons = in_row(self.count, self.pin, self.save, None, spacing=8)
        in_column(heading("Farthest points"), buttons, self.words, self.wrong, of=self, spacing=8)
        context.grid.activated.connect(lambda *_: self.show_state())

    # ------------------------------------------------------------------ what is told
    def show_state(self) -> None:
        """Show by which distance the farthest points would be."""
        if self._then is not None:
            return
        panel = self._panel
        for button in (self.pin, self.save):
            button.setEnabled(panel is not None)
        if panel is None:
            self._say("Choose a panel that shows a distance.")
        else:
            name = quantity_name(panel.shows)
            self._say(f"By the active panel's distance: {name[0].lower()}{name[1:]}")

    # ------------------------------------------------------------------ what is done
    def pin_them(self) -> None:
        """Look for farthest points, and put pins there."""
        self._ask(self._pin)

    def save_to(self, path: str = "") -> None:
        """Write them to a file once they are found, which is asked for if none is given."""
        surface, shown = self._surface, "" if self._panel is None else str(self._panel.shows)
        name = file_name([surface.name], "samples", shown)

        def write(vertices: IntArray) -> None:
            formats = SAMPLE_FORMATS
            write_to = partial(write_samples, surface=surface, vertices=vertices)
            save(self._context, "Save farthest points", name, formats, write_to, path)

        self._ask(write)

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
        self._background.ask(SamplesRequest(loaded, document.areas, spec, at, self.count.value()))

    def _take(self, request: SamplesRequest, vertices: IntArray) -> None:
        then, self._then = self._then, None
        self.show_state()
        if then is not None and self._name and self._context.session.loaded(self._name) is request.loaded:
            then(vertices)

    def _refuse(self, request: SamplesRequest, sentence: str) -> None:
        self._then = None
        self.show_state()
        self._say(sentence, is_error=True)

    def _show_progress(self, going: tuple[float, str] | None) -> None:
        if going is not None and self._then is not None:
            self._say(progress_words(*going))

    @property
    def _name(self) -> str:
        """Return the name of the panel's surface in the document, "" without such a panel."""
        return "" if self._panel is None else self._panel.surface

    @property
    def _surface(self) -> Surface:
        return self._context.session.mesh(self._name or None).surface

    @property
    def _panel(self) -> Panel | None:
        """Return the active panel, or the first that shows a distance."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return panels[0] if panels and panels[0].shows.is_distance else None

    def _say(self, text: str, is_error: bool = False) -> None:
        for label, is_meant in ((self.words, not is_error), (self.wrong, is_error)):
            label.setText(text)
            label.setVisible(is_meant)
