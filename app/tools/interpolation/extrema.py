"""The extrema that interpolants have besides their anchors: a table in the dock, and a line in each panel."""

from collections.abc import Iterator

import numpy as np
from qtpy import QtWidgets

from bihdist_core.analysis.other_extrema import OtherExtrema
from bihdist_core.applications.tips import at_tips, tips
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...session.loaded_mesh import LoadedMesh
from .quantity import interpolated


class AnchorExtrema(FactTable):
    """Those at tips of the shape, where any monotone field must have one, are counted apart."""

    def __init__(self, context: Context, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._context = context
        self._ends: IntArray | None = None  # the tips of the surface; None until they are found
        self._about: tuple[object, ...] | None = None
        self._tips = context.background("tips", _found_tips)
        self._tips.answered.connect(self._take_tips)
        self._tips.failed.connect(self._no_tips)
        context.found_changed.connect(self._take_found)

    def show_document(self, document: Document) -> None:
        """Look for the tips of another surface's limbs, and count extrema anew."""
        loaded = self._context.session.loaded()
        about = (loaded, document.areas)
        if loaded is not None and about != self._about:
            self._about, self._ends = about, None
            self._tips.ask(about)
        self.show_counts()

    def _take_tips(self, _: object, found: AnyArray) -> None:
        self._ends = found
        self.show_counts()

    def _no_tips(self, *_: object) -> None:
        self._ends = np.zeros(0, int)
        self.show_counts()

    def _take_found(self, kind: type) -> None:
        if kind is OtherExtrema:
            self.show_counts()

    def show_counts(self) -> None:
        """Show how many extrema each interpolant has beside its anchors."""
        session, grid = self._context.session, self._context.grid
        if session.surface is None or "anchors" not in session.document.docks:
            return
        facts: list[tuple[str, ...]] = []
        for panel in session.document.panels_of():
            counts = None
            part = interpolated(panel.shows)
            if part is not None:
                counts = self._counts(panel.id)
                words = ("…", "…") if counts is None else tuple(map(str, counts))
                facts.append((kind_name(part.spec.kind), *words))
            if any(shown.id == panel.id for shown in grid.panels):
                grid.panel(panel.id).view.over.write(() if counts is None else in_words(*counts))
        self.show_facts([("Panel", "at tips", "elsewhere"), *facts] if facts else [])

    def _counts(self, panel: int) -> tuple[int, int] | None:
        found = self._context.found(panel, OtherExtrema)
        if found is None or self._ends is None:
            return None
        near = int(at_tips(self._context.session.first_surface, found.vertices, self._ends).sum())
        return near, len(found.vertices) - near

    def leave(self) -> None:
        """Say nothing in panels any more."""
        for panel in self._context.grid.panels:
            panel.view.over.write(())


def in_words(near: int, elsewhere: int) -> tuple[str, str]:
    """What a panel says of so many extrema at tips, and so many elsewhere; and the same in short."""
    word = "extremum" if near + elsewhere == 1 else "extrema"
    at_tips_too = f", {near} at tips" if near else ""
    return f"{near + elsewhere} {word} besides the anchors{at_tips_too}", f"{near + elsewhere}{at_tips_too}"


def _found_tips(about: tuple[LoadedMesh, str], progress: Progress) -> Iterator[IntArray]:
    loaded, areas = about
    yield tips(loaded.distances(areas).laplacian)
