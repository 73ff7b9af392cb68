"""Isolines as objects: saved as coordinates, and the region between two values as vertices, a mesh or a selection."""

from typing import Any

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core.analysis.bands import Band, band
from bihdist_core.analysis.level_words import value_from_words
from bihdist_core.analysis.selecting import write_ids
from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError
from bihdist_core.formats.field_output import write_fields

from ...document.file_names import file_name
from ...drawing.numbers import share
from ...qt.background import call
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.files.field_files import Levels, save_isolines
from ...qt.files.saving import Writing
from ...qt.look.controls import TextBox, mark_wrong
from ...qt.look.form import describe, in_column, in_row, push_button, quiet_label
from ...qt.panels.flat_button import FlatButton

SETTLE_MS = 250
"""After the last letter, until the region is looked for."""

REGION_FORMATS = {"ids": (".txt", ".npy", ".csv"), "mesh": (".ply", ".vtp")}


def write_region(path: str, levels: Levels, found: Band, way: str) -> None:
    """Write the region: "ids" of its vertices, or a "mesh" cut along the two isolines, with the field on it."""
    if way == "ids":
        write_ids(path, found.vertices)
    else:
        write_fields(path, found.surface, {levels.label or "field": found.along(levels.field)})


class LevelBox(QtWidgets.QWidget):
    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._levels: Levels | None = None
        self._asked: tuple[Any, ...] | None = None
        self.band: Band | None = None
        tip = "The panel's isolines as coordinates: CSV, OBJ, VTP or JSON"
        self.lines = push_button("Save isolines…", lambda: save_isolines(context, context.grid.active), tip)
        self.low, self.high = TextBox(placeholderText="least"), TextBox(placeholderText="greatest")
        for box, words in ((self.low, "from"), (self.high, "to")):
            describe(box, f"Region: {words}", "A value, or a fraction of the maximum such as 25 %")
            box.textChanged.connect(self._type)
        self.more = FlatButton(self)
        self.more.setText("Save")
        menu = QtWidgets.QMenu(self.more)
        menu.addAction("Select its vertices", self.select)
        menu.addAction("Save vertex ids…", lambda: self.save_region("ids"))
        menu.addAction("Save the cut-out mesh…", lambda: self.save_region("mesh"))
        self.more.setMenu(menu)
        self.more.setToolTip("The region between the two values")
        self.note = quiet_label(wraps=True)
        ends = in_row((self.low, 1), QtWidgets.QLabel("to"), (self.high, 1), self.more, spacing=6)
        in_column(self.lines, ends, self.note, of=self, spacing=6)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=SETTLE_MS)
        self._soon.timeout.connect(self._look)
        self._background = context.background("region", call, self._take, self._refuse)

    def show_levels(self, levels: Levels | None) -> None:
        """Show another panel, or another field."""
        self._levels = levels
        self.setEnabled(levels is not None)
        self._type()

    # ------------------------------------------------------------------ the region
    def _type(self, *_: object) -> None:
        self.band = None
        self.more.setEnabled(False)
        self._soon.start()

    def ends(self) -> tuple[float, float]:
        """Return the two values; ParameterError for text that is not a value."""
        top = self._levels.maximum if self._levels is not None else 1.0
        low, high = (value_from_words(box.text(), top) for box in (self.low, self.high))
        return -np.inf if low is None else low, np.inf if high is None else high

    def _look(self) -> None:
        levels = self._levels
        self.note.setText("The region between two values of the field: type one or both.")
        for box in (self.low, self.high):
            mark_wrong(box, False)
        if levels is None or not (self.low.text().strip() or self.high.text().strip()):
            self._background.ask(None)
            return
        try:
            low, high = self.ends()
        except ParameterError as error:
            self._background.ask(None)
            self._refuse(None, str(error))
            return
        self._background.ask((lambda: band(levels.surface, levels.field, low, high),))

    def _refuse(self, request: object, sentence: str) -> None:
        self.band = None
        self.note.setText(sentence)
        for box in (self.low, self.high):
            mark_wrong(box, bool(box.text().strip()))

    def _take(self, request: object, found: Band) -> None:
        if self._levels is None:
            return  # the field has gone meanwhile
        self.band = found
        self.more.setEnabled(True)
        part = found.area / self._levels.surface.face_areas.sum()
        self.note.setText(f"{counted(len(found.vertices), 'vertex', 'vertices')}, {share(float(part))} of the area")

    # ------------------------------------------------------------------ what becomes of it
    def select(self) -> None:
        """Select the vertices between the two values."""
        if self.band is not None:
            self._context[Brushing].select(self.band.vertices)

    def save_region(self, way: str, path: str = "") -> None:
        """Write what is between the two values, in one of the ways of REGION_FORMATS; ask for a path if none is
        given."""
        levels, found = self._levels, self.band
        if levels is None or found is None:
            return

        def write(path: str) -> None:
            write_region(path, levels, found, way)

        name = file_name([levels.surface.name], "region", levels.name)
        self._context[Writing].save("Save a region", name, REGION_FORMATS[way], write, path)
