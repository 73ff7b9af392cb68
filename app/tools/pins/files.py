"""Pins to and from files, and to the clipboard."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray
from bihdist_core.counts import counted
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.pins import PIN_FORMATS, Pins, read_pins, write_pins

from ...document.file_names import file_name
from ...drawing.numbers import number, share
from ...qt.context import Context
from ...qt.files.saving import ask_path, file_filter
from .locations import LocatedPin, matrix_text, pins_text, pins_to_write, with_pins

PIN_FILES = file_filter("Pins", PIN_FORMATS)


class PinFiles:
    """Pins in files and on the clipboard; `pins()` returns those that there are now."""

    def __init__(self, context: Context, pins: Callable[[], Sequence[LocatedPin]]) -> None:
        self._context, self._pins = context, pins

    def save(self, path: str = "") -> None:
        """Write the pins, and say how far those in faces are from the vertices that are written.

        Asks for a path if none is given.
        """
        surface = self._context.session.mesh().surface
        path = path or ask_path(self._context, "Save pins", file_name([surface.name], "pins"), PIN_FORMATS)
        if not path:
            return
        with self._context.errors_shown():
            written = pins_to_write(self._pins(), surface)
            write_pins(path, surface, written)
            remark = snapped(written, surface)
            saved = f"Saved {counted(len(written), 'pin')} in {Path(path).name}"
            self._context.tell(f"{saved}: {remark}" if remark else saved)

    def read(self, path: str) -> None:
        """Add the pins of a file, and say how far they were from vertices."""
        session = self._context.session
        document, surface = session.document, session.mesh().surface
        with self._context.errors_shown():
            found = read_pins(path, surface)
            session.show(with_pins(document, found, document.surfaces[0].name))
            read = f"Read {counted(len(found), 'pin')} from {Path(path).name}"
            self._context.tell(". ".join([snapped(found, surface) or read, *found.facts]))

    def copy_list(self, answers: Sequence[tuple[str, Answer]]) -> None:
        """Copy the list with all digits, with a tab between columns."""
        text = pins_text(self._pins(), self._context.session.mesh().surface, answers)
        self._context.copy(text, "The list of pins is on the clipboard")

    def copy_matrix(self, matrix: FloatArray) -> None:
        """Copy the distances among the pins, with a tab between columns."""
        self._context.copy(matrix_text(self._pins(), matrix), "The distances among pins are on the clipboard")


def snapped(pins: Pins, surface: Surface) -> str:
    """Return a sentence on pins of a file that were moved to vertices, "" if none was by more than rounding."""
    size = float(np.ptp(surface.vertices, axis=0).max())
    far = np.flatnonzero(pins.moved > 1e-9 * size)
    if not len(far):
        return ""
    most = int(far[pins.moved[far].argmax()])
    of_size = share(float(pins.moved[most]) / size) if size else ""
    return (
        f"{counted(len(far), 'pin')} moved to a vertex, the farthest, {pins.ids[most]}, by "
        f"{number(float(pins.moved[most]))} ({of_size} of the mesh's size)"
    )
