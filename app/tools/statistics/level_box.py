"""Isolines as objects: saved as coordinates, and the region between two values as vertices, a mesh or a selection."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core.analysis.bands import Band, band
from bihdist_core.analysis.level_words import value_from_words
from bihdist_core.analysis.selecting import write_ids
from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError
from bihdist_core.formats.field_output import write_fields
from bihdist_core.progress import Progress

from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.files.isoline_files import Levels, save_isolines
from ...qt.files.writing import Writing
from ...qt.look.numbers import share
from ...qt.look.text_box import TextBox, mark_wrong
from ...qt.panels.flat_button import FlatButton

REST_MS = 250
"""After the last letter, until the region is looked for."""

REGION_FORMATS = {"ids": (".txt", ".npy", ".csv"), "mesh": (".ply", ".vtp")}


def write_region(path: str, levels: Levels, found: Band, way: str) -> None:
    """way: "ids" of the vertices in the region, or "mesh", cut along the two isolines, with the field on it."""
    if way == "ids":
        write_ids(path, found.vertices)
    else:
        write_fields(path, found.surface, {levels.label or "field": found.along(levels.field)})


def _done(request: tuple[Callable[[], object]], progress: Progress) -> Iterator[object]:
    yield request[0]()


class LevelBox(QtWidgets.QWidget):
    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._levels: Levels | None = None
        self._asked: tuple[Any, ...] | None = None
        self.band: Band | None = None
        self.lines = QtWidgets.QPushButton("Save isolines…", autoDefault=False)
        self.lines.setToolTip("The panel's isolines as coordinates: CSV, OBJ, VTP or JSON")
        self.lines.clicked.connect(self.save_isolines)
        self.low, self.high = TextBox(), TextBox()
        for box, words, hint in ((self.low, "From", "least"), (self.high, "To", "greatest")):
            box.setPlaceholderText(hint)
            box.setAccessibleName(f"Region: {words.lower()}")
            box.setToolTip("A value, or a fraction of the maximum such as 25 %")
            box.textChanged.connect(self._type)
        self.more = FlatButton(self)
        self.more.setText("Save")
        menu = QtWidgets.QMenu(self.more)
        menu.addAction("Select its vertices", self.select)
        menu.addAction("Save vertex ids…", self.save_ids)
        menu.addAction("Save the cut-out mesh…", self.save_mesh)
        self.more.setMenu(menu)
        self.more.setToolTip("The region between the two values")
        row = QtWidgets.QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.low, 1)
        row.addWidget(QtWidgets.QLabel("to"))
        row.addWidget(self.high, 1)
        row.addWidget(self.more)
        self.note = QtWidgets.QLabel(wordWrap=True)
        self.note.setProperty("quiet", True)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addWidget(self.lines)
        column.addLayout(row)
        column.addWidget(self.note)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
        self._soon.timeout.connect(self._look)
        self._background = context.background("region", _done)
        self._background.answered.connect(self._take)
        self._background.failed.connect(self._refuse)

    def show_levels(self, levels: Levels | None) -> None:
        """Of another panel, or another field."""
        self._levels = levels
        self.setEnabled(levels is not None)
        self._type()

    # ------------------------------------------------------------------ the region
    def _type(self, *_: object) -> None:
        self.band = None
        self.more.setEnabled(False)
        self._soon.start()

    def ends(self) -> tuple[float, float]:
        """The two values; ParameterError for what is none."""
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

    def save_isolines(self, *_: object, path: str = "") -> None:
        """path: asks for one if it is empty."""
        save_isolines(self._context, self._context.grid.active, path)

    def save_ids(self, path: str = "") -> None:
        """Write the ids of the vertices between the two values; with "" a file is asked for."""
        self._save_region("ids", path)

    def save_mesh(self, path: str = "") -> None:
        """Write the part of the mesh between the two values; with "" a file is asked for."""
        self._save_region("mesh", path)

    def _save_region(self, way: str, path: str) -> None:
        levels, found = self._levels, self.band
        if levels is None or found is None:
            return

        def write(path: str) -> None:
            write_region(path, levels, found, way)

        name = file_name([levels.surface.name], "region", levels.name)
        self._context[Writing].save("Save a region", name, REGION_FORMATS[way], write, path)
