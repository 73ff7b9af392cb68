"""The dock by which one sees inside surfaces: a clip plane, and their opacity."""

from dataclasses import replace

import numpy as np
from qtpy import QtWidgets

from ...document.document import Document
from ...document.looks import AXES, Clip
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import fill
from ...qt.docks.slider_box import Scale, SliderBox
from ...qt.look.controls import Segments
from ...qt.look.form import Form, in_column, in_row, push_button, quiet_label

LABEL_WIDTH_PX, BOX_WIDTH_PX = 56, 54

NONE, VIEW = "none", "view"
"""Words of the directions that are no axes."""

LEAST_OPACITY = 5
"""Percent: what is less opaque is lost."""

PERCENT = Scale(0, 100, steps=1000, digits=1)


class PercentRow(SliderBox):
    """A percentage with a slider and a box."""

    def __init__(self, name: str, tip: str) -> None:
        super().__init__(PERCENT, BOX_WIDTH_PX, lambda value: 0 <= value <= 100, "A number from 0 to 100")
        self.name_value(name, tip)
        in_row((self.slider, 1), self.box, quiet_label("%"), of=self, spacing=8)


class InsideDock(Instrument):
    """The clip plane of all surfaces, and their opacity."""

    word = "inside"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        directions = {"Whole": NONE, "x": "x", "y": "y", "z": "z", "View": VIEW}
        self.direction = Segments(directions, "Cut across")
        self.kept = PercentRow("Kept", "The part of the surface's extent across the plane that is left")
        self.opacity = PercentRow("Opacity", "Below 100 %, what is behind the surface is seen")
        self.flip = push_button("Other side", self._flip, "Show what is cut away, and cut away what is shown")
        form = Form(LABEL_WIDTH_PX)
        form.section("Clip plane")
        form.row("Cut", self.direction, "Cut across an axis, or across the line of sight of the active panel")
        form.row("Kept", self.kept)
        other, inside = QtWidgets.QWidget(), QtWidgets.QWidget()
        in_row(self.flip, None, of=other, spacing=0)
        form.row("Side", other)
        form.section("Translucency")
        form.row("Opacity", self.opacity)
        in_column(form, None, of=inside, spacing=8, margins=(PAD, 8, PAD, PAD))
        fill(self, inside)
        self.opacity.valued.connect(self._let_through)
        self.direction.chosen.connect(self._choose)
        self.kept.valued.connect(lambda percent, _: self._show(replace(self._clip, kept=percent / 100), "clip"))

    @property
    def _clip(self) -> Clip:
        return self.document.clip or Clip()

    def show_document(self, document: Document, before: Document | None) -> None:
        clip = document.clip
        along = "" if clip is None else str(replace(clip, kept=1.0)).partition("@")[0].lstrip("-")
        self.direction.choose(NONE if clip is None else along if along in AXES else VIEW)
        for widget in (self.kept, self.flip):
            widget.setEnabled(clip is not None)
        self.kept.show_value(round(100 * self._clip.kept, 6))
        self.opacity.show_value(round(100 * document.opacity, 6))
        self.note_changed.emit("" if clip is None else f"{100 * clip.kept:.3g} %")

    def _choose(self, word: str) -> None:
        """Cut across an axis, or across the line of sight of now; what is kept stays as much."""
        if word == NONE:
            self._show(None)
        elif word != VIEW:
            self._show(replace(self._clip, normal=AXES[word]))
        elif (panel := self.context.active) is not None:
            x, y, z = np.round(panel.view.camera.GetDirectionOfProjection(), 3).tolist()
            self._show(replace(self._clip, normal=(0.0 - x, 0.0 - y, 0.0 - z)))

    def _flip(self) -> None:
        x, y, z = self._clip.normal
        self._show(Clip((0.0 - x, 0.0 - y, 0.0 - z), round(1 - self._clip.kept, 12)))

    def _let_through(self, percent: float, is_live: bool) -> None:
        opacity = max(percent, LEAST_OPACITY) / 100
        self.context.session.show(replace(self.document, opacity=opacity), "opacity")

    def _show(self, clip: Clip | None, key: str = "") -> None:
        self.context.session.show(replace(self.document, clip=clip), key)
