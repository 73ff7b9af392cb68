"""Asking for a path to open or save, and writing files, also in the background, or telling why that is not possible."""

import os
import re
import sys
from collections.abc import Callable, Sequence

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.formats.mesh_names import GZIP, MESH_FORMATS

from ..background import call
from ..context import Context

MESH_PATTERNS = " ".join([*(f"*{each}" for each in (*MESH_FORMATS, GZIP, ".surf", ".asc")), "lh.*", "rh.*"])
MESH_FILES = f"Meshes ({MESH_PATTERNS});;All files (*)"
"""The filter of dialogs that open meshes."""

NAMES = {
    ".txt": "Text, an id on each line",
    ".npy": "NumPy array",
    ".csv": "Table",
    ".ply": "PLY mesh",
    ".vtp": "VTK PolyData",
    ".vtu": "VTK unstructured grid",
    ".func.gii": "GIFTI values",
    ".shape.gii": "GIFTI shape",
    ".obj": "OBJ",
    ".glb": "glTF binary",
    ".off": "OFF",
    ".json": "JSON",
    ".pp": "MeshLab's picked points",
    ".fcsv": "Slicer's fiducials",
    ".mrk.json": "Slicer's markups",
    ".pts": "IDAV Landmark",
    ".landmarkAscii": "Avizo's landmarks",
    ".tps": "TPS landmarks",
    ".pdf": "PDF",
    ".png": "PNG",
    ".svg": "SVG",
    ".eps": "EPS",
}


def file_filter(kind: str, formats: Sequence[str]) -> str:
    """Return the filter of a dialog that opens files of a kind, by their extensions."""
    return f"{kind} ({' '.join(f'*{extension}' for extension in formats)});;All files (*)"


def ask_file(context: Context, title: str, files: str, take: Callable[[str], object]) -> None:
    """Ask for a file to open, by a filter of the dialog, and let a function take its path."""
    path, _ = QtWidgets.QFileDialog.getOpenFileName(context.widget, title, context.folder, files)
    if path:
        context.folder = os.path.dirname(path)
        take(path)


def save(
    context: Context,
    title: str,
    name: str,
    formats: Sequence[str],
    write: Callable[[str], object],
    path: str = "",
) -> None:
    """Write to a path, which is asked for (`ask_path`) if none is given."""
    path = path or ask_path(context, title, name, formats)
    if path:
        written(context, path, write)


def ask_path(context: Context, title: str, name: str, formats: Sequence[str]) -> str:
    """Ask for a path that ends in one of the formats, the first if none is typed; return "" if the user cancels.

    `name` is a `file_name`.
    """
    dialog = QtWidgets.QFileDialog(context.widget, title, context.folder)
    dialog.setAcceptMode(QtWidgets.QFileDialog.AcceptMode.AcceptSave)
    dialog.setNameFilters([f"{NAMES[extension]} (*{extension})" for extension in formats])
    dialog.setDefaultSuffix(formats[0].removeprefix("."))

    def take_format(chosen: str) -> None:
        found = re.search(r"\*(\.[\w.]+)", chosen)
        extension = found[1] if found else formats[0]
        dialog.setDefaultSuffix(extension.removeprefix("."))
        for path in dialog.selectedFiles()[:1]:  # a dialog of the desktop may have none yet
            name = os.path.basename(path)
            typed = next((each for each in formats if name.endswith(each)), "")
            if typed:
                dialog.selectFile(name.removesuffix(typed) + extension)

    dialog.filterSelected.connect(take_format)
    dialog.selectFile(name + formats[0])
    paths = dialog.selectedFiles() if dialog.exec() else []
    dialog.deleteLater()  # some fifty widgets, which the window would keep
    if not paths:
        return ""
    (path,) = paths
    context.folder = os.path.dirname(path)
    return str(path)


def written(context: Context, path: str, write: Callable[[str], object]) -> bool:
    """Write a file, tell the user, and return whether it was written."""
    with context.errors_shown():
        write(path)
        context.tell(saved_words(path))
        return True
    return False


def saved_words(path: str) -> str:
    """Return a sentence that a file was saved, with its folder."""
    folder, name = os.path.split(os.path.abspath(path))
    return f"Saved {name} in {folder}"


class Writing(QtCore.QObject):
    """Asks for paths, and writes files in the background, one after the other."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._waiting: list[Callable[[], str]] = []  # the first of them is being written
        self._background = context.background("writing", call, self._say, self._refuse)
        context.closed.connect(self._finish)

    def save(
        self,
        title: str,
        name: str,
        formats: tuple[str, ...],
        write: Callable[[str], None],
        path: str,
        remark: str = "",
    ) -> None:
        """Write a file, asking for a path if none is given; `remark` is told besides."""
        path = path or ask_path(self._context, title, name, formats)

        def work() -> str:
            write(path)
            return f"{saved_words(path)}{remark}"

        if path:
            self._waiting.append(work)
            if len(self._waiting) == 1:
                self._write_next()

    def _write_next(self) -> None:
        self._background.ask((self._waiting[0],))

    def _finish(self) -> None:
        """Write what still waits, as the window has closed."""
        for work in self._waiting[1:]:
            try:
                work()
            except (BihdistError, OSError) as error:
                print(f"bihdist: {error}", file=sys.stderr)
        self._waiting.clear()

    def _say(self, request: object, words: str) -> None:
        self._context.tell(words)
        self._ended()

    def _refuse(self, request: object, sentence: str) -> None:
        self._context.fail(sentence)
        self._ended()

    def _ended(self) -> None:
        self._waiting.pop(0)
        if self._waiting:
            self._write_next()
