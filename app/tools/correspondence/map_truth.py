"""The menu of the truth that maps are measured by, and over how many vertices."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from qtpy import QtWidgets

from bihdist_core.applications.map_errors import ErrorCurve
from bihdist_core.formats.vertex_maps import MAP_FORMATS

from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.files.exports import paper_theme, save_figure
from ...qt.files.saving import ask_file, file_filter, save
from ...qt.panels.flat_button import add_entry, menu_button
from .map_errors import MapErrorRequest, is_same_ids
from .maps import MapFile, Maps, map_file, with_map, with_truth

MAPS = file_filter("Maps", MAP_FORMATS)
SAMPLES = {100: "Over 100 sampled vertices", 400: "Over 400 sampled vertices", 0: "Over all vertices"}


class MapTruth:
    """A button that names the truth, with a menu.

    `request()` returns what errors are asked for now, None without two meshes; `curves()` those that are shown.
    """

    def __init__(
        self,
        parent: QtWidgets.QWidget,
        context: Context,
        request: Callable[[], MapErrorRequest | None],
        curves: Callable[[], dict[str, ErrorCurve]],
    ) -> None:
        self._context, self._request, self._curves = context, request, curves
        tip = "The ground truth, and the number of sampled vertices"
        self.button = menu_button(parent, self._fill, tip, "Truth", quiet=True)

    def show(self) -> None:
        """Show the name of the truth on the button."""
        truth, word = self._context.document[Maps].truth, self.word
        named = truth.file.name if truth.file is not None else "same ids" if word == "identity" else "not known"
        self.button.setText(f"truth: {named}")

    @property
    def word(self) -> str:
        """The kind of truth, one of TRUTHS except "auto", which stands for another."""
        truth, asked = self._context.document[Maps].truth, self._request()
        if truth.word != "auto" or asked is None:
            return str(truth.word)
        return "identity" if is_same_ids(asked.one.surface, asked.two.surface) else "none"

    def _fill(self, menu: QtWidgets.QMenu) -> None:
        asked, truth, word = self._request(), self._context.document[Maps].truth, self.word
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
        has_curves = bool(self._curves())
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
        asked = self._request()
        if asked is None:
            return None
        one, two = asked.one.surface, asked.two.surface
        with self._context.errors_shown():
            return map_file(path, two if is_on_second else one, two)
        return None

    # ------------------------------------------------------------------ the curves
    def _file_name(self) -> str:
        asked = self._request()
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
            return ErrorFigure(self._curves(), colours, ChartLook(style))

        save_figure(context, "Save the curves as a figure", self._file_name(), save_error_figure, figure, path)

    def save_numbers(self) -> None:
        """Ask for a file, and write the curves of errors as a table."""
        from ...figures.error_figure import ErrorFigure, save_error_figure

        curves = self._curves()
        name = self._file_name()
        save(self._context, "Save the curves", name, (".csv",), lambda p: save_error_figure(ErrorFigure(curves), p))
