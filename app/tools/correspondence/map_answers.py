"""Maps between the two surfaces of a document: in files or from its pairs, and the colours that say where they lead."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import BihdistError, Cancelled, Surface, VertexError
from bihdist_core.applications.correspondence import NOWHERE, carried_back, position_colours
from bihdist_core.arrays import IntArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document, MeshFile
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import Question, question_of
from .maps import MapColours, MapFile, Maps, map_in
from .pairs import other_side
from .prediction_answers import NO_OTHER, correspondence, pairs_on

NO_PAIRS = "There are no pairs yet to make a map from."
"""The message of a panel that shows a map before there is a pair."""


@dataclass(frozen=True)
class PositionQuestion(Question):
    """The colours of a surface by position."""

    mesh: MeshFile
    areas: str

    def __str__(self) -> str:
        return str(MapColours())

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        colours = position_colours(loaded.surface)
        colours.flags.writeable = False
        return Answer(label=str(self), colours=colours, error_estimate=ErrorEstimate())


@dataclass(frozen=True)
class MapQuestion(Question):
    """The map to another surface, in a file or made by pairs of points here and there.

    `other` is that surface, None if there is none.
    """

    mesh: MeshFile
    areas: str
    by: Spec | MapFile
    other: MeshFile | None
    pairs: tuple[tuple[Source | None, Source | None], ...]

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.by,) if isinstance(self.by, Spec) else ()

    def with_specs(self, specs: tuple[Spec, ...]) -> "MapQuestion":
        return replace(self, by=specs[0]) if specs else self

    @property
    def about(self) -> Hashable:
        """The values that the answer depends on, except the pairs."""
        return (self.mesh, self.areas, self.by, self.other, "map")

    @property
    def others(self) -> tuple[MeshFile, ...]:
        return () if self.other is None else (self.other,)

    def __str__(self) -> str:
        return str(MapColours(self.by.path if isinstance(self.by, MapFile) else self.by))

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """Return each vertex in the colour of the one that it is mapped to."""
        other = loaded.shown_with(self.other)
        if other is None:
            return Answer(label=str(self), failure=NO_OTHER)
        try:
            if isinstance(self.by, MapFile):
                found, label = map_in(self.by, loaded.surface, other.surface), f"map {self.by.name}"
            elif not self.pairs:
                return Answer(label=str(self), failure=NO_PAIRS)
            else:
                known = correspondence(self.areas, self.by, self.pairs, loaded, other, part(progress, 0, 0.5))
                found, label = known.map(progress=part(progress, 0.5, 1)), f"map by {known.distance_m.label}"
            colours = carried_back(position_colours(other.surface), found)
        except (Cancelled, VertexError):
            raise
        except (BihdistError, MemoryError) as error:
            return failed(str(self), error)
        found.flags.writeable = colours.flags.writeable = False
        remark = _reached_in_words(found, other.surface)
        return Answer(label=label, colours=colours, leads_to=found, error_estimate=ErrorEstimate(), remark=remark)


@question_of.register
def _(shows: MapColours, document: Document, surface: str) -> PositionQuestion | MapQuestion:
    mesh, areas, there = document.mesh(surface), document.areas, other_side(document, surface)
    if not shows.by:
        return PositionQuestion(mesh, areas)
    other = None if there is None else document.mesh(there)
    if isinstance(shows.by, str):
        return MapQuestion(mesh, areas, document[Maps].of(shows.by), other, ())
    return MapQuestion(mesh, areas, shows.by, other, () if there is None else pairs_on(document, surface, there))


def _reached_in_words(found: IntArray, onto: Surface) -> str:
    """Return a sentence on the vertices of the other surface that are reached, and on those mapped nowhere."""
    reached, count = len(np.unique(found[found != NOWHERE])), len(onto.vertices)
    sentence = f"{reached:,} of {count:,} vertices of {onto.name} are reached"
    lost = int((found == NOWHERE).sum())
    return f"{sentence}, {lost:,} are mapped nowhere (grey)" if lost else sentence


def colours_words(answer: Answer | None) -> tuple[str, ...]:
    """Return the meaning of an answer's colours, in more and in fewer words; () for an answer without colours."""
    if answer is None or answer.colours is None or answer.labels is not None:
        return ()
    if answer.leads_to is None:
        return "red, green and blue from x, y and z", "coloured by position", ""
    reached = len(np.unique(answer.leads_to[answer.leads_to != NOWHERE]))
    return answer.remark, f"{reached:,} vertices are reached", ""
