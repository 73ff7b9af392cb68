"""One panel: its head, its view, and its colour bar.  Gestures become signals; it decides nothing."""

from html import escape

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import Surface
from bihdist_core.analysis.places import Places
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.answers import Answer

from ...document.document import COMPARISON, Zoom
from ...document.looks import AS_IT_IS, TWENTY_STEPS, Isolines, Shading
from ...document.quantities import DistanceFrom
from ...marks.primitives import Caption
from ...scene.bands import band_edges
from ...scene.drawable import drawable
from ...scene.height_field import rise, warp_by_scalar
from ...scene.levels import in_unit, with_kept_step
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.picking import LatePicker
from ...scene.prepared import Drawn
from ...session.answering import Shown
from ...session.isoline_points import IsolinePoint
from ...session.loaded_mesh import LoadedMesh
from ..look.layouts import in_column
from ..look.look import LOOK
from .answer_bar import show_answer
from .colour_bar import ColourBar
from .end_box import EndPopUp
from .head import PanelHead
from .overlay import Pointed
from .panel_marks import PanelMarks
from .panel_view import PanelView
from .stopped import Stopped, stopped_words
from .value_words import copied_words, value_words
from .waiting import Waiting

COMPACT_BELOW = 360
"""Logical pixels of a panel's height under which its head and its bar are lower."""

ACCENT = 2
"""Height of the line over the panel that the keys go to."""

NOTHING = Drawn(AS_IT_IS, vtkPolyData(), None)


class DistancePanel(QtWidgets.QWidget):
    """See the module.  id, surface: those of the document's panel."""

    ended = QtCore.Signal(object)  # where its colour bar is to end, None for the field's own maximum

    def __init__(self, offscreen: OffscreenRenderer, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.id, self.surface = -1, ""
        self.head = PanelHead(DistanceFrom(COMPARISON[0]), self)
        self.view = PanelView(offscreen, self)
        self.marks = PanelMarks(self.view)
        self.bar = ColourBar(self)
        self.bar.end_wanted.connect(self.ask_end)
        self._end = EndPopUp(self)
        self._end.chosen.connect(self._end_at)
        self.waiting = Waiting(self)
        self.stopped = Stopped(self.view)
        self._accent = QtWidgets.QWidget(self, objectName="activeLine")
        self._accent.setAttribute(QtCore.Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        in_column(self.head, (self.view, 1), self.bar, of=self, spacing=0)
        self.view.resized.connect(self._place_waiting)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Ignored)
        self.loaded: LoadedMesh | None = None
        self._height_field: Surface | None = None  # that is drawn instead of the surface
        self._raised: tuple[int, float, float] | None = None  # its field, where that ends, and its height
        self._shading, self._drawn = AS_IT_IS, NOTHING  # of the surface as it lies
        self._zooms: tuple[Zoom, ...] = ()
        self.isolines = TWENTY_STEPS  # of the document
        self._top = 0.0  # where the colours of the answer end
        self.answer: Answer | None = None
        self._is_preview = self._is_waiting = self._in_shares = self._is_compact = self.keeps_step = False
        self.show_active(False)  # as long as it is the only one

    # ------------------------------------------------------------------ how it looks
    def show_active(self, is_active: bool) -> None:
        """Whether this is the panel that the keys go to."""
        self._accent.setVisible(is_active)
        self._accent.raise_()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._is_compact = self.height() < COMPACT_BELOW * LOOK.scale
        self.head.set_compact(self._is_compact)
        self.bar.set_compact(self._is_compact)
        self._accent.setGeometry(0, 0, self.width(), ACCENT)
        self._place_waiting()

    def _place_waiting(self) -> None:
        """Over the view, or where the shape fills that, over the bar, if it is empty; if not, a line has to do."""
        is_at_bar, view = self._is_compact and self._is_waiting, self.view.geometry()
        top = view.bottom() + 1 if is_at_bar else view.top()
        self.waiting.fit(top, view.width(), self._is_compact, is_at_bar or not self._is_compact)
        self.stopped.fit()

    def rest(self) -> None:
        """Show nothing, and keep nothing of what was shown."""
        self.view.plotter.clear()
        self._forget()

    def _forget(self) -> None:
        self.loaded = self.answer = self._height_field = self._raised = None
        self._drawn, self._zooms = NOTHING, ()
        self.marks.rest()
        self.view.picker = None
        self.view.scene.show_surface(vtkPolyData(), (0, 1, 0, 1, 0, 1))
        self.view.show_empty(True)
        self.bar.clear()
        self.head.show_warning("")
        self.head.show_surface(None)
        self.show_waiting(None)

    # ------------------------------------------------------------------ state into pixels
    def show_surface(self, loaded: LoadedMesh) -> None:
        """Another surface, without a field yet; or the same in another look, with what others have added to it."""
        if loaded is not self.loaded:
            self.view.plotter.clear()
        self._forget()
        self.loaded = loaded
        self.head.show_surface(loaded.surface)
        self.marks.begin(loaded.surface)
        self.view.picker = loaded.prepared.picker
        self._drawn = loaded.prepared.meshes.usual
        self.view.scene.show_surface(self._drawn.mesh, loaded.prepared.bounds)
        self.view.scene.take_stand_in(self._drawn.stand_in)
        self.view.scene.show_bare()
        self.view.show_empty(False)

    def show_shading(self, shading: Shading, drawn: Drawn) -> None:
        """Shade the surface so; drawn: the mesh for that, as it lies."""
        scene = self.view.scene
        scene.show_shading(shading)
        if self._height_field is None and drawn is not self._drawn:
            scene.show_normals(drawn.mesh)
            scene.take_stand_in(drawn.stand_in)
        elif self._height_field is not None and shading != self._shading:
            scene.show_normals(drawable(self._height_field, shading))
        self._shading, self._drawn = shading, drawn
        self.view.redraw()

    def show_insets(self, zooms: tuple[Zoom, ...]) -> None:
        """Enlarge these places."""
        self._zooms = zooms
        self.view.scene.insets.show(zooms, self.positions)
        self.view.redraw()

    def settle_insets(self) -> None:
        """Put the insets where they hide the least."""
        if self.loaded is not None and self._zooms:
            samples = self.loaded.prepared.samples if self._height_field is None else self.positions
            self.view.scene.insets.settle(samples, self.marks.places)

    def show_isolines(self, isolines: Isolines, through: tuple[IsolinePoint, ...] = ()) -> None:
        """These, and one through each of the points, which have dots."""
        self.isolines = isolines
        scene = self.view.scene
        scene.show_isolines(self._lines, tuple(point.value for point in through))
        self.marks.mark_passed(through, self.answer)
        scene.show_bands(self._edges)
        self._show_bar()
        self._warn()
        self.view.redraw()

    @property
    def _edges(self) -> AnyArray:
        """(k,) fractions of the maximum at which bands end."""
        is_signed = self.answer is not None and self.answer.is_signed
        return band_edges(self._lines, self.view.scene.maximum, is_signed)

    @property
    def _lines(self) -> Isolines:
        """The document's, as those of the answer."""
        answer, step = self.answer, self.view.scene.levels.step
        if answer is None:
            return self.isolines
        lines = in_unit(self.isolines, answer.scale, self._in_shares, answer.is_signed)
        return with_kept_step(lines, step, self._top, answer.maximum, answer.is_signed) if self.keeps_step else lines

    @property
    def _current(self) -> Answer | None:
        """The answer, unless it is not what is asked for now."""
        return None if self._is_waiting else self.answer

    @property
    def shape(self) -> Surface | None:
        """The surface as it is drawn, perhaps as a height field; None if there is none."""
        return self._height_field or (None if self.loaded is None else self.loaded.surface)

    @property
    def source(self) -> int | None:
        """Where its field starts."""
        return self.marks.source

    @property
    def positions(self) -> FloatArray:
        """(n, 3) where the vertices are drawn."""
        return self.marks.positions

    # ------------------------------------------------------------------ answers
    def show_answer(
        self, shown: Shown, maximum: float | None = None, height: float = 0.0, in_shares: bool = False
    ) -> None:
        """A field with its colour bar up to `maximum`, its own if None; or why there is none.

        height: of the height field that a flat surface becomes.  in_shares: the bar reads fractions of the maximum.
        """
        self._in_shares = in_shares and shown.answer.signs is None
        self.answer = answer = shown.answer
        self._top = maximum or answer.maximum
        scene = self.view.scene
        if self._lines != scene.wanted_isolines:
            scene.show_isolines(self._lines)
        self._raise(answer, self._top, height)
        if answer.colours is not None:
            scene.show_colours(answer.colours)
        elif answer.field is None:
            scene.show_bare(is_plain=not answer.failure)
        else:
            scene.show_field(answer.field, maximum, answer.is_signed, not answer.is_rough)
            scene.show_bands(self._edges)
        self.marks.mark_field(answer)
        self.view.redraw()
        self.show_waiting(None)
        self.show_error_estimate(shown)
        self._show_bar()

    def _show_bar(self) -> None:
        answer = self._current
        if answer is None or answer.field is None:
            self.bar.clear()
        else:
            show_answer(self.bar, answer, self.view.scene, self._edges, self._in_shares)

    def show_caption(self, caption: Caption) -> None:
        """What stands at the bar and in the head besides the field."""
        self.bar.show_rest(caption.value, caption.unit)
        self.bar.show_sentence(caption.sentence)
        self.head.show_plain(caption.plain)

    def ask_end(self) -> None:
        """Let it be typed where the colour bar ends."""
        answer = self._current
        if answer is not None and answer.field is not None:
            self._end.ask(self.bar, self.view.scene.maximum, answer.maximum, answer.unit)

    def _end_at(self, end: float | None) -> None:
        """What was typed is in the answer's unit, and the document's are fractions."""
        scale = 1.0 if self.answer is None else self.answer.scale
        self.ended.emit(None if end is None else end / scale)

    def _raise(self, answer: Answer, top: float, height: float) -> None:
        """Let the surface be a height field of the answer, or flat again."""
        if self.loaded is None:
            return
        prepared, shape, scene = self.loaded.prepared, self.loaded.surface, self.view.scene
        field = answer.field if height and prepared.is_flat else None
        raised = None if field is None else (id(field), top, height)
        if raised == self._raised:
            return
        self._raised = raised
        if field is None:
            self._height_field, self.view.picker = None, prepared.picker
            scene.show_shape(self._drawn.mesh, prepared.bounds)
            scene.take_stand_in(self._drawn.stand_in)
        else:
            *others, low, high = prepared.bounds
            up = rise(prepared.bounds, height)
            shape = self._height_field = warp_by_scalar(shape, field, top, up)
            self.view.picker = LatePicker(shape)  # made when somebody points at it
            scene.show_shape(drawable(shape, self._shading), (*others, low - up, high + up))
            scene.take_stand_in(None)
        self.marks.follow(shape)
        self.show_insets(self._zooms)
        self.settle_insets()

    def show_error_estimate(self, shown: Shown) -> None:
        """How accurate the field is."""
        self.answer, self._is_preview = shown.answer, shown.is_preview
        accuracy = shown.answer.accuracy
        self._warn()
        self.head.show_method(shown.asked.specs, shown.answer.label, shown.is_preview)
        texts = [shown.answer.label, self.head.shows.hint, accuracy.text]
        self.head.show_info("<br>".join(escape(f"{text[0].upper()}{text[1:]}.") for text in texts if text))

    def _warn(self) -> None:
        """Of what is not as one would think."""
        poor = ""
        if self.answer is not None and self.answer.accuracy.is_poor and not self._is_preview:
            poor = f"Not exact here: only {self.answer.accuracy.text}."
        self.head.show_warning(" ".join(filter(None, (poor, self.view.scene.too_many))))

    def show_waiting(self, progress: tuple[float, str] | None, is_old: bool = True) -> None:
        """What is being computed; None when nothing is.  is_old: the field that is shown is not what is asked for."""
        is_waiting = progress is not None and is_old
        changes = is_waiting != self._is_waiting
        self._is_waiting = is_waiting
        self._place_waiting()
        self.view.dim(is_waiting)
        self.stopped.hide()
        # Why there is no field is not said of one that is on its way.
        self.view.over.say("" if is_waiting or self.answer is None else self.answer.failure)
        if progress is None:
            self.waiting.hide()
        else:
            self.waiting.show_progress(*progress)
        if changes and is_waiting:
            # It takes a while: let the place be seen meanwhile.
            self.marks.mark_field(self.answer)
        if changes:
            self._show_bar()

    def show_stopped(self, shown: Shown | None = None, is_old: bool = True) -> None:
        """The user has stopped it, and this is what it shows.  is_old: which is not what is asked for."""
        words = stopped_words(shown)
        if self.stopped.is_saying(words):
            return
        self.show_waiting(None)
        self._is_waiting = is_old
        self.view.dim(is_old)
        self.view.over.say("")
        self.stopped.show_words(words)
        self._show_bar()

    # ------------------------------------------------------------------ the pointer
    def point_at(self, vertex: int | None, is_own: bool, is_hidden: bool = False) -> None:
        """Put the ring at a vertex, and its value into the bar and, under the pointer, beside it."""
        answer = self._current
        words = value_words(answer, vertex, self.head.shows)
        if vertex is None or self.loaded is None:
            self.view.over.point_at(None)
        else:
            value, part = words if is_own else ("", "")
            self.view.over.point_at(Pointed(self.positions[vertex], is_own, is_hidden, value, part))
        if vertex is None or answer is None or answer.field is None:
            self.bar.show_value(None)
        elif np.isnan(answer.field[vertex]):
            self.bar.show_words(words[0])
        else:
            self.bar.show_value(float(answer.field[vertex]))

    def image_of(self, vertex: int) -> int | None:
        """Where the map that is shown leads from a vertex; None for nowhere, and where no map is shown."""
        leads_to = None if self._current is None else self._current.leads_to
        return None if leads_to is None or leads_to[vertex] < 0 else int(leads_to[vertex])

    def echo(self, place: Places | None) -> None:
        """Put a ring at one place, and its value into the bar: somewhere else the pointer is there."""
        if place is None or self.loaded is None:
            self.point_at(None, False)
            return
        position = place.values(self.positions)[0]
        self.view.over.point_at(Pointed(position, False, not self.view.sees(position)))
        field = None if self._current is None else self._current.field
        self.bar.show_value(None if field is None else float(place.values(field)[0]))

    def words_at(self, vertex: int) -> str:
        """Its value in words, for the clipboard."""
        return copied_words(self._current, vertex, self.head.shows)
