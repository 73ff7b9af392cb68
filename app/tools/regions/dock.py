"""Farthest points, and the regions of the pins: which panels show them, and how large they are by each distance."""

from collections.abc import Callable
from functools import partial

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.region_boundaries import region_boundaries, write_boundaries
from bihdist_core.analysis.region_mesh import (
    LABEL_FORMATS,
    REGION_MESH_FORMATS,
    region_mesh,
    write_labels,
    write_region_mesh,
)
from bihdist_core.analysis.sampling import SAMPLE_FORMATS, write_samples
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.formats.curve_output import CURVE_FORMATS

from ...document.document import Document, Panel
from ...document.file_names import file_name
from ...document.quantities import column_names, quantity_name
from ...document.shared_parts.pins import Pins, add_pins
from ...drawing.numbers import number, progress_words, share
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import PanelTable, RowList, fill
from ...qt.files.saving import save
from ...qt.look.controls import Segments
from ...qt.look.form import describe, error_label, hairline, heading, in_column, in_row, push_button, quiet_label
from ...qt.look.look import LOOK
from ...qt.panels.badges import curve_colour, disc_icon
from ...qt.panels.flat_button import add_entry, menu_button
from ...scene.style import PINS
from ...session.chosen_sources import SamplesRequest, find_samples
from .findings import RegionFindings
from .part import DividedPanels, can_divide, show_regions

USUAL_POINTS, MAX_POINTS = 10, 10_000
"""Points at first, and at most."""


class Sampler(QtWidgets.QWidget):
    """Their number, two buttons, and by which distance they would be."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self._then: Callable[[AnyArray], None] | None = None  # what is done with the points that are looked for
        self._background = context.background("samples", find_samples, self._take, self._refuse, self._show_progress)
        self.count = QtWidgets.QSpinBox(minimum=1, maximum=MAX_POINTS, value=USUAL_POINTS)
        describe(self.count, "How many farthest points", "The source is the first of them")
        tip = "Each point is the farthest from the source and those before it, and becomes a pin"
        self.pin = push_button("Pin them", self.pin_them, tip)
        tip = "Their vertex ids as text or an array, or as a file of pins"
        self.save = push_button("Save…", lambda: self.save_to(), tip)
        self.words, self.wrong = quiet_label(wraps=True), error_label()
        for label in (self.words, self.wrong):
            label.setProperty("small", True)
        buttons = in_row(self.count, self.pin, self.save, None, spacing=8)
        in_column(heading("Farthest points"), buttons, self.words, self.wrong, of=self, spacing=8)
        context.grid.activated.connect(lambda *_: self.show_state())

    # ------------------------------------------------------------------ what is told
    def show_state(self) -> None:
        """Show by which distance the farthest points would be."""
        if self._then is not None:
            return
        panel = self._panel
        for button in (self.pin, self.save):
            button.setEnabled(panel is not None)
        if panel is None:
            self._say("Choose a panel that shows a distance.")
        else:
            name = quantity_name(panel.shows)
            self._say(f"By the active panel's distance: {name[0].lower()}{name[1:]}")

    # ------------------------------------------------------------------ what is done
    def pin_them(self) -> None:
        """Look for farthest points, and put pins there."""
        self._ask(self._pin)

    def save_to(self, path: str = "") -> None:
        """Write them to a file once they are found, which is asked for if none is given."""
        surface, shown = self._surface, "" if self._panel is None else str(self._panel.shows)
        name = file_name([surface.name], "samples", shown)

        def write(vertices: IntArray) -> None:
            formats = SAMPLE_FORMATS
            write_to = partial(write_samples, surface=surface, vertices=vertices)
            save(self._context, "Save farthest points", name, formats, write_to, path)

        self._ask(write)

    def _pin(self, vertices: IntArray) -> None:
        session = self._context.session
        try:
            session.show(add_pins(session.document, vertices.tolist(), self._name))
        except BihdistError as error:
            self._say(str(error), is_error=True)

    def _ask(self, then: Callable[[AnyArray], None]) -> None:
        session, panel = self._context.session, self._panel
        loaded = session.loaded(panel.surface) if panel is not None else None
        document = session.document
        at = document.point(panel.shows.points[0]).at if panel is not None else None
        if panel is None or loaded is None or at is None:
            return
        self._then = then
        spec = panel.shows.specs[0]
        self._background.ask(SamplesRequest(loaded, document.areas, spec, at, self.count.value()))

    def _take(self, request: SamplesRequest, vertices: IntArray) -> None:
        then, self._then = self._then, None
        self.show_state()
        if then is not None and self._name and self._context.session.loaded(self._name) is request.loaded:
            then(vertices)

    def _refuse(self, request: SamplesRequest, sentence: str) -> None:
        self._then = None
        self.show_state()
        self._say(sentence, is_error=True)

    def _show_progress(self, going: tuple[float, str] | None) -> None:
        if going is not None and self._then is not None:
            self._say(progress_words(*going))

    @property
    def _name(self) -> str:
        """Return the name of the panel's surface in the document, "" without such a panel."""
        return "" if self._panel is None else self._panel.surface

    @property
    def _surface(self) -> Surface:
        return self._context.session.mesh(self._name or None).surface

    @property
    def _panel(self) -> Panel | None:
        """Return the active panel, or the first that shows a distance."""
        document, active = self._context.document, self._context.grid.active
        panels = sorted(document.panels, key=lambda panel: panel.id != active)
        return panels[0] if panels and panels[0].shows.is_distance else None

    def _say(self, text: str, is_error: bool = False) -> None:
        for label, is_meant in ((self.words, not is_error), (self.wrong, is_error)):
            label.setText(text)
            label.setVisible(is_meant)


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
        self.table.fit(self.document, [panel for _, panel in self._shown])

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._measure()
