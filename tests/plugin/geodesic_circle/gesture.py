"""A click lets the circle go through the vertex, as long as the dock is open; its pin marker can be dragged."""

from typing import TYPE_CHECKING

from bihdist.qt.gesture import Gesture
from bihdist.qt.panels.events import Click

from .part import with_circle

if TYPE_CHECKING:
    from bihdist.scene.picking import Hit


class CircleGesture(Gesture):
    tool = "circle"

    def is_on(self, panel: int) -> bool:
        return "circle" in self.context.document.docks

    def click(self, panel: int, click: Click) -> None:
        self._put(panel, click.hit)

    def drag(self, panel: int, number: int, hit: "Hit") -> None:
        self._put(panel, hit, live=True)

    def _put(self, panel: int, hit: "Hit", live: bool = False) -> None:
        document = self.context.document
        self.context.session.show(with_circle(document, hit.vertex, document.panel(panel).surface), "circle", live=live)
