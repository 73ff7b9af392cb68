"""The panels of the window, equal in size, those of a surface seen from one camera.

Shows what a session knows; decides nothing."""

from collections.abc import Callable, Collection
from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from ...document.camera import Camera
from ...document.derived_surfaces import COLUMNS, changed_mesh
from ...document.document import Document, Panel
from ...document.panel_edits import edits_that_are_on, possible_edits
from ...document.second_mesh_edits import MOST_SHOWN, letter_of
from ...document.settings import Preferences
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.style import PAPER, Style
from ...session.answering import Shown
from ...session.bar_ends import bar_end, ends_with
from ...session.base import BaseGreys
from ...session.session import Session
from ..look.look import LOOK
from .ambient_occlusion import AmbientOcclusion
from .camera_controller import CameraController
from .events import Events
from .grid_marks import GridMarks
from .line_labels import LineLabels
from .motion_state import MotionState
from .panel import DistancePanel
from .pointing import Pointing
from .shading_cache import ShadingCache

SIDE_BY_SIDE = 3
"""Panels in a row at most, but for those of two meshes that correspond; more stand in rows as even as can be."""

LEAST_WIDTH, LEAST_HEIGHT = 280, 220
"""Least size of a panel in logical pixels; with less room, panels stand below each other and the grid is scrolled."""

LEAST_IN_ROW = 180
"""The same width where panels that belong together stand in a row: before, after, difference."""

LINE = 1
"""Pixels between panels."""

BY_MENUS = (QtCore.Qt.FocusReason.PopupFocusReason, QtCore.Qt.FocusReason.MenuBarFocusReason)
"""Reasons of focus that mean no panel."""


class PanelGrid(QtWidgets.QWidget):
    """The panels of a document by their ids; `events` tells what the mouse does in each."""

    looked = QtCore.Signal(Camera, str)  # where the user has turned or moved the camera of a surface to
    activated = QtCore.Signal(int)  # a panel
    quantity_chosen = QtCore.Signal(int, object)  # in a panel's head
    slider_let_go = QtCore.Signal(int)
    edit_chosen = QtCore.Signal(int, str)  # the text of a `PanelEdit`, in a panel's menu
    save_wanted = QtCore.Signal(int)  # the field of a panel
    bar_ended = QtCore.Signal(int, object)  # where a colour bar is to end, None for the field's own maximum
    cancelled = QtCore.Signal(int)  # the computation for a panel
    retried = QtCore.Signal(int)  # what was cancelled

    def __init__(self, session: Session, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.events = Events()
        self.offscreen = OffscreenRenderer()
        self.motion = MotionState(lambda: [panel.view for panel in self.panels], self)
        self.labels = LineLabels(lambda: self.panels, self)
        self._shading_cache = ShadingCache(self)
        self._shading_cache.made.connect(self.show_shading)
        self.occlusion = AmbientOcclusion(self)
        self.occlusion.made.connect(self.show_shading)
        self.camera_controllers = tuple(
            CameraController(session, lambda: self.panels, self, place) for place in range(MOST_SHOWN)
        )
        self.camera_controller = self.camera_controllers[0]  # that of the first surface
        for controller in self.camera_controllers:
            controller.placed.connect(self._placed)
        self.active = -1  # the id of the panel that the keys go to
        self.wheel_factor = 1.0
        self.keys: Callable[[QtGui.QKeyEvent], bool] = lambda event: False  # what a key does on a view
        self._panels: dict[int, DistancePanel] = {}
        self._spare: list[DistancePanel] = []
        self._style = PAPER
        self._once: list[Callable[[], None]] = []  # once all is painted
        self._is_closed = False
        self._are_in_rows = self._correspond = False
        self.pointing = Pointing()
        self.marks = GridMarks(session, lambda: self._panels, self.motion)
        LOOK.changed.connect(self.update)
        self.show_panels(session.document)
        self.show_edits(session.document)

    @property
    def panels(self) -> list[DistancePanel]:
        """The panels in the order of the document."""
        return list(self._panels.values())

    def panel(self, id: int) -> DistancePanel:
        """Return the panel of an id; KeyError if there is none."""
        return self._panels[id]

    def has(self, id: int) -> bool:
        """Return whether there is a panel of this id."""
        return id in self._panels

    # ------------------------------------------------------------------ where the panels are
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.fillRect(event.rect(), QtGui.QColor(theme.canvas))
        for panel in self.panels:
            # A hairline to the right and below, where there is another.
            painter.fillRect(panel.geometry().adjusted(0, 0, LINE, LINE), QtGui.QColor(theme.border))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        """Lay out the panels, all of one size, whatever is in them; what is left over stands at the right and below."""
        count = len(self._panels)
        if not count:
            return
        room = self.parentWidget().size() if self.parentWidget() is not None else self.size()
        least = LEAST_IN_ROW if self._are_in_rows else LEAST_WIDTH
        fitting = max(1, (room.width() + LINE) // (round(least * LOOK.scale) + LINE))
        rows = -(-count // min(count if self._correspond else SIDE_BY_SIDE, fitting))
        columns = -(-count // rows)
        if self._are_in_rows and fitting >= COLUMNS:
            rows, columns = -(-count // COLUMNS), COLUMNS
        self.setMinimumHeight(rows * (LEAST_HEIGHT + LINE) - LINE)
        width = (self.width() - (columns - 1) * LINE) // columns
        height = (self.height() - (rows - 1) * LINE) // rows
        for number, panel in enumerate(self.panels):
            row, column = divmod(number, columns)
            # The last in a row has what is left over: a pixel or two, no more than a panel has columns.
            panel.setGeometry(column * (width + LINE), row * (height + LINE), width, height)
        self._refit()  # panels that were kept for later may have had this size before

    # ------------------------------------------------------------------ the document
    def show_panels(self, document: Document) -> None:
        """Make, leave out and put in order the panels, and let their heads say what they show."""
        wanted = {panel.id: panel for panel in document.panels}
        self._are_in_rows = changed_mesh(document) is not None
        self._correspond = any(panel.shows.relates_surfaces for panel in document.panels)
        for id in self._panels.keys() - wanted.keys():
            gone = self._panels.pop(id)
            gone.hide()
            gone.clear()
            # Kept for the next: VTK does not give back all the memory of a scene that is gone.
            self._spare.append(gone)
        for id, panel in wanted.items():
            is_new = id not in self._panels
            if is_new:
                self._panels[id] = self._spare.pop() if self._spare else self._new_panel()
            if is_new or self._panels[id].surface != panel.surface:
                self._begin(self._panels[id], panel)
            head, loaded = self._panels[id].head, self._session.loaded(panel.surface)
            head.show_quantity(panel.shows, [each.name for each in document.fields if each.surface == panel.surface])
            head.show_letter(letter_of(document, panel), "" if loaded is None else loaded.surface.name)
        self._panels = {id: self._panels[id] for id in wanted}
        self.pointing.begin(self._panels)
        self._arrange()
        self.update()
        if self.active not in self._panels:
            self.activate(next(iter(self._panels), -1))
        self._show_active()

    def show_edits(self, document: Document) -> None:
        """Let the panels' menus offer what is possible now; pins alone may change that."""
        for id, panel in self._panels.items():
            panel.head.allow(possible_edits(document, id), edits_that_are_on(document, id))

    def _new_panel(self) -> DistancePanel:
        panel = DistancePanel(self.offscreen, self)
        view = panel.view
        view.pressed.connect(lambda: self.activate(panel.id))
        view.happened.connect(lambda event: self.events.emit(panel.id, event))
        view.moved.connect(lambda: self._looked(panel))
        view.camera_released.connect(self.motion.stop)
        view.resized.connect(self._refit)
        view.drawn.connect(self._drawn)
        view.installEventFilter(self)
        self.labels.watch(panel)
        panel.head.clicked.connect(lambda: self.activate(panel.id))
        for signal, with_id in (
            (panel.head.changed, self.quantity_chosen),
            (panel.head.let_go, self.slider_let_go),
            (panel.head.asked, self.edit_chosen),
            (panel.head.save_wanted, self.save_wanted),
            (panel.ended, self.bar_ended),
            (panel.waiting.cancelled, self.cancelled),
            (panel.stopped.retried, self.retried),
        ):
            signal.connect(lambda *values, with_id=with_id: with_id.emit(panel.id, *values))
        view.show_style(self._style)
        return panel

    def _begin(self, panel: DistancePanel, shown: Panel) -> None:
        """Let a panel be one of the document's, without a field yet."""
        panel.id, panel.surface = shown.id, shown.surface
        loaded, controller = self._session.loaded(panel.surface), self.controller_of(panel.surface)
        panel.view.plotter.look_through(controller.camera)
        panel.view.show_style(self._style)
        if loaded is not None:
            panel.show_surface(loaded)
            self._shade(panel)
        panel.view.wheel_factor = self.wheel_factor
        panel.view.upright = controller.upright
        panel.view.over.show_axes(self._session.document.axes)
        panel.view.over.show_scale_bar(self._session.document.scale_unit)
        self.marks.begin(panel)
        panel.show()

    def show_style(self, style: Style) -> bool:
        """Let all panels have a style; return whether their fields have to be shown again."""
        if self._is_closed:
            return False  # the colours of the desktop have changed, or those of another window
        self._style = style
        changed = [panel.view.show_style(style) for panel in (*self.panels, *self._spare)]
        return any(changed)

    def show_surface(self, surfaces: Collection[str] | None = None) -> None:
        """Show surfaces that are new, all of them or those of these names."""
        for panel in self.panels:
            loaded = self._session.loaded(panel.surface)
            if loaded is not None and (surfaces is None or panel.surface in surfaces):
                panel.show_surface(loaded)
                panel.head.show_letter(panel.head.letter, loaded.surface.name)
        self.pointing.leave()
        self.show_shading()

    def show_shading(self) -> None:
        """Shade all surfaces as the document says, once their meshes are there."""
        if not self._is_closed:
            for panel in self.panels:
                self._shade(panel)

    def _shade(self, panel: DistancePanel) -> None:
        shading, loaded = self._session.document.shading, self._session.loaded(panel.surface)
        if loaded is not None:
            panel.show_shading(shading, self._shading_cache.drawn(loaded.prepared.meshes, shading))
            panel.show_light(self.occlusion.light(loaded.prepared.meshes))

    def show_base(self, document: Document) -> None:
        """Show the greys of the document's base on all surfaces, or none."""
        for panel in document.panels:
            loaded = self._session.loaded(panel.surface)
            if loaded is not None:
                greys = loaded.memory(BaseGreys).greys(document, panel, loaded)
                self._panels[panel.id].show_base(greys, not document.base.white_isolines)

    # ------------------------------------------------------------------ answers
    def show_answer(self, id: int) -> None:
        """Show the answer that the session has now for a panel."""
        document, shown = self._session.document, self._session.shown
        for other in ends_with(document, shown, id):
            if other in self._panels:
                end, in_shares = bar_end(document, shown, other, self._session.loaded), document.range == "fraction"
                self._panels[other].show_answer(self._in_unit(shown[other]), end, document.warp_factor, in_shares)
                self.marks.show_isolines_again(document, other)
                self.marks.show_in(document, other)
        self.pointing.show_again_soon()

    def show_error_estimate(self, id: int) -> None:
        """Show in a panel's head how accurate its answer is."""
        self._panels[id].show_error_estimate(self._in_unit(self._session.shown[id]))

    def _in_unit(self, shown: Shown) -> Shown:
        """Return an answer in the unit that the document names."""
        unit = self._session.document.unit_of(shown.answer.unit)
        return shown if unit == shown.answer.unit else replace(shown, answer=replace(shown.answer, unit=unit))

    # ------------------------------------------------------------------ the camera
    def _placed(self) -> None:
        self.marks.settle_insets()
        self.redraw()

    def show_axes(self, has_axes: bool) -> None:
        """Show in all panels which way the axes point, or no longer."""
        for panel in self.panels:
            panel.view.over.show_axes(has_axes)

    def show_scale_bar(self, document: Document) -> None:
        """Show in all panels how long a round length is, or no longer."""
        for panel in self.panels:
            panel.view.over.show_scale_bar(document.scale_unit)

    def show_inside(self) -> None:
        """Cut all surfaces by the document's plane, and let them be translucent; large ones are drawn in full later."""
        document = self._session.document
        changed = [panel.show_inside(document.clip, document.opacity) for panel in self.panels]
        if any(changed):
            self.motion.moved()

    def follow_preferences(self, preferences: Preferences) -> None:
        """Turn, zoom and shade as the user prefers."""
        self.wheel_factor = -1.0 if preferences.wheel_reversed else 1.0
        for panel in (*self.panels, *self._spare):
            panel.view.wheel_factor = self.wheel_factor
        self.camera_controller.is_turntable = preferences.turntable
        self.turn_upright()
        if self.occlusion.is_on != preferences.ambient_occlusion:
            self.occlusion.is_on = preferences.ambient_occlusion
            self.show_shading()

    def turn_upright(self) -> None:
        """Let surfaces turn about what is up now, freely or as on a turntable."""
        for controller in self.camera_controllers:
            controller.is_turntable = self.camera_controller.is_turntable
        for panel in self.panels:
            panel.view.upright = self.controller_of(panel.surface).upright

    def controller_of(self, surface: str) -> CameraController:
        """Return the camera of a surface, by its name in the document."""
        return next(
            (controller for controller in self.camera_controllers if surface and controller.surface == surface),
            self.camera_controller,
        )

    def _refit(self) -> None:
        for controller in self.camera_controllers:
            controller.refit()

    def _looked(self, panel: DistancePanel) -> None:
        """Take the move of a panel's camera by the user; linked cameras of other surfaces follow."""
        if self._session.loaded() is None:
            return
        controller = self.controller_of(panel.surface)
        before, after = controller.known, controller.note()
        seen = {controller.surface: after}
        for other in self.camera_controllers if self._session.document.linked else ():
            followed = None if other is controller or before is None else other.follow(before, after)
            if followed is not None:
                seen[other.surface] = followed
        self.motion.moved()
        self.redraw()
        for surface, camera in seen.items():
            self.looked.emit(camera, surface)

    def redraw(self) -> None:
        """Draw each panel once more, when Qt paints next."""
        for panel in self.panels:
            panel.view.redraw()
        self.pointing.show_again_soon()

    def once_painted(self, function: Callable[[], None]) -> None:
        """Call a function when the panels have been painted as they are now: at once if they have."""
        if not any(panel.view.is_stale for panel in self.panels):
            function()
        elif function not in self._once:
            self._once.append(function)

    def _drawn(self) -> None:
        """Wait for the other views, which are drawn next, and then all come to the screen."""
        if self._once:
            QtCore.QTimer.singleShot(0, self._painted)

    def _painted(self) -> None:
        if any(panel.view.is_stale for panel in self.panels):
            return  # they wait until keys and clicks have been looked at
        once, self._once = self._once, []
        for function in once:
            function()

    def draw_in_full(self) -> None:
        """Draw the panels with all that comes only once the camera rests."""
        self.motion.stop()
        for panel in self.panels:
            panel.view.shot()

    # ------------------------------------------------------------------ the keys
    def activate(self, id: int) -> None:
        """Let a panel be the one that the keys and the menu Panels mean."""
        if id != self.active:
            self.active = id
            self._show_active()
            self.activated.emit(id)

    def _show_active(self) -> None:
        for id, panel in self._panels.items():
            panel.show_active(id == self.active and len(self._panels) > 1)

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        # A menu that closes gives the keys back to where they were, wherever one has pressed since.
        if event.type() == QtCore.QEvent.Type.FocusIn and event.reason() not in BY_MENUS:
            for id, panel in self._panels.items():
                if panel.view is watched:
                    self.activate(id)
        if event.type() == QtCore.QEvent.Type.KeyPress and self.keys(event):
            return True
        return bool(super().eventFilter(watched, event))

    def focus(self, step: int = 0) -> None:
        """Give the keys to the active panel, or to another, so many steps on."""
        ids = list(self._panels)
        if ids:
            place = ids.index(self.active) if self.active in ids else 0
            self._panels[ids[(place + step) % len(ids)]].view.setFocus(QtCore.Qt.FocusReason.ShortcutFocusReason)

    def close_views(self) -> None:
        """Close the views: nothing is drawn from now on."""
        self._is_closed = True
        self.labels.close()
        self.offscreen.close()
