"""Farthest points, and the regions of the pins: which panels show them, and how large they are by each distance."""

from functools import partial

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.region_boundaries import region_boundaries, write_boundaries
from bihdist_core.analysis.region_mesh import (
    LABEL_FORMATS,
    REGION_MESH_FORMATS,
    region_mesh,
    write_labels,
    write_region_mesh,
)
from bihdist_core.formats.curve_output import CURVE_FORMATS

from ...document.document import Document, Panel
from ...document.file_names import file_name
from ...document.quantities import column_names, quantity_name
from ...document.shared_parts.pins import Pins
from ...drawing.numbers import number, share
from ...qt.context import Context
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.plain import PanelTable, fill
from ...qt.docks.row_list import RowList
from ...qt.files.saving import save
from ...qt.look.layouts import hairline, heading, in_column, in_row, quiet_label
from ...qt.look.look import LOOK
from ...qt.look.segments import Segments
from ...qt.panels.badges import curve_colour, disc_icon
from ...qt.panels.flat_button import add_entry, menu_button
from ...scene.style import PINS
from .findings import RegionFindings
from .part import DividedPanels, can_divide, show_regions
from .sampler import Sampler

SIDE = 10
"""Logical pixels of the dots of panels."""

MIN_COLUMN_WIDTH_PX = 68
"""Logical pixels of a panel's column."""

NUMBER = QtCore.Qt.ItemDataRole.UserRole
"""The role of a cell's number: the area or the fraction of it."""

WAYS = ("labels", "mesh", "boundaries")
"""The ways to save regions."""

FORMATS = {"labels": LABEL_FORMATS, "mesh": REGION_MESH_FORMATS, "boundaries": CURVE_FORMATS}
TITLES = {
    "labels": "Vertex labels…",
    "mesh": "Mesh cut along the boundaries…",
    "boundaries": "Boundaries…",
}

NO_PINS = "There are no pins. Shift+click the surface, or pin the farthest points."
NO_PANEL = "Tick a distance above to divide the surface among the pins by it."


class RegionsDock(Instrument):
    """A tick for each panel; a row for each pin, a column for each panel that is ticked."""

    word = "regions"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._dividing = context[RegionFindings].dividing
        self.sampler = Sampler(context)
        self._ticks = RowList(self._new_tick, spacing=4)
        self.ticks: dict[int, QtWidgets.QCheckBox] = self._ticks.rows
        self.unit = Segments({"Area": "area", "%": "share"}, "Areas")
        self.unit.choose("area")
        self.unit.chosen.connect(lambda *_: self._fill())
        self.table = PanelTable("Areas of the pins' regions", MIN_COLUMN_WIDTH_PX)
        self._words = quiet_label(wraps=True)
        row = in_row((heading("Regions of the pins, by"), 1), self.unit)
        upper = in_column(
            self.sampler, hairline(), row, self._ticks, self._words, spacing=8, margins=(PAD, PAD, PAD, 0)
        )
        self._inside = QtWidgets.QWidget()
        in_column(upper, self.table, None, of=self._inside, spacing=8)
        fill(self, self._inside)
        self.copy_button = self.add_head_button("copy", "Copy the areas as text", self.copy)
        tip = "Save regions: labels, mesh, boundaries"
        self.save_button = menu_button(self, self._fill_menu, tip, "Save regions", "save")
        self.head.append(self.save_button)
        context[RegionFindings].changed.connect(lambda *_: self._fill())
        LOOK.follow(self, lambda: self.show_document(self.document, None))

    def sizeHint(self) -> QtCore.QSize:
        """Leave room for the table below the docks above."""
        return self._inside.sizeHint()

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        self.sampler.show_state()
        self._show_ticks(document)
        self._make_table(document)
        self._fill()

    def _new_tick(self, id: int) -> QtWidgets.QCheckBox:
        tick = QtWidgets.QCheckBox(iconSize=QtCore.QSize(SIDE, SIDE))
        tick.setToolTip("Draw the boundaries on this panel, and list the areas")
        tick.clicked.connect(lambda is_on: self.context.session.show(show_regions(self.document, id, is_on)))
        return tick

    def _show_ticks(self, document: Document) -> None:
        self._ticks.show_rows(panel.id for panel in document.panels)
        for k, panel in enumerate(document.panels):
            tick, is_on = self.ticks[panel.id], panel.id in document[DividedPanels].regions
            tick.setText(quantity_name(panel.shows))
            tick.setIcon(disc_icon(curve_colour(k), side=SIDE, radius=4))
            tick.setChecked(is_on)
            tick.setEnabled(is_on or can_divide(document, panel.id))

    # ------------------------------------------------------------------ the table
    @property
    def _shown(self) -> list[tuple[int, Panel]]:
        """The panels with regions, with their places among all."""
        document = self.document
        return [(k, panel) for k, panel in enumerate(document.panels) if panel.id in document[DividedPanels].regions]

    def _make_table(self, document: Document) -> None:
        shown = self._shown
        self.table.make_cells(len(document[Pins].pins), len(shown))
        for row, pin in enumerate(document[Pins].pins):
            item = QtWidgets.QTableWidgetItem(disc_icon(PINS[pin.colour], str(row + 1)), pin.name)
            self.table.setVerticalHeaderItem(row, item)
        self.table.setVisible(bool(shown and document[Pins].pins))
        self._words.setText(NO_PINS if not document[Pins].pins else "" if shown else NO_PANEL)
        self._words.setVisible(bool(self._words.text()))
        self._measure()

    def _fill(self) -> None:
        document, shown = self.document, self._shown
        if (len(document[Pins].pins), len(shown)) != (self.table.rowCount(), self.table.columnCount()):
            return  # the document's change is on its way
        failure = ""
        for column, (_, panel) in enumerate(shown):
            divided = self._dividing.divided(panel.id)
            regions = None if divided is None else divided.regions
            failure = failure or ("" if divided is None else divided.failure)
            rows = [
                k for k, pin in enumerate(document[Pins].pins) if document.point(pin.point).surface == panel.surface
            ]
            known = regions is not None and len(regions.areas) == len(rows)
            total = float(self.context.session.mesh(panel.id).surface.face_areas.sum())
            for row in range(self.table.rowCount()):
                area = float(regions.areas[rows.index(row)]) if regions is not None and known and row in rows else None
                text = "…" if area is None else number(area) if self.unit.choice() == "area" else share(area / total)
                item = self.table.item(row, column)
                item.setText(text)
                item.setData(NUMBER, None if area is None else area if self.unit.choice() == "area" else area / total)
                item.setToolTip("" if area is None else f"{number(area)}, {share(area / total)} of the surface")
        if failure:
            self._words.setText(failure)
            self._words.show()
        is_on_its_way = any(not self._dividing.is_answered(panel.id) for _, panel in shown) and bool(
            document[Pins].pins
        )
        self._measure()
        self.note_changed.emit("dividing…" if is_on_its_way else "")

    def text(self) -> str:
        """Return the areas, or their fractions of the whole, with tabs and all digits; pins by their numbers."""
        columns, rows = range(self.table.columnCount()), range(self.table.rowCount())
        lines = [["pin", *column_names([panel.shows for _, panel in self._shown])]]
        for row in rows:
            areas = [self.table.item(row, k).data(NUMBER) for k in columns]
            lines.append([str(row + 1), *("" if area is None else repr(area) for area in areas)])
        return "\n".join("\t".join(line) for line in lines)

    def copy(self) -> None:
        """Copy the areas to the clipboard."""
        self.context.copy(self.text(), "The areas are on the clipboard")

    # ------------------------------------------------------------------ files
    def _fill_menu(self, menu: QtWidgets.QMenu) -> None:
        for place, panel in self._shown:
            # A menu of its own for each distance, where there are several.
            name = f"Panel {place + 1}: {quantity_name(panel.shows)}"
            inner = menu.addMenu(name) if len(self._shown) > 1 else menu
            for way in WAYS:
                do = partial(self.save, panel.id, way)
                add_entry(inner, TITLES[way], do, can=self._dividing.is_answered(panel.id))
        if menu.isEmpty():
            menu.addAction("No panel shows regions").setEnabled(False)

    def save(self, panel: int, way: str, path: str = "") -> None:
        """Write the regions of a panel, one of WAYS; ask for a path if none is given."""
        shows = self.document.panel(panel).shows
        name = file_name([self.context.session.mesh().surface.name], "regions", way, str(shows))
        title = f"{TITLES[way].removesuffix('…')}, by {quantity_name(shows)}"
        save(self.context, title, name, FORMATS[way], partial(self.write, panel, way), path)

    def write(self, panel: int, way: str, path: str) -> None:
        """Write the regions in one of the WAYS; labels are the pins' numbers."""
        document, divided = self.document, self._dividing.divided(panel)
        if divided is None or divided.regions is None or divided.columns is None:
            return
        name = document.panel(panel).surface
        surface = self.context.session.mesh(name).surface
        numbers = [k for k, pin in enumerate(document[Pins].pins, 1) if document.point(pin.point).surface == name]
        if way == "labels":
            write_labels(path, surface, divided.regions, numbers)
        elif way == "mesh":
            write_region_mesh(path, region_mesh(surface, divided.columns), numbers)
        else:
            write_boundaries(path, region_boundaries(surface, divided.regions), numbers)

    # ------------------------------------------------------------------ how it looks
    def _measure(self) -> None:
        self.table.fit([panel.shows for _, panel in self._shown])

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._measure()
