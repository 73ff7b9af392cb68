"""The source in words: what the tool bar's box says.  `window` is the main window."""

from collections.abc import Mapping

from bihdist_core import BihdistError
from bihdist_core.sources.source import Curve, Source
from bihdist_core.sources.words import NONE

from ..document.edits import move_source
from ..session.questions import source_at


class TypedSource:
    """What the first panel's field starts from."""

    def __init__(self, window) -> None:
        self._window, self._box = window, window.source_box
        self._box.chosen.connect(self.choose)
        self._box.left.connect(window.leave_boxes)

    def choose(self, source: Source, files: Mapping[Curve, str] = NONE) -> None:
        """Let it start there, or say why it cannot.  files: where its curves were read from."""
        session = self._window.session
        document = session.document
        if session.surface is not None and document.panels:
            try:
                source = source_at(source, session.surface_in(document.panels[0].id))
            except BihdistError as error:
                self._window.refused.emit(str(error))
                self._box.refuse(str(error))
                return
            self._window.curve_files.paths.update(files)
            session.show(move_source(document, document.panels[0].id, source))
            self.show()

    def ask(self) -> None:
        """Let it be typed."""
        if self._box.isEnabled():
            self._box.ask()

    def show(self) -> None:
        """Let the box say what it is."""
        session = self._window.session
        document = session.document
        name = next((name for panel in document.panels for name in panel.shows.points), "")
        sources = [document.point(name).at] if name else []
        loaded = session.loaded(document.point(name).surface) if name else session.loaded()
        surface = None if loaded is None else loaded.surface
        known = source_at(sources[0], surface) if surface is not None and sources else None
        self._box.show_source(known, 0 if surface is None else len(surface.vertices))
