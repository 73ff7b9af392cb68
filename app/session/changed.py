"""Surfaces that are made from others: where points of these are on them, and how distances change."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import BihdistError, ParameterError
from bihdist_core.analysis.diagnostics import field_change
from bihdist_core.applications.perturbation import image_of
from bihdist_core.distances.accuracy import Certificate
from bihdist_core.distances.answers import Answer, failed
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source, SourceSet

from ..document.document import Document
from ..document.sourcing import members_of
from .questions import ChangeQuestion, DistanceQuestion, vertex_at

if TYPE_CHECKING:
    from .opened import Opened


def carried(at: Source, opened: "Opened") -> Source:
    """Where a place of the surface that another is made from is on that: its vertices, or the nearest that are left.

    ParameterError for what is not of vertices, VertexError for one that is not there.
    """
    assert opened.origin is not None
    images: dict[int, None] = {}
    for member in members_of(at):
        if not isinstance(member, int):
            raise ParameterError(
                "A source that is followed onto a changed mesh is a vertex or several, as faces and boundaries change."
            )
        images[image_of(opened.origin.surface, opened.ids, member, opened.surface)] = None
    found = tuple(images)
    return found[0] if len(found) == 1 else SourceSet(found)


def led(document: Document, before: Document, opened: "Opened") -> Document:
    """Where a point on a changed surface has been moved there, what it is the image of moves, and it follows.

    Onto what is new there it does not move at all.
    """
    were = {point.name: point for point in before.points}
    for point in document.points:
        was, original = were.get(point.name), were.get(point.image_of)
        is_here = point.surface == opened.mesh.name and point.image_of
        if not is_here or was is None or original not in document.points or point.at in (None, was.at):
            continue
        vertices = [vertex_at(member, opened.surface) for member in members_of(point.at)]
        old = tuple(dict.fromkeys(int(opened.ids[vertex]) for vertex in vertices if opened.ids[vertex] >= 0))
        if old:
            at = old[0] if len(old) == 1 else SourceSet(old)
            points = (replace(p, at=at) if p.name == point.image_of else p for p in document.points)
            document = replace(document, points=tuple(points))
    return document


def change_of(question: ChangeQuestion, opened: "Opened", progress: Progress | None) -> Answer:
    """At the vertices that both surfaces have, each distance as a share of its maximum there; NaN elsewhere."""
    origin, ids = opened.origin, opened.ids
    if origin is None:
        return Answer(label=str(question), failure="This mesh is made from no other, so that no distance changes.")
    try:
        members = members_of(question.at)
        starts = tuple(int(ids[member]) for member in members if isinstance(member, int) and ids[member] >= 0)
        if len(starts) < len(members):
            raise ParameterError("A change is seen from vertices that the mesh had before.")
        start = starts[0] if len(starts) == 1 else SourceSet(starts)
        areas, spec = question.areas, question.spec
        after = opened.answer(DistanceQuestion(opened.mesh, areas, spec, question.at), part(progress, 0, 0.5))
        before = origin.answer(DistanceQuestion(origin.mesh, areas, spec, start), part(progress, 0.5, 1))
        for answer in (before, after):
            if answer.field is None:
                return Answer(label=str(question), failure=answer.failure)
        field, remark = _compared(before.field, after.field, ids)
    except (BihdistError, MemoryError) as error:
        return failed(str(question), error)
    shares = [answer.accuracy.share for answer in (before, after)]
    certificate = Certificate() if None in shares else Certificate.of(sum(share for share in shares if share))
    return Answer(
        label=f"change of {after.label}",
        unit="difference of shares",
        field=field,
        certificate=certificate,
        is_signed=True,
        remark=remark,
    )


def _compared(before: np.ndarray | None, after: np.ndarray | None, ids: np.ndarray) -> tuple[np.ndarray, str]:
    """The field, and its numbers in words.  before: (n,); after: (n',); ids: (n',) of the vertices before, or -1."""
    assert before is not None
    assert after is not None
    old = np.where(ids >= 0, before[np.maximum(ids, 0)], np.nan)
    both = np.isfinite(old) & np.isfinite(after)
    found = field_change(old[both], after[both])
    field = np.full(len(after), np.nan)
    field[both] = after[both] / after[both].max() - old[both] / old[both].max()
    field.flags.writeable = False
    return field, (
        f"mean {found.normalised_mean:.3g}, largest {found.normalised_largest:.3g}, each as a share of its own "
        f"maximum; raw, over the maximum before: {found.mean:.3g}, {found.largest:.3g}"
    )
