"""What is done to anchors on panels that show an interpolant: put, dragged, removed.  `window` is the main window."""

from typing import TYPE_CHECKING

from qtpy import QtWidgets

from bihdist_core import ParameterError

from ..document.anchors import Anchors, add_anchor, remove_anchors
from ..document.document import Document
from ..document.edits import put_point

if TYPE_CHECKING:
    from ..scene.picking import Hit


class AnchorGestures:
    """See the module."""

    def __init__(self, window) -> None:
        self._window, self._grid = window, window.grid
        self._moved = ""  # the name of the point that is dragged

    def are_meant(self, panel: int) -> bool:
        """Whether a panel shows an interpolant, so that what is done there is done to anchors."""
        shows = self._window.session.document.panel(panel).shows
        return any(part.has_anchors for part in shows.parts)

    def put(self, panel: int, hit: "Hit") -> None:
        """An anchor at a vertex, with the value that the panel has there."""
        session = self._window.session
        document, surface = session.document, session.document.panel(panel).surface
        try:
            changed, name = add_anchor(document, hit.vertex, self._value(panel, hit.vertex), surface)
        except ParameterError as error:  # there are too many
            self._window.failed(str(error))
            return
        session.show(changed)
        self._window.docks.choose_anchor(name)

    def _value(self, panel: int, vertex: int) -> float:
        """What is there, so that nothing changes yet; 0 for the first anchor and 1 for the second."""
        session = self._window.session
        known = [a for a in session.document[Anchors].anchors if a.value is not None and not a.left_out]
        shown = session.shown.get(panel)
        field = None if shown is None else shown.answer.field
        if len(known) < 2 or field is None or not session.is_answered(panel):
            return float(min(len(known), 1))
        return float(f"{field[vertex]:.3g}")

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: "Hit") -> None:
        """In a menu: what can be done with the place."""
        name = self._name_at(panel, hit.vertex)
        if name:
            menu.addAction("Remove this anchor", lambda: self.remove([name]))
        else:
            menu.addAction("Anchor here\tClick", lambda: self.put(panel, hit))

    def remove(self, points: list[str]) -> None:
        session = self._window.session
        session.show(remove_anchors(session.document, points))

    def remove_chosen(self) -> None:
        """The anchor that stands out, if there is one."""
        name = self._grid.marks.chosen_anchor
        if any(anchor.point == name for anchor in self._window.session.document[Anchors].anchors):
            self.remove([name])

    def drag(self, panel: int, mark: int, hit: "Hit") -> None:
        """One of the anchors is over a place; one that another has is passed."""
        session = self._window.session
        document, surface = session.document, session.document.panel(panel).surface
        if not self._moved:
            names = anchor_points(document, surface)
            if mark >= len(names):
                return
            self._moved = names[mark]
            self._window.docks.choose_anchor(self._moved)
            self._window.gestures.sources.set_off()
        if not self._name_at(panel, hit.vertex):
            moved = put_point(document, self._moved, hit.vertex, surface)
            session.show(moved, key=f"drag of {self._moved}", live=True)

    def rest(self) -> None:
        """It has arrived."""
        self._moved = ""

    def _name_at(self, panel: int, vertex: int) -> str:
        document = self._window.session.document
        names = anchor_points(document, document.panel(panel).surface)
        return next((name for name in names if document.point(name).at == vertex), "")


def anchor_points(document: Document, surface: str) -> list[str]:
    """The names of the points of the anchors on a surface, in order."""
    return [a.point for a in document[Anchors].anchors if document.point(a.point).surface == surface]
