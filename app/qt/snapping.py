"""Whether the pointer means vertices, or places anywhere in faces."""

from typing import TYPE_CHECKING

from bihdist_core.sources.source import Source

from ..document.source_edits import place_at
from .context import Context

if TYPE_CHECKING:
    from ..scene.picking import Hit


class Snapping:
    """What the pointer means for sources and pins, by the document and, at the next start, by the preferences."""

    def __init__(self, context: Context) -> None:
        self._context = context

    @property
    def is_on(self) -> bool:
        """Whether sources are put on vertices."""
        return self._context.document.snap

    def at(self, panel: int, hit: "Hit") -> Source:
        """The source that a place in a panel means."""
        if self.is_on:
            return hit.vertex
        faces = self._context.session.surface_in(panel).faces
        return place_at(faces[hit.face], hit.face, hit.weights.tolist())

    def set(self, is_on: bool) -> None:
        """Whether the source is put on vertices, or anywhere in faces, also at the next start."""
        self._context.session.keep_snapping(is_on)
        self._context.prefer(snap=is_on)
        where = "on vertices" if is_on else "anywhere in faces"
        self._context.tell(f"A click puts the source {where}")
