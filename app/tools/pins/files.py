"""Pins to and from files, and to the clipboard."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from qtpy import QtWidgets

from bihdist_core import BihdistError
from bihdist_core.arrays import FloatArray
from bihdist_core.counts import counted
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.pins import PIN_FORMATS, Pins, read_pins, write_pins

from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.files.saving import ask_path
from ...qt.look.numbers import number, share
from .locations import LocatedPin, matrix_text, pins_text, pins_to_write, with_pins

READ = f"Pins ({' '.join(f'*{extension}' for extension in PIN_FORMATS)});;All files (*)"


class PinFiles:
    """What the menu of pins offers; `pins()` gives the places that there are now."""

    def __init__(self, context: Context, pins: Callable[[], Sequence[LocatedPin]]) -> None:
        self._context, self._pins = context, pins

    @property
    def _folder(self) -> Path:
        return Path(self._context.folder)

    # ------------------------------------------------------------------ files
    def choose_and_save(self) -> None:
        """Ask for a file, and write the pins."""
        surface = self._context.session.first_surface
        path = ask_path(self._context, "Save pins", file_name([surface.name], "pins"), PIN_FORMATS)
        if path:
            self.save(path)

    def save(self, path: str) -> None:
        """Write the pins, or say why not; how far those in faces are from the vertices that are written is said."""
        surface = self._context.session.first_surface
        try:
            written = pins_to_write(self._pins(), surface)
            write_pins(path, surface, written)
        except BihdistError as error:
            self._context.fail(error)
            return
        size = float(np.ptp(surface.vertices, axis=0).max())
        remark = snapped(written, size)
        self._context.tell(
            f"Saved {counted(len(written), 'pin')} in {Path(path).name}{f': {remark}' if remark else ''}"
        )

    def choose_and_read(self) -> None:
        """Ask for a file of pins, and read it."""
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self._context.widget, "Read pins", str(self._folder), READ)
        if path:
            self.read(path)

    def read(self, path: str) -> None:
        """Pins of a file besides those that there are; how far they were from vertices is said."""
        session = self._context.session
        document, surface = session.document, session.first_surface
        try:
            found = read_pins(path, surface)
            session.show(with_pins(document, found, document.surfaces[0].name))
        except BihdistError as error:
            self._context.fail(error)
            return
        size = float(np.ptp(surface.vertices, axis=0).max())
        self._context.tell(snapped(found, size) or f"Read {counted(len(found), 'pin')} from {Path(path).name}")

    # ------------------------------------------------------------------ the clipboard
    def copy_list(self, answers: Sequence[tuple[str, Answer]]) -> None:
        """The list with all digits, with a tab between columns."""
        self._copy(pins_text(self._pins(), self._context.session.first_surface, answers), "The list of pins")

    def copy_matrix(self, matrix: FloatArray) -> None:
        """The same of the distances among them."""
        self._copy(matrix_text(self._pins(), matrix), "The distances among pins")

    def _copy(self, text: str, what: str) -> None:
        QtWidgets.QApplication.clipboard().setText(text)
        self._context.tell(f"{what} {'are' if what.startswith('The distances') else 'is'} on the clipboard")


def snapped(pins: Pins, size: float) -> str:
    """How far pins of a file were moved to vertices, in words; empty if none was by more than rounding."""
    far = np.flatnonzero(pins.moved > 1e-9 * size)
    if not len(far):
        return ""
    most = int(far[pins.moved[far].argmax()])
    of_size = share(float(pins.moved[most]) / size) if size else ""
    return (
        f"{counted(len(far), 'pin')} moved to a vertex, the farthest, {pins.ids[most]}, by "
        f"{number(float(pins.moved[most]))} ({of_size} of the mesh's size)"
    )
