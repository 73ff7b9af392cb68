"""The change of a distance on a perturbed mesh: the question, its answer, and the change in numbers."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np

from bihdist_core import BihdistError, Cancelled, ParameterError, SolverError, Surface
from bihdist_core.analysis.diagnostics import field_change
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed, percent, same_on
from bihdist_core.distances.difference import PERCENTAGE_POINTS, difference_in_unit
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source, SourceSet

from ...document.document import Document, MeshFile
from ...document.source_edits import members_of
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import ByDistance, DistanceQuestion, question_of, source_at
from .quantity import DistanceChange

ROUGH_CROSSINGS = 20
"""Zeros in more faces than this many times the root of their number come from noise."""


@dataclass(frozen=True)
class ChangeQuestion(ByDistance):
    """How a distance from a vertex of a perturbed surface differs from what it was before."""

    mesh: MeshFile
    areas: str
    spec: Spec
    at: Source | None
    starts_at_point = True

    @property
    def about(self) -> Hashable:
        """The values that the answer depends on, except the source."""
        return (self.mesh, self.areas, self.spec, "change")

    def __str__(self) -> str:
        return str(DistanceChange(self.spec))

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """Return the difference at the vertices that both surfaces have, each distance as a fraction of its maximum;
        NaN elsewhere."""
        if loaded.origin is None:
            return Answer(
                label=str(self), failure="This mesh was not made from another, so there is no change to show."
            )
        try:
            before, after = _before_and_after(self, loaded, progress)
            for answer in (before, after):
                if answer.field is None:
                    return Answer(label=str(self), failure=answer.failure)
            field, remark = _field_of_change(before.field, after.field, loaded.ids)
        except Cancelled:
            raise
        except (BihdistError, MemoryError) as error:
            return failed(str(self), error)
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

    def start(self, field: FloatArray, surface: Surface) -> Source:
        """Return the point on the perturbed surface."""
        return source_at(self.at, surface)


@question_of.register
def _(shows: DistanceChange, document: Document, surface: str) -> ChangeQuestion:
    return ChangeQuestion(document.mesh(surface), document.areas, shows.spec, document.point(shows.point).at)


def crosses_itself(field: FloatArray, faces: IntArray) -> bool:
    """Return whether the zeros of a field (n,) are everywhere, as noise makes them, and not on a few lines."""
    corners = field[faces]
    crossed = int(((corners.min(axis=1) < 0) & (corners.max(axis=1) > 0)).sum())
    # A line once around a shape crosses a few times the root of the number of faces.
    return bool(crossed > ROUGH_CROSSINGS * np.sqrt(len(faces)))


def _before_and_after(question: ChangeQuestion, loaded: LoadedMesh, progress: Progress | None) -> tuple[Answer, Answer]:
    """Return the answers of one distance from the same vertices, before and after."""
    origin, ids = loaded.origin, loaded.ids
    assert origin is not None
    areas, start = question.areas, question.at
    spec = same_on(question.spec, (origin.distances(areas), loaded.distances(areas)), part(progress, 0, 0.1))
    if not loaded.has_faces_of_origin:
        members = members_of(question.at)
        starts = tuple(int(ids[member]) for member in members if isinstance(member, int) and ids[member] >= 0)
        if len(starts) < len(members):
            raise ParameterError("The source has to be a vertex of the original mesh.")
        start = starts[0] if len(starts) == 1 else SourceSet(starts)
    after = loaded.answer_once(DistanceQuestion(loaded.mesh, areas, spec, question.at), part(progress, 0.1, 0.5))
    before = origin.answer_once(DistanceQuestion(origin.mesh, areas, spec, start), part(progress, 0.5, 1))
    return before, after


@dataclass(frozen=True)
class ChangeNumbers:
    """How far a distance changes at the vertices that both surfaces have: in its unit, and as fractions of the
    maximum.

    For fractions each field is divided by its own maximum first.
    """

    mean: float
    largest: float
    unit: str
    share_mean: float
    share_largest: float


def change_numbers(question: ChangeQuestion, loaded: LoadedMesh, progress: Progress | None = None) -> ChangeNumbers:
    """Return the change in numbers; BihdistError if there are none."""
    if loaded.origin is None:
        raise ParameterError("This mesh was not made from another, so there is no change to show.")
    before, after = _before_and_after(question, loaded, progress)
    for answer in (before, after):
        if answer.field is None:
            raise SolverError(answer.failure)
    old, new = _common_values(before.field, after.field, loaded.ids)
    found, unit = field_change(old, new), float(np.nanmax(old))
    return ChangeNumbers(
        found.mean * unit, found.largest * unit, after.unit, found.normalised_mean, found.normalised_largest
    )


def _common_values(before: AnyArray | None, after: AnyArray | None, ids: IntArray) -> tuple[AnyArray, AnyArray]:
    """Return the fields (k,) at the vertices that both surfaces have, where they are finite."""
    assert before is not None
    assert after is not None
    old = np.where(ids >= 0, before[np.maximum(ids, 0)], np.nan)
    both = np.isfinite(old) & np.isfinite(after)
    return old[both], after[both]


def _field_of_change(before: FloatArray | None, after: FloatArray | None, ids: IntArray) -> tuple[FloatArray, str]:
    """Return the change as a field (n',), and its numbers in words.

    The fields before (n,) and after (n',) meet at the vertices `ids` (n',) of the mesh before, -1 for new ones.
    """
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
