"""The extrema that interpolants have besides their anchors: a table in the dock, and a line in each panel."""

from collections.abc import Iterator

import numpy as np
from qtpy import QtWidgets

from bihdist_core.analysis.persistence import OtherExtrema
from bihdist_core.applications.tips import at_tips, tips
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.counts import counted
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...session.loaded_mesh import LoadedMesh
from .part import Anchors
from .quantity import interpolated


class AnchorExtrema(FactTable):
    """The numbers of extrema besides the anchors; those at tips of the shape, which any monotone field has, are
    counted apart."""

    HEADS = SHORT_HEADS = ("at tips", "elsewhere")
    HEAD = 22.0

    def __init__(self, context: Context, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._context = context
        self._ends: IntArray | None = None  # the tips of the surface; None until they are found
        self._about: tuple[object, ...] | None = None
        self._tips = context.background("tips", _compute_tips, self._take_tips, self._refuse_tips)
        context.found_changed.connect(lambda kind: self.show_counts() if kind is OtherExtrema else None)

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

    def _refuse_tips(self, about: object, sentence: str) -> None:
        self._take_tips(about, np.zeros(0, int))

    def show_counts(self) -> None:
        """Show how many extrema each interpolant has beside its anchors."""
        session, grid = self._context.session, self._context.grid
        if session.loaded() is None or "anchors" not in session.document.docks:
            return
        facts: list[tuple[str, ...]] = []
        for panel in session.document.panels_of():
            counts = None
            part = interpolated(panel.shows)
            if part is not None:
                counts = self._counts(panel.id)
                # By a single anchor all is one value.
                unknown = "…" if len(session.document[Anchors].anchors) > 1 else "–"
                words = (unknown, unknown) if counts is None else tuple(map(str, counts))
                facts.append((kind_name(part.spec.distance_type), *words))
            if any(shown.id == panel.id for shown in grid.panels):
                grid.panel(panel.id).view.over.write(() if counts is None else in_words(*counts))
        self.show_facts(facts)

    def _counts(self, panel: int) -> tuple[int, int] | None:
        found = self._context.found(panel, OtherExtrema)
        if found is None or self._ends is None:
            return None
        near = int(at_tips(self._context.session.mesh().surface, found.vertices, self._ends).sum())
        return near, len(found.vertices) - near

    def leave(self) -> None:
        """Clear the lines in the panels."""
        for panel in self._context.grid.panels:
            panel.view.over.write(())


def in_words(near: int, elsewhere: int) -> tuple[str, ...]:
    """Return a panel's line on numbers of extrema at tips and elsewhere, in more and in fewer words."""
    found = counted(near + elsewhere, "extremum", "extrema")
    at_tips_too = f", {near} at tips" if near else ""
    counts = f"{found} besides the anchors", found, f"{near + elsewhere}"
    return tuple(words + at_tips_too for words in counts)


def _compute_tips(about: tuple[LoadedMesh, str], progress: Progress) -> Iterator[IntArray]:
    loaded, areas = about
    yield tips(loaded.distances(areas).laplacian)
