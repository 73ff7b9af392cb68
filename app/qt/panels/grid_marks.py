"""Marks of a document on its surfaces, in every panel of the grid: sources, marks of tools, insets."""

from collections.abc import Callable, Mapping

from qtpy import QtGui

from bihdist_core.distances.answers import Answer

from ...document.document import Document, Panel
from ...marks.marked_panel import MarkedPanel, marks_of_tools, starts
from ...marks.primitives import Caption
from ...session.isoline_points import IsolinePoint, passed
from ...session.questions import vertex_at
from ...session.session import Session
from .motion_state import MotionState
from .panel import DistancePanel

NOTHING = Answer(label="")
"""The answer of a panel that has none yet."""

SELECTED_MS = 600
"""After a selection has changed, until large surfaces are drawn with it in full; the next stroke may begin before."""


class GridMarks:
    """The marks of a document in all panels that are shown."""

    def __init__(
        self, session: Session, panels: Callable[[], Mapping[int, DistancePanel]], motion: MotionState
    ) -> None:
        self._session, self._shown, self._motion = session, panels, motion
        self._highlighted: dict[str, tuple[str, ...]] = {}  # points, by the words of tools
        self._is_drawn_on = self._keeps_steps = False
        self._brush: QtGui.QCursor | None = None

    @property
    def _panels(self) -> Mapping[int, DistancePanel]:
        return self._shown()

    def begin(self, panel: DistancePanel) -> None:
        """Start marking a panel's surface, with what is marked there whatever the field."""
        panel.view.draw_on(self._is_drawn_on)
        panel.show_isolines(self._session.document.isolines)
        panel.view.set_brush(self._brush_of(panel))

    # ------------------------------------------------------------------ sources
    def expect_sources(self, document: Document) -> None:
        """Tell each panel where its field starts."""
        for panel in document.panels:
            surface = self._session.mesh(panel.id).surface
            first = next((vertex_at(document.point(name).at, surface) for name in panel.shows.points), None)
            question = self._session.questions[panel.id]
            self._panels[panel.id].marks.expect(question, first, starts(document, panel, surface))

    def show_sources(self, document: Document) -> None:
        """Mark at once where the fields that are shown start, or no longer."""
        self.expect_sources(document)
        for id, panel in self._panels.items():
            if self._session.is_answered(id):  # where another field is on its way, its source comes with it
                panel.marks.mark_field(panel.answer, None)

    def draw_on(self, is_drawn_on: bool) -> None:
        """Set whether the left button draws on the surfaces, and no longer turns them there."""
        self._is_drawn_on = is_drawn_on
        for panel in self._panels.values():
            panel.view.draw_on(is_drawn_on)

    # ------------------------------------------------------------------ what tools mark
    def show(self, document: Document) -> None:
        """Show what tools mark in each panel."""
        changed = [self.show_in(document, panel.id) for panel in document.panels]
        if any(changed):
            self._motion.moved(SELECTED_MS)

    def show_in(self, document: Document, id: int) -> bool:
        """Show what tools mark in a panel; return whether other vertices are selected there."""
        panel, widget, shown = document.panel(id), self._panels[id], self._session.shown.get(id)
        surfaces = {mesh.name: self._session.loaded(mesh.name) for mesh in document.surfaces}
        there = {name: loaded for name, loaded in surfaces.items() if loaded is not None}
        if panel.surface not in there:
            return False
        answer = NOTHING if shown is None else shown.answer
        marked = MarkedPanel(document, panel, there, answer, widget.marks.found)
        marks = marks_of_tools(marked)
        has_other_areas = [widget.marks.show(word, found, self.highlighted(word)) for word, found in marks.items()]
        captions = (mark for found in marks.values() for mark in found if isinstance(mark, Caption))
        widget.show_caption(next(captions, Caption()))
        return any(has_other_areas)

    def show_found(self, id: int, kind: type, found: object | None) -> None:
        """Mark what has been found beside the window's thread for a panel, by its type; None for nothing."""
        known = self._panels[id].marks.found
        if found is not known.get(kind):
            known[kind] = found
            if id in [panel.id for panel in self._session.document.panels]:
                self.show_in(self._session.document, id)

    def highlighted(self, tool: str) -> tuple[str, ...]:
        """Return the points of a tool's marks that stand out, by its word."""
        return self._highlighted.get(tool, ())

    def highlight(self, tool: str, points: tuple[str, ...]) -> None:
        """Let a tool's marks at these points stand out, and no others of it."""
        if points != self.highlighted(tool):
            self._highlighted[tool] = points
            if self._session.loaded() is not None:
                self.show(self._session.document)

    # ------------------------------------------------------------------ brushes
    def set_brush(self, brush: QtGui.QCursor | None) -> None:
        """Set what a drag paints with in the panels of the first surface, None if it turns them."""
        self._brush = brush
        for panel in self._panels.values():
            panel.view.set_brush(self._brush_of(panel))

    def _brush_of(self, panel: DistancePanel) -> QtGui.QCursor | None:
        surfaces = self._session.document.surfaces
        return self._brush if panel.surface == (surfaces[0].name if surfaces else "") else None

    # ------------------------------------------------------------------ insets and isolines
    def show_insets(self, document: Document) -> None:
        """Enlarge the document's places in each panel."""
        for panel in self._panels.values():
            panel.show_insets(document.insets)
        self.settle_insets()

    def settle_insets(self) -> None:
        """Put insets where there is room, seen from where the camera is now."""
        for panel in self._panels.values() if self._session.loaded() is not None else ():
            panel.settle_insets()

    def show_isolines(self, document: Document) -> None:
        """Show the document's isolines, those through its points included."""
        for panel in document.panels:
            if panel.id in self._panels:
                self._panels[panel.id].show_isolines(document.isolines, self._through(document, panel))

    def keep_steps(self, are_kept: bool) -> None:
        """Set whether isolines keep their steps for as long as these will do, which they do while a source moves."""
        if are_kept == self._keeps_steps:
            return
        self._keeps_steps = are_kept
        for panel in self._panels.values():
            panel.keeps_step = are_kept
        if not are_kept:
            self.show_isolines(self._session.document)

    def show_isolines_again(self, document: Document, id: int) -> None:
        """Show the isolines through points, with the answer that a panel shows now."""
        if document.isolines.through:
            self._panels[id].show_isolines(document.isolines, self._through(document, document.panel(id)))

    def _through(self, document: Document, panel: Panel) -> tuple[IsolinePoint, ...]:
        loaded, shown = self._session.loaded(panel.surface), self._session.shown.get(panel.id)
        if loaded is None or shown is None:
            return ()
        return passed(document, panel.surface, loaded, shown.answer)
