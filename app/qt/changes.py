"""From one document to the next: the panels are shown what is another.

`window` is the main window.
"""

from ..document.anchors import Anchor, Anchors
from ..document.document import Document, Point
from ..document.pairs import Pairs
from ..document.pins import Pins
from ..document.selections import Selections
from ..scene.style import Style
from ..session.loaded_mesh import LoadedMesh
from .look.canvas import canvas_style
from .look.look import LOOK


class Changes:
    """What the panels show, kept equal to what the session does."""

    def __init__(self, window) -> None:
        self._window = window
        self._loaded: tuple[LoadedMesh | None, ...] = ()  # the surfaces in the panels

    @property
    def _style(self) -> Style:
        """What fields look like: that of the page, in the document's colours, on the window's ground."""
        return canvas_style(self._window.page.style, LOOK.theme, self._window.session.document.colours)

    def show(self, before: Document) -> None:
        """The session's document, where the one before is shown."""
        window, session, grid = self._window, self._window.session, self._window.grid
        document = session.document
        loaded = tuple(session.loaded(mesh.name) for mesh in document.surfaces)
        is_dressed = grid.show_style(self._style)  # in other colours
        is_other = loaded != self._loaded
        other_panels = is_other or is_dressed or (document.panels, document.fields) != (before.panels, before.fields)
        if other_panels:
            grid.show_panels(document)
        if is_other:
            shown, self._loaded = self._loaded, loaded
            is_remade = _is_remade(shown, loaded)
            (window.surface_remade if is_remade else window.surface_changed)(*loaded)
            grid.show_surface([mesh.name for mesh in document.surfaces[1:]] if is_remade and not is_dressed else None)
        elif is_dressed:
            grid.show_surface()
        if other_panels or document.points != before.points:
            grid.marks.expect_sources(document)
            window.typed_source.show()
        if other_panels or _anchored(document) != _anchored(before):
            grid.marks.mark_anchors(document)
        if other_panels or (document.points, document[Pins].pins) != (before.points, before[Pins].pins):
            grid.marks.show_pins(document)
        if other_panels or (document.points, document[Pairs].pairs) != (before.points, before[Pairs].pairs):
            grid.marks.show_pairs(document)
        if other_panels or document.zooms != before.zooms:
            grid.marks.show_insets(document)
        passed = document.isolines.through and document.points != before.points
        if is_other or is_dressed or passed or document.isolines != before.isolines:
            grid.marks.show_isolines(document)
        is_raised = document.height != before.height
        if document.shading != before.shading and not is_other:
            grid.show_shading()
        if other_panels or is_raised or document.range != before.range:
            for panel in document.panels:
                if session.is_answered(panel.id) or (is_dressed and panel.id in session.shown):
                    window.answer_changed(panel.id)
        window.views.document_changed(before, is_other, is_raised)
        if other_panels or document[Selections].selections != before[Selections].selections:
            window.docks.brushing.show(document)

    def apply_theme(self) -> None:
        """Other colours of the window, or another style of the fields."""
        if self._window.grid is not None and self._window.grid.show_style(self._style):
            self.show_all_again()

    def apply_theme_next(self) -> None:
        """The same, with the next change of the document, which then shows all anew."""
        if self._window.grid is not None and self._window.grid.show_style(self._style):
            self._loaded = ()

    def show_all_again(self) -> None:
        """All that is in the panels, where nothing has changed but how it looks."""
        window, session, grid = self._window, self._window.session, self._window.grid
        if session.loaded() is None:
            return
        document = session.document
        grid.show_surface()
        grid.marks.expect_sources(document)
        grid.marks.show_isolines(document)
        grid.marks.mark_anchors(document)
        grid.marks.show_pins(document)
        grid.marks.show_pairs(document)
        grid.marks.show_insets(document)
        window.docks.brushing.show(document)
        for id in session.shown:
            grid.show_answer(id)
        window.docks.show_again()
        window.progress_display.show()


def _is_remade(before: tuple[LoadedMesh | None, ...], after: tuple[LoadedMesh | None, ...]) -> bool:
    """Whether the first surface stays, and the others are made from it, or were."""
    others = [*before[1:], *after[1:]]
    return bool(before and after) and before[0] is after[0] and all(o and o.origin is after[0] for o in others)


def _anchored(document: Document) -> list[tuple[Anchor, Point]]:
    """Where the anchors are, whatever other points do: a pin that is dragged redraws none."""
    return [(anchor, document.point(anchor.point)) for anchor in document[Anchors].anchors]
