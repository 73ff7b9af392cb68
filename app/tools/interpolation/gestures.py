"""Clicks and drags on panels that show an interpolant: they place, move and remove anchors."""

from qtpy import QtCore, QtWidgets

from ...document.document import Document
from ...document.edits import put_point
from ...qt.context import Context
from ...qt.dragging import Dragging
from ...qt.gesture import Gesture
from ...qt.panels.events import Click
from ...scene.picking import Hit
from .part import Anchors, add_anchor, remove_anchors
from .quantity import interpolants


class AnchorGestures(Gesture):
    chosen = QtCore.Signal(str)  # the point of the anchor that stands out from now on, "" for none

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._moved = ""  # the name of the point that is dragged

    def is_on(self, panel: int) -> bool:
        """Return whether a panel shows an interpolant."""
        return bool(interpolants(self.document.panel(panel).shows))

    def click(self, panel: int, click: Click) -> None:
        self.put(panel, click.hit)

    def put(self, panel: int, hit: Hit) -> None:
        """Add an anchor at a vertex, with the value that the panel has there."""
        session = self.context.session
        document, surface = session.document, session.document.panel(panel).surface
        with self.context.errors_shown():  # there may be too many
            changed, name = add_anchor(document, hit.vertex, self._value(panel, hit.vertex), surface)
            session.show(changed)
            self.choose(name)

    def _value(self, panel: int, vertex: int) -> float:
        """Return the value there, so that nothing changes yet; 0 for the first anchor and 1 for the second."""
        session = self.context.session
        known = [a for a in session.document[Anchors].anchors if a.value is not None and not a.left_out]
        answer = session.answer(panel)
        if len(known) < 2 or answer is None or answer.field is None or not session.is_answered(panel):
            return float(min(len(known), 1))
        return float(f"{answer.field[vertex]:.3g}")

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: Hit) -> None:
        """Add what can be done at a place to a menu."""
        name = self._name_at(panel, hit.vertex)
        if name:
            menu.addAction("Remove this anchor", lambda: self.remove([name]))
        else:
            menu.addAction("Anchor here\tClick", lambda: self.put(panel, hit))

    def choose(self, point: str) -> None:
        """Highlight the anchor at a point, in the list, too."""
        self.context.grid.marks.highlight("anchors", (point,) if point else ())
        self.chosen.emit(point)

    def remove(self, points: list[str]) -> None:
        """Remove the anchors at these points."""
        self.context.session.apply(lambda document: remove_anchors(document, points))

    def remove_chosen(self) -> bool:
        highlighted = self.context.grid.marks.highlighted("anchors")
        found = [anchor.point for anchor in self.document[Anchors].anchors if anchor.point in highlighted]
        if found:
            self.remove(found)
        return bool(found)

    def drag(self, panel: int, number: int, hit: Hit) -> None:
        """Move an anchor, past vertices that another has."""
        session = self.context.session
        document, surface = session.document, session.document.panel(panel).surface
        if not self._moved:
            names = anchor_points(document, surface)
            if number >= len(names):
                return
            self._moved = names[number]
            self.choose(self._moved)
            self.context[Dragging].begin()
        if not self._name_at(panel, hit.vertex):
            moved = put_point(document, self._moved, hit.vertex, surface)
            session.show(moved, key=f"drag of {self._moved}", live=True)

    def release(self) -> None:
        self._moved = ""

    def _name_at(self, panel: int, vertex: int) -> str:
        document = self.document
        names = anchor_points(document, document.panel(panel).surface)
        return next((name for name in names if document.point(name).at == vertex), "")


def anchor_points(document: Document, surface: str) -> list[str]:
    """Return the names of the points of the anchors on a surface, in order."""
    return [a.point for a in document[Anchors].anchors if document.point(a.point).surface == surface]
