"""What maps are measured by, as a menu: which places are right, over how many vertices.  `section` is what shows the
errors."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from qtpy import QtWidgets

from bihdist_core import BihdistError
from bihdist_core.formats.vertex_maps import MAP_FORMATS

from ...document.file_names import file_name
from ...qt.files.chart_files import paper_theme, save_figure
from ...qt.files.saving import save
from ...qt.panels.flat_button import FlatButton
from .judgement import is_same_ids
from .map_answers import map_file
from .maps import MapFile, Maps, with_map, with_truth

READ = f"Maps ({' '.join(f'*{extension}' for extension in MAP_FORMATS)});;All files (*)"
SAMPLES = {100: "Over 100 sampled vertices", 400: "Over 400 sampled vertices", 0: "Over all vertices"}


class MapTruth:
    """button: says what is right, and has the menu."""

    def __init__(self, section: Any) -> None:
        self._section, self._context = section, section.context
        self.button = FlatButton(section, quiet=True)
        self.button.setAccessibleName("Truth")
        self.button.setToolTip("What is right, and over how many vertices errors are found")
        self._menu = QtWidgets.QMenu(self.button)
        self._menu.aboutToShow.connect(self._fill)
        self.button.setMenu(self._menu)

    def show(self) -> None:
        """Say what is right now."""
        truth, word = self._context.document[Maps].truth, self.word
        named = truth.file.name if truth.file is not None else "same ids" if word == "identity" else "not known"
        self.button.setText(f"truth: {named}")

    @property
    def word(self) -> str:
        """One of TRUTHS, but for "auto", which means one of the others."""
        truth, asked = self._context.document[Maps].truth, self._section.asked
        if truth.word != "auto" or asked is None:
            return str(truth.word)
        return "identity" if is_same_ids(asked.one.surface, asked.two.surface) else "none"

    def _fill(self) -> None:
        self._menu.clear()
        asked, truth, word = self._section.asked, self._context.document[Maps].truth, self.word
        if asked is None:
            return
        has_ids = len(asked.one.surface.vertices) == len(asked.two.surface.vertices)
        self._add("Same ids", partial(self._choose, word="identity", file=None), word == "identity", has_ids)
        self._add("A map's file…", self.choose, word == "file")
        self._add("Not known", partial(self._choose, word="none", file=None), word == "none")
        self._menu.addSeparator()
        for samples, words in SAMPLES.items():
            self._add(words, partial(self._choose, samples=samples), truth.samples == samples)
        self._menu.addSeparator()
        self._add("Symmetric partners from a map's file…", self.choose_partners)
        self._add("Show the map of a file…", self.choose_map)
        self._menu.addSeparator()
        has_curves = bool(self._section.named_curves())
        self._add("Save the curves as a figure…", self.save_figure, can=has_curves)
        self._add("Save the curves' numbers…", self.save_numbers, can=has_curves)

    def _add(self, words: str, do: Callable[[], None], is_on: bool | None = None, can: bool = True) -> None:
        action = self._menu.addAction(words)
        action.setCheckable(is_on is not None)
        action.setChecked(bool(is_on))
        action.setEnabled(can)
        action.triggered.connect(lambda *_: do())

    def _choose(self, **changes: Any) -> None:
        session = self._context.session
        session.show(with_truth(session.document, replace(session.document[Maps].truth, **changes)))

    # ------------------------------------------------------------------ by a dialog
    def choose(self) -> None:
        """Ask for the file of the true map."""
        self._ask("Where each vertex of A belongs on B", self.take)

    def choose_partners(self) -> None:
        """Ask for the file of symmetric partners."""
        self._ask("The symmetric partner of each vertex of B", self.take_partners)

    def choose_map(self) -> None:
        """Ask for the file of a map to be compared."""
        self._ask("A map from A to B", self.take_map)

    def _ask(self, title: str, take: Callable[[str], None]) -> None:
        folder = self._context.folder
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self._section, title, folder, READ)
        if path:
            take(path)

    # ------------------------------------------------------------------ files
    def take(self, path: str) -> None:
        """The map in a file is right, or why it cannot be."""
        file = self._read(path)
        if file is not None:
            self._choose(word="file", file=file)

    def take_partners(self, path: str) -> None:
        """Symmetric partners count from now on, as a file says, or why they cannot."""
        file = self._read(path, is_on_second=True)
        if file is not None:
            self._choose(partners=file, mirror=True)

    def take_map(self, path: str) -> None:
        """Show where the map of a file leads, and judge it beside the others; or why it cannot be."""
        file, session = self._read(path), self._context.session
        if file is not None:
            try:
                session.show(with_map(session.document, file))
            except BihdistError as error:
                self._context.fail(error)

    def count_mirror(self, counts: bool) -> None:
        """Whether symmetric partners count; what they are is asked for where it is not known."""
        if counts and self._context.document[Maps].truth.partners is None:
            self.choose_partners()
        else:
            self._choose(mirror=counts)

    def _read(self, path: str, is_on_second: bool = False) -> MapFile | None:
        asked = self._section.asked
        if asked is None:
            return None
        one, two = asked.one.surface, asked.two.surface
        try:
            return map_file(path, two if is_on_second else one, two)
        except BihdistError as error:
            self._context.fail(error)
            return None

    # ------------------------------------------------------------------ the curves
    def _file_name(self) -> str:
        asked = self._section.asked
        return file_name([] if asked is None else [asked.one.surface.name, asked.two.surface.name], "map-errors")

    def save_figure(self, path: str = "") -> None:
        """In the style of the page, in the colours that go with its ground."""
        from ...figures.chart_page import ChartLook
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
