"""What can be chosen of a profile: its ends, and how it goes from point to point.  `dock` is its dock."""

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, ParameterError
from bihdist_core.analysis.plane_sections import PARTS

from ...document.document import Document
from ...document.shared_parts.pins import Pins, pinned_at
from ...qt.look.text_box import TextBox
from .badges import badge_of
from .part import SECTIONS, Profile, points_along

if TYPE_CHECKING:
    from .dock import ProfileDock

WAYS = {
    "auto": "shortest geodesic",
    "exact": "shortest geodesic, exact",
    "edges": "shortest path along edges",
    **{way: PARTS[part] for way, part in SECTIONS.items()},
}
"""In words, by the document's; what has been found says more."""


class ProfileChoices:
    """The menus of the profile's dock: its ends, and how the path is found."""

    def __init__(self, dock: "ProfileDock") -> None:
        self._dock = dock

    def show(self, document: Document, **profile: Any) -> None:
        """Show a document with these fields of its profile changed."""
        self._dock.context.edit(document.with_part(replace(document[Profile], **profile)))

    def choose_way(self, way: str) -> None:
        """A section keeps its plane whatever part of it is taken; another one's is turned to the view."""
        across = (self._dock.document[Profile].across or self._dock.seen()) if way in SECTIONS else None
        self.show(self._dock.document, way=way, across=across)

    def turn_plane(self) -> None:
        """The plane of the section through the view as it is now."""
        self.show(self._dock.document, across=self._dock.seen())

    def choose_end(self, k: int, name: str, document: Document | None = None) -> None:
        """Let the profile begin (0) or end (1) at a point."""
        document = document or self._dock.document
        through = points_along(document)
        other = (
            through[k - 1]
            if len(through) > 1
            else next((each for each in ("source", *(pin.point for pin in document[Pins].pins)) if each != name), "")
        )
        if other == name:  # then it goes the other way
            other = through[-k] if len(through) > 1 else ""
        known = {point.name for point in document.points}
        if other not in known or other == name:
            self._dock.context.fail("A profile needs two points; choose the other end first.")
            return
        self.show(document, points=(name, other) if k == 0 else (other, name))

    def type_end(self, k: int, text: str) -> None:
        """An end by its vertex id, which is pinned."""
        try:
            surface = self._dock.surface_of(self._dock.surface)
            if not text.strip().isdigit():
                raise ParameterError(f"A vertex id is a whole number, not {text.strip()!r}.")
            document, name = pinned_at(self._dock.document, surface.check_vertex(int(text)), self._dock.surface)
            self.choose_end(k, name, document)
        except BihdistError as error:
            self._dock.context.fail(error)

    def fill_ends(self, k: int) -> None:
        """Fill the menu of the first (0) or last (1) point."""
        menu, document = self._dock.ends[k].menu(), self._dock.document
        menu.clear()
        through = points_along(document)
        points = [*(point.name for point in document.points if point.name.startswith("source"))]
        for name in [*points, *(pin.point for pin in document[Pins].pins)]:
            badge = badge_of(document, name)
            action = menu.addAction(badge.name[:1].upper() + badge.name[1:], partial(self.choose_end, k, name))
            action.setCheckable(True)
            action.setChecked(len(through) > 1 and through[-k] == name)
        menu.addSeparator()
        box = TextBox()
        box.setPlaceholderText("Vertex id")
        box.setAccessibleName("Vertex id")
        box.returnPressed.connect(partial(self._take_typed, k, box))
        typed = QtWidgets.QWidgetAction(menu)
        typed.setDefaultWidget(_padded(box))
        menu.addAction(typed)

    def _take_typed(self, k: int, box: QtWidgets.QLineEdit) -> None:
        text = box.text()
        self._dock.ends[k].menu().close()
        # The menu with the box is gone by then.
        QtCore.QTimer.singleShot(0, partial(self.type_end, k, text))

    def fill_ways(self) -> None:
        """Fill the menu of how the path goes from point to point."""
        menu, document = self._dock.way.menu(), self._dock.document
        menu.clear()
        through = points_along(document)
        for way, words in WAYS.items():
            words = "shortest geodesic, as exact as it goes" if way == "auto" else words
            if way == "section":
                menu.addSeparator()
            action = menu.addAction(words[:1].upper() + words[1:], partial(self.choose_way, way))
            action.setCheckable(True)
            action.setChecked(document[Profile].way == way)
            action.setEnabled(len(through) < 3 or SECTIONS.get(way) != "whole")
        plane = menu.addAction("Turn the plane to the view", self.turn_plane)
        plane.setEnabled(document[Profile].way in SECTIONS)
        menu.addSeparator()
        along = menu.addAction("Through all pins, in order", partial(self.show, document, points=()))
        along.setCheckable(True)
        along.setChecked(not document[Profile].points)
        along.setEnabled(len(document[Pins].pins) > 1)
        turn = menu.addAction("The other way round", partial(self.show, document, points=through[::-1]))
        turn.setEnabled(len(through) > 1)


def _padded(widget: QtWidgets.QWidget) -> QtWidgets.QWidget:
    around = QtWidgets.QWidget()
    row = QtWidgets.QHBoxLayout(around)
    row.setContentsMargins(12, 4, 12, 4)
    row.addWidget(widget)
    return around
