"""A click lets the circle go through the vertex, as long as the dock is open."""

from bihdist.qt.gesture import Gesture
from bihdist.qt.panels.events import Click

from .part import with_circle


class CircleGesture(Gesture):
    def is_on(self, panel: int) -> bool:
        return "circle" in self.context.document.docks

    def click(self, panel: int, click: Click) -> None:
        document = self.context.document
        self.context.edit(with_circle(document, click.hit.vertex, document.panel(panel).surface), "circle")
