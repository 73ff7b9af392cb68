"""The controls of a profile's path: its ends, and how it goes from point to point."""

from collections.abc import Callable
from functools import partial
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.analysis.plane_sections import PARTS

from ...document.document import Document
from ...document.shared_parts.pins import Pins, pinned_at
from ...qt.context import Context
from ...qt.look.controls import TextBox
from ...qt.look.form import in_row, quiet_label
from ...qt.panels.flat_button import add_entry, menu_button
from .badges import BadgeButton, BadgeRow, badge_of
from .part import SECTIONS, Profile, points_along

WAYS = {
    "auto": "shortest geodesic",
    "exact": "shortest geodesic, exact",
    "edges": "shortest path along edges",
    **{way: PARTS[part] for way, part in SECTIONS.items()},
}
"""The names of the ways; the label of a path that has been found says more."""


class PathControls:
    """The widgets in the head of the profile's dock, and the edits that their menus make.

    Vertices that are typed are on the surface `surface()`; planes lie in the direction `view_direction()`.
    """

    def __init__(
        self,
        parent: QtWidgets.QWidget,
        context: Context,
        surface: Callable[[], str],
        view_direction: Callable[[], tuple[float, float, float]],
    ) -> None:
        self._context, self._surface, self._view_direction = context, surface, view_direction
        self.ends = (BadgeButton(parent, "From"), BadgeButton(parent, "To"))
        self._between = BadgeRow(parent)
        for k, button in enumerate(self.ends):
            button.menu().aboutToShow.connect(partial(self.fill_ends, k))
        self.way = menu_button(parent, self._fill_ways, "", "Way of the profile", quiet=True)
        self.way.setSizePolicy(QtWidgets.QSizePolicy.Policy.Preferred, QtWidgets.QSizePolicy.Policy.Fixed)
        self.widgets = [self.ends[0], self._between, quiet_label("to"), self.ends[1], self.way]

    @property
    def _document(self) -> Document:
        return self._context.document

    # ------------------------------------------------------------------ what is shown
    def show_document(self, document: Document) -> None:
        """Show the points that the path goes through."""
        through = points_along(document)
        for k, button in enumerate(self.ends):
            button.show_badge(badge_of(document, through[-k]) if len(through) > 1 else None)
        self._between.show_badges(tuple(badge_of(document, name) for name in through[1:-1]))

    def show_way(self, label: str) -> None:
        """Show how a path that has been found goes from point to point, or "" for the way that is chosen."""
        self.way.setText(label or WAYS[self._document[Profile].way])
        self.way.setToolTip(f"How the profile goes from point to point: {self.way.text()}")
        self.way.updateGeometry()

    # ------------------------------------------------------------------ edits
    def edit(self, document: Document, **profile: Any) -> None:
        """Change these fields of the document's profile."""
        self._context.session.show(document.with_changed(Profile, **profile))

    def choose_way(self, way: str) -> None:
        """Choose a way; a section keeps its plane whatever part of it is taken, and a new one goes through the view."""
        across = (self._document[Profile].across or self._view_direction()) if way in SECTIONS else None
        self.edit(self._document, way=way, across=across)

    def turn_plane(self) -> None:
        """Turn the plane of the section to the view as it is now."""
        self.edit(self._document, across=self._view_direction())

    def choose_end(self, k: int, name: str, document: Document | None = None) -> None:
        """Let the profile begin (0) or end (1) at a point."""
        document = document or self._document
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
            self._context.fail("A profile needs two points; choose the other end first.")
            return
        self.edit(document, points=(name, other) if k == 0 else (other, name))

    def type_end(self, k: int, text: str) -> None:
        """Pin the vertex that is typed, and let it be an end."""
        name = self._surface()
        with self._context.errors_shown():
            if not text.strip().isdigit():
                raise ParameterError(f"A vertex id is a whole number, not {text.strip()!r}.")
            vertex = self._context.session.mesh(name).surface.check_vertex(int(text))
            document, point = pinned_at(self._document, vertex, name)
            self.choose_end(k, point, document)

    # ------------------------------------------------------------------ menus
    def fill_ends(self, k: int) -> None:
        """Fill the menu of the first (0) or last (1) point."""
        menu, document = self.ends[k].menu(), self._document
        menu.clear()
        through = points_along(document)
        points = [*(point.name for point in document.points if point.name.startswith("source"))]
        for name in [*points, *(pin.point for pin in document[Pins].pins)]:
            badge = badge_of(document, name)
            is_on = len(through) > 1 and through[-k] == name
            add_entry(menu, badge.name[:1].upper() + badge.name[1:], partial(self.choose_end, k, name), is_on)
        menu.addSeparator()
        box = TextBox(placeholderText="Vertex id", accessibleName="Vertex id")
        box.returnPressed.connect(partial(self._take_typed, k, box))
        typed, around = QtWidgets.QWidgetAction(menu), QtWidgets.QWidget()
        in_row(box, of=around, margins=(12, 4, 12, 4))
        typed.setDefaultWidget(around)
        menu.addAction(typed)

    def _take_typed(self, k: int, box: QtWidgets.QLineEdit) -> None:
        text = box.text()
        self.ends[k].menu().close()
        # The menu with the box is gone by then.
        QtCore.QTimer.singleShot(0, partial(self.type_end, k, text))

    def _fill_ways(self, menu: QtWidgets.QMenu) -> None:
        document, through = self._document, points_along(self._document)
        for way, words in WAYS.items():
            words = "shortest geodesic, as exact as possible" if way == "auto" else words
            if way == "section":
                menu.addSeparator()
            is_on, can = document[Profile].way == way, len(through) < 3 or SECTIONS.get(way) != "whole"
            add_entry(menu, words[:1].upper() + words[1:], partial(self.choose_way, way), is_on, can)
        add_entry(menu, "Turn the plane to the view", self.turn_plane, can=document[Profile].way in SECTIONS)
        menu.addSeparator()
        along, can = partial(self.edit, document, points=()), len(document[Pins].pins) > 1
        add_entry(menu, "Through all pins, in order", along, not document[Profile].points, can)
        turn = partial(self.edit, document, points=through[::-1])
        add_entry(menu, "Reverse the path", turn, can=len(through) > 1)
