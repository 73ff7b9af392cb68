"""The dialogs of File > Export figure and File > Export movie: how the file shall be."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError, VertexError
from bihdist_core.distances.answers import Answer

from ...document.document import MOST_PANELS, Document
from ...document.page import FORMATS, Recipe
from ...drawing.style import STYLES
from ...figures.description import Figure
from ...figures.export import Surfaces, check_export, figure_of, write_figure
from ...figures.layout import lay_out
from ...figures.movie import Movie, check_movie, write_movie
from ...session.given import Given
from ..look.look import LOOK
from .exports import Exports
from .job_dialog import Choice, Count, FileKind, JobDialog, blamed_on, stem

FIGURE_KINDS = (
    FileKind(".png", "PNG", "PNG picture"),
    FileKind(".pdf", "PDF", "PDF with vector isolines"),
    FileKind(".svg", "SVG", "SVG with vector isolines"),
)
MOVIE_KINDS = (FileKind(".mp4", "MP4", "MP4 movie"), FileKind(".gif", "GIF", "GIF"))
STYLE_NAMES = {
    "paper": "The paper's colours",
    "uniform": "Perceptually uniform",
    "lines": "Isolines only, black and white",
    "dark": "Dark, for slides",
}
VIEWS = {"As in the window": None, "Front and back": ("front", "back"), "Front": ("front",), "Home": ("home",)}

SizeNames = tuple[tuple[str, str, str], ...]
"""Of each size its name, how it is written, and what is said beside it."""

FIGURE_SIZES: SizeNames = (
    ("Usual", "", "follows the panels"),
    ("One column", "85mm", "85 mm"),
    ("Two columns", "178mm", "178 mm"),
    ("Slide", "1920x1080", "1920 × 1080 px"),
    ("Poster", "600mm", "600 mm"),
)
MOVIE_SIZES: SizeNames = (
    ("Usual", "", "follows the panels"),
    ("Small", "640px", "640 px wide"),
    ("Slide", "1920x1080", "1920 × 1080 px"),
)


class _Looks(JobDialog):
    """What figures and movies have in common: recipe is what the window shows, on these surfaces."""

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        title: str,
        what: str,
        kinds: tuple[FileKind, ...],
        sizes: SizeNames,
        exports: Exports,
        parent: QtWidgets.QWidget | None,
    ) -> None:
        super().__init__(title, what, stem(recipe.document.surfaces[0].path, "figure"), kinds, exports, parent)
        self._recipe, self._surfaces = recipe, surfaces
        self.section("Size")
        self._add_sizes(sizes)

    def _add_sizes(self, sizes: SizeNames) -> None:
        self.size_text = QtWidgets.QLineEdit()
        self.size_text.setPlaceholderText("usual")
        self._written = [written for _, written, _ in sizes]
        self._sizes = QtWidgets.QButtonGroup(self)
        rows = QtWidgets.QVBoxLayout()
        rows.setSpacing(0)
        for number, (name, written, detail) in enumerate((*sizes, ("Own size", None, ""))):
            row = _SizeRow(name, detail)
            row.setToolTip("Written in the box below" if written is None else f"{name}: {detail}")
            row.setAccessibleName(f"Size: {name}, {detail}" if detail else f"Size: {name}")
            self._sizes.addButton(row, number)
            rows.addWidget(row)
        self.column.addLayout(rows)
        self.row(
            "Wi&dth or size",
            self.size_text,
            "Such as 1280px, 1680x640, 160mm@300dpi or 160x80mm; empty: as large as the panels need",
        )
        self._sizes.idClicked.connect(self._take_size)
        self.size_text.textChanged.connect(self._name_size)
        self.size_text.setText(self._recipe.page.size)
        self._name_size(self.size_text.text())

    def _take_size(self, number: int) -> None:
        """The size of a row, or one's own."""
        if number < len(self._written):
            self.size_text.setText(self._written[number])
        else:
            self.size_text.setFocus()
            self.size_text.selectAll()

    def _name_size(self, text: str) -> None:
        """Choose the row of the size that is written."""
        text = text.strip().replace("×", "x")
        is_known = text in self._written
        number = self._written.index(text) if is_known else len(self._written)
        self._sizes.button(number).setChecked(True)

    def add_look(self) -> None:
        """Style, columns, and what is shown."""
        page = self._recipe.page
        self.section("Look")
        self.style_box = Choice()
        for word in STYLES:
            self.style_box.addItem(STYLE_NAMES.get(word, word), word)
        self.style_box.setCurrentIndex(max(self.style_box.findData(page.style), 0))
        self.columns = Count(0, MOST_PANELS, page.columns or 0, nothing="All in one row")
        self.row("St&yle", self.style_box, "The colours and lines of the drawing")
        self.row("&Columns", self.columns, "How many panels stand side by side")
        self.shared = self.tick(
            "&One colour bar for all panels",
            self._recipe.document.range == "shared",
            "The same colour means the same value everywhere",
        )
        self.hints = self.tick("&What to look for", page.hints, "A line under each heading")

    def allow_sharing(self, has_one_unit: bool) -> None:
        """One colour bar is for one unit; in the window each unit has its own."""
        self.shared.setEnabled(has_one_unit)
        if not has_one_unit:
            self.shared.setChecked(False)
            self.shared.setToolTip("The panels have different units")

    def chosen(self) -> Recipe:
        """The recipe as the dialog stands."""
        page = replace(
            self._recipe.page,
            size=self.size_text.text().strip(),
            style=self.style_box.currentData(),
            columns=self.columns.value() or None,
            hints=self.hints.isChecked(),
        )
        return replace(
            self._recipe,
            page=page,
            document=self._ranged(self._recipe.document),
        )

    def _ranged(self, document: Document) -> Document:
        """Without one colour bar for all, ranges are as they are, unless they were shared."""
        if self.shared.isChecked():
            return replace(document, range="shared")
        return replace(document, range="own") if document.range == "shared" else document

    def check_size(self, recipe: Recipe) -> None:
        """WrongBox for a size that is none, or with which there would be no picture."""
        with blamed_on(self.size_text):
            nothing_yet = [Answer(label="")] * len(recipe.document.panels)
            lay_out(figure_of(recipe, self._surfaces, nothing_yet))


class ExportDialog(_Looks):
    """A figure of what the window shows; answers: one for each panel."""

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: Given,
        answers: list[Answer],
        version: str,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(recipe, surfaces, "Export figure", "Figure", FIGURE_KINDS, FIGURE_SIZES, exports, parent)
        self._given, self._answers, self._version = given, answers, version
        self.kinds.choose((recipe.page.format or FORMATS[0]).upper())
        self.add_look()
        self.transparent = self.tick("&No background", recipe.page.transparent, "Transparent where nothing is drawn")
        self.crop = self.tick("Without the empty &margins", recipe.page.crop, "Cut to what is drawn")
        self.view = Choice()
        self.view.addItems(list(VIEWS))
        self.row("&View", self.view, "Where the shapes are seen from")

    def chosen(self) -> Recipe:
        views = VIEWS[self.view.currentText()]
        recipe = super().chosen()
        page = replace(recipe.page, transparent=self.transparent.isChecked(), crop=self.crop.isChecked())
        return replace(recipe, page=page if views is None else replace(page, views=views))

    def check(self) -> None:
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., None]:
        recipe = self.chosen()
        check_export(recipe.document, path)
        return partial(write_figure, self._figure(recipe), recipe, self._given, path, self._version)

    def _figure(self, recipe: Recipe) -> Figure:
        return figure_of(recipe, self._surfaces, self._answers)


class MovieDialog(_Looks):
    """A movie of what the window shows."""

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: Given,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(recipe, surfaces, "Export movie", "Movie", MOVIE_KINDS, MOVIE_SIZES, exports, parent)
        self._given = given
        self.section("Movement")
        self.turn = Count(-3600, 3600, 360, suffix="°")
        self.path_text = QtWidgets.QLineEdit()
        self.path_text.setPlaceholderText("12, 900; empty: it stays")
        self.frames = Count(2, 10_000, 120)
        self.fps = Count(1, 50, 25)
        self.length = QtWidgets.QLabel("")
        self.length.setProperty("quiet", True)
        self.row("&Turn by", self.turn, "How far the shapes turn from the first frame to the last; 0: they stay")
        self.row("Source &path", self.path_text, "Vertices the source goes through along edges, by their ids")
        self.row("&Frames", self.frames, "How many pictures the movie has")
        self.row("Frames a &second", self.fps, "How fast they are shown")
        self.row("Length", self.length, "How long the movie lasts")
        for box in (self.frames, self.fps):
            box.valueChanged.connect(self._show_length)
        self._show_length()
        self.add_look()

    def check(self) -> None:
        self._movie()
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., None]:
        check_movie(path)
        return partial(write_movie, self._movie(), path, given=self._given)

    def _movie(self) -> Movie:
        with blamed_on(self.path_text):
            stops = self._stops()
        with blamed_on(self.path_text if stops else self.turn):
            return Movie(self.chosen(), self.turn.value(), stops, self.frames.value(), self.fps.value())

    def _stops(self) -> tuple[int, ...]:
        text = self.path_text.text().strip()
        try:
            stops = tuple(int(word) for word in text.split(",")) if text else ()
        except ValueError:
            raise ParameterError(f"{text!r} is not vertex ids with commas between them.") from None
        surface = self._surfaces[self._recipe.document.panels[0].surface].surface
        for stop in stops:
            if not 0 <= stop < len(surface.vertices):
                raise VertexError(f"No vertex {stop} here: 0 to {len(surface.vertices) - 1:,}.")
        return stops

    def _show_length(self) -> None:
        self.length.setText(f"{self.frames.value() / self.fps.value():.3g} s")


class _SizeRow(QtWidgets.QRadioButton):
    """A choice with a quiet word at its end."""

    def __init__(self, name: str, detail: str) -> None:
        super().__init__(name)
        self._detail = detail
        self.setProperty("row", True)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QtGui.QPainter(self)
        painter.setFont(LOOK.font())
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        align = QtCore.Qt.AlignmentFlag
        painter.drawText(self.rect().adjusted(0, 0, -8, 0), align.AlignRight | align.AlignVCenter, self._detail)
