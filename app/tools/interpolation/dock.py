"""The dock of interpolation: anchors with their values, how they are weighed, and the extrema that are at no anchor."""

import time
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.counts import counted
from bihdist_core.formats.anchors import ANCHOR_FORMATS, read_anchors, write_anchors
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
from bihdist_core.scalars import with_decimal_point
from bihdist_core.sources.source import SourceSet

from ...document.document import Document, Panel
from ...document.file_names import file_name
from ...document.quantities import Quantity
from ...document.shared_parts.pins import Pins
from ...drawing.numbers import progress_words
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import RowList, fill
from ...qt.files.saving import ask_file, file_filter, save
from ...qt.look.controls import Segments, TextBox, mark_wrong
from ...qt.look.form import Form, describe, in_column, in_row, push_button, quiet_label
from ...qt.look.look import LOOK
from ...session.chosen_sources import SamplesRequest, find_samples
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import first_source, vertex_at
from .answers import InterpolantMemory
from .extrema import AnchorExtrema
from .gestures import AnchorGestures
from .part import Anchor, Anchors, add_anchor, change_anchor, remove_anchors
from .quantity import Interpolant, interpolants, interpolate, interpolated, show_distances
from .row import BOX_WIDTH_PX, AnchorRow

USUAL_SAMPLES, MAX_SAMPLES = 5, 100
"""More anchors at first, and at most at once."""


class AnchorSamples(QtWidgets.QWidget):
    """A number, and a button: so many points more, each the farthest from all anchors by the active panel's distance.

    What is there keeps its value: where a field is known, each gets what the field has there.
    """

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._background = context.background("samples", find_samples, self._take, self._refuse, self._show_progress)
        self._asked: tuple[Document, AnyArray, int] | None = None  # of whose anchors, by which panel
        tip = "Anchors at points that are farthest from each other, by the active panel's distance"
        self.add = push_button("Add samples", self.add_them, tip)
        self.count = QtWidgets.QSpinBox(minimum=1, maximum=MAX_SAMPLES, value=USUAL_SAMPLES)
        self.count.setAccessibleName("How many samples become anchors")
        in_row(self.add, self.count, None, of=self, spacing=8)

    def add_them(self) -> None:
        """Look for farthest points, and make anchors of them."""
        session, panel = self._context.session, self._panel
        loaded = None if panel is None else session.loaded(panel.surface)
        if panel is None or loaded is None:
            return
        (part,) = panel.shows.parts
        document = session.document
        points = [document.point(anchor.point) for anchor in document[Anchors].anchors]
        there = [vertex_at(point.at, loaded.surface) for point in points if point.surface == panel.surface]
        start = there or [first_source(loaded.surface, loaded.up)]
        self._asked = (document, np.array(there, int), panel.id)
        at = start[0] if len(start) == 1 else SourceSet(tuple(start))
        more = self.count.value() + len(there)
        self._background.ask(SamplesRequest(loaded, document.areas, part.specs[0], at, more))

    def _take(self, request: SamplesRequest, vertices: IntArray) -> None:
        self._context.status.show_progress("")
        asked, self._asked = self._asked, None
        if asked is None:
            return
        session = self._context.session
        document, there, panel = asked
        if (document[Anchors].anchors, document.points) != (session.document[Anchors].anchors, session.document.points):
            return  # they are farthest from others
        answer = session.answer(panel) if len(there) > 1 and session.is_answered(panel) else None
        field = None if answer is None else answer.field
        new = [vertex for vertex in vertices.tolist() if vertex not in there]
        document, surface = session.document, session.document.panel(panel).surface
        with self._context.errors_shown():  # there may be too many
            for rank, vertex in enumerate(new):
                share = rank / max(1, len(new) - 1)
                value = share if field is None else float(field[vertex])
                document, _ = add_anchor(document, vertex, float(f"{value:.3g}"), surface)
            session.show(document)

    def _refuse(self, request: SamplesRequest, sentence: str) -> None:
        self._asked = None
        self._context.status.show_progress("")
        self._context.fail(sentence)

    def _show_progress(self, going: tuple[float, str] | None) -> None:
        self._context.status.show_progress("" if going is None or self._asked is None else progress_words(*going))

    @property
    def _panel(self) -> Panel | None:
        """Return the active panel, or the first that shows an interpolant."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return next((p for p in panels if isinstance(p.shows, Interpolant)), None)


class AnchorClock:
    """Measures how long all panels take to follow the values of anchors."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._begun: float | None = None
        self._columns = 0
        self._anchors: tuple[Anchor, ...] = ()

    def begin(self, anchors: tuple[Anchor, ...]) -> None:
        """Start the clock: the values become these."""
        session = self._context.session
        loaded = session.loaded()
        if loaded is not None and anchors != session.document[Anchors].anchors:
            self._begun, self._columns, self._anchors = time.perf_counter(), _columns(loaded), anchors

    def note(self) -> None:
        """Note that a panel shows another field; the time is told when all do, after they were painted."""
        session = self._context.session
        if session.document[Anchors].anchors != self._anchors:
            self._begun = None  # something else has been done meanwhile
        if self._begun is not None and all(session.is_answered(panel.id) for panel in session.document.panels):
            QtCore.QTimer.singleShot(0, self._say)

    def _say(self) -> None:
        begun, self._begun = self._begun, None
        loaded = self._context.session.loaded()
        if begun is None or loaded is None:
            return
        count = _columns(loaded) - self._columns
        solved = f", with {counted(count, 'new solve')}" if count else ", without solving again"
        self._context.status.show_time(f"Updated in {1000 * (time.perf_counter() - begun):.0f} ms{solved}")


def _columns(loaded: LoadedMesh) -> int:
    """Return the number of columns of distances solved for so far."""
    return loaded.memory(InterpolantMemory).columns


LABEL_WIDTH_PX = 88

HINT = "Click the surface to add an anchor, drag one to move it."
NO_PANEL = "Each panel can show the interpolant of the anchors' values by its distance."


class AnchorsDock(Instrument):
    """The list of anchors, the weights, and the extrema of the interpolants."""

    word = "anchors"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._list = RowList(self._new_row)
        self.rows: dict[str, AnchorRow] = self._list.rows
        self.hint = quiet_label(HINT, wraps=True)
        self.start = push_button("Show interpolants", self.begin)
        self.back = push_button("Show distances", self.end_tool, "Panels show their distances again; the anchors stay")
        self.exponent, self.smoothness = TextBox(), TextBox()
        for box, name, tip in (
            (self.exponent, "Exponent of the weights", "Larger: flatter at anchors, steeper between them; 0.1 to 20"),
            (self.smoothness, "Smoothness of the weights", "How far around anchors cones are rounded, from 0 to 1"),
        ):
            describe(box, name, tip)
            box.setFixedWidth(round(BOX_WIDTH_PX * LOOK.scale))
            box.editingFinished.connect(self._weigh)
        self.shows = Segments({"Interpolant": "interpolant", "Weights": "total"}, "What panels show")
        self.shows.chosen.connect(self._show_total)
        self.extrema = AnchorExtrema(context)
        self.samples = AnchorSamples(context)
        tip = "Save the interpolants that panels show, one column each"
        self.save_field = push_button("Save field…", self.save_fields, tip)
        self._clock = AnchorClock(context)
        self._gestures = context[AnchorGestures]
        self._gestures.chosen.connect(self.choose)
        self._more, self._besides = Form(LABEL_WIDTH_PX), Form()
        self._more.section("Weights")
        for text, control in (("Exponent p", self.exponent), ("Smoothness", self.smoothness), ("Show", self.shows)):
            self._more.row(text, control, control.toolTip())
        self._besides.section("Extrema besides the anchors")
        self._besides.add(self.extrema)
        self._more.add(4, self._besides)
        self._more.section("Samples and fields")
        self._more.add(self.samples, (self.save_field, 0, QtCore.Qt.AlignmentFlag.AlignLeft))
        below = in_column(self.hint, self.start, self.back, self._more, spacing=8, margins=(PAD, 6, PAD, PAD))
        inside = QtWidgets.QWidget()
        in_column(self._list, below, None, of=inside, spacing=0, margins=(0, 4, 0, 0))
        fill(self, inside)
        read = partial(ask_file, context, "Read anchors", file_filter("Anchors", ANCHOR_FORMATS), self.read)
        self.add_head_button("open", "Read anchors: CSV, JSON, landmarks of MeshLab, Slicer and others…", read)
        self.add_head_button("save", "Save the anchors…", self.choose_and_save)
        menu = {
            "Save the interpolants as fields…": self.save_fields,
            "Turn pins into anchors": self.take_pins,
            "": None,
            "Remove all anchors": self.remove_all,
        }
        self.add_head_button("more", "More about anchors", menu)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        anchors = self._anchors(document)
        self.note_changed.emit(str(len(anchors)) if anchors else "")
        self._show_rows(anchors)
        parts = [part for panel in document.panels for part in interpolants(panel.shows)]
        is_on = bool(parts)
        self.start.setVisible(not is_on)
        self.back.setVisible(is_on)
        self.hint.setText(HINT if is_on else NO_PANEL)
        self._more.setVisible(is_on)
        weights = document[Anchors].weights
        for box, value in ((self.exponent, weights.exponent), (self.smoothness, weights.smoothness)):
            if not box.isModified():
                box.setText(f"{value:.6g}")
                mark_wrong(box, False)
        self.shows.choose("total" if parts and all(part.total for part in parts) else "interpolant")
        self._besides.setVisible(any(interpolated(panel.shows) for panel in document.panels_of()))
        self.extrema.show_document(document)

    def show_answer(self, panel: int) -> None:
        self.extrema.show_counts()
        self._clock.note()

    def show_again(self) -> None:
        self.extrema.show_counts()

    def show_closed(self) -> None:
        self.extrema.leave()
        self.context.grid.marks.highlight(self.word, ())

    def leave(self) -> None:
        """Let panels show distances again, in their own ranges."""
        if any(interpolants(panel.shows) for panel in self.document.panels):
            self.end_tool()
            self.context.tell("The panels show distances again; Ctrl+Z brings the interpolants back")

    def _anchors(self, document: Document) -> list[Anchor]:
        surface = document.surfaces[0].name
        return [
            a for a in document[Anchors].anchors if document.point(a.point).surface == surface and a.value is not None
        ]

    def _show_rows(self, anchors: list[Anchor]) -> None:
        names = [anchor.point for anchor in anchors]
        self._list.show_rows(names)
        highlighted = self.context.grid.marks.highlighted(self.word)
        values = [anchor.value for anchor in anchors if anchor.value is not None]
        ends = (min([0.0, *values]), max([1.0, *values]))
        for anchor in anchors:
            row = self.rows[anchor.point]
            row.show_anchor(anchor.name or anchor.point, anchor.value or 0.0, anchor.left_out, ends)
            row.show_chosen(anchor.point in highlighted)

    def _new_row(self, point: str) -> AnchorRow:
        row = AnchorRow(point)
        row.valued.connect(lambda value, is_live: self._value(point, value, is_live))
        row.named.connect(lambda name: self._name(point, name))
        row.left_out.connect(lambda is_out: self._change(point, left_out=is_out))
        row.removed.connect(lambda: self._remove(point))
        row.chosen.connect(lambda: self._gestures.choose(point))
        row.stepped.connect(lambda by: self._step(point, by))
        return row

    def choose(self, point: str) -> None:
        """Highlight the row of this point."""
        if self.word not in self.document.docks:
            return
        for row in self.rows.values():
            row.show_chosen(row.point == point)

    # ------------------------------------------------------------------ edits
    def _anchor(self, point: str) -> Anchor:
        return next(anchor for anchor in self.document[Anchors].anchors if anchor.point == point)

    def begin(self) -> None:
        """Let every panel show the interpolant by its distance."""
        self.context.session.show(interpolate(self.document))

    def end_tool(self) -> None:
        """Show distances again in place of interpolants."""
        self.context.session.show(show_distances(self.document))

    def _value(self, point: str, value: float, is_live: bool) -> None:
        self._gestures.choose(point)
        changed = change_anchor(self.document, replace(self._anchor(point), value=value))
        self._clock.begin(changed[Anchors].anchors)
        self.context.session.show(changed, f"value of {point}", live=is_live)

    def _name(self, point: str, name: str) -> None:
        name = "" if name == point else name
        if name != self._anchor(point).name:
            self._change(point, name=name)

    def _change(self, point: str, **changes: Any) -> None:
        self.context.session.apply(lambda document: change_anchor(document, replace(self._anchor(point), **changes)))

    def _remove(self, point: str) -> None:
        """Remove an anchor, and give the focus to the next row or the last."""
        after = self._list.after_removal(point)
        had_keys = self.rows[point].isAncestorOf(QtWidgets.QApplication.focusWidget() or self)
        self.context.session.show(remove_anchors(self.document, [point]))
        if after:
            self._gestures.choose(after)
            if had_keys:
                self.rows[after].slider.setFocus()

    def _step(self, point: str, by: int) -> None:
        """Move the focus to the same box of the row above or below."""
        beside = self._list.beside(point, by)
        if beside:
            self.rows[beside].take_keys(like=self.rows[point])
            self._gestures.choose(beside)

    def remove_all(self) -> None:
        """Remove all anchors."""
        self.context.session.show(
            remove_anchors(self.document, [anchor.point for anchor in self._anchors(self.document)])
        )

    def _weigh(self) -> None:
        for box, name in ((self.exponent, "exponent"), (self.smoothness, "smoothness")):
            if not box.isModified():
                continue
            try:
                weights = replace(self.document[Anchors].weights, **{name: float(with_decimal_point(box.text()))})
            except (ValueError, ParameterError):
                mark_wrong(box, True)
                continue
            box.setModified(False)
            self.context.session.show(self.document.with_changed(Anchors, weights=weights), name)

    def _show_total(self, word: str) -> None:
        def shown(shows: Quantity) -> Quantity:
            parts = (replace(p, total=word == "total") if isinstance(p, Interpolant) else p for p in shows.parts)
            return shows.with_parts(tuple(parts))

        document = self.document
        self.context.session.show(
            replace(document, panels=tuple(replace(p, shows=shown(p.shows)) for p in document.panels))
        )

    def take_pins(self) -> None:
        """Add an anchor at each pin that is at a vertex, from 0 for the first to 1 for the last."""
        document = self.document
        pins = [(pin.name, document.point(pin.point)) for pin in document[Pins].pins]
        there = [(name, point.at, point.surface) for name, point in pins if isinstance(point.at, int)]
        for k, (name, vertex, surface) in enumerate(there):
            value = round(k / max(1, len(there) - 1), 3)
            document, _ = add_anchor(document, vertex, value, surface, name)
        self.context.session.show(document)

    # ------------------------------------------------------------------ files
    def read(self, path: str) -> None:
        """Add the anchors of a file and say how far they were moved to vertices, or say why it cannot be read."""
        session, document = self.context.session, self.document
        with self.context.errors_shown():
            found = read_anchors(path, session.mesh().surface)
            for vertex, value, name in zip(found.vertices.tolist(), found.values.tolist(), found.names, strict=True):
                document, _ = add_anchor(document, vertex, value, document.surfaces[0].name, name)
            session.show(document)
            far = float(found.moved.max())
            moved = f", moved to vertices by up to {far:.3g}" if far > 0 else ""
            self.context.tell(". ".join([f"Read {len(found):,} anchors from {Path(path).name}{moved}", *found.facts]))

    def choose_and_save(self) -> None:
        """Ask for a file, and write the anchors."""
        document, surface = self.document, self.context.session.mesh().surface
        anchors = self._anchors(document)
        vertices = [vertex_at(document.point(anchor.point).at, surface) for anchor in anchors]
        values = [anchor.value for anchor in anchors if anchor.value is not None]
        names = tuple(anchor.name for anchor in anchors)

        def write(path: str) -> None:
            write_anchors(path, surface, vertices, values, names)

        save(self.context, "Save anchors", file_name([surface.name], "anchors"), ANCHOR_FORMATS, write)

    def save_fields(self) -> None:
        """Save the interpolants that panels show."""
        session, surface = self.context.session, self.context.session.mesh().surface
        fields = {}
        for panel in session.document.panels_of():
            answer = session.answer(panel.id)
            if interpolants(panel.shows) and answer is not None and answer.field is not None:
                fields[str(panel.shows)] = answer.field
        name = file_name([surface.name], "interpolants")
        save(self.context, "Save interpolants", name, FIELD_FORMATS, lambda path: write_fields(path, surface, fields))
