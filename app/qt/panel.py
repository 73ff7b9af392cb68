"""One panel of the window: its controls, its words and its view.  Gestures become signals; it decides nothing."""

from collections.abc import Sequence

import numpy as np
from pyvistaqt import QtInteractor
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from bihdist_core import Surface
from bihdist_core.distances.answers import Answer

from ..document.document import COMPARISON, Zoom
from ..document.quantities import DistanceFrom
from ..drawing.field_actor import drawable
from ..drawing.picking import Met, Picker, pixel_of
from ..drawing.relief import relief, rise
from ..drawing.scene import PanelScene
from ..drawing.style import Style
from ..session.anchors import anchor_value
from ..session.answering import Shown
from ..session.opened import Opened
from .controls import PanelControls

MARK_SLACK = 4.0
"""Pixels beside the mark of the source at which it can still be taken hold of."""


class DistancePanel(QtWidgets.QWidget):
    """Controls above, the picture, and the value under the pointer below."""

    clicked = QtCore.Signal(object)  # a `Met`, clicked without dragging
    dragged = QtCore.Signal(int)  # the mark of the source, over a vertex
    released = QtCore.Signal()  # the mark
    hovered = QtCore.Signal(object)  # a vertex, or None beside the surface
    moved = QtCore.Signal()  # the camera
    resized = QtCore.Signal()  # the picture
    changed = QtCore.Signal(object)  # the quantity chosen with the controls

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.id = -1  # that of the document's panel
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)
        self.controls = PanelControls(DistanceFrom(COMPARISON[0]), self)
        self.controls.changed.connect(self.changed)
        self.title = QtWidgets.QLabel("", self, objectName="title")
        self.hint = QtWidgets.QLabel("", self, objectName="hint")
        self.value = QtWidgets.QLabel("", self, objectName="value")
        for label in (self.title, self.hint, self.value):
            label.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
            label.setMinimumWidth(1)
            label.setTextFormat(QtCore.Qt.TextFormat.PlainText)
        # Multisampling costs three times on software rendering, which is what a screen without OpenGL gets; smoothing
        # the picture afterwards (FXAA, below) is nearly free.
        self.interactor = QtInteractor(self, auto_update=False, multi_samples=0)
        self.interactor.setMinimumSize(160, 160)
        # VTK's own keys would close the view or turn it to wireframe.
        self.interactor.iren.interactor.RemoveObservers("CharEvent")
        self.interactor.installEventFilter(self)
        layout = QtWidgets.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        for widget in (self.controls, self.title, self.hint):
            layout.addWidget(widget)
        layout.addWidget(self.interactor, 1)
        layout.addWidget(self.value)
        self.renderer.UseFXAAOn()
        self.scene = PanelScene(self.renderer, scale=self.interactor.devicePixelRatioF())
        self._picker: Picker | None = None
        self._positions = np.empty((0, 3))
        self._press: QtCore.QPoint | None = None
        self._dragging = False
        self._holds_mark = False
        self._source: int | None = None
        self._zooms: tuple[Zoom, ...] = ()
        self._opened: Opened | None = None
        self._raised: tuple[int, float, float] | None = None  # the field, its top, and the height
        self._shape: Surface | None = None
        self._anchors: Sequence[tuple[int, float | None]] = ()
        self.answer: Answer | None = None
        self._is_preview = False

    @property
    def renderer(self) -> vtkRenderer:
        return self.interactor.renderer

    def show_style(self, style: Style) -> None:
        """Look like this from now on; what was shown has to be shown again."""
        ratio = self.interactor.devicePixelRatioF()
        if (style, ratio) != (self.scene.style, self.scene.scale):
            self.scene.remove()
            self.scene = PanelScene(self.renderer, style, ratio)

    def rest(self) -> None:
        """Show nothing, and keep nothing of what was shown."""
        self._opened = self._picker = self.answer = self._source = None
        self._positions, self._raised, self._shape = np.empty((0, 3)), None, None
        self._anchors, self._zooms = (), ()
        self.scene.show_surface(vtkPolyData())

    # ------------------------------------------------------------------ state into pixels
    def show_surface(self, opened: Opened, camera: vtkCamera) -> None:
        """Another surface, without a field yet."""
        self.rest()
        # On the screen that the window is on now.
        self.show_style(self.scene.style)
        self._opened, self._picker, self._positions = opened, opened.prepared.picker, opened.surface.vertices
        self.scene.show_surface(opened.prepared.mesh)
        self.renderer.SetActiveCamera(camera)
        self.renderer.camera_set = True
        self.title.setText("")
        self.value.setText("")
        self.repaint_view()

    def mark_source(self, vertex: int | None) -> None:
        """Where the field starts; None for one that starts nowhere."""
        self._source = vertex
        self.scene.mark_source(self._position(vertex))

    def show_insets(self, zooms: tuple[Zoom, ...]) -> None:
        """Enlarge these places."""
        self._zooms = zooms
        self.scene.insets.show(zooms, self._positions)

    def point_at(self, vertex: int | None) -> None:
        """Mark the vertex under the pointer, and say the value there."""
        self.scene.mark_pointer(self._position(vertex))
        self.show_value(vertex)

    def _position(self, vertex: int | None) -> np.ndarray | None:
        return None if vertex is None else self._positions[vertex]

    def mark_anchors(self, anchors: Sequence[tuple[int, float | None]]) -> None:
        """Vertices with a value each; without one it is the field's own."""
        self._anchors = anchors
        values = [anchor_value(value, vertex, self.answer) for vertex, value in anchors]
        self.scene.mark_anchors(self._positions[[vertex for vertex, _ in anchors]], values)

    def show_answer(self, shown: Shown, maximum: float | None = None, height: float = 0.0) -> None:
        """A field with its colour bar up to `maximum`, its own if None; or why there is none.

        height: of the relief that a flat surface becomes.
        """
        self.answer = answer = shown.answer
        self._raise(answer, maximum or answer.maximum, height)
        if answer.field is None:
            self.scene.show_failure(answer.failure)
        else:
            self.scene.show_field(answer.field, answer.unit, maximum, answer.is_signed)
        self.mark_anchors(self._anchors)
        self.scene.mark_largest(self._position(answer.largest))
        self.title.setText(answer.label)
        self.show_certificate(shown)
        self.repaint_view()

    def _raise(self, answer: Answer, top: float, height: float) -> None:
        """Let the surface be a relief of the answer, or flat again."""
        prepared, surface = self._opened.prepared, self._opened.surface
        is_relief = bool(height) and answer.field is not None and prepared.is_flat
        raised = (id(answer.field), top, height) if is_relief else None
        if raised == self._raised:
            return
        self._raised = raised
        if is_relief:
            surface = relief(surface, answer.field, top, rise(prepared.bounds, height))
        self._picker = None if is_relief else prepared.picker  # made when somebody points at it
        self._positions = surface.vertices
        self._shape = surface
        self.scene.show_shape(drawable(surface) if is_relief else prepared.mesh)
        self.scene.mark_pointer(None)
        self.mark_source(self._source)
        self.show_insets(self._zooms)
        self.settle_insets()

    def settle_insets(self) -> None:
        """Put the insets where they hide the least."""
        if self._opened is not None:
            samples = self._opened.prepared.samples if self._raised is None else self._positions
            self.scene.insets.settle(samples)

    def show_certificate(self, shown: Shown) -> None:
        """How accurate the field is, for who points at its name; `show_note` says it where it is poor."""
        self.answer, self._is_preview = shown.answer, shown.is_preview
        self.title.setToolTip(shown.answer.accuracy.text)

    def show_note(self, text: str) -> None:
        """What is being computed, in place of the hint; an empty text brings the hint back."""
        if self.answer is not None and self._is_preview:
            text = text or "a quick look; the exact one follows"
        self.hint.setText(text or "   ·   ".join(self._remarks()) or self.controls.shows.hint)

    def _remarks(self) -> list[str]:
        """What there is to say about the answer itself."""
        said = []
        if self.answer is not None and self.answer.largest is not None:
            vertex = self.answer.largest
            said.append(f"largest {self.answer.field[vertex]:+.3g} at vertex {vertex}")
        if self.answer is not None and self.answer.accuracy.is_poor:
            said.append(f"not exact here: only {self.answer.accuracy.text}")
        return said

    def show_value(self, vertex: int | None) -> None:
        """The field's value at a vertex, raw and as a share of the maximum."""
        if self.answer is None or self.answer.field is None or vertex is None:
            self.value.setText("")
            return
        d, top = float(self.answer.field[vertex]), self.answer.maximum
        if np.isnan(d):
            starts = self.controls.shows.points
            self.value.setText("not connected to the source" if starts else "undefined here")
        elif self.answer.is_signed:
            self.value.setText(f"{d:+.5g} {self.answer.unit}")
        else:
            self.value.setText(f"{d:.5g}   ·   {d / top:.1%} of the maximum" if top > 0 else f"{d:.5g}")

    def repaint_view(self) -> None:
        # QtInteractor.render() would draw at once, and again when Qt repaints.
        QtWidgets.QWidget.update(self.interactor)

    def picture(self) -> QtGui.QImage:
        """What the view shows, read back from VTK: a native window is not part of QWidget.grab()."""
        pixels = np.ascontiguousarray(self.interactor.screenshot(return_img=True)[..., :3])
        height, width, _ = pixels.shape
        return QtGui.QImage(pixels.data, width, height, 3 * width, QtGui.QImage.Format.Format_RGB888).copy()

    # ------------------------------------------------------------------ gestures into intents
    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """Tell clicks, drags of the source's mark and drags of the view apart; only these last reach VTK."""
        kind = event.type()
        left = QtCore.Qt.MouseButton.LeftButton
        if kind == QtCore.QEvent.Type.MouseButtonPress and event.button() == left:
            return self._pressed(event)
        if kind == QtCore.QEvent.Type.MouseMove:
            return self._moved(event)
        if kind == QtCore.QEvent.Type.MouseButtonRelease and event.button() == left:
            return self._let_go()
        if kind == QtCore.QEvent.Type.Wheel:
            self._camera_may_move()
        elif kind == QtCore.QEvent.Type.Leave:
            self.hovered.emit(None)
        elif kind == QtCore.QEvent.Type.Resize:
            # After VTK has handled it: then the view has its new size.
            QtCore.QTimer.singleShot(0, self._fit_failure)
            self.resized.emit()
        return False

    def _pressed(self, event: QtGui.QMouseEvent) -> bool:
        self._press, self._dragging = event.pos(), False
        plain = event.modifiers() == QtCore.Qt.KeyboardModifier.NoModifier
        self._holds_mark = plain and self._is_on_mark(event.pos())
        if self._holds_mark:
            self.interactor.setCursor(QtCore.Qt.CursorShape.ClosedHandCursor)
        return self._holds_mark

    def _moved(self, event: QtGui.QMouseEvent) -> bool:
        if event.buttons() == QtCore.Qt.MouseButton.NoButton:
            self.hovered.emit(self._vertex_at(event.pos()))
            shape = QtCore.Qt.CursorShape.OpenHandCursor if self._is_on_mark(event.pos()) else None
            self.interactor.unsetCursor() if shape is None else self.interactor.setCursor(shape)
            return True
        if self._press is not None and not self._dragging:
            # A hand that trembles still clicks.
            path = (event.pos() - self._press).manhattanLength()
            if path < QtWidgets.QApplication.startDragDistance():
                return True
            self._dragging = True
            self.hovered.emit(None)
        if self._holds_mark:
            vertex = self._vertex_at(event.pos())
            if vertex is not None:
                self.dragged.emit(vertex)
            return True
        self._camera_may_move()
        return False

    def _let_go(self) -> bool:
        press, self._press = self._press, None
        held, self._holds_mark = self._holds_mark, False
        if held:
            self.interactor.unsetCursor()
        if held and self._dragging:
            self.released.emit()
        elif press is not None and not self._dragging:
            met = self._met_at(press)
            if met is not None:
                self.clicked.emit(met)
        return held

    def _is_on_mark(self, position: QtCore.QPoint) -> bool:
        """Whether the mark of the source is seen under a point of the view."""
        x, y = self._pixel(position)
        picker = self._current_picker()
        if picker is None or self._source is None or self.scene.insets.renderer_at(x, y) is not self.renderer:
            return False
        at = pixel_of(self.renderer, self._positions[self._source])
        reach = (self.scene.style.marker_size / 2 + MARK_SLACK) * self.interactor.devicePixelRatioF()
        if np.hypot(x - at[0], y - at[1]) > reach:
            return False
        return picker.sees(self.renderer, self._positions[self._source])

    def _fit_failure(self) -> None:
        if self.answer is not None and self.answer.failure:
            self.scene.show_failure(self.answer.failure)
            self.repaint_view()

    def _camera_may_move(self) -> None:
        # After VTK has handled the event this filter sees first.
        QtCore.QTimer.singleShot(0, self.moved.emit)

    def _met_at(self, position: QtCore.QPoint) -> Met | None:
        picker, pixel = self._current_picker(), self._pixel(position)
        return None if picker is None else picker.met_at(self.scene.insets.renderer_at(*pixel), *pixel)

    def _current_picker(self) -> Picker | None:
        """Of the surface in its present shape."""
        if self._picker is None and self._shape is not None:
            self._picker = Picker(self._shape)
        return self._picker

    def _vertex_at(self, position: QtCore.QPoint) -> int | None:
        met = self._met_at(position)
        return None if met is None else met.vertex

    def _pixel(self, position: QtCore.QPoint) -> tuple[float, float]:
        """Device pixels, y up."""
        ratio = self.interactor.devicePixelRatioF()
        return (position.x() + 0.5) * ratio, (self.interactor.height() - position.y() - 0.5) * ratio
