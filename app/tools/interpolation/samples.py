"""Farthest points that become anchors."""

import numpy as np
from qtpy import QtWidgets

from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.sources.source import SourceSet

from ...document.document import Document, Panel
from ...drawing.numbers import progress_words
from ...qt.context import Context
from ...qt.look.form import in_row, push_button
from ...session.farthest_points import SamplesRequest, find_samples
from ...session.questions import first_source, vertex_at
from .part import Anchors, add_anchor
from .quantity import Interpolant

USUAL_SAMPLES, MAX_SAMPLES = 5, 100
"""More anchors at first, and at most at once."""


class AnchorSamples(QtWidgets.QWidget):
    """A number, and a button: so many points more, each the farthest from all anchors by the active panel's distance.

    What is there keeps its value: where a field is known, each gets what the field has there.
    """

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._background = context.background("samples", find_samples, self._take, self._refuse, self._show_progress)
        self._asked: tuple[Document, AnyArray, int] | None = None  # of whose anchors, by which panel
        tip = "Anchors at points that are farthest from each other, by the active panel's distance"
        self.add = push_button("Add samples", self.add_them, tip)
        self.count = QtWidgets.QSpinBox(minimum=1, maximum=MAX_SAMPLES, value=USUAL_SAMPLES)
        self.count.setAccessibleName("How many samples become anchors")
        in_row(self.add, self.count, None, of=self, spacing=8)

    def add_them(self) -> None:
        """Look for farthest points, and make anchors of them."""
        session, panel = self._context.session, self._panel
        loaded = None if panel is None else session.loaded(panel.surface)
        if panel is None or loaded is None:
            return
        (part,) = panel.shows.parts
        document = session.document
        points = [document.point(anchor.point) for anchor in document[Anchors].anchors]
        there = [vertex_at(point.at, loaded.surface) for point in points if point.surface == panel.surface]
        start = there or [first_source(loaded.surface, loaded.up)]
        self._asked = (document, np.array(there, int), panel.id)
        at = start[0] if len(start) == 1 else SourceSet(tuple(start))
        more = self.count.value() + len(there)
        self._background.ask(SamplesRequest(loaded, document.areas, part.specs[0], at, more))

    def _take(self, request: SamplesRequest, vertices: IntArray) -> None:
        self._context.status.show_progress("")
        asked, self._asked = self._asked, None
        if asked is None:
            return
        session = self._context.session
        document, there, panel = asked
        if (document[Anchors].anchors, document.points) != (session.document[Anchors].anchors, session.document.points):
            return  # they are farthest from others
        answer = session.answer(panel) if len(there) > 1 and session.is_answered(panel) else None
        field = None if answer is None else answer.field
        new = [vertex for vertex in vertices.tolist() if vertex not in there]
        document, surface = session.document, session.document.panel(panel).surface
        with self._context.errors_shown():  # there may be too many
            for rank, vertex in enumerate(new):
                share = rank / max(1, len(new) - 1)
                value = share if field is None else float(field[vertex])
                document, _ = add_anchor(document, vertex, float(f"{value:.3g}"), surface)
            session.show(document)

    def _refuse(self, request: SamplesRequest, sentence: str) -> None:
        self._asked = None
        self._context.status.show_progress("")
        self._context.fail(sentence)

    def _show_progress(self, going: tuple[float, str] | None) -> None:
        self._context.status.show_progress("" if going is None or self._asked is None else progress_words(*going))

    @property
    def _panel(self) -> Panel | None:
        """Return the active panel, or the first that shows an interpolant."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return next((p for p in panels if isinstance(p.shows, Interpolant)), None)
