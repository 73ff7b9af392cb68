"""The source as typed in the tool bar's box."""

from collections.abc import Mapping

from bihdist_core import BihdistError
from bihdist_core.sources.source import Curve, Source
from bihdist_core.sources.words import EMPTY

from ..document.edits import move_source
from ..session.questions import source_at
from .context import Context
from .files.curve_files import CurveFiles
from .source_box import SourceBox


class TypedSource:
    """The source of the first panel, with the `box` in which it is typed."""

    def __init__(self, context: Context) -> None:
        self._context, self.box = context, SourceBox(context.widget)
        context[CurveFiles].taken.connect(self.choose)
        self.box.chosen.connect(self.choose)
        self.box.left.connect(context.focus_panels)

    def choose(self, source: Source, files: Mapping[Curve, str] = EMPTY) -> None:
        """Move the source, or show why that is not possible; `files` are those of its curves."""
        session = self._context.session
        document = session.document
        if session.loaded() is not None and document.panels:
            try:
                source = source_at(source, session.mesh(document.panels[0].id).surface)
            except BihdistError as error:
                self._context.refused.emit(str(error))
                self.box.refuse(str(error))
                return
            self._context[CurveFiles].paths.update(files)
            session.show(move_source(document, document.panels[0].id, source))
            self.show()

    def ask(self) -> None:
        """Give the box the keyboard focus."""
        if self.box.isEnabled():
            self.box.ask()

    def show(self) -> None:
        """Show the source in the box."""
        session = self._context.session
        document = session.document
        point = next((document.point(name) for panel in document.panels for name in panel.shows.points), None)
        loaded = session.loaded() if point is None else session.loaded(point.surface)
        if loaded is None:
            self.box.show_source(None, 0)
        else:
            source = None if point is None else source_at(point.at, loaded.surface)
            self.box.show_source(source, len(loaded.surface.vertices))
