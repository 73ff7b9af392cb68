"""Surfaces that are made from others: where points of these are on them, and how distances change."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import BihdistError, Cancelled, ParameterError, SolverError
from bihdist_core.analysis.diagnostics import field_change
from bihdist_core.applications.perturbation import image_of
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed, percent, same_on
from bihdist_core.distances.difference import PERCENTAGE_POINTS, difference_in_unit
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source, SourceSet

from ..document.document import Document
from ..document.sourcing import members_of
from .questions import ChangeQuestion, DistanceQuestion, Question, questions, source_at, vertex_at

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh

ROUGH = 20
"""Zeros in more faces than so many times the root of their number are those of noise."""


def carried(at: Source, loaded: "LoadedMesh") -> Source:
    """Where a place of the surface that another is made from is on that: its vertices, or the nearest that are left.

    ParameterError for what is not of vertices, VertexError for one that is not there.
    """
    assert loaded.origin is not None
    if loaded.has_faces_of_origin:
        source_at(at, loaded.surface)
        return at
    images: dict[int, None] = {}
    for member in members_of(at):
        if not isinstance(member, int):
            raise ParameterError(
                "A source that is followed onto a mesh with other faces is a vertex or several, not a place or a curve."
            )
        images[image_of(loaded.origin.surface, loaded.ids, member, loaded.surface)] = None
    found = tuple(images)
    return found[0] if len(found) == 1 else SourceSet(found)


def counterpart(vertex: int | None, here: "LoadedMesh | None", there: "LoadedMesh | None") -> int | None:
    """The vertex of another surface that one of this is, where one is made from the other; None if there is none."""
    if vertex is None or here is None or there is None:
        return None
    if there.origin is here:
        found = np.flatnonzero(there.ids == vertex)
        return int(found[0]) if len(found) else None
    if here.origin is there and here.ids[vertex] >= 0:
        return int(here.ids[vertex])
    return None


def led(document: Document, before: Document, loaded: "LoadedMesh") -> Document:
    """Where a point on a changed surface has been moved there, what it is the image of moves, and it follows.

    Onto what is new there it does not move at all.
    """
    were = {point.name: point for point in before.points}
    for point in document.points:
        was, original = were.get(point.name), were.get(point.image_of)
        is_here = point.surface == loaded.mesh.name and point.image_of
        if not is_here or was is None or original not in document.points or point.at in (None, was.at):
            continue
        at: Source | None = point.at
        if not loaded.has_faces_of_origin:
            vertices = [vertex_at(member, loaded.surface) for member in members_of(point.at)]
            old = tuple(dict.fromkeys(int(loaded.ids[vertex]) for vertex in vertices if loaded.ids[vertex] >= 0))
            at = None if not old else old[0] if len(old) == 1 else SourceSet(old)
        if at is not None:
            points = (replace(p, at=at) if p.name == point.image_of else p for p in document.points)
            document = replace(document, points=tuple(points))
    return document


def answers_ahead(
    document: Document, found: Sequence["LoadedMesh"], there: Sequence["LoadedMesh"], progress: Progress
) -> Iterator[tuple[Question, Answer]]:
    """What a document asks of surfaces that are not shown yet: so none is ever seen without its fields.

    found: these; there: those that are.
    """
    by_name = {}
    for mesh in document.surfaces:
        matching = [loaded for loaded in (*found, *there) if loaded.is_of(mesh)]
        if matching:
            by_name[mesh.name] = matching[0]
            document = matching[0].settled(document)
    surfaces = {panel.id: by_name.get(panel.surface) for panel in document.panels}
    asked = [(question, surfaces[id]) for id, question in questions(document).items()]
    new = [(question, loaded) for question, loaded in asked if loaded is not None and loaded in found]
    for k, (question, loaded) in enumerate(new):
        yield question, loaded.answer_once(question, part(progress, k / len(new), (k + 1) / len(new)))


def change_of(question: ChangeQuestion, loaded: "LoadedMesh", progress: Progress | None) -> Answer:
    """At the vertices that both surfaces have, each distance as a fraction of its maximum there; NaN elsewhere."""
    ids = loaded.ids
    if loaded.origin is None:
        return Answer(label=str(question), failure="This mesh is made from no other, so that no distance changes.")
    try:
        before, after = _sides(question, loaded, progress)
        for answer in (before, after):
            if answer.field is None:
                return Answer(label=str(question), failure=answer.failure)
        field, remark = _compared(before.field, after.field, ids)
    except Cancelled:
        raise
    except (BihdistError, MemoryError) as error:
        return failed(str(question), error)
    name = after.label.partition(",")[0]
    return Answer(
        label=f"change of {after.label}",
        unit=PERCENTAGE_POINTS,
        field=field,
        error_estimate=ErrorEstimate.of_difference(before.accuracy, after.accuracy),
        is_signed=True,
        signs=(f"{name} is farther after", f"{name} is nearer after"),
        is_rough=crosses_itself(field, loaded.surface.faces),
        remark=remark,
    )


def crosses_itself(field: np.ndarray, faces: np.ndarray) -> bool:
    """Whether the zeros of a field (n,) are no line but everywhere, as in what noise does to a distance."""
    corners = field[faces]
    crossed = int(((corners.min(axis=1) < 0) & (corners.max(axis=1) > 0)).sum())
    # A line once around a shape crosses a few times the root of the number of faces.
    return crossed > ROUGH * np.sqrt(len(faces))


def _sides(question: ChangeQuestion, loaded: "LoadedMesh", progress: Progress | None) -> tuple[Answer, Answer]:
    """Of the same distance, from the same vertices, before and after."""
    origin, ids = loaded.origin, loaded.ids
    assert origin is not None
    areas, start = question.areas, question.at
    spec = same_on(question.spec, (origin.distances(areas), loaded.distances(areas)), part(progress, 0, 0.1))
    if not loaded.has_faces_of_origin:
        members = members_of(question.at)
        starts = tuple(int(ids[member]) for member in members if isinstance(member, int) and ids[member] >= 0)
        if len(starts) < len(members):
            raise ParameterError("A change is seen from vertices that the mesh had before.")
        start = starts[0] if len(starts) == 1 else SourceSet(starts)
    after = loaded.answer_once(DistanceQuestion(loaded.mesh, areas, spec, question.at), part(progress, 0.1, 0.5))
    before = origin.answer_once(DistanceQuestion(origin.mesh, areas, spec, start), part(progress, 0.5, 1))
    return before, after


@dataclass(frozen=True)
class ChangeNumbers:
    """How far a distance changes at the vertices that both surfaces have: in its unit, and as fractions of the maximum.

    For shares each field is divided by its own maximum first.
    """

    mean: float
    largest: float
    unit: str
    share_mean: float
    share_largest: float


def change_numbers(question: ChangeQuestion, loaded: "LoadedMesh", progress: Progress | None = None) -> ChangeNumbers:
    """In numbers; BihdistError where there are none."""
    if loaded.origin is None:
        raise ParameterError("This mesh is made from no other, so that no distance changes.")
    before, after = _sides(question, loaded, progress)
    for answer in (before, after):
        if answer.field is None:
            raise SolverError(answer.failure)
    old, new = _common(before.field, after.field, loaded.ids)
    found, unit = field_change(old, new), float(np.nanmax(old))
    return ChangeNumbers(
        found.mean * unit, found.largest * unit, after.unit, found.normalised_mean, found.normalised_largest
    )


def _common(before: np.ndarray | None, after: np.ndarray | None, ids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k,) each: the fields at the vertices that both surfaces have, where they are finite."""
    assert before is not None
    assert after is not None
    old = np.where(ids >= 0, before[np.maximum(ids, 0)], np.nan)
    both = np.isfinite(old) & np.isfinite(after)
    return old[both], after[both]


def _compared(before: np.ndarray | None, after: np.ndarray | None, ids: np.ndarray) -> tuple[np.ndarray, str]:
    """The field, and its numbers in words.  before: (n,); after: (n',); ids: (n',) of the vertices before, or -1."""
    assert before is not None
    assert after is not None
    old = np.where(ids >= 0, before[np.maximum(ids, 0)], np.nan)
    both = np.isfinite(old) & np.isfinite(after)
    found = field_change(old[both], after[both])
    field = np.full(len(after), np.nan)
    field[both], _ = difference_in_unit(after[both], old[both])
    field.flags.writeable = False
    return field, (
        f"mean {percent(found.normalised_mean)}, largest {percent(found.normalised_largest)}, each of its own "
        f"maximum; of the maximum before: mean {percent(found.mean)}, largest {percent(found.largest)}"
    )
