"""The profile in files and on the clipboard, as numbers and as a figure."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from bihdist_core import ParameterError
from bihdist_core.analysis.surface_paths import PROFILE_FORMATS, SurfacePath, write_profile
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.files.chart_files import save_figure
from ...qt.files.saving import save

if TYPE_CHECKING:
    from .figure import ProfileFigure


class ProfileFiles:
    """Saves and copies a profile; `profile()` returns its path and the ids of the panels with a curve."""

    def __init__(self, context: Context, profile: Callable[[], tuple[SurfacePath | None, list[int]]]) -> None:
        self._context, self._profile = context, profile

    def save_numbers(self, path: str = "") -> None:
        """Save the path and the fields along it; ask for a file if none is given."""

        def write(path: str) -> None:
            write_profile(path, self._path(), self._fields())

        save(self._context, "Save the profile's numbers", self._name, tuple(PROFILE_FORMATS), write, path)

    def save_figure(self, path: str = "") -> None:
        """Save the figure in the background; ask for a file if none is given."""
        from .figure import save_profile_figure

        title = "Save the profile as a figure"
        save_figure(self._context, title, self._name, save_profile_figure, self.figure, path)

    def figure(self) -> "ProfileFigure":
        """Return the figure of the chart, in the style of the page and the colours that go with its background."""
        from .figure import profile_figure

        context = self._context
        return profile_figure(context.document, context.page, self._path(), self._answers)

    def copy(self) -> None:
        """Copy a table with tabs, as spreadsheets read it."""
        path = self._path()
        fields = {name: path.along(field) for name, field in self._fields().items()}
        rows = ["\t".join(["arc", *fields])]
        for k, arc in enumerate(path.arcs):
            rows.append("\t".join(repr(float(x)) for x in (arc, *(column[k] for column in fields.values()))))
        self._context.copy("\n".join(rows) + "\n", f"{len(rows) - 1:,} points of the profile are on the clipboard")

    @property
    def _name(self) -> str:
        return file_name([self._context.session.mesh().surface.name], "profile")

    def _path(self) -> SurfacePath:
        path, _ = self._profile()
        if path is None:
            raise ParameterError("There is no path yet; wait until it has been found.")
        return path

    @property
    def _answers(self) -> dict[int, Answer]:
        """The answers of the panels that show a curve."""
        _, panels = self._profile()
        return {id: self._context.session.shown[id].answer for id in panels}

    def _fields(self) -> dict[str, FloatArray]:
        from .figure import profile_fields

        return profile_fields(self._context.document, self._answers)
