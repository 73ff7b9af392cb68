"""The isolines that a panel shows, saved as coordinates.  `window` is the main window."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from qtpy import QtCore

from bihdist_core import Surface
from bihdist_core.analysis.isoline_output import ISOLINE_FORMATS, write_isolines
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress

from .background import Background
from .saving import ask_path


@dataclass(frozen=True, eq=False)
class Levels:
    """What can be saved of a panel: its surface, its field (n,) with the end of its bar, and the isolines' values."""

    surface: Surface
    field: np.ndarray
    label: str
    maximum: float
    values: np.ndarray


def levels_of(window: Any, panel: int) -> Levels | None:
    """Those of a panel by its id; None where it has no field."""
    shown, opened = window.session.shown.get(panel), window.session.opened_in(panel)
    if shown is None or opened is None or shown.answer.field is None:
        return None
    answer = shown.answer
    values = np.array(window.grid.panel(panel).view.scene.isolines)
    return Levels(opened.surface, answer.field, answer.label, answer.maximum, values)


def write_levels(path: str, levels: Levels) -> None:
    """The isolines that the panel shows; see `write_isolines`."""
    if not len(levels.values):
        raise ParameterError("This panel shows no isolines; choose some in the menu Isolines first.")
    write_isolines(path, isolines(levels.surface, levels.field, levels.values))


class Writing(QtCore.QObject):
    """Asks where things go, and writes them in the background."""

    def __init__(self, window: Any) -> None:
        super().__init__(window)
        self._window = window
        self._background = Background("isolines", _done, window)
        self._background.answered.connect(self._say)
        self._background.failed.connect(self._refuse)

    def save(self, title: str, name: str, formats: tuple[str, ...], write: Callable[[str], None], path: str) -> None:
        """path: asks for one if it is empty."""
        path = path or ask_path(self._window, title, name, formats)

        def work() -> str:
            write(path)
            return path

        if path:
            self._background.ask((work,))

    def save_isolines(self, panel: int, path: str = "") -> None:
        """Those of a panel by its id."""
        levels = levels_of(self._window, panel)
        if levels is None:
            self._window.failed("This panel has no field yet.")
            return

        def write(path: str) -> None:
            write_levels(path, levels)

        self.save("Save isolines", f"{levels.surface.name} isolines", ISOLINE_FORMATS, write, path)

    def _say(self, request: object, path: str) -> None:
        self._window.say(f"Saved {QtCore.QFileInfo(path).fileName()}")

    def _refuse(self, request: object, sentence: str) -> None:
        self._window.failed(sentence)


def _done(request: tuple[Callable[[], object]], progress: Progress) -> Iterator[object]:
    yield request[0]()
