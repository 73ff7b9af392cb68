"""The place that is pointed at: a ring in every panel, with its value in each."""

from collections.abc import Mapping

from qtpy import QtCore

from ...session.derived_surfaces import counterpart
from .panel import DistancePanel


class Pointing:
    """The place that is pointed at, at most one at a time."""

    def __init__(self) -> None:
        self._panels: Mapping[int, DistancePanel] = {}
        self._at: tuple[int, int] | None = None  # panel, vertex

    def begin(self, panels: Mapping[int, DistancePanel]) -> None:
        """Take the panels that are shown from now on."""
        self._panels = panels

    @property
    def is_on(self) -> bool:
        """True if any panel shows a ring."""
        return self._at is not None

    def leave(self) -> None:
        """Point at nothing."""
        self._at = None
        for panel in self._panels.values():
            panel.point_at(None, False)

    def show(self, id: int, vertex: int | None) -> None:
        """Mark a vertex in every panel of its surface, and show its values; `id` is the panel under the pointer.

        In panels of a surface that is made from that, or that it is made from, the same vertex there; where a map is
        shown, in those of the other surface the vertex that it leads to.
        """
        self._at = None if vertex is None else (id, vertex)
        here = self._panels[id]
        image = None if vertex is None else here.image_of(vertex)
        for other, panel in self._panels.items():
            if panel.surface != here.surface:
                there = image if image is not None else counterpart(vertex, here.loaded, panel.loaded)
                is_hidden = there is not None and not panel.view.sees(panel.positions[there])
                panel.point_at(there, False, is_hidden)
                continue
            # Panels with the same shape show the same of it.
            is_hidden = (
                vertex is not None
                and panel.positions is not self._panels[id].positions
                and not panel.view.sees(panel.positions[vertex])
            )
            panel.point_at(vertex, other == id, is_hidden)

    def show_again_soon(self) -> None:
        """Show the place again soon: the field or the camera has changed under the pointer."""
        QtCore.QTimer.singleShot(0, self._show_again)

    def _show_again(self) -> None:
        if self._at is not None and self._at[0] in self._panels:
            id, vertex = self._at
            self._panels[id].view.point_again()
            if self._at == (id, vertex):
                self.show(id, vertex)
