"""One panel of the window: its controls, its words and its view.  Gestures become signals; it decides nothing."""

import numpy as np
from pyvistaqt import QtInteractor
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from bihdist_core.distances.kinds import Spec

from ..picking import Picker
from ..scene import PanelScene
from ..session import PanelAnswer
from .controls import PanelControls


class DistancePanel(QtWidgets.QWidget):
    """Controls above, the picture, and the value under the pointer below."""

    clicked = QtCore.Signal(int)  # a vertex, clicked without dragging
    hovered = QtCore.Signal(object)  # a vertex, or None beside the surface
    moved = QtCore.Signal()  # the camera
    resized = QtCore.Signal()  # the picture
    changed = QtCore.Signal(object)  # the distance chosen with the controls: a Spec

    def __init__(self, spec: Spec, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)
        self.controls = PanelControls(spec, self)
        self.controls.changed.connect(self.changed)
        self.title = QtWidgets.QLabel("", self, objectName="title")
        self.hint = QtWidgets.QLabel("", self, objectName="hint")
        self.value = QtWidgets.QLabel("", self, objectName="value")
        for label in (self.title, self.hint, self.value):
            label.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
            label.setMinimumWidth(1)
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
        self._press: QtCore.QPoint | None = None
        self._dragging = False
        self.answer: PanelAnswer | None = None

    @property
    def renderer(self) -> vtkRenderer:
        return self.interactor.renderer

    # ------------------------------------------------------------------ state into pixels
    def show_surface(self, mesh: vtkPolyData, picker: Picker, camera: vtkCamera) -> None:
        self._picker = picker
        self.answer = None
        self.scene.show_surface(mesh)
        self.renderer.SetActiveCamera(camera)
        self.renderer.camera_set = True
        self.title.setText("")
        self.value.setText("")
        self.repaint_view()

    def show_answer(self, answer: PanelAnswer) -> None:
        self.answer = answer
        if answer.field is None:
            self.scene.show_failure(answer.failure)
        else:
            self.scene.show_field(answer.field, answer.unit)
        self.title.setText(answer.label)
        self.show_certificate(answer)
        self.repaint_view()

    def show_certificate(self, answer: PanelAnswer) -> None:
        """How accurate the field is, for who points at its name; `show_note` says it where it is poor."""
        self.answer = answer
        self.title.setToolTip(answer.certificate.text)

    def show_note(self, text: str) -> None:
        """What is being computed, in place of the hint; an empty text brings the hint back."""
        if self.answer is not None and self.answer.preview:
            text = text or "a better one is on its way"
        if self.answer is not None and self.answer.certificate.is_poor:
            text = text or f"not exact here: only {self.answer.certificate.text}"
        self.hint.setText(text or self.controls.spec.kind.hint)

    def show_value(self, vertex: int | None) -> None:
        """The field's value at a vertex, raw and as a share of the maximum."""
        if self.answer is None or self.answer.field is None or vertex is None:
            self.value.setText("")
            return
        d, top = float(self.answer.field[vertex]), self.answer.maximum
        if np.isnan(d):
            self.value.setText("not connected to the source")
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
        """Tell a click from a drag: moves shorter than a drag are not passed on to VTK."""
        kind = event.type()
        if kind == QtCore.QEvent.Type.MouseButtonPress and event.button() == QtCore.Qt.MouseButton.LeftButton:
            self._press, self._dragging = event.pos(), False
        elif kind == QtCore.QEvent.Type.MouseMove:
            if event.buttons() == QtCore.Qt.MouseButton.NoButton:
                self.hovered.emit(self._vertex_at(event.pos()))
                return True
            if self._press is not None and not self._dragging:
                path = (event.pos() - self._press).manhattanLength()
                if path < QtWidgets.QApplication.startDragDistance():
                    return True
                self._dragging = True
            self._camera_may_move()
        elif kind == QtCore.QEvent.Type.Wheel:
            self._camera_may_move()
        elif kind == QtCore.QEvent.Type.MouseButtonRelease and event.button() == QtCore.Qt.MouseButton.LeftButton:
            press, self._press = self._press, None
            if press is not None and not self._dragging:
                vertex = self._vertex_at(press)
                if vertex is not None:
                    self.clicked.emit(vertex)
        elif kind == QtCore.QEvent.Type.Leave:
            self.hovered.emit(None)
        elif kind == QtCore.QEvent.Type.Resize:
            # After VTK has handled it: then the view has its new size.
            QtCore.QTimer.singleShot(0, self._fit_failure)
            self.resized.emit()
        return False

    def _fit_failure(self) -> None:
        if self.answer is not None and self.answer.failure:
            self.scene.show_failure(self.answer.failure)
            self.repaint_view()

    def _camera_may_move(self) -> None:
        # After VTK has handled the event this filter sees first.
        QtCore.QTimer.singleShot(0, self.moved.emit)

    def _vertex_at(self, position: QtCore.QPoint) -> int | None:
        if self._picker is None:
            return None
        ratio = self.interactor.devicePixelRatioF()
        x = (position.x() + 0.5) * ratio
        y = (self.interactor.height() - position.y() - 0.5) * ratio
        return self._picker.vertex_at(self.renderer, x, y)
