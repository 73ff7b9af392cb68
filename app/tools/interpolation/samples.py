"""Farthest points that become anchors."""

import numpy as np
from qtpy import QtWidgets

from bihdist_core import BihdistError
from bihdist_core.arrays import AnyArray
from bihdist_core.sources.source import SourceSet

from ...document.document import Document, Panel
from ...qt.context import Context
from ...session.farthest_points import Sampled, SamplesQuestion, Sampling
from ...session.questions import first_source, vertex_at
from .part import Anchors, add_anchor
from .quantity import Interpolant

USUAL, MOST = 5, 100
"""More anchors at first, and at most at once."""


class AnchorSamples(QtWidgets.QWidget):
    """A number, and a button: so many points more, each the farthest from all anchors by the active panel's distance.

    What is there keeps its value: where a field is known, each gets what the field has there.
    """

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._sampling = Sampling(context.post, self._sampled, self._show_going)
        self._asked: tuple[Document, AnyArray, int] | None = None  # of whose anchors, by which panel
        self.add = QtWidgets.QPushButton("Add samples", autoDefault=False)
        self.add.setToolTip("Anchors at points that are farthest from each other, by the active panel's distance")
        self.add.clicked.connect(self.add_them)
        self.count = QtWidgets.QSpinBox()
        self.count.setRange(1, MOST)
        self.count.setValue(USUAL)
        self.count.setAccessibleName("How many samples become anchors")
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        row.addWidget(self.add)
        row.addWidget(self.count)
        row.addStretch(1)
        context.closed.connect(self._sampling.close)

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
        self._sampling.ask(
            SamplesQuestion(document.mesh(panel.surface), document.areas, part.specs[0], at, more), loaded
        )

    def _sampled(self, sampled: Sampled) -> None:
        self._context.status.show_progress("")
        asked, session = self._asked, self._context.session
        if asked is None or sampled.vertices is None:
            self._context.fail(sampled.failure)
            return
        document, there, panel = asked
        if (document[Anchors].anchors, document.points) != (session.document[Anchors].anchors, session.document.points):
            return  # they are farthest from others
        shown = session.shown.get(panel)
        field = shown.answer.field if shown is not None and len(there) > 1 and session.is_answered(panel) else None
        new = [vertex for vertex in sampled.vertices.tolist() if vertex not in there]
        document, surface = session.document, session.document.panel(panel).surface
        try:
            for rank, vertex in enumerate(new):
                share = rank / max(1, len(new) - 1)
                value = share if field is None else float(field[vertex])
                document, _ = add_anchor(document, vertex, float(f"{value:.3g}"), surface)
        except BihdistError as error:  # too many
            self._context.fail(error)
            return
        session.show(document)

    def _show_going(self, fraction: float | None, text: str) -> None:
        is_going = fraction is not None and self._sampling.is_going
        self._context.status.show_progress(f"{text}, {fraction:.0%}".replace("%", " %") if is_going else "")

    @property
    def _panel(self) -> Panel | None:
        """The active one, or the first of those that show an interpolant."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return next((p for p in panels if isinstance(p.shows, Interpolant)), None)
