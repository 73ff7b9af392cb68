"""Whether the pointer means vertices, or places anywhere in faces."""

from typing import TYPE_CHECKING

from bihdist_core.sources.source import Source

from ..document.settings import Preferences
from ..document.source_edits import place_at
from .context import Context

if TYPE_CHECKING:
    from ..scene.picking import Hit


class Snapping:
    """Whether the pointer snaps to vertices, by the document and, at the next start, by the preferences."""

    def __init__(self, context: Context) -> None:
        self._context = context
        context.preferred.connect(self._follow)

    @property
    def is_on(self) -> bool:
        """Return whether sources are put on vertices."""
        return self._context.document.snap

    def at(self, panel: int, hit: "Hit") -> Source:
        """Return the source that a place in a panel means."""
        if self.is_on:
            return hit.vertex
        faces = self._context.session.mesh(panel).surface.shape.faces
        return place_at(faces[hit.face], hit.face, hit.weights.tolist())

    def _follow(self, before: Preferences) -> None:
        if self._context.preferences.snap != before.snap:
            self._context.session.set_fields(snap=self._context.preferences.snap)

    def set(self, is_on: bool) -> None:
        """Put the source on vertices, or anywhere in faces, also at the next start."""
        self._context.session.set_fields(snap=is_on)
        self._context.prefer(snap=is_on)
        self._context.choice_changed.emit()
        where = "on vertices" if is_on else "anywhere in faces"
        self._context.tell(f"A click puts the source {where}")
