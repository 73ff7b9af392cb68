"""Curves that fields start from, and the files they are saved in."""

import hashlib
import os
from contextlib import suppress
from pathlib import Path

from qtpy import QtCore

from bihdist_core import BihdistError, Curve, OutputError, ParameterError
from bihdist_core.file_content import file_json
from bihdist_core.sources.words import curve_text, read_curve
from bihdist_core.whole_file import whole_file

from ...document.file_names import file_name
from ...document.source_edits import members_of
from .. import remembered
from ..context import Context
from .saving import ask_path


class CurveFiles(QtCore.QObject):
    """Curves that are read, and saved.

    paths: where they were read from, or saved by the user; a file may have changed since.
    """

    taken = QtCore.Signal(object, object)  # a curve for distances to start from, and its path by the curve
    saved = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.paths: dict[Curve, str] = {}

    def take(self, path: str) -> None:
        """Let distances start from the curve in a file, or say why they cannot."""
        context = self._context
        try:
            curve = read_curve(path)
        except ParameterError as error:
            context.fail(error)
            return
        if context.session.surface is None:
            context.fail(f"{os.path.basename(path)} is a curve for distances to start from; open its mesh first.")
        else:
            self.taken.emit(curve, {curve: os.path.abspath(path)})

    def save_source(self, panel: int) -> bool:
        """Ask where to save the curve that a panel's field starts from; whether it was saved."""
        document = self._context.document
        points = [document.point(name) for each in document.panels if each.id == panel for name in each.shows.points]
        curves = [each for point in points for each in members_of(point.at) if isinstance(each, Curve)]
        if len(curves) == 1:
            return self.choose_and_save(curves[0])
        where = "right click the one that is to be saved" if curves else "draw one on the surface (D)"
        self._context.tell(f"The source has {len(curves) or 'no'} curve{'s' * bool(curves)}; {where}")
        return False

    def choose_and_save(self, curve: Curve) -> bool:
        """Ask for a file; whether the curve was saved."""
        surface = self._context.session.surface
        name = file_name([] if surface is None else [surface.name], "curve")
        path = ask_path(self._context, "Save the curve", name, (".json",))
        if not path:
            return False
        try:
            self.save(curve, path)
        except BihdistError as error:
            self._context.fail(error)
            return False
        return True

    def save(self, curve: Curve, path: str) -> None:
        """Into a file, `curve.json` as a source in words; OutputError if it cannot be written."""
        with whole_file(path) as temporary:
            Path(temporary).write_text(curve_text(curve), encoding="utf-8")
        self.paths[curve] = os.path.abspath(path)
        self.saved.emit()
        self._context.tell(f"Saved {os.path.basename(path)}")

    def path_of(self, curve: Curve) -> str:
        """A file that holds a curve: the user's, or one among the program's data; OutputError if there can be none."""
        path = self.paths.get(curve, "")
        with suppress(ParameterError):
            if path and read_curve(path) == curve:
                return path
        text = curve_text(curve)
        kept = remembered.folder() / "curves" / f"curve-{hashlib.sha256(text.encode()).hexdigest()[:8]}.json"
        try:
            kept.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(kept) as temporary:
                temporary.write_text(text, encoding="utf-8")
        except OSError as error:
            raise OutputError(f"The curve cannot be kept in {kept.parent}: {error.strerror or error}.") from error
        return str(kept)


def is_curve(path: str) -> bool:
    """Whether a file looks like a curve, which is no session or recipe."""
    try:
        data = file_json(path, "curve", "a curve")
    except ParameterError:
        return False
    return isinstance(data, dict) and "points" in data and "document" not in data
