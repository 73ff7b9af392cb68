"""Farthest points, and the regions of the pins: which panels show them, and how large they are by each distance."""

from functools import partial

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.region_boundaries import region_boundaries, write_boundaries
from bihdist_core.analysis.region_mesh import region_mesh
from bihdist_core.analysis.region_output import LABEL_FORMATS, REGION_MESH_FORMATS, write_labels, write_region_mesh
from bihdist_core.formats.curve_output import CURVE_FORMATS

from ...document.document import Document, Panel
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ...document.shared_parts.pins import Pins
from ...qt.context import Context
from ...qt.docks.badges import BADGE, Badge, paint_badge
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.panel_dots import SIDE, curve_colour, dot
from ...qt.docks.plain import fill, lie_on_dock
from ...qt.files.saving import save, written
from ...qt.look.look import LOOK
from ...qt.look.numbers import number, share
from ...qt.look.segments import Segments
from ...qt.panels.flat_button import FlatButton
from ...scene.style import PINS
from .findings import RegionFindings
from .part import DividedPanels, can_divide, show_regions
from .sampler import Sampler

ROW, HEAD = 30, 32
LEAST_COLUMN = 68
"""Logical pixels of a panel's column."""

NUMBER = QtCore.Qt.ItemDataRole.UserRole
"""Of a cell: the area that it shows, or the share."""

WAYS = ("labels", "mesh", "boundaries")
"""What regions are saved as."""

FORMATS = {"labels": LABEL_FORMATS, "mesh": REGION_MESH_FORMATS, "boundaries": CURVE_FORMATS}
TITLES = {
    "labels": "Labels of the vertices…",
    "mesh": "Mesh cut along the boundaries…",
    "boundaries": "Boundaries…",
}

NO_PINS = "There are no pins. Shift+click the surface, or pin the farthest points."
NO_PANEL = "Tick a distance above: each part of the surface then belongs to the pin that is nearest by it."


class RegionsDock(Instrument):
    """A tick for each panel; a row for each pin, a column for each panel that is ticked."""

    word, title = "regions", "Regions"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._findings = context[RegionFindings]
        self.sampler = Sampler(context)
        self.ticks: dict[int, QtWidgets.QCheckBox] = {}
        self._ticks = QtWidgets.QVBoxLayout()
        self._ticks.setSpacing(4)
        self.unit = Segments({"Area": "area", "%": "share"}, "Areas")
        self.unit.choose("area")
        self.unit.chosen.connect(lambda *_: self._fill())
        self.table = QtWidgets.QTableWidget(0, 0)
        self.table.setAccessibleName("Areas of the pins' regions")
        lie_on_dock(self.table)
        self.table.setVerticalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.table.horizontalHeader().setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Stretch)
        self.table.horizontalHeader().setMinimumSectionSize(LEAST_COLUMN)
        self._words = QtWidgets.QLabel()
        self._words.setWordWrap(True)
        self._words.setProperty("quiet", True)
        heading = QtWidgets.QLabel("Regions of the pins, by")
        heading.setProperty("heading", True)
        row = QtWidgets.QHBoxLayout()
        row.addWidget(heading)
        row.addStretch(1)
        row.addWidget(self.unit)
        line = QtWidgets.QFrame(objectName="hairline")
        upper = QtWidgets.QVBoxLayout()
        upper.setContentsMargins(PAD, PAD, PAD, 0)
        upper.setSpacing(8)
        upper.addWidget(self.sampler)
        upper.addWidget(line)
        upper.addLayout(row)
        upper.addLayout(self._ticks)
        upper.addWidget(self._words)
        inside = QtWidgets.QWidget()
        whole = QtWidgets.QVBoxLayout(inside)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(8)
        whole.addLayout(upper)
        whole.addWidget(self.table)
        whole.addStretch(1)
        self._inside = inside
        fill(self, inside)
        self.copy_button = FlatButton(self, "copy")
        self.copy_button.setToolTip("Copy the areas as text")
        self.copy_button.setAccessibleName("Copy the areas as text")
        self.copy_button.activated.connect(self.copy)
        self.save_button = FlatButton(self, "save")
        self.save_button.setToolTip("Save regions: labels, mesh, boundaries")
        self.save_button.setAccessibleName("Save regions")
        menu = QtWidgets.QMenu(self.save_button)
        menu.aboutToShow.connect(self._fill_menu)
        self.save_button.setMenu(menu)
        self._findings.changed.connect(lambda *_: self._fill())
        LOOK.follow(self, self._restyle)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.copy_button, self.save_button]

    def sizeHint(self) -> QtCore.QSize:
        """So that docks above it leave it room for its table."""
        return self._inside.sizeHint()

    def end(self) -> None:
        self.sampler.end()

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        self.sampler.show_state()
        self._show_ticks(document)
        self._make_table(document)
        self._fill()

    def _show_ticks(self, document: Document) -> None:
        for id in [id for id in self.ticks if id not in {panel.id for panel in document.panels}]:
            gone = self.ticks.pop(id)
            gone.hide()
            gone.deleteLater()
        for k, panel in enumerate(document.panels):
            if panel.id not in self.ticks:
                tick = self.ticks[panel.id] = QtWidgets.QCheckBox()
                tick.setIconSize(QtCore.QSize(SIDE, SIDE))
                # With a partial PySide would leave out whether it is on.
                tick.clicked.connect(lambda is_on, id=panel.id: self._tick(id, is_on))
            tick = self.ticks[panel.id]
            self._ticks.removeWidget(tick)
            self._ticks.addWidget(tick)
            tick.setText(quantity_name(panel.shows))
            tick.setIcon(dot(curve_colour(k)))
            tick.setChecked(panel.id in document[DividedPanels].regions)
            tick.setEnabled(can_divide(document, panel.id) or panel.id in document[DividedPanels].regions)
            tick.setToolTip("Draw the boundaries on this panel, and list the areas")

    def _tick(self, panel: int, is_on: bool) -> None:
        session = self.context.session
        session.show(show_regions(session.document, panel, is_on))

    # ------------------------------------------------------------------ the table
    @property
    def _shown(self) -> list[tuple[int, Panel]]:
        """The panels with regions, with their places among all."""
        document = self.context.document
        return [(k, panel) for k, panel in enumerate(document.panels) if panel.id in document[DividedPanels].regions]

    def _make_table(self, document: Document) -> None:
        shown = self._shown
        self.table.setColumnCount(len(shown))
        self.table.setRowCount(len(document[Pins].pins))
        for column, (_, panel) in enumerate(shown):
            item = QtWidgets.QTableWidgetItem(quantity_name(panel.shows))
            item.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
            item.setToolTip(quantity_name(panel.shows))
            self.table.setHorizontalHeaderItem(column, item)
        for row, pin in enumerate(document[Pins].pins):
            item = QtWidgets.QTableWidgetItem(_badge(row + 1, PINS[pin.colour]), pin.name)
            self.table.setVerticalHeaderItem(row, item)
            for column in range(len(shown)):
                cell = QtWidgets.QTableWidgetItem()
                cell.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
                self.table.setItem(row, column, cell)
        self.table.setVisible(bool(shown and document[Pins].pins))
        self._words.setText(NO_PINS if not document[Pins].pins else "" if shown else NO_PANEL)
        self._words.setVisible(bool(self._words.text()))
        self._measure()

    def _fill(self) -> None:
        document, shown = self.context.document, self._shown
        if (len(document[Pins].pins), len(shown)) != (self.table.rowCount(), self.table.columnCount()):
            return  # the document's change is on its way
        failure = ""
        for column, (_, panel) in enumerate(shown):
            divided = self._findings.divided(panel.id)
            regions = None if divided is None else divided.regions
            failure = failure or ("" if divided is None else divided.failure)
            rows = [
                k for k, pin in enumerate(document[Pins].pins) if document.point(pin.point).surface == panel.surface
            ]
            known = regions is not None and len(regions.areas) == len(rows)
            total = float(self.context.session.surface_in(panel.id).face_areas.sum())
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
        is_on_its_way = any(not self._findings.is_divided(panel.id) for _, panel in shown) and bool(document[Pins].pins)
        self.note_changed.emit("dividing…" if is_on_its_way else "")

    def text(self) -> str:
        """The areas, or their shares of the whole, with tabulators and all digits; pins by their numbers."""
        columns, rows = range(self.table.columnCount()), range(self.table.rowCount())
        lines = [["pin", *(self.table.horizontalHeaderItem(k).text() for k in columns)]]
        for row in rows:
            areas = [self.table.item(row, k).data(NUMBER) for k in columns]
            lines.append([str(row + 1), *("" if area is None else repr(area) for area in areas)])
        return "\n".join("\t".join(line) for line in lines)

    def copy(self) -> None:
        """Copy the areas to the clipboard."""
        QtWidgets.QApplication.clipboard().setText(self.text())
        self.context.tell("The areas are in the clipboard")

    # ------------------------------------------------------------------ files
    def _fill_menu(self) -> None:
        menu = self.save_button.menu()
        menu.clear()
        for place, panel in self._shown:
            # A menu of its own for each distance, where there are several.
            name = f"Panel {place + 1}: {quantity_name(panel.shows)}"
            inner = menu.addMenu(name) if len(self._shown) > 1 else menu
            for way in WAYS:
                action = inner.addAction(TITLES[way], partial(self._save, panel.id, way))
                action.setEnabled(self._findings.is_divided(panel.id))
        if menu.isEmpty():
            menu.addAction("No panel shows regions").setEnabled(False)

    def _save(self, panel: int, way: str) -> None:
        shows = self.context.document.panel(panel).shows
        name = file_name([self.context.session.first_surface.name], "regions", way, str(shows))
        title = f"{TITLES[way].removesuffix('…')}, by {quantity_name(shows)}"
        save(self.context, title, name, FORMATS[way], partial(self.write, panel, way))

    def save_to(self, panel: int, way: str, path: str) -> bool:
        """Write the regions of a panel, one of WAYS; whether that could be done."""
        return written(self.context, path, partial(self.write, panel, way))

    def write(self, panel: int, way: str, path: str) -> None:
        """The same; labels are the pins' numbers."""
        document, divided = self.context.document, self._findings.divided(panel)
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
        for row in range(self.table.rowCount()):
            self.table.setRowHeight(row, round(ROW * LOOK.scale))
        height = round(HEAD * LOOK.scale) + self.table.rowCount() * round(ROW * LOOK.scale) + 2
        self.table.setFixedHeight(height)

    def _restyle(self) -> None:
        document = self.context.document
        self._show_ticks(document)
        self._make_table(document)
        self._fill()


def _badge(place: int, colour: str) -> QtGui.QIcon:
    """A pin's disc with its number."""
    picture = QtGui.QPixmap(round(2 * BADGE), round(2 * BADGE))
    picture.setDevicePixelRatio(2)
    picture.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    paint_badge(painter, QtCore.QPointF(BADGE / 2, BADGE / 2), Badge(str(place), colour, ""))
    painter.end()
    return QtGui.QIcon(picture)
