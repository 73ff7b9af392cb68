"""Selections on all panels, and the brush that paints them on the surface."""

from collections.abc import Iterator

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import Surface
from bihdist_core.analysis.selecting import Brush
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.progress import Progress

from ...document.document import free_names
from ...document.runs import ids_of
from ...document.shared_parts.selections import Selections, select
from ...scene.picking import Hit
from ...scene.style import PINS
from ..context import Context
from ..held_keys import HeldKeys
from ..look.form import describe
from ..panels.events import BrushLift, BrushTouch
from ..panels.panel import DistancePanel

RADII = (4, 28)
"""Limits of the radius in logical pixels; a cursor can be no larger."""

RADIUS = 12

ERASED = "#FFFFFF"
"""Colour of what is removed, while the brush is down."""


class Brushing(QtCore.QObject):
    """The brush of the window, and the selection that it changes.

    Attributes
    ----------
    current
        Name of the selection that strokes are added to, "" for a new one.
    is_on
        Whether drags paint, switched on by a button; they do as well while the key is held.
    cuts
        Whether strokes cut: `cut` is emitted with faces (k,), and with Ctrl whether they come back.
    stroked
        Emitted with the vertices (k,) of a stroke that goes on; they become a step of the history at its end.
    """

    stroked = QtCore.Signal(object)
    switched = QtCore.Signal(bool)
    cut = QtCore.Signal(object, bool)
    cut_switched = QtCore.Signal(bool)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context, self._grid = context, context.grid
        self.current = ""
        self.radius = RADIUS
        self.is_on = self.cuts = self._is_held = False
        self._surface: Surface | None = None  # that the brush is for
        self._brush: Brush | None = None
        self._waiting: list[tuple[Hit, float]] = []  # places touched before the brush is there
        self._is_lifted = True
        self._stroke: AnyArray | None = None  # (n,) bool
        self._is_erasing = False
        self._faces: set[int] = set()  # that the pointer itself has been in
        self._making = context.background("brush", _prepare_brush, self._ready)
        self._grid.events.on(BrushTouch, lambda panel, touch: self._touch(touch.hit, touch.pixel))
        self._grid.events.on(BrushLift, lambda *_: self._lift())
        context[HeldKeys].brush_held.connect(self._hold)

    @property
    def colour(self) -> int:
        """The number of the brush's colour."""
        document = self._context.document
        for each in document[Selections].selections:
            if each.name == self.current:
                return each.colour
        return select(document, "\N{BULLET}", np.array([0]))[Selections].selections[-1].colour

    # ------------------------------------------------------------------ what is chosen
    def choose(self, name: str) -> None:
        """Choose the selection that the brush adds to, "" for a new one."""
        self.current = name

    def select(self, vertices: IntArray, way: str = "new") -> None:
        """Select vertices (k,) as a "new" selection, or let them be "added" to or "removed" from the current one."""
        session = self._context.session
        document = session.document
        known = {each.name: each for each in document[Selections].selections}
        if way == "new" or self.current not in known:
            if way == "removed" or not len(vertices):
                return
            name = free_names("selection", 1, list(known))[0]
            wanted = vertices
        else:
            name, before = self.current, ids_of(known[self.current].runs)
            wanted = np.union1d(before, vertices) if way == "added" else np.setdiff1d(before, vertices)
        after = select(document, name, wanted)
        if name in [each.name for each in after[Selections].selections]:
            self.current = name
        session.show(after)

    @property
    def _panels(self) -> list[DistancePanel]:
        """The panels of the first surface, on which alone the brush paints."""
        return [panel for panel in self._grid.panels if panel.surface == self._grid.camera_controller.surface]

    # ------------------------------------------------------------------ the brush
    def switch(self, is_on: bool, cuts: bool = False) -> None:
        """Switch the brush on or off, for selecting or for cutting."""
        self.is_on, self.cuts = is_on, is_on and cuts
        self._take()
        self.switched.emit(is_on and not cuts)
        self.cut_switched.emit(self.cuts)

    def size_slider(self) -> QtWidgets.QSlider:
        """Return a slider for the radius of the brush."""
        slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal, minimum=RADII[0], maximum=RADII[1])
        slider.setValue(self.radius)
        describe(slider, "Size of the brush", "Size of the brush")
        slider.valueChanged.connect(self.enlarge)
        return slider

    def enlarge(self, radius: int) -> None:
        """Set the radius of the brush in pixels, kept within its limits."""
        self.radius = min(max(radius, RADII[0]), RADII[1])
        self._take()

    def _hold(self, is_held: bool) -> None:
        if is_held != self._is_held:
            self._is_held = is_held
            self._take()

    def _take(self) -> None:
        """Show the cursor of the brush while it is wanted, and prepare the surface."""
        is_wanted = self.is_on or self._is_held
        surface = self._shown
        self._grid.marks.set_brush(_cursor(self.radius, self._grid.devicePixelRatioF()) if is_wanted else None)
        if is_wanted and surface is not None and surface is not self._surface:
            self._surface, self._brush = surface, None
            self._making.ask((surface,))

    @property
    def _shown(self) -> Surface | None:
        loaded = self._context.session.loaded()
        return None if loaded is None else loaded.surface

    def _ready(self, request: tuple[Surface], brush: Brush) -> None:
        self._brush = brush
        waiting, self._waiting = self._waiting, []
        for hit, pixel in waiting:
            self._touch(hit, pixel)
        if self._is_lifted:
            self._lift()

    def _touch(self, hit: Hit, pixel: float) -> None:
        surface = self._shown
        if surface is None:
            return
        self._is_lifted = False
        self._grid.motion.postpone()
        if surface is not self._surface:
            self._take()
        if self._brush is None:
            self._waiting.append((hit, pixel))
            return
        if self._stroke is None or len(self._stroke) != len(surface.vertices):
            self._stroke = np.zeros(len(surface.vertices), bool)
            keys = QtWidgets.QApplication.keyboardModifiers()
            known = [each.name for each in self._context.document[Selections].selections]
            has_ctrl = bool(keys & QtCore.Qt.KeyboardModifier.ControlModifier)
            self._is_erasing = has_ctrl and (self.cuts or self.current in known)
        self._faces.add(hit.face)
        position = hit.weights @ surface.vertices[surface.shape.faces[hit.face]]  # not that in a height field
        near = self._brush.near(hit.face, position, self.radius * pixel)
        new = near[~self._stroke[near]]
        if len(new):
            self._stroke[new] = True
            for panel in self._panels:
                panel.marks.show_dabs(new, self._paint)
            if not self.cuts:
                self.stroked.emit(np.flatnonzero(self._stroke))

    @property
    def _paint(self) -> str:
        """The colour of a stroke; faces that are cut look as if removed."""
        return ERASED if self._is_erasing != self.cuts else PINS[self.colour]

    def _lift(self) -> None:
        self._is_lifted = True
        if self._brush is None and self._waiting:
            return
        stroke, self._stroke = self._stroke, None
        touched, self._faces = self._faces, set()
        for panel in self._grid.panels:
            panel.marks.show_dabs(None)
        surface = self._shown
        if self.cuts and stroke is not None and surface is not None and surface is self._surface:
            within = np.flatnonzero(stroke[surface.shape.faces].all(axis=1))
            self.cut.emit(np.union1d(within, np.array(sorted(touched), np.int64)), self._is_erasing)
        elif stroke is not None and surface is self._surface:
            self.select(np.flatnonzero(stroke), "removed" if self._is_erasing else "added")
        self.stroked.emit(np.empty(0, np.int64))


def _prepare_brush(request: tuple[Surface], progress: Progress) -> Iterator[Brush]:
    brush = Brush(request[0])
    brush.near(0, request[0].vertices[request[0].shape.faces[0, 0]], 1e-300)  # its edges, too
    yield brush


def _cursor(radius: int, ratio: float) -> QtGui.QCursor:
    side = 2 * radius + 6
    picture = QtGui.QPixmap(round(side * ratio), round(side * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    for colour, width in (("#14161A", 3.0), ("#FFFFFF", 1.25)):
        painter.setPen(QtGui.QPen(QtGui.QColor(colour), width))
        painter.drawEllipse(QtCore.QPointF(side / 2, side / 2), radius, radius)
    painter.end()
    return QtGui.QCursor(picture, side // 2, side // 2)
