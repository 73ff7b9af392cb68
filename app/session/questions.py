"""Questions of a document: for each panel all that its answer depends on, and nothing else."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import singledispatch
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

from bihdist_core import BihdistError, Cancelled, Laplacian, Signature, Surface
from bihdist_core.analysis.first_view import first_look
from bihdist_core.analysis.quality import apparent_source
from bihdist_core.analysis.signature_types import SignatureSpec
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, difference_of, failed
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.pieces import Pieces, pieces_of
from bihdist_core.sources.source import Source, SourceSet

from ..document.document import Document, FieldArray, MeshFile
from ..document.quantities import Difference, DistanceFrom, OwnField, VertexSignature
from ..document.source_edits import members_of
from ..document.tools import tools

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh


Asked = TypeVar("Asked", bound="Question")


class Question(ABC):
    """A panel's question on a surface; subclasses are frozen dataclasses, and equal questions have equal answers.

    Attributes
    ----------
    mesh
        The surface, by path and checksum.
    areas
        The vertex areas of its operators.
    """

    mesh: MeshFile
    areas: str

    is_distance: ClassVar[bool] = False
    """Whether it asks for a distance, and nothing made of it."""

    is_own_field: ClassVar[bool] = False
    """Whether it asks for a field of the user's own, which is known from one source only."""

    starts_at_point: ClassVar[bool] = False
    """Whether it is of a distance from a point that the document names."""

    @property
    def parts(self) -> "tuple[Question, ...]":
        """The two questions of a difference; any other question has one part, itself."""
        return (self,)

    @property
    def specs(self) -> tuple[Spec, ...]:
        """The distances that the answer is made of."""
        return ()

    def with_specs(self: Asked, specs: tuple[Spec, ...]) -> Asked:
        """Return the question by as many other distances."""
        return self

    @property
    def about(self) -> Hashable:
        """The value that two questions share if they ask for one thing from two places."""
        return self

    @property
    def others(self) -> tuple[MeshFile, ...]:
        """Other surfaces on whose distances the answer depends, too."""
        return ()

    @abstractmethod
    def answer(
        self, loaded: "LoadedMesh", progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """The answer on a surface; `at_once` is called with a rougher one that is there at once, if there is one, and
        returns True where that is enough.

        VertexError or ParameterError for a point that is not on the surface; Cancelled as `progress` raises it.
        """

    def is_at_hand(self, loaded: "LoadedMesh") -> bool:
        """Return whether nothing has to be solved for the answer."""
        return False

    def start(self, field: FloatArray, surface: Surface) -> Source | None:
        """Return the source of the answer's field (n,); VertexError or ParameterError for one not on the surface."""
        return apparent_source(field)


class ByDistance(Question):
    """A question that one distance answers; subclasses have the fields mesh, areas and spec."""

    spec: Spec

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.spec,)

    def with_specs(self: Asked, specs: tuple[Spec, ...]) -> Asked:
        (spec,) = specs
        return replace(self, spec=spec)  # type: ignore[type-var]


@dataclass(frozen=True)
class DistanceQuestion(ByDistance):
    """The distance of every vertex from a source."""

    mesh: MeshFile
    areas: str
    spec: Spec
    at: Source | None
    is_distance = True
    starts_at_point = True

    @property
    def about(self) -> Hashable:
        return (self.mesh, self.areas, self.spec)

    def __str__(self) -> str:
        return str(self.spec)

    def answer(
        self, loaded: "LoadedMesh", progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        source = source_at(self.at, loaded.surface)
        return loaded.distances(self.areas).answer(self.spec, source, progress, at_once)

    def start(self, field: FloatArray, surface: Surface) -> Source | None:
        return source_at(self.at, surface)


@dataclass(frozen=True)
class FieldQuestion(Question):
    """A field of the user's own."""

    mesh: MeshFile
    areas: str
    field: FieldArray
    is_own_field = True

    def __str__(self) -> str:
        return self.field.name

    def answer(
        self, loaded: "LoadedMesh", progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        return loaded.own_field(self.field)


@dataclass(frozen=True)
class SignatureQuestion(Question):
    """A signature of the vertices."""

    mesh: MeshFile
    areas: str
    spec: SignatureSpec

    @property
    def about(self) -> Hashable:
        return (self.mesh, self.areas, self.spec.word)

    def __str__(self) -> str:
        return str(self.spec)

    def answer(
        self, loaded: "LoadedMesh", progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        return signature_answer(self.spec, loaded.distances(self.areas).laplacian, progress)


def signature_answer(spec: SignatureSpec, laplacian: Laplacian, progress: Progress | None = None) -> Answer:
    """Compute a signature; a failure becomes an answer that tells of it, and only Cancelled is raised."""
    try:
        found: Signature = spec.load()(laplacian, **dict(spec.values), progress=progress)
    except Cancelled:
        raise
    except (BihdistError, MemoryError) as error:
        return failed(str(spec), error)
    estimate = ErrorEstimate.of(found.accuracy)
    return Answer(label=found.label, unit=found.unit, field=found.values, error_estimate=estimate)


@dataclass(frozen=True)
class DifferenceQuestion(Question):
    """One answer less another, on the same surface."""

    minuend: Question
    subtrahend: Question
    raw: bool = False

    @property
    def mesh(self) -> MeshFile:  # type: ignore[override]
        """The surface of both fields."""
        return self.minuend.mesh

    @property
    def areas(self) -> str:  # type: ignore[override]
        """The vertex areas of both fields."""
        return self.minuend.areas

    @property
    def parts(self) -> tuple[Question, ...]:
        return (self.minuend, self.subtrahend)

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

    @property
    def others(self) -> tuple[MeshFile, ...]:
        return (*self.minuend.others, *self.subtrahend.others)

    def __str__(self) -> str:
        return f"{self.minuend} - {self.subtrahend}"

    def answer(
        self, loaded: "LoadedMesh", progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        def answered(at_once: Callable[[Answer], object] | None) -> Answer:
            first = self.minuend.answer(loaded, part(progress, 0, 0.5), at_once)
            second = self.subtrahend.answer(loaded, part(progress, 0.5, 1), at_once)
            return difference_of(first, second, self.raw)

        if at_once is not None:
            rough = answered(lambda half: True)
            if rough.is_final or at_once(rough) is True:
                return rough
        return answered(None)

    def start(self, field: FloatArray, surface: Surface) -> Source | None:
        """Return all that the distances start from that it is made of."""
        starts = [each.start(field, surface) for each in self.parts if each.starts_at_point]
        members = tuple(dict.fromkeys(member for start in starts if start is not None for member in members_of(start)))
        return SourceSet(members) if len(members) > 1 else next(iter(members), None)


def are_about_the_same(one: Question, other: Question) -> bool:
    """Return whether they ask for the same on the same surface, perhaps from elsewhere."""
    return one.about == other.about


def are_alike(one: Question, other: Question) -> bool:
    """Return whether they ask for the same, perhaps from elsewhere, or with other values of parameters."""
    kinds = [[spec.distance_type for spec in each.specs] for each in (one, other)]
    return kinds[0] == kinds[1] and are_about_the_same(one.with_specs(other.specs), other)


def asks_of(question: Question, mesh: MeshFile) -> bool:
    """Return whether an answer depends on distances on this surface, too, on which it is not."""
    # Whatever they are called in documents.
    return any(replace(other, name=mesh.name) == mesh for other in question.others)


def questions(document: Document) -> dict[int, Question]:
    """Return the question of each panel, by the panel's id."""
    return {panel.id: question_of(panel.shows, document, panel.surface) for panel in document.panels}


@singledispatch
def question_of(shows: Any, document: Document, surface: str) -> Question:
    """Return the question of a quantity on a surface of a document; tools register theirs (`Tool.questions`)."""
    for tool in tools():
        if type(shows).__module__.startswith(f"{tool.package}."):
            for module in tool.questions:
                tool.load(module)
    registered = question_of.dispatch(type(shows))
    if registered is question_of.dispatch(object):
        raise TypeError(f"No question is registered for {type(shows).__name__}.")
    return registered(shows, document, surface)


@question_of.register
def _(shows: DistanceFrom, document: Document, surface: str) -> Question:
    return DistanceQuestion(document.mesh(surface), document.areas, shows.spec, document.point(shows.point).at)


@question_of.register
def _(shows: OwnField, document: Document, surface: str) -> Question:
    return FieldQuestion(document.mesh(surface), document.areas, document.field(shows.name))


@question_of.register
def _(shows: VertexSignature, document: Document, surface: str) -> Question:
    return SignatureQuestion(document.mesh(surface), document.areas, shows.spec)


@question_of.register
def _(shows: Difference, document: Document, surface: str) -> Question:
    first, second = (question_of(each, document, surface) for each in shows.parts)
    return DifferenceQuestion(first, second, shows.raw)


def source_at(at: Source | None, surface: Surface, up: str = "y") -> Source:
    """Return the source of a point; None stands for the first source, with `up` up.

    VertexError or ParameterError if that is not on this surface.
    """
    if at is None:
        return first_source(surface, up)
    if isinstance(at, int):
        return surface.check_vertex(at)
    pieces_of(at, surface)
    return at


def pieces_at(at: Source | None, surface: Surface) -> Pieces:
    """Return the pieces of a source on a surface; errors as in `source_at`."""
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
    """Return the vertex to start from with an axis up: one of the largest component that is seen, see `first_look`."""
    return first_look(surface, up).source
