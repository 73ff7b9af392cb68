"""The section "Error" of the dock of pairs: how far maps are from a truth that a menu chooses, and the full map."""

from dataclasses import replace
from functools import partial
from typing import Any

from qtpy import QtWidgets

from bihdist_core.applications.map_errors import ErrorCurve
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.vertex_maps import MAP_FORMATS, write_map

from ...document.document import Document
from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.docks.instrument import PAD
from ...qt.files.exports import paper_theme, save_figure
from ...qt.files.saving import ask_file, file_filter, save
from ...qt.look.form import hairline, heading, in_column, in_row, push_button, quiet_label
from ...qt.look.look import LOOK
from ...qt.panels.badges import curve_colour
from ...qt.panels.flat_button import add_entry, menu_button
from .error_chart import ErrorChart, ErrorTable, MapCurve
from .map_errors import Map, MapErrorRequest, MapErrors, MapErrorWorker, is_same_ids, map_name, maps_of, request_of
from .maps import MapColours, MapFile, Maps, map_file, show_maps, shows_maps, with_map, with_truth
from .pairs import whole_pairs
from .quantity import predict, predicts_in

MAPS = file_filter("Maps", MAP_FORMATS)
SAMPLES = {100: "Over 100 sampled vertices", 400: "Over 400 sampled vertices", 0: "Over all vertices"}


class MapTruth:
    """A button of the section that names the truth that maps are measured by, with a menu."""

    def __init__(self, section: "ErrorSection") -> None:
        self._context, self._section = section.context, section
        tip = "The ground truth, and the number of sampled vertices"
        self.button = menu_button(section, self._fill, tip, "Truth", quiet=True)

    def show(self) -> None:
        """Show the name of the truth on the button."""
        truth, word = self._context.document[Maps].truth, self.word
        named = truth.file.name if truth.file is not None else "same ids" if word == "identity" else "not known"
        self.button.setText(f"truth: {named}")

    @property
    def word(self) -> str:
        """The kind of truth, one of TRUTHS except "auto", which stands for another."""
        truth, asked = self._context.document[Maps].truth, self._section.asked
        if truth.word != "auto" or asked is None:
            return str(truth.word)
        return "identity" if is_same_ids(asked.one.surface, asked.two.surface) else "none"

    def _fill(self, menu: QtWidgets.QMenu) -> None:
        asked, truth, word = self._section.asked, self._context.document[Maps].truth, self.word
        if asked is None:
            return
        has_ids = len(asked.one.surface.vertices) == len(asked.two.surface.vertices)
        add = partial(add_entry, menu)
        choose_truth = partial(ask_file, self._context, "Where each vertex of A belongs on B", MAPS, self.take)
        add("Same ids", partial(self._choose, word="identity", file=None), word == "identity", has_ids)
        add("A map's file…", choose_truth, word == "file")
        add("Not known", partial(self._choose, word="none", file=None), word == "none")
        menu.addSeparator()
        for samples, words in SAMPLES.items():
            add(words, partial(self._choose, samples=samples), truth.samples == samples)
        menu.addSeparator()
        add("Symmetric partners from a map's file…", self.choose_partners)
        add("Show the map of a file…", partial(ask_file, self._context, "A map from A to B", MAPS, self.take_map))
        menu.addSeparator()
        has_curves = bool(self._section.named_curves())
        add("Save the curves as a figure…", self.save_figure, can=has_curves)
        add("Save the curves' numbers…", self.save_numbers, can=has_curves)

    def _choose(self, **changes: Any) -> None:
        session = self._context.session
        session.show(with_truth(session.document, replace(session.document[Maps].truth, **changes)))

    # ------------------------------------------------------------------ files
    def choose_partners(self) -> None:
        """Ask for the file of symmetric partners."""
        ask_file(self._context, "The symmetric partner of each vertex of B", MAPS, self.take_partners)

    def take(self, path: str) -> None:
        """Take the map in a file as the truth, or say why it cannot be."""
        file = self._read(path)
        if file is not None:
            self._choose(word="file", file=file)

    def take_partners(self, path: str) -> None:
        """Count symmetric partners as the map in a file says, or say why it cannot be."""
        file = self._read(path, is_on_second=True)
        if file is not None:
            self._choose(partners=file, mirror=True)

    def take_map(self, path: str) -> None:
        """Show the map of a file, with its errors beside the others, or say why it cannot be."""
        file = self._read(path)
        if file is not None:
            self._context.session.apply(lambda document: with_map(document, file))

    def count_mirror(self, counts: bool) -> None:
        """Count symmetric partners or not; ask for their file if it is not known."""
        if counts and self._context.document[Maps].truth.partners is None:
            self.choose_partners()
        else:
            self._choose(mirror=counts)

    def _read(self, path: str, is_on_second: bool = False) -> MapFile | None:
        asked = self._section.asked
        if asked is None:
            return None
        one, two = asked.one.surface, asked.two.surface
        with self._context.errors_shown():
            return map_file(path, two if is_on_second else one, two)
        return None

    # ------------------------------------------------------------------ the curves
    def _file_name(self) -> str:
        asked = self._section.asked
        return file_name([] if asked is None else [asked.one.surface.name, asked.two.surface.name], "map-errors")

    def save_figure(self, path: str = "") -> None:
        """Save the curves in the style of the page, with the colours that go with its background."""
        from ...figures.chart_look import ChartLook
        from ...figures.error_figure import ErrorFigure, save_error_figure
        from ...scene.style import style_of

        context = self._context
        page, colours = context.page, paper_theme(context).curves

        def figure() -> ErrorFigure:
            style = style_of(page.style, context.document.colours)
            return ErrorFigure(self._section.named_curves(), colours, ChartLook(style))

        save_figure(context, "Save the curves as a figure", self._file_name(), save_error_figure, figure, path)

    def save_numbers(self) -> None:
        """Ask for a file, and write the curves of errors as a table."""
        from ...figures.error_figure import ErrorFigure, save_error_figure

        curves = self._section.named_curves()
        name = self._file_name()
        save(self._context, "Save the curves", name, (".csv",), lambda p: save_error_figure(ErrorFigure(curves), p))


NO_TRUTH = "Errors need a ground truth: choose the same ids, or the file of a map."
NO_MAP = "Errors are shown from the first pair on."


class ErrorSection(QtWidgets.QWidget):
    """How far maps are from the truth: a chart, a table and the menu of the truth; `errors` is None while there are
    none."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self.errors: MapErrors | None = None
        self.asked: MapErrorRequest | None = None
        self._answered: tuple[object, ...] = ()  # what the errors is about
        self._failure = ""  # why there is none
        self._dotted: list[Any] = []  # panels that have a dot of these
        self.truth = MapTruth(self)
        self.chart, self.table = ErrorChart(), ErrorTable()
        self.note = quiet_label(wraps=True)
        tip = "Colour every vertex of A by its place on B, for each distance"
        self.full = push_button("Compute full map", self.show_or_leave_maps, tip)
        tip = "Save a full map: for each vertex of A one of B"
        self.save = menu_button(self, self._fill_maps, tip, "Save a full map", "save")
        self.mirror = QtWidgets.QCheckBox("Accept mirror images")
        self.mirror.setToolTip(
            "Count the symmetric partner of the right vertex as right; a map file names the partners"
        )
        self.mirror.clicked.connect(self._count_mirror)
        top = in_row(heading("Error"), None, self.truth.button)
        bottom = in_row(self.full, self.save, None, spacing=8)
        parts = top, self.chart, self.table, self.note, self.mirror, bottom
        in_column(hairline(), in_column(*parts, spacing=8, margins=(PAD, 8, PAD, PAD)), of=self, spacing=0)
        self._worker = MapErrorWorker()
        self._background = context.background("map errors", self._worker.errors, self._take, self._refuse)
        LOOK.follow(self, self._show)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document) -> None:
        """Ask for the errors of a document's maps."""
        loaded = [self.context.session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        there = [each for each in loaded if each is not None]
        self.setVisible(len(there) == 2)
        if len(there) < 2:
            self._ask(None)
            return
        self._ask(request_of(document, *there))
        self._show()

    def show_answer(self) -> None:
        """Offer to save the maps that panels show now."""
        self.save.setVisible(bool(self._full_maps()))

    def show_again(self) -> None:
        """Draw the dots again on panels that were cleared."""
        if self.asked is not None:
            self._put_dots(self._colours())

    def show_closed(self) -> None:
        """Ask for nothing while the dock is closed."""
        self._ask(None)
        self._put_dots({})

    def _ask(self, asked: MapErrorRequest | None) -> None:
        before, self.asked = self.asked, asked
        if asked is None or before is None or asked.about != before.about:
            if asked is None or before is None or not _differ_in_maps_only(asked, before):
                self.errors = None
            self._failure = ""
            self._background.ask(asked)

    def _take(self, asked: MapErrorRequest, errors: MapErrors) -> None:
        self.errors, self._answered, self._failure = errors, asked.about, ""
        self._show()

    def _refuse(self, asked: MapErrorRequest, sentence: str) -> None:
        self.errors, self._failure = None, sentence
        self._show()

    @property
    def is_whole(self) -> bool:
        """Return whether the errors of all wanted vertices are shown, for the pairs that there are now."""
        asked, errors = self.asked, self.errors
        return asked is not None and errors is not None and errors.is_whole and self._answered == asked.about

    # ------------------------------------------------------------------ what is seen
    @property
    def _document(self) -> Document:
        return self.context.document

    def _show(self) -> None:
        asked, document = self.asked, self._document
        if asked is None:
            return
        word = self.truth.word
        self.truth.show()
        self.mirror.setChecked(document[Maps].truth.mirror)
        self.mirror.setEnabled(word != "none")
        has_maps = bool(document[Maps].maps or (whole_pairs(document) and asked.maps))
        errors = self.errors if word != "none" and has_maps else None
        curves = [] if errors is None else self._curves(errors)
        self.chart.setVisible(bool(curves))
        self.chart.show_curves(curves)
        failures = [] if errors is None else self._failures(errors)
        self.table.setVisible(bool(curves or failures))
        self.table.show_rows(curves, failures)
        self.note.setText(NO_TRUTH if word == "none" else NO_MAP if not has_maps else self._over(errors))
        has_full = shows_maps(document)
        self.full.setText("Show predictions" if has_full else "Compute full map")
        self.full.setEnabled(bool(has_full or document[Maps].maps or whole_pairs(document)))
        self.show_answer()
        self._put_dots(self._colours())

    def _over(self, errors: MapErrors | None) -> str:
        """Return the number of vertices and the distance of the errors in words, or the reason why there are none."""
        if errors is None:
            return self._failure or "Finding errors…"
        if not errors.curves:
            return " ".join(dict.fromkeys(errors.failures.values()))
        known = f"{errors.known:,}" if errors.is_whole else f"{errors.known:,} of {errors.wanted:,}"
        vertices = "vertices" if errors.wanted == errors.vertices else "sampled vertices"
        return f"over {known} {vertices}; {errors.method}"

    def name_of(self, map: Map) -> str:
        """Return the name of a map in the table."""
        return map_name(map, self._document)

    def _colour_of(self, map: Map) -> str:
        maps = maps_of(self._document)
        return curve_colour(maps.index(map)) if map in maps else LOOK.theme.quiet

    def _curves(self, errors: MapErrors) -> list[MapCurve]:
        return [
            MapCurve(self.name_of(map), self._colour_of(map), curve)
            for map, curve in errors.curves.items()
            if map in maps_of(self._document)
        ]

    def _failures(self, errors: MapErrors) -> list[tuple[str, str, str]]:
        return [(self.name_of(map), self._colour_of(map), why) for map, why in errors.failures.items()]

    def _colours(self) -> dict[int, str]:
        """Return the colours of the dots in the heads of panels, those of their curves."""
        document, found = self._document, {}
        for panel in document.panels:
            shows = panel.shows
            if predicts_in(panel) and panel.surface == document.surfaces[1].name:
                found[panel.id] = self._colour_of(shows.specs[0])
            elif isinstance(shows, MapColours) and shows.by:
                found[panel.id] = self._colour_of(
                    document[Maps].of(shows.by) if isinstance(shows.by, str) else shows.by
                )
        return found

    def _put_dots(self, colours: dict[int, str]) -> None:
        panels = list(self.context.grid.panels)
        for panel in panels:
            if panel.id in colours or panel in self._dotted:
                panel.head.show_dot(colours.get(panel.id, ""))
        self._dotted = [panel for panel in panels if panel.id in colours]

    def named_curves(self) -> dict[str, ErrorCurve]:
        """Return the curves of the chart by their names."""
        return {curve.name: curve.errors for curve in self.chart.curves}

    def _count_mirror(self, counts: bool) -> None:
        self.truth.count_mirror(counts)
        self.mirror.setChecked(self._document[Maps].truth.mirror)

    # ------------------------------------------------------------------ maps
    def show_or_leave_maps(self) -> None:
        """Show the full map by each distance, or predictions again."""
        document = self._document
        self.context.session.show(predict(document) if shows_maps(document) else show_maps(document))

    def _full_maps(self) -> dict[Spec, Any]:
        """Return the full maps (n,) that panels show, by distance."""
        session = self.context.session
        found = {}
        for panel in self._document.panels:
            answer = session.answer(panel.id) if session.is_answered(panel.id) else None
            is_by_pairs = panel.shows.is_map and panel.shows.specs
            if is_by_pairs and answer is not None and answer.leads_to is not None:
                found[panel.shows.specs[0]] = answer.leads_to
        return found

    def _fill_maps(self, menu: QtWidgets.QMenu) -> None:
        for spec, found in self._full_maps().items():
            menu.addAction(f"Save the map by {self.name_of(spec).lower()}…", partial(self.save_map, spec, found))

    def save_map(self, spec: Spec, found: Any) -> None:
        """Ask for a file, and write a map's vertices (n,)."""
        asked = self.asked
        meshes = [] if asked is None else [each.surface.name for each in (asked.one, asked.two)]
        name = file_name(meshes, "map", str(spec))
        save(self.context, "Save the map", name, MAP_FORMATS, lambda path: write_map(path, found))


def _differ_in_maps_only(one: MapErrorRequest, other: MapErrorRequest) -> bool:
    """Return whether two requests differ in their pairs and maps only, so that the old errors may stay meanwhile."""
    return (one.about[:3], one.truth) == (other.about[:3], other.truth)
