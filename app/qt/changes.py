"""Changes of the document: the panels are shown what differs."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from qtpy import QtCore

from ..document.document import Document
from ..document.on_surface import SOURCE, Hidden
from ..scene.style import Style
from ..session.loaded_mesh import LoadedMesh
from .context import Context
from .look.canvas import canvas_style
from .look.look import LOOK
from .progress_display import ProgressDisplay
from .typed_source import TypedSource
from .views import Views


class Row(NamedTuple):
    """Something of a document, and what shows it in all panels."""

    of: Callable[[Document], object]
    show: Callable[[Context], object]


def _sources(context: Context) -> None:
    context.grid.marks.expect_sources(context.document)
    context[TypedSource].show()


TABLE = (
    Row(lambda d: d.points, _sources),
    Row(lambda d: SOURCE in d[Hidden].hidden, lambda c: c.grid.marks.show_sources(c.document)),
    Row(lambda d: d, lambda c: c.grid.marks.show(c.document)),
    Row(lambda d: d, lambda c: c.grid.show_edits(c.document)),
    Row(lambda d: d.insets, lambda c: c.grid.marks.show_insets(c.document)),
    Row(
        lambda d: (d.isolines, d.isolines.through and (d.points, d[Hidden])),
        lambda c: c.grid.marks.show_isolines(c.document),
    ),
    Row(lambda d: d.shading, lambda c: c.grid.show_shading()),
    Row(lambda d: (d.clip, d.opacity), lambda c: c.grid.show_inside()),
    Row(lambda d: d.base, lambda c: c.grid.show_base(c.document)),
)
"""What panels show besides their fields."""


class Changes(QtCore.QObject):
    """Keeps the panels equal to what the session shows."""

    answered = QtCore.Signal(int)  # a panel has to show its answer again
    surfaces_changed = QtCore.Signal(object, bool)  # those in the panels now; whether the first is that from before

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._loaded: tuple[LoadedMesh | None, ...] = ()  # the surfaces in the panels
        context.page_changed.connect(self._apply_theme_next)
        context.style_changed.connect(self.apply_theme)

    @property
    def _style(self) -> Style:
        """The style of fields: that of the page, in the document's colours, on the window's ground."""
        return canvas_style(self._context.page.style, LOOK.theme, self._context.document.colours)

    def show(self, before: Document) -> None:
        """Show the session's document, where the one before is shown."""
        context, session, grid = self._context, self._context.session, self._context.grid
        document = session.document
        loaded = tuple(session.loaded(mesh.name) for mesh in document.surfaces)
        has_other_style = grid.show_style(self._style)  # in other colours
        is_other = loaded != self._loaded
        other_panels = is_other or has_other_style or not _are_alike(document, before)
        if other_panels or document.panels != before.panels:
            grid.show_panels(document)
        if is_other:
            shown, self._loaded = self._loaded, loaded
            is_remade = _is_remade(shown, loaded)
            self.surfaces_changed.emit(loaded, is_remade)
            grid.show_surface(
                [mesh.name for mesh in document.surfaces[1:]] if is_remade and not has_other_style else None
            )
        elif has_other_style:
            grid.show_surface()
        for row in TABLE:
            if other_panels or row.of(document) != row.of(before):
                row.show(context)
        is_raised = document.warp_factor != before.warp_factor
        if other_panels or is_raised or (document.range, document.unit) != (before.range, before.unit):
            for panel in document.panels:
                if session.is_answered(panel.id) or (has_other_style and panel.id in session.shown):
                    self.answered.emit(panel.id)
        context[Views].document_changed(before, is_other, is_raised)

    def show_none(self) -> None:
        """The document has no meshes, and so no panels; what is next is shown anew."""
        self._loaded = ()
        self._context.grid.show_panels(self._context.document)
        self._context[TypedSource].show()

    def apply_theme(self) -> None:
        """Show the window's other colours, or another style of the fields."""
        if self._context.is_built and self._context.grid.show_style(self._style):
            self.show_all_again()

    def _apply_theme_next(self) -> None:
        """Apply the theme with the next change of the document, which then shows all anew."""
        if self._context.is_built and self._context.grid.show_style(self._style):
            self._loaded = ()

    def show_all_again(self) -> None:
        """Show everything in the panels again, where nothing has changed but how it looks."""
        context, grid = self._context, self._context.grid
        if context.session.loaded() is None:
            return
        grid.show_surface()
        for row in TABLE:
            row.show(context)
        for id in context.session.shown:
            grid.show_answer(id)
        context.panels_cleared.emit()
        context[ProgressDisplay].show()


def _are_alike(document: Document, before: Document) -> bool:
    """Return whether the panels are those from before, perhaps with other values of parameters."""
    pairs = list(zip(document.panels, before.panels, strict=False))
    return (
        document.fields == before.fields
        and len(document.panels) == len(before.panels)
        and all(panel.shows.is_alike(old.shows) and replace(panel, shows=old.shows) == old for panel, old in pairs)
    )


def _is_remade(before: tuple[LoadedMesh | None, ...], after: tuple[LoadedMesh | None, ...]) -> bool:
    """Return whether the first surface stays, and the others are made from it, or were."""
    others = [*before[1:], *after[1:]]
    return bool(before and after) and before[0] is after[0] and all(o and o.origin is after[0] for o in others)
