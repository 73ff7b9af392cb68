"""From a document to its questions: for each panel all that its answer depends on, and nothing else."""

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.first_view import first_look
from bihdist_core.applications.weights import INVERSE_DISTANCES, Weights
from bihdist_core.distances.kinds import Spec
from bihdist_core.sources.pieces import Pieces, pieces_of
from bihdist_core.sources.source import Source

from ..document.document import Document, FieldArray, MeshFile
from ..document.map_colours import MapColours, MapFile
from ..document.pairing import other_side, waiting_point, whole_pairs
from ..document.quantities import ChangeOf, Difference, Interpolant, OwnField, Part, Prediction, Quantity


@dataclass(frozen=True)
class _ByDistance:
    """What is answered by one distance.  mesh: the surface, by path and checksum; areas: of its operators."""

    mesh: MeshFile
    areas: str
    spec: Spec

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.spec,)

    def with_specs(self: "Asked", specs: tuple[Spec, ...]) -> "Asked":
        """The same by another distance."""
        (spec,) = specs
        return replace(self, spec=spec)


Asked = TypeVar("Asked", bound=_ByDistance)


@dataclass(frozen=True)
class _ByNothing:
    """What is known without a distance."""

    mesh: MeshFile
    areas: str

    @property
    def specs(self) -> tuple[Spec, ...]:
        return ()

    def with_specs(self: "Known", specs: tuple[Spec, ...]) -> "Known":
        return self

    @property
    def about(self) -> Hashable:
        return self


Known = TypeVar("Known", bound=_ByNothing)


@dataclass(frozen=True)
class DistanceQuestion(_ByDistance):
    """The distance of every vertex from a source; equal questions have equal answers."""

    at: Source | None

    @property
    def about(self) -> Hashable:
        """All but from where."""
        return (self.mesh, self.areas, self.spec)

    def __str__(self) -> str:
        return str(self.spec)


@dataclass(frozen=True)
class FieldQuestion(_ByNothing):
    """A field of the user's own."""

    field: FieldArray

    def __str__(self) -> str:
        return self.field.name


@dataclass(frozen=True)
class InterpolantQuestion(_ByDistance):
    """Values at vertices, interpolated by a distance; or, if total, the sum of the weights."""

    anchors: tuple[tuple[Source | None, float], ...]
    weights: Weights = INVERSE_DISTANCES
    total: bool = False

    @property
    def about(self) -> Hashable:
        """All but where the anchors are, and their values."""
        return (self.mesh, self.areas, self.spec, self.total, "interpolant")

    def __str__(self) -> str:
        return str(Interpolant(self.spec, self.total))


@dataclass(frozen=True)
class ChangeQuestion(_ByDistance):
    """How a distance from a vertex of a changed surface differs from what it was before."""

    at: Source | None

    @property
    def about(self) -> Hashable:
        """All but from where."""
        return (self.mesh, self.areas, self.spec, "change")

    def __str__(self) -> str:
        return str(ChangeOf(self.spec))


@dataclass(frozen=True)
class PredictionQuestion(_ByDistance):
    """How badly each vertex fits a point of another surface, from pairs of points here and there.

    other: that surface, None if there is none.  at: the point there; None where no point of it waits, or none can be
    predicted.
    """

    other: MeshFile | None
    pairs: tuple[tuple[Source | None, Source | None], ...]
    at: Source | None

    @property
    def about(self) -> Hashable:
        """All but where the points are, and whether there is one."""
        return (self.mesh, self.areas, self.spec, self.other, self.at is None, "prediction")

    def __str__(self) -> str:
        return str(Prediction(self.spec))


@dataclass(frozen=True)
class PositionQuestion(_ByNothing):
    """The colours of a surface by position."""

    def __str__(self) -> str:
        return str(MapColours())


@dataclass(frozen=True)
class MapQuestion:
    """Where a map to another surface leads: one in a file, or one that pairs of points here and there make.

    other: that surface, None if there is none.
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
        """All but the pairs."""
        return (self.mesh, self.areas, self.by, self.other, "map")

    def __str__(self) -> str:
        return str(MapColours(self.by.path if isinstance(self.by, MapFile) else self.by))


PartQuestion = (
    DistanceQuestion
    | FieldQuestion
    | InterpolantQuestion
    | ChangeQuestion
    | PredictionQuestion
    | PositionQuestion
    | MapQuestion
)


@dataclass(frozen=True)
class DifferenceQuestion:
    """One answer less another, on the same surface."""

    minuend: PartQuestion
    subtrahend: PartQuestion
    raw: bool = False

    @property
    def mesh(self) -> MeshFile:
        return self.minuend.mesh

    @property
    def areas(self) -> str:
        return self.minuend.areas

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (*self.minuend.specs, *self.subtrahend.specs)

    def with_specs(self, specs: tuple[Spec, ...]) -> "DifferenceQuestion":
        count = len(self.minuend.specs)
        first, second = self.minuend.with_specs(specs[:count]), self.subtrahend.with_specs(specs[count:])
        return replace(self, minuend=first, subtrahend=second)

    @property
    def about(self) -> Hashable:
        return (self.minuend.about, self.subtrahend.about, self.raw)

    def __str__(self) -> str:
        return f"{self.minuend} - {self.subtrahend}"


Question = PartQuestion | DifferenceQuestion


def are_about_the_same(one: Question, other: Question) -> bool:
    """Whether they ask for the same on the same surface, perhaps from elsewhere."""
    return one.about == other.about


def asks_of(question: Question, mesh: MeshFile) -> bool:
    """Whether an answer depends on distances on this surface, too, on which it is not."""
    parts = (question.minuend, question.subtrahend) if isinstance(question, DifferenceQuestion) else (question,)
    others = [each.other for each in parts if isinstance(each, PredictionQuestion | MapQuestion)]
    # Whatever they are called in documents.
    return any(other is not None and replace(other, name=mesh.name) == mesh for other in others)


def questions(document: Document) -> dict[int, Question]:
    """The question of each panel, by the panel's id."""
    return {panel.id: _question(document, panel.surface, panel.shows) for panel in document.panels}


def _question(document: Document, surface: str, shows: Quantity) -> Question:
    mesh, areas = document.mesh(surface), document.areas

    def asked(part: Part) -> PartQuestion:
        if isinstance(part, OwnField):
            return FieldQuestion(mesh, areas, document.field(part.name))
        if isinstance(part, Interpolant):
            anchors = [(document.point(anchor.point), anchor) for anchor in document.anchors if not anchor.left_out]
            known = tuple((p.at, a.value) for p, a in anchors if p.surface == surface and a.value is not None)
            return InterpolantQuestion(mesh, areas, part.spec, known, document.weights, part.total)
        if isinstance(part, MapColours):
            return _mapped(document, surface, part)
        if isinstance(part, Prediction):
            return _predicted(document, surface, part.spec)
        kind = ChangeQuestion if isinstance(part, ChangeOf) else DistanceQuestion
        return kind(mesh, areas, part.spec, document.point(part.point).at)

    if isinstance(shows, Difference):
        return DifferenceQuestion(asked(shows.minuend), asked(shows.subtrahend), shows.raw)
    return asked(shows)


def _predicted(document: Document, surface: str, spec: Spec) -> PredictionQuestion:
    there, waiting = other_side(document, surface), waiting_point(document)
    other = None if there is None else document.mesh(there)
    asked = PredictionQuestion(document.mesh(surface), document.areas, spec, other, (), None)
    if there is None or waiting is None or waiting.surface != there or not whole_pairs(document):
        return asked  # what is plain is the same whatever pairs there are
    return replace(asked, pairs=_places(document, surface, there), at=waiting.at)


def _mapped(document: Document, surface: str, shows: MapColours) -> PositionQuestion | MapQuestion:
    mesh, areas, there = document.mesh(surface), document.areas, other_side(document, surface)
    if not shows.by:
        return PositionQuestion(mesh, areas)
    other = None if there is None else document.mesh(there)
    if isinstance(shows.by, str):
        return MapQuestion(mesh, areas, document.map(shows.by), other, ())
    return MapQuestion(mesh, areas, shows.by, other, () if there is None else _places(document, surface, there))


def _places(document: Document, surface: str, there: str) -> tuple[tuple[Source | None, Source | None], ...]:
    """Of the pairs, on one surface and on the other."""
    on = [{document.point(name).surface: document.point(name).at for name in p.points} for p in whole_pairs(document)]
    return tuple((each[surface], each[there]) for each in on)


def source_at(at: Source | None, surface: Surface, up: str = "y") -> Source:
    """Where a point is: None is the first source, with `up` up.

    VertexError or ParameterError if that is not on this surface.
    """
    if at is None:
        return first_source(surface, up)
    if isinstance(at, int):
        return surface.check_vertex(at)
    pieces_of(at, surface)
    return at


def pieces_at(at: Source | None, surface: Surface) -> Pieces:
    """What a point is made of on a surface; the same errors."""
    return pieces_of(source_at(at, surface), surface)


def vertex_at(at: Source | None, surface: Surface) -> int:
    """A vertex that stands for a point: itself, the nearest corner by weight, that of the first of several places.

    The same errors.
    """
    at = source_at(at, surface)
    if isinstance(at, int):
        return at
    pieces = pieces_of(at, surface)
    return surface.check_vertex(int(pieces.corners[0][int(np.argmax(pieces.start[0]))]))


def first_source(surface: Surface, up: str = "y") -> int:
    """Where to start with an axis up: a vertex of the largest component that is seen, see `first_look`."""
    return first_look(surface, up).source
