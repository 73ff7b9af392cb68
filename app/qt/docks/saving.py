"""Asking where a file goes, and writing it; what fails is said in the window.  `window` is the main window."""

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from qtpy import QtWidgets

from bihdist_core import BihdistError

MESH_FILES = "Meshes (*.off *.obj *.ply *.stl *.vtk *.vtp);;All files (*)"
"""What can be opened."""

NAMES = {
    ".txt": "Text, an id on each line",
    ".npy": "NumPy array",
    ".csv": "Table",
    ".ply": "PLY mesh",
    ".vtp": "VTK PolyData",
    ".obj": "OBJ",
    ".off": "OFF",
    ".json": "JSON",
    ".pp": "MeshLab's picked points",
    ".pdf": "PDF",
    ".png": "PNG",
    ".svg": "SVG",
    ".eps": "EPS",
}


def save(window: Any, title: str, name: str, formats: Sequence[str], write: Callable[[str], object]) -> None:
    """Ask for a path (`ask_path`), and write what there is to it."""
    path = ask_path(window, title, name, formats)
    if path:
        written(window, path, write)


def ask_path(window: Any, title: str, name: str, formats: Sequence[str]) -> str:
    """A path that ends in one of the formats, the first if none is typed; empty if the user has none.

    name: a `file_name`.
    """
    dialog = QtWidgets.QFileDialog(window, title, window.preferences.last_folder)
    dialog.setAcceptMode(QtWidgets.QFileDialog.AcceptMode.AcceptSave)
    dialog.setNameFilters([f"{NAMES[extension]} (*{extension})" for extension in formats])
    dialog.setDefaultSuffix(formats[0].removeprefix("."))

    def take_format(chosen: str) -> None:
        extension = re.search(r"\*(\.\w+)", chosen)[1]
        dialog.setDefaultSuffix(extension.removeprefix("."))
        for path in dialog.selectedFiles()[:1]:  # a dialog of the desktop may have none yet
            stem, typed = os.path.splitext(os.path.basename(path))
            if typed in formats:
                dialog.selectFile(stem + extension)

    dialog.filterSelected.connect(take_format)
    dialog.selectFile(name + formats[0])
    if not dialog.exec():
        return ""
    (path,) = dialog.selectedFiles()
    window.preferences = replace(window.preferences, last_folder=os.path.dirname(path))
    return path


def written(window: Any, path: str, write: Callable[[str], object]) -> bool:
    """Write a file, and say so or why not."""
    try:
        write(path)
    except BihdistError as error:
        window.failed(str(error))
        return False
    window.say(saved_words(path))
    return True


def saved_words(path: str) -> str:
    """That a file is written, and where."""
    folder, name = os.path.split(os.path.abspath(path))
    return f"Saved {name} in {folder}"
