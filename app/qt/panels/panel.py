"""One panel: its head, its view, and its colour bar.  Gestures become signals; it decides nothing."""

from html import escape

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import Surface
from bihdist_core.analysis.places import Places
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.answers import Answer

from ...document.document import COMPARISON, Inset
from ...document.looks import AS_IT_IS, TWENTY_STEPS, Clip, Isolines, Shading
from ...document.quantities import DistanceFrom
from ...marks.marked_panel import label_rows
from ...marks.primitives import Caption
from ...scene.bands import band_edges, beyond
from ...scene.clipping import clip_plane, cut_through
from ...scene.drawable import drawable, rise, warp_by_scalar
from ...scene.field_actor import FieldActor
from ...scene.levels import in_unit, with_kept_step
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.picking import Picker
from ...scene.prepared import Drawn
from ...session.answering import Shown
from ...session.base import Greys
from ...session.isoline_points import IsolinePoint
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import Question
from ..look.form import in_column
from ..look.look import LOOK
from .answer_words import copied_words, reading_of, value_words
from .colour_bar import MOST_LABELS, ColourBar
from .head import PanelHead
from .number_box import EndPopUp
from .overlay import Pointed
from .panel_marks import PanelMarks
from .panel_view import PanelView
from .waiting import Stopped, Waiting, stopped_words

COMPACT_BELOW = 360
"""Logical pixels of a panel's height under which its head and its bar are lower."""

ACCENT = 2
"""Height of the line over the panel that the keys go to."""

NOTHING = Drawn(AS_IT_IS, vtkPolyData(), None)


class DistancePanel(QtWidgets.QWidget):
    """A panel of the document, by its id and the name of its surface."""

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
        self._insets: tuple[Inset, ...] = ()
        self._inside: tuple[Clip | None, float] = (None, 1.0)  # the clip, and the opacity
        self.isolines = TWENTY_STEPS  # of the document
        self._top = 0.0  # where the colours of the answer end
        self.answer: Answer | None = None
        self._asked: Question | None = None  # what is answered by that
        self._is_preview = self._is_waiting = self._in_shares = self._is_compact = self.keeps_step = False
        self.show_active(False)  # as long as it is the only one

    # ------------------------------------------------------------------ how it looks
    def show_active(self, is_active: bool) -> None:
        """Set whether this is the panel that the keys go to."""
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
        """Place the progress over the view, or over an empty bar in a low panel, where the shape fills the view."""
        is_at_bar, view = self._is_compact and self._is_waiting, self.view.geometry()
        top = view.bottom() + 1 if is_at_bar else view.top()
        self.waiting.fit(top, view.width(), self._is_compact, is_at_bar or not self._is_compact)
        self.stopped.fit()

    def clear(self) -> None:
        """Show nothing, and keep nothing of what was shown."""
        self.view.plotter.clear()
        self.view.forget_picture()
        self._forget()

    def _forget(self) -> None:
        self.loaded = self.answer = self._asked = self._height_field = self._raised = None
        self._drawn, self._insets = NOTHING, ()
        self.marks.clear()
        self.view.picker = None
        self.view.scene.show_surface(vtkPolyData(), (0, 1, 0, 1, 0, 1))
        self.view.show_empty(True)
        self.bar.clear()
        self.head.show_warning("")
        self.head.show_surface(None)
        self.show_waiting(None)

    # ------------------------------------------------------------------ state into pixels
    def show_surface(self, loaded: LoadedMesh) -> None:
        """Show another surface without a field yet, or the same one anew with what others have added to it."""
        if loaded is not self.loaded:
            self.view.plotter.clear()
            self.view.forget_picture()
        self._forget()
        self.loaded = loaded
        self.head.show_surface(loaded.surface)
        self.marks.begin(loaded.surface)
        self.view.picker = loaded.prepared.picker
        self._drawn = loaded.prepared.meshes.usual
        self.view.scene.show_surface(self._drawn.mesh, loaded.prepared.bounds)
        self._field_actor.stand_in.take(self._drawn.stand_in)
        self._field_actor.show_bare()
        self.show_inside(*self._inside)
        self.view.show_empty(False)

    def show_shading(self, shading: Shading, drawn: Drawn) -> None:
        """Shade the surface; `drawn` is its mesh for that shading, not raised."""
        actor = self._field_actor
        actor.show_shading(shading)
        if self._height_field is None and drawn is not self._drawn:
            actor.show_normals(drawn.mesh)
            actor.stand_in.take(drawn.stand_in)
        elif self._height_field is not None and shading != self._shading:
            actor.show_normals(drawable(self._height_field, shading))
        self._shading, self._drawn = shading, drawn
        self.view.redraw()

    def show_light(self, light: AnyArray | None) -> None:
        """Darken vertices by the share (n,) of the light that reaches them; None for none."""
        self._field_actor.show_light(light)
        self.view.redraw()

    def show_inside(self, clip: Clip | None, opacity: float) -> bool:
        """Cut the surface as it is drawn by a plane, and let it be translucent; return whether that is otherwise."""
        actor = self._field_actor
        self._inside, before = (clip, opacity), (actor.clip, actor.opacity)
        plane = None if self.shape is None else clip_plane(clip, self.shape)
        actor.show_clip(plane)
        actor.show_cut(None if self.shape is None else cut_through(self.shape, plane))
        actor.show_opacity(opacity)
        self.view.redraw()
        return (actor.clip, actor.opacity) != before

    def show_base(self, base: Greys | None, has_coloured_isolines: bool) -> None:
        """Show greys instead of the field's colours, which isolines may have; or these again."""
        self._field_actor.show_base(base, has_coloured_isolines)
        self.view.redraw()

    def show_insets(self, insets: tuple[Inset, ...]) -> None:
        """Enlarge these places."""
        self._insets = insets
        self.view.scene.insets.show(insets, self.positions)
        self.view.redraw()

    def settle_insets(self) -> None:
        """Put the insets where they hide the least."""
        if self.loaded is not None and self._insets:
            samples = self.loaded.prepared.samples if self._height_field is None else self.positions
            self.view.scene.insets.settle(samples, self.marks.places)

    def show_isolines(self, isolines: Isolines, through: tuple[IsolinePoint, ...] = ()) -> None:
        """Show the isolines of the document, and one through each of these points, which have dots."""
        self.isolines = isolines
        actor = self._field_actor
        actor.show_isolines(self._lines, tuple(point.value for point in through))
        self.marks.mark_passed(through, self.answer)
        actor.show_bands(self._edges)
        self._show_bar()
        self._warn()
        self.view.redraw()

    @property
    def _field_actor(self) -> FieldActor:
        return self.view.scene.field_actor

    @property
    def _edges(self) -> AnyArray:
        """The fractions (k,) of the maximum at which bands end."""
        is_signed = self.answer is not None and self.answer.is_signed
        return band_edges(self._lines, self._field_actor.maximum, is_signed)

    @property
    def _lines(self) -> Isolines:
        """The document's isolines in the unit of the answer."""
        answer, step = self.answer, self._field_actor.levels.step
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
    def positions(self) -> FloatArray:
        """The places (n, 3) where the vertices are drawn."""
        return self.marks.positions

    # ------------------------------------------------------------------ answers
    def show_answer(
        self, shown: Shown, maximum: float | None = None, height: float = 0.0, in_shares: bool = False
    ) -> None:
        """Show a field with its colour bar, or why there is none.

        Parameters
        ----------
        maximum
            Upper colour limit, the field's own maximum if None.
        height
            Height of the height field that a flat surface becomes.
        in_shares
            Whether the bar reads fractions of the maximum.
        """
        self._in_shares = in_shares and shown.answer.signs is None
        self.answer = answer = shown.answer
        self._top = maximum or answer.maximum
        actor = self._field_actor
        if self._lines != actor.isolines:
            actor.show_isolines(self._lines)
        self._raise(answer, self._top, height)
        if answer.colours is not None:
            actor.show_colours(answer.colours, answer.labels is not None)
        elif answer.field is None:
            actor.show_bare(is_plain=not answer.failure)
        else:
            actor.show_field(answer.field, maximum, answer.is_signed, not answer.is_rough)
            actor.show_bands(self._edges)
        self._asked = shown.question
        self.marks.mark_field(answer, self._asked)
        self.view.redraw()
        self.show_waiting(None)
        self.show_error_estimate(shown)
        self._show_bar()

    def _show_bar(self) -> None:
        answer = self._current
        self.bar.show_labels(() if answer is None else label_rows(answer, MOST_LABELS))
        if answer is None or answer.field is None:
            self.bar.clear()
        else:
            actor = self._field_actor
            goes_beyond = beyond(answer.field, actor.maximum, answer.is_signed)
            reading = reading_of(answer, actor, self._in_shares)
            self.bar.show_range(reading, self.view.scene.style, self._edges, goes_beyond)

    def show_caption(self, caption: Caption) -> None:
        """Show what stands at the bar and in the head besides the field."""
        self.bar.show_rest(caption.value, caption.unit)
        self.bar.show_sentence(caption.sentence)
        self.head.show_plain(caption.plain)

    def ask_end(self) -> None:
        """Open the box for the upper colour limit."""
        answer = self._current
        if answer is not None and answer.field is not None:
            self._end.ask(self.bar, self._field_actor.maximum, answer.maximum, answer.unit)

    def _end_at(self, end: float | None) -> None:
        """Emit where the bar ends: what was typed is in the answer's unit, and the document's ends are fractions."""
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
            scene.field_actor.stand_in.take(self._drawn.stand_in)
        else:
            *others, low, high = prepared.bounds
            up = rise(prepared.bounds, height)
            shape = self._height_field = warp_by_scalar(shape, field, top, up)
            self.view.picker = Picker(shape)  # whose blocks are made when somebody points at it
            scene.show_shape(drawable(shape, self._shading), (*others, low - up, high + up))
            scene.field_actor.stand_in.take(None)
        self.show_inside(*self._inside)
        self.marks.follow(shape)
        self.show_insets(self._insets)
        self.settle_insets()

    def show_error_estimate(self, shown: Shown) -> None:
        """Show how accurate the field is."""
        self.answer, self._is_preview = shown.answer, shown.is_preview
        accuracy = shown.answer.accuracy
        self._warn()
        self.head.show_method(shown.question.specs, shown.answer.label, shown.is_preview)
        texts = [shown.answer.label, self.head.shows.hint, accuracy.text]
        self.head.show_info("<br>".join(escape(f"{text[0].upper()}{text[1:]}.") for text in texts if text))

    def _warn(self) -> None:
        """Show a warning of a poor accuracy, or of too many isolines."""
        poor = ""
        if self.answer is not None and self.answer.accuracy.is_poor and not self._is_preview:
            poor = f"Not exact here: only {self.answer.accuracy.text}."
        self.head.show_warning(" ".join(filter(None, (poor, self._field_actor.too_many))))

    def show_waiting(self, progress: tuple[float, str] | None, is_old: bool = True) -> None:
        """Show what is being computed, None for nothing; `is_old` where the field is not the one asked for."""
        self._stand_back(progress is not None and is_old)
        self._place_waiting()
        self.view.over.cover_top(progress is not None and not self._is_compact)
        if progress is None:
            self.waiting.hide()
        else:
            self.waiting.show_progress(*progress)

    def show_behind(self, is_behind: bool) -> None:
        """Let the field be pale, without words, while it is too far behind a source that moves."""
        self.waiting.hide()
        self.view.over.cover_top(False)
        self._stand_back(is_behind)

    def _stand_back(self, is_behind: bool) -> None:
        """Let the field be pale while another is on its way, and mark where that one starts; or no longer."""
        changes = is_behind != self._is_waiting
        self._is_waiting = is_behind
        self.view.dim(is_behind)
        self.stopped.hide()
        # Why there is no field is not said of one that is on its way.
        self.view.over.say("" if is_behind or self.answer is None else self.answer.failure)
        if changes or is_behind:  # the source may go on
            self.marks.mark_field(self.answer, None if is_behind else self._asked)
        if changes:
            self._show_bar()

    def show_stopped(self, shown: Shown | None = None, is_old: bool = True) -> None:
        """Show that the user has stopped it, and what it shows; `is_old` where that is not what was asked for."""
        words = stopped_words(shown)
        if self.stopped.is_saying(words):
            return
        self.show_behind(is_old)
        self.view.over.say("")
        self.stopped.show_words(words)

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
        """Return the vertex that the map shown leads to; None for none, and where no map is shown."""
        leads_to = None if self._current is None else self._current.leads_to
        return None if leads_to is None or leads_to[vertex] < 0 else int(leads_to[vertex])

    def highlight_place(self, place: Places | None) -> None:
        """Put a ring at a place, and its value into the bar, while the pointer is elsewhere, as in a chart."""
        if place is None or self.loaded is None:
            self.point_at(None, False)
            return
        position = place.values(self.positions)[0]
        self.view.over.point_at(Pointed(position, False, not self.view.sees(position)))
        field = None if self._current is None else self._current.field
        self.bar.show_value(None if field is None else float(place.values(field)[0]))

    def words_at(self, vertex: int) -> str:
        """Return the value of a vertex in words, for the clipboard."""
        return copied_words(self._current, vertex, self.head.shows)
