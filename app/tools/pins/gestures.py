"""Clicks, drags and menus that add, choose, move and remove pins."""

from functools import partial

from qtpy import QtCore, QtWidgets

from bihdist_core.sources.source import Source

from ...document.edits import move_source, put_point
from ...document.shared_parts.pins import Pin, Pins, add_pins, remove_pins
from ...qt.context import Context
from ...qt.gesture import Gesture
from ...qt.panels.events import Click
from ...qt.snapping import Snapping
from ...scene.picking import Hit


class PinGestures(Gesture):
    tool = "pins"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._grid, self._at = context.grid, context[Snapping].at

    def takes(self, panel: int, click: Click) -> bool:
        return click.has_shift

    def click(self, panel: int, click: Click) -> None:
        self.put(panel, click.hit)

    def put(self, panel: int, hit: Hit) -> None:
        """Add a pin, unless there is one."""
        at, surface = self._at(panel, hit), self.document.panel(panel).surface
        self.context.session.apply(lambda document: add_pins(document, [at], surface))

    def offer_always(self, menu: QtWidgets.QMenu, panel: int, hit: Hit | None, where: QtCore.QPoint) -> None:
        """Add what can be done with a pin or a place to a menu."""
        view = self._grid.panel(panel).view
        found = view.over.points.standing_at(view.mapFromGlobal(where))
        number = found[1] if found and found[0] == self.tool else 0
        if not number and hit is not None:
            number = self._number_at(panel, self._at(panel, hit))
        if number:
            pin = self._pin(number)
            menu.addAction(f"Source at {_name(pin, number)}", lambda: self._move_source(panel, pin.point))
            remove = partial(remove_pins, points=[pin.point])
            menu.addAction(f"Remove {_name(pin, number)}", lambda: self.context.session.apply(remove))
        elif hit is not None:
            menu.addAction("Pin here\tShift+click", lambda: self.put(panel, hit))

    # ------------------------------------------------------------------ what it does
    def _pin(self, number: int) -> Pin:
        return self.document[Pins].pins[number - 1]

    def _number_at(self, panel: int, at: Source) -> int:
        """Return the number of the pin at a place, 0 for none."""
        document = self.document
        surface = document.panel(panel).surface
        points = [document.point(pin.point) for pin in document[Pins].pins]
        return next((k for k, point in enumerate(points, 1) if (point.at, point.surface) == (at, surface)), 0)

    def click_mark(self, panel: int, number: int, has_ctrl: bool) -> None:
        """Highlight a pin, or no longer, and name it; an open list of pins does that itself."""
        if "pins" in self.document.docks:
            return  # the list does it
        pin, highlighted = self._pin(number), set(self._grid.marks.highlighted(self.tool))
        chosen = highlighted ^ {pin.point} if has_ctrl else {pin.point} - highlighted
        self._grid.marks.highlight(self.tool, tuple(chosen))
        if pin.point in chosen:
            where = self.document.point(pin.point).at
            noun = self.context.session.mesh(panel).surface.nouns[0]
            place = f"{noun} {where}" if isinstance(where, int) else "in a face"
            self.context.tell(f"{_name(pin, number).capitalize()}: {place}")

    def drag(self, panel: int, number: int, hit: Hit) -> None:
        """Move a pin as one step of the history, past places that another has."""
        session = self.context.session
        document, at = session.document, self._at(panel, hit)
        pin = self._pin(number)
        point = document.point(pin.point)
        if at != point.at and not self._number_at(panel, at):
            session.show(put_point(document, point.name, at, point.surface), key=f"drag of {point.name}", live=True)

    def _move_source(self, panel: int, point: str) -> None:
        session = self.context.session
        document = session.document
        pinned = document.point(point)
        if pinned.at is not None and pinned.surface == document.panel(panel).surface:
            session.show(move_source(document, panel, pinned.at))


def _name(pin: Pin, number: int) -> str:
    return f"pin {number}{f', {pin.name}' if pin.name else ''}"
