"""Source curves, and the files they are saved in."""

import hashlib
import os
from contextlib import suppress
from pathlib import Path

from qtpy import QtCore

from bihdist_core import Curve, OutputError, ParameterError
from bihdist_core.file_content import file_json
from bihdist_core.file_output import atomic_write
from bihdist_core.sources.words import curve_text, read_curve

from ...document.file_names import file_name
from ...document.source_edits import members_of
from .. import remembered
from ..context import Context
from .saving import ask_path


class CurveFiles(QtCore.QObject):
    """Reads and saves curves.

    `paths` holds the files that curves were read from or saved to; a file may have changed since.
    """

    taken = QtCore.Signal(object, object)  # a curve for distances to start from, and its path by the curve
    saved = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.paths: dict[Curve, str] = {}

    def take(self, path: str) -> None:
        """Make the curve in a file the source, or tell why that is not possible."""
        with self._context.errors_shown():
            curve = read_curve(path)
            if self._context.session.loaded() is None:
                raise ParameterError(f"{os.path.basename(path)} is a source curve; open its mesh first.")
            self.taken.emit(curve, {curve: os.path.abspath(path)})

    def save_source(self, panel: int) -> bool:
        """Ask where to save the source curve of a panel, and return whether it was saved."""
        document = self._context.document
        points = [document.point(name) for each in document.panels if each.id == panel for name in each.shows.points]
        curves = [each for point in points for each in members_of(point.at) if isinstance(each, Curve)]
        if len(curves) == 1:
            return self.choose_and_save(curves[0])
        where = "right click the one to save" if curves else "draw one on the surface (D)"
        self._context.tell(f"The source has {len(curves) or 'no'} curve{'s' * bool(curves)}; {where}")
        return False

    def choose_and_save(self, curve: Curve) -> bool:
        """Ask for a file, and return whether the curve was saved."""
        loaded = self._context.session.loaded()
        name = file_name([] if loaded is None else [loaded.surface.name], "curve")
        path = ask_path(self._context, "Save the curve", name, (".json",))
        if not path:
            return False
        with self._context.errors_shown():
            self.save(curve, path)
            return True
        return False

    def save(self, curve: Curve, path: str) -> None:
        """Write a curve to a file; OutputError if it cannot be written."""
        with atomic_write(path) as temporary:
            Path(temporary).write_text(curve_text(curve), encoding="utf-8")
        self.paths[curve] = os.path.abspath(path)
        self.saved.emit()
        self._context.tell(f"Saved {os.path.basename(path)}")

    def path_of(self, curve: Curve) -> str:
        """Return a file with the curve, the user's or one of the program's; OutputError if none can be written."""
        path = self.paths.get(curve, "")
        with suppress(ParameterError):
            if path and read_curve(path) == curve:
                return path
        text = curve_text(curve)
        kept = remembered.folder() / "curves" / f"curve-{hashlib.sha256(text.encode()).hexdigest()[:8]}.json"
        try:
            kept.parent.mkdir(parents=True, exist_ok=True)
            with atomic_write(kept) as temporary:
                temporary.write_text(text, encoding="utf-8")
        except OSError as error:
            raise OutputError(f"The curve cannot be saved in {kept.parent}: {error.strerror or error}.") from error
        return str(kept)


def is_curve(path: str) -> bool:
    """Return whether a file looks like a curve rather than a session or recipe."""
    try:
        data = file_json(path, "curve", "a curve")
    except ParameterError:
        return False
    return isinstance(data, dict) and "points" in data and "document" not in data
