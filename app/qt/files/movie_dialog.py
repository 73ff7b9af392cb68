"""The dialog of File > Export movie."""

from collections.abc import Callable
from functools import partial

from qtpy import QtWidgets

from bihdist_core import BihdistError, ParameterError, VertexError

from ...document.page import Recipe
from ...figures.export import Surfaces
from ...figures.movie import SWING, Movie, write_movie
from ...figures.movie_files import check_movie, encoder_lack
from ..context import Context
from ..look.form import Count, describe, in_row, push_button, quiet_label
from .job_dialog import FileKind, blamed_on
from .looks_dialog import LooksDialog


class MovieDialog(LooksDialog):
    """A movie of what the window shows."""

    what = "Movie"
    file_kinds = (
        FileKind(".mp4", "MP4", "MP4 movie"),
        FileKind(".webm", "WebM", "WebM movie"),
        FileKind(".gif", "GIF", "GIF"),
        FileKind("-%04d.png", "PNG", "PNG frames"),
    )
    sizes = (
        ("Default", "", "fits the movement"),
        ("Small", "640px", "640 px wide"),
        ("Slide", "slide", "1920 × 1080 px"),
    )

    def __init__(self, context: Context, recipe: Recipe, surfaces: Surfaces) -> None:
        super().__init__(context, recipe, surfaces)
        if lack := encoder_lack():
            self.kinds.choose("GIF")
            self._add_advice(lack)
        self.form.section("Movement")
        self.turn = Count(-3600, 3600, 360, suffix="°")
        self.path_text = QtWidgets.QLineEdit(placeholderText="e.g. 12, 900")
        self.sweep_text = QtWidgets.QLineEdit(placeholderText="e.g. t=4..1/60")
        self.frames = Count(2, 10_000, 120)
        self.fps = Count(1, 50, 25)
        self.length = quiet_label()
        self.form.row("&Turn by", self.turn, "Rotation from the first frame to the last; 0 for none")
        tip = "Turn to one side and back to the other, with the source in view"
        self.swing = self.form.tick("Back an&d forth", False, tip)
        self.swing.toggled.connect(lambda is_on: self.turn.setValue(round(SWING) if is_on else 360))
        self.form.row("Source &path", self.path_text, "Ids of the vertices that the source moves through, along edges")
        tip = "Values that a parameter of the distances takes: a range such as t=4..1/60, or several, k=10,50,200"
        self.form.row("Para&meter", self.sweep_text, tip)
        self.form.row("&Frames", self.frames, "Number of frames")
        self.form.row("Frames per &second", self.fps, "Frame rate")
        self.form.row("Length", self.length, "How long the movie lasts")
        for box in (self.frames, self.fps):
            box.valueChanged.connect(self._show_length)
        self._show_length()
        self.form.section("Look")
        self.add_look()
        self.add_shares()

    def choose(self, format: str, size: str) -> None:
        super().choose("GIF" if encoder_lack() else format, size)

    def _add_advice(self, lack: str) -> None:
        """Add under the formats what MP4 needs, with a button that copies the command that installs it."""
        words, _, line = lack.partition(": ")
        copy = push_button("Copy the command", lambda: QtWidgets.QApplication.clipboard().setText(line))
        copy.setObjectName("link")
        copy.setVisible(bool(line))
        describe(copy, "Copy the command that installs it", line)
        self.form.column.insertLayout(2, in_row(quiet_label(words), copy, None))

    def check(self) -> None:
        if self.kinds.choice() in ("MP4", "WebM") and (lack := encoder_lack()):
            raise BihdistError(lack)
        self._movie()
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., object]:
        check_movie(path, self.frames.value())
        return partial(write_movie, self._movie(), path, given=self._given)

    def _movie(self) -> Movie:
        with blamed_on(self.path_text):
            stops = self._stops()
        sweep, length = self.sweep_text.text().strip(), (self.frames.value(), self.fps.value())
        with blamed_on(self.path_text if stops else self.sweep_text if sweep else self.turn):
            return Movie(self.chosen(), self.turn.value(), self.swing.isChecked(), stops, sweep, *length)

    def _stops(self) -> tuple[int, ...]:
        text = self.path_text.text().strip()
        try:
            stops = tuple(int(word) for word in text.split(",")) if text else ()
        except ValueError:
            raise ParameterError(f"{text!r} is not a list of vertex ids separated by commas.") from None
        surface = self._surfaces[self._recipe.document.panels[0].surface].surface
        for stop in stops:
            if not 0 <= stop < len(surface.vertices):
                raise VertexError(f"No vertex {stop} here: 0 to {len(surface.vertices) - 1}.")
        return stops

    def _show_length(self) -> None:
        self.length.setText(f"{self.frames.value() / self.fps.value():.3g} s")
