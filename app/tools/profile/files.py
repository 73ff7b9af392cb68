"""What can be saved and copied of a profile.  `dock` is its dock."""

import os
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from qtpy import QtWidgets

from bihdist_core import BihdistError, ParameterError
from bihdist_core.analysis.profile_output import PROFILE_FORMATS, write_profile
from bihdist_core.analysis.surface_paths import SurfacePath
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.whole_file import check_output

from ...document.file_names import file_name
from ...qt.files.exports import Exports
from ...qt.files.saving import ask_path

if TYPE_CHECKING:
    from .dock import ProfileDock
    from .figure import ProfileFigure

FIGURE_FORMATS = (".pdf", ".png", ".svg", ".eps")


class ProfileFiles:
    """The profile as numbers and as a figure: the menu, the dialogs and what they write."""

    def __init__(self, dock: "ProfileDock") -> None:
        self._dock = dock
        self._actions: list[QtWidgets.QAction] = []

    def menu(self, parent: QtWidgets.QWidget) -> QtWidgets.QMenu:
        """The menu of what can be saved and copied."""
        menu = QtWidgets.QMenu(parent)
        self._actions = [
            menu.addAction("Save the numbers…", self.choose_numbers),
            menu.addAction("Save as a figure…", self.choose_figure),
            menu.addAction("Copy the numbers", self.copy),
        ]
        self.allow(False)
        return menu

    def allow(self, is_there: bool) -> None:
        """Enable the menu's entries, or disable them."""
        for action in self._actions:
            action.setEnabled(is_there)

    # ------------------------------------------------------------------ by a dialog
    def choose_numbers(self) -> None:
        """Ask for a file, and write the numbers."""
        self._choose("Save the profile's numbers", tuple(PROFILE_FORMATS), self.save_numbers)

    def choose_figure(self) -> None:
        """Ask for a file, and draw the chart."""
        self._choose("Save the profile as a figure", FIGURE_FORMATS, self.save_figure)

    def _choose(self, title: str, formats: tuple[str, ...], save: Callable[[str], None]) -> None:
        context = self._dock.context
        path = ask_path(context, title, file_name([context.session.first_surface.name], "profile"), formats)
        if path:
            try:
                save(path)
            except BihdistError as error:
                context.fail(error)

    # ------------------------------------------------------------------ what is written
    def save_numbers(self, path: str) -> None:
        """The path, and the fields along it, as the extension says (`PROFILE_FORMATS`)."""
        if os.path.splitext(path)[1].lower() not in PROFILE_FORMATS:
            raise ParameterError(f"{path} has to end with one of {', '.join(PROFILE_FORMATS)}.")
        write_profile(path, self._there(), self._fields())
        self._dock.context.tell(f"Saved {os.path.basename(path)}")

    def save_figure(self, path: str) -> None:
        """In the background, as all figures."""
        from .figure import save_profile_figure

        check_output(path, FIGURE_FORMATS)
        self._dock.context[Exports].start(partial(save_profile_figure, self.figure(), path), path, "Figure")

    def figure(self) -> "ProfileFigure":
        """What the chart shows, in the style of the page and the colours that go with its ground."""
        from .figure_curves import profile_figure

        context = self._dock.context
        return profile_figure(context.document, context.page, self._there(), self._answers)

    def copy(self) -> None:
        """A table with tabs, as spreadsheets read it."""
        if self._dock.path is None:
            return
        fields = {name: self._dock.path.along(field) for name, field in self._fields().items()}
        rows = ["\t".join(["arc", *fields])]
        for k, arc in enumerate(self._dock.path.arcs):
            rows.append("\t".join(repr(float(x)) for x in (arc, *(column[k] for column in fields.values()))))
        QtWidgets.QApplication.clipboard().setText("\n".join(rows) + "\n")
        self._dock.context.tell(f"{len(rows) - 1:,} points of the profile are on the clipboard")

    def _there(self) -> SurfacePath:
        if self._dock.path is None:
            raise ParameterError("There is no path yet; wait until it has been found.")
        return self._dock.path

    @property
    def _answers(self) -> dict[int, Answer]:
        """Of the panels that have a curve."""
        return {id: self._dock.context.session.shown[id].answer for id in self._dock.curves}

    def _fields(self) -> dict[str, FloatArray]:
        from .figure_curves import profile_fields

        return profile_fields(self._dock.context.document, self._answers)
