"""Answers to questions: the distances of a Laplacian, each built once for whoever asks.

The window, figures, movies, the command line and the experiments all ask here, so that they agree about what is
computed, how accurate it is, and what is said where it cannot be done.
"""

import threading
from collections.abc import Callable, Collection, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import BihdistError, Cancelled, ParameterError, VertexError
from ..laplacian import Laplacian
from ..machine_memory import MEMORY_ADVICE
from ..progress import Progress, part, silent, turn
from ..sources.pieces import Pieces, pieces_of
from ..sources.source import Source
from ..unexpected import note_unexpected, unexpected_words
from .accuracy import ErrorEstimate
from .difference import PERCENTAGE_POINTS, difference_in_unit, scale_of
from .distance import Distance
from .distance_types import Spec
from .source_questions import OtherSource

if TYPE_CHECKING:
    from ..formats.vertex_arrays import VertexArray


@dataclass(frozen=True, eq=False, kw_only=True)
class Answer:
    """A field (n,) with NaN where undefined, or None and the failure in words.

    The label and the unit are the distance's; the error estimate is None as long as it is not known. A field that is
    signed has values on both sides of 0, as differences have; its maximum is the largest absolute value. `is_distance`
    is True if it says how far vertices are. `signs` say what a positive and a negative value of a difference mean, such
    as "biharmonic is farther". `is_rough` is True for noise, which isolines would only cover. `remark` is what else is
    to be said of it. `colours` (n, 3) are red, green and blue from 0 to 1, NaN where there is none, shown instead of a
    field; `leads_to` (n,) are the vertices of another surface that they stand for, -1 for none; `labels` are the labels
    that they stand for.
    """

    label: str
    unit: str = ""
    field: FloatArray | None = None
    failure: str = ""
    error_estimate: ErrorEstimate | None = None
    is_signed: bool = False
    is_distance: bool = False
    signs: tuple[str, str] | None = None
    is_rough: bool = False
    remark: str = ""
    colours: FloatArray | None = None
    leads_to: IntArray | None = None
    labels: "VertexArray | None" = None

    @property
    def maximum(self) -> float:
        """Largest value of the field, in absolute value if it is signed; 0 without a field."""
        if self.field is None:
            return 0.0
        return float(np.nanmax(np.abs(self.field) if self.is_signed else self.field, initial=0.0))

    @property
    def largest(self) -> int | None:
        """The vertex with the largest absolute value, of a signed field."""
        if self.field is None or not self.is_signed or self.maximum == 0:
            return None
        return int(np.nanargmax(np.abs(self.field)))

    @property
    def scale(self) -> float:
        """The factor from fractions of a maximum to the field's unit: 100 for percentage points."""
        return scale_of(self.unit)

    @property
    def largest_words(self) -> str:
        """The largest difference, "largest +14.2 % at vertex 0: biharmonic is farther"; "" of a single field."""
        if self.field is None or self.signs is None or self.largest is None:
            return ""
        value = float(self.field[self.largest])
        unit = " %" if self.unit == PERCENTAGE_POINTS else with_unit(self.unit)
        size = f"{'−' if value < 0 else '+'}{plain(abs(value))}{unit}"
        return f"largest {size} at vertex {self.largest}: {self.signs[value < 0]}"

    @property
    def is_final(self) -> bool:
        """True if nothing more is to come: it failed, or its accuracy is known."""
        return bool(self.failure) or self.error_estimate is not None

    @property
    def accuracy(self) -> ErrorEstimate:
        """The certificate, or an empty one."""
        return self.error_estimate or ErrorEstimate()


def difference_of(minuend: Answer, subtrahend: Answer, raw: bool = False) -> Answer:
    """Return the difference of two answers (`difference`); a failure of either is its failure.

    One without a unit, which is no distance, is taken to be in the unit of the other.
    """
    label = f"{minuend.label} − {subtrahend.label}"
    if minuend.field is None or subtrahend.field is None:
        both = (minuend, subtrahend)
        failures = dict.fromkeys(
            answer.failure or f"{answer.label} is shown in colours, and has no values to subtract."
            for answer in both
            if answer.field is None
        )
        return Answer(label=label, failure=" ".join(failures))
    try:
        field, unit = difference_in_unit(minuend.field, subtrahend.field, (minuend.unit, subtrahend.unit), raw)
    except ParameterError as error:
        return failed(label, error)
    field.flags.writeable = False
    error_estimate = None
    if minuend.error_estimate is not None and subtrahend.error_estimate is not None:
        error_estimate = ErrorEstimate.of_difference(minuend.error_estimate, subtrahend.error_estimate)
    return Answer(
        label=label,
        unit=unit,
        field=field,
        error_estimate=error_estimate,
        is_signed=True,
        is_rough=minuend.is_rough or subtrahend.is_rough,
        signs=_signs(minuend, subtrahend),
    )


def _signs(minuend: Answer, subtrahend: Answer) -> tuple[str, str]:
    """Names of two distances that differ, each with what it is where it is the larger."""
    larger = "farther" if minuend.is_distance and subtrahend.is_distance else "larger"
    labels = (minuend.label, subtrahend.label)
    names = [label.partition(",")[0] for label in labels]
    if names[0] == names[1]:
        names = list(labels) if labels[0] != labels[1] else ["the first", "the second"]  # from other points
    first, second = names
    return f"{first} is {larger}", f"{second} is {larger}"


def plain(value: float) -> str:
    """Return three digits without a power of ten, unless that would be long."""
    return f"{value:.3g}" if not 999.5 <= abs(value) < 1e7 else f"{value:,.0f}"


def percent(fraction: float) -> str:
    """Return "14.2 %"."""
    return f"{plain(100 * fraction)} %"


def with_unit(unit: str) -> str:
    """Return the text that follows a value in a unit."""
    return unit.removeprefix("1") if unit.startswith("1 /") else f" {unit}" if unit else ""


SIGNED = 0.01
"""The share of the largest value from which on values below 0 are no rounding: those of thicknesses are."""
ROUGH = 5.0
"""Of the length of a line once around the shape, the mean length of an isoline from which on isolines cover a field.
Distances have 2, cortical thickness and curvature 7 to 17."""


def given_answer(name: str, field: FloatArray, faces: IntArray, labels: "VertexArray | None" = None) -> Answer:
    """Return the answer of a field (n,) that somebody else has computed, under its name; labels have no values."""
    answer = Answer(label=name, error_estimate=ErrorEstimate())
    if labels is not None:
        return replace(answer, colours=labels.vertex_colours, labels=labels)
    low, high = float(np.nanmin(field, initial=0.0)), float(np.nanmax(field, initial=0.0))
    across = np.nansum(np.ptp(field[faces], axis=1)) / (high - low) if high > low else 0.0
    is_rough = bool(across > ROUGH * np.sqrt(len(faces)))
    return replace(answer, field=field, is_signed=low < -SIGNED * high, is_rough=is_rough)


def failed(label: str, error: Exception) -> Answer:
    """Return an answer that says why there is no field."""
    return Answer(label=label, failure=failure_in_words(error))


def failure_in_words(error: Exception) -> str:
    """Return a sentence for the user; an error that nothing foresaw is noted, too."""
    if isinstance(error, BihdistError):
        return str(error)
    if isinstance(error, MemoryError):
        return f"There is not enough memory for this mesh; {MEMORY_ADVICE}"
    note_unexpected(error)
    return unexpected_words(error)


def same_on(spec: Spec, surfaces: "Sequence[Distances]", progress: Progress | None = None) -> Spec:
    """Return the spec that can be compared between surfaces: where "auto" takes one method here and another there, the
    method that all of them have, so that they differ by their shapes and not by their methods."""
    free = [name for name, value in spec.values if value == "auto"]
    taken = [tuple(getattr(each.get(spec, progress), name) for name in free) for each in surfaces]
    if len(set(taken)) < 2:
        return spec
    # "auto" is exact wherever it can be.
    chosen = next(each for each in taken if "exact" not in each)
    return Spec.of(spec.word, **{**dict(spec.values), **dict(zip(free, chosen, strict=True))})


class Distances:
    """The distances of one Laplacian, made when first asked for, by any number of threads."""

    def __init__(self, laplacian: Laplacian) -> None:
        self.laplacian = laplacian
        self._known: dict[Spec, Distance] = {}
        self._unbuilt: dict[Spec, BihdistError] = {}
        self._failures: dict[tuple[Spec, tuple[int, ...], str], str] = {}
        self._turns: dict[Spec, threading.Lock] = {}
        self._lock = threading.Lock()

    def get(self, spec: Spec, progress: Progress | None = None) -> Distance:
        """Return the distance, ready to be asked on the largest component; whoever asks meanwhile waits for it.

        BihdistError if it cannot be had, at once where that is known.
        """
        with self._turn(spec, progress):
            with self._lock:
                distance = self._known.pop(spec, None)
                failure = self._unbuilt.get(spec)
            if failure is not None:
                raise type(failure)(str(failure))
            if distance is None:
                distance = self._built(spec, progress)
            with self._lock:
                # Asked for last stands last, see `keep`.
                self._known[spec] = distance
        return distance

    def _built(self, spec: Spec, progress: Progress | None) -> Distance:
        try:
            return spec.build(self.laplacian, progress)
        except Cancelled:
            raise
        except BihdistError as error:
            # It would be the same again, after as long; but memory may be free by then.
            if not isinstance(error, MemoryError):
                # A copy: the traceback of the error itself refers to this object.
                self._unbuilt[spec] = type(error)(str(error))
            raise

    def is_ready(self, spec: Spec) -> bool:
        """Return whether it has been built already."""
        with self._lock:
            return spec in self._known

    def meanwhile(self, spec: Spec) -> Spec | None:
        """Return a coarse distance that is there at once, where this one has still to be made, or None."""
        coarse = None if self.is_ready(spec) else spec.meanwhile(self.laplacian)
        if coarse is None:
            return None
        with self._lock:
            self._known[spec.as_coarse] = coarse
        return spec.as_coarse

    def preview(self, spec: Spec, progress: Progress | None = None) -> Spec | None:
        """Return a distance that is quick and resembles this one, or None if it is quick itself."""
        return spec.quick(self.get(spec, progress))

    def answer(
        self,
        spec: Spec,
        source: Source,
        progress: Progress | None = None,
        at_once: Callable[[Answer], object] | None = None,
    ) -> Answer:
        """Compute the field from a source, with its error estimate on the components that the source is on.

        Failures become an answer that tells of them; only Cancelled is raised, and VertexError or ParameterError for a
        source that is not on this surface. `at_once` is called with the answer without its error estimate where that
        has still to be made; if it returns True, the estimate is left out.
        """
        pieces: Pieces | None = None
        components, what = [], "vertices"
        if isinstance(source, OtherSource):
            pieces = pieces_of(source, self.laplacian.surface)
            components = np.unique(self.laplacian.surface.component_of_vertex[pieces.corners[:, 0]]).tolist()
            what = "vertices" if pieces.vertices is not None else "lines" if pieces.along.any() else "places"
        else:
            components = [self.laplacian.component_of(source).index]
        key = (spec, tuple(components), what)
        if known_failure := self._failures.get(key):
            return Answer(label=str(spec), failure=known_failure)
        try:
            distance = self.get(spec, part(progress, 0, 0.8))
            with self._turn(spec, progress):
                for index in components:
                    distance.prepare(self.laplacian.components[index], part(progress, 0.8, 0.9))
            if pieces is None:
                field, label = distance.from_source(source, part(progress, 0.9, 1)), distance.label
            else:
                field, label = distance.from_pieces(pieces, part(progress, 0.9, 1)), distance.label_from(pieces)
            field.flags.writeable = False
            answer = Answer(label=label, unit=distance.unit, field=field, is_distance=True)
            if pieces is None and distance.is_measured_for_each_source:
                pieces = pieces_of(source, self.laplacian.surface)
            starts = [] if pieces is None else [pieces]
            if at_once is not None and not all(distance.has_error_estimate(index, starts) for index in components):
                if at_once(answer) is True:
                    return answer
                # Whoever has a newer question need not wait for the certificate of this one.
                (progress or silent)(1.0, distance.label)
            estimate = distance.error_estimate(components, part(progress, 1, 1), starts)
            label = f"{answer.label}, {estimate.short}" if estimate.short else answer.label
            return replace(answer, label=label, error_estimate=estimate)
        except (Cancelled, VertexError):
            raise
        except MemoryError as error:
            return failed(str(spec), error)
        except BihdistError as error:
            # The same for every such source of the components: what fails is the distance.
            self._failures[key] = str(error)
            return failed(str(spec), error)

    def keep(self, wanted: Collection[Spec]) -> None:
        """Forget all but what is wanted, its stand-ins, and the last of each word: a slider leaves one at every step.

        What is expensive about most of them, the factor and the eigenpairs, stays with the Laplacian.
        """
        with self._lock:
            quick = {spec.quick(self._known[spec]) for spec in wanted if spec in self._known}
            wanted = {*wanted, *(spec for spec in quick if spec is not None)}
            last = {spec.word: spec for spec in self._known if spec not in wanted}
            spared = {*wanted, *last.values()}
            self._known = {spec: distance for spec, distance in self._known.items() if spec in spared}

    def _turn(self, spec: Spec, progress: Progress | None) -> AbstractContextManager[None]:
        """Nobody else builds or prepares this distance meanwhile."""
        with self._lock:
            lock = self._turns.setdefault(spec, threading.Lock())
        return turn(lock, progress, f"waiting for {spec}")
