"""The dialog of File > Export movie."""

from collections.abc import Callable
from functools import partial

from qtpy import QtWidgets

from bihdist_core import ParameterError, VertexError

from ...document.page import Recipe
from ...figures.export import Surfaces
from ...figures.movie import Movie, check_movie, write_movie
from ...session.array_store import ArrayStore
from ..look.layouts import quiet_label
from .exports import Exports
from .job_dialog import Count, FileKind, blamed_on
from .looks_dialog import LooksDialog


class MovieDialog(LooksDialog):
    """A movie of what the window shows."""

    what = "Movie"
    file_kinds = (FileKind(".mp4", "MP4", "MP4 movie"), FileKind(".gif", "GIF", "GIF"))
    sizes = (
        ("Usual", "", "follows what turns"),
        ("Small", "640px", "640 px wide"),
        ("Slide", "slide", "1920 × 1080 px"),
    )

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: ArrayStore,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(recipe, surfaces, given, exports, parent)
        self.section("Movement")
        self.turn = Count(-3600, 3600, 360, suffix="°")
        self.path_text = QtWidgets.QLineEdit(placeholderText="12, 900; empty: it stays")
        self.frames = Count(2, 10_000, 120)
        self.fps = Count(1, 50, 25)
        self.length = quiet_label()
        self.row("&Turn by", self.turn, "How far the shapes turn from the first frame to the last; 0: they stay")
        self.row("Source &path", self.path_text, "Vertices the source goes through along edges, by their ids")
        self.row("&Frames", self.frames, "How many pictures the movie has")
        self.row("Frames a &second", self.fps, "How fast they are shown")
        self.row("Length", self.length, "How long the movie lasts")
        for box in (self.frames, self.fps):
            box.valueChanged.connect(self._show_length)
        self._show_length()
        self.section("Look")
        self.add_look()
        self.add_shares()

    def check(self) -> None:
        self._movie()
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., object]:
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
                raise VertexError(f"No vertex {stop} here: 0 to {len(surface.vertices) - 1}.")
        return stops

    def _show_length(self) -> None:
        self.length.setText(f"{self.frames.value() / self.fps.value():.3g} s")
