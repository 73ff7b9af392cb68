"""Asking where a file goes, and writing it; what fails is said in the window."""

import os
import re
from collections.abc import Callable, Sequence

from qtpy import QtWidgets

from bihdist_core import BihdistError
from bihdist_core.formats.mesh_names import GZIP, MESH_FORMATS

from ..context import Context

MESH_PATTERNS = " ".join([*(f"*{extension}" for extension in MESH_FORMATS), f"*{GZIP}", "lh.*", "rh.*"])
MESH_FILES = f"Meshes ({MESH_PATTERNS});;All files (*)"
"""What can be opened."""

NAMES = {
    ".txt": "Text, an id on each line",
    ".npy": "NumPy array",
    ".csv": "Table",
    ".ply": "PLY mesh",
    ".vtp": "VTK PolyData",
    ".func.gii": "GIFTI values",
    ".shape.gii": "GIFTI shape",
    ".obj": "OBJ",
    ".off": "OFF",
    ".json": "JSON",
    ".pp": "MeshLab's picked points",
    ".pdf": "PDF",
    ".png": "PNG",
    ".svg": "SVG",
    ".eps": "EPS",
}


def save(context: Context, title: str, name: str, formats: Sequence[str], write: Callable[[str], object]) -> None:
    """Ask for a path (`ask_path`), and write what there is to it."""
    path = ask_path(context, title, name, formats)
    if path:
        written(context, path, write)


def ask_path(context: Context, title: str, name: str, formats: Sequence[str]) -> str:
    """A path that ends in one of the formats, the first if none is typed; empty if the user has none.

    name: a `file_name`.
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
    if not dialog.exec():
        return ""
    (path,) = dialog.selectedFiles()
    context.folder = os.path.dirname(path)
    return str(path)


def written(context: Context, path: str, write: Callable[[str], object]) -> bool:
    """Write a file, and say so or why not."""
    try:
        write(path)
    except BihdistError as error:
        context.fail(error)
        return False
    context.tell(saved_words(path))
    return True


def saved_words(path: str) -> str:
    """That a file is written, and where."""
    folder, name = os.path.split(os.path.abspath(path))
    return f"Saved {name} in {folder}"
