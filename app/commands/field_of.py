"""The field of a command: of a distance, or of the difference of two, from a source or from several."""

import argparse
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.document import FieldArray
from ..document.file_names import field_name
from ..document.quantities import OwnField, Quantity, VertexSignature
from .mesh import read_laplacian
from .mesh_sources import first_spec, sources_on
from .options import quantities
from .result import Facts, accuracy_facts
from .terminal import tell_accuracy

if TYPE_CHECKING:
    from bihdist_core import Laplacian, Surface
    from bihdist_core.arrays import FloatArray
    from bihdist_core.distances.answers import Answer


@dataclass(frozen=True, eq=False)
class CommandField:
    """A quantity from the sources of a command: its answer, whose field is (n,) from one source or (n, k) from k, and
    how accurate it is, as it is printed behind a label."""

    laplacian: "Laplacian"
    sources: list[Source]
    shows: Quantity
    answer: "Answer"
    accuracy: str

    @property
    def facts(self) -> Facts:
        """The facts about the field, without its values."""
        about = {"distance": str(self.shows), "label": self.answer.label, "unit": self.answer.unit}
        return {**about, **accuracy_facts(self.answer.accuracy)}

    @property
    def word(self) -> str:
        """The name of the field in letters, digits and `_`."""
        return field_name(self.shows, ()).removesuffix("_percent")

    @property
    def surface(self) -> "Surface":
        """The surface of the field."""
        return self.laplacian.surface

    @property
    def field(self) -> "FloatArray":
        """The values, NaN where there is none."""
        assert self.answer.field is not None
        return self.answer.field


def field_of(
    options: argparse.Namespace,
    words: str | None,
    progress: Progress | None,
    before: CommandField | None = None,
    several: bool = False,
) -> CommandField:
    """Return the field that `words` name, from the sources and with the parameters of the options; None stands for the
    first field of the options, else for the biharmonic distance.

    `before` is another field of the same mesh from the same sources.  Raises ParameterError for several sources unless
    `several` allows them.
    """
    from bihdist_core.distances.answers import Answer, Distances, difference_of
    from bihdist_core.sources.pieces import pieces_of

    from ..session.questions import signature_answer

    fields = {field.name: field for field in options.fields or ()}
    (chosen,) = quantities(options, [words or next(iter(fields), "biharmonic")])
    laplacian = before.laplacian if before else read_laplacian(options)
    distances = Distances(laplacian)
    if before:
        sources = before.sources
    else:
        found = sources_on(options, laplacian.surface, lambda: distances.get(first_spec([chosen]), progress), progress)
        sources = found.sources if several and chosen.points else [found.one()] if chosen.points else found.sources[:1]
    pieces = [pieces_of(each, laplacian.surface) for each in sources]
    answers, accuracies = [], []
    for each in chosen.parts:
        if isinstance(each, OwnField):
            answer = _given(fields[each.name], laplacian.surface)
            answers.append(_repeated(answer, sources) if several else answer)
            continue
        if isinstance(each, VertexSignature):
            answer = signature_answer(each.spec, laplacian, progress)
            accuracies.append(f", {answer.accuracy.text}" if answer.accuracy.text else "")
            answers.append(_repeated(answer, sources) if several else answer)
            continue
        (spec,) = each.specs
        distance = distances.get(spec, progress)
        field = distance.from_sources(sources, progress) if several else distance.from_source(sources[0], progress)
        estimate = distance.error_estimate(pieces=pieces)
        label = " or ".join(dict.fromkeys(distance.label_from(each) for each in pieces))
        answers.append(Answer(label=label, unit=distance.unit, field=field, error_estimate=estimate, is_distance=True))
        accuracies.append(tell_accuracy(distance, estimate))
    answer = answers[0]
    if chosen.is_difference:
        answer = difference_of(answers[0], answers[1], raw=not chosen.in_percent)
    if answer.failure:
        raise ParameterError(answer.failure)
    check_values(answer)
    return CommandField(laplacian, sources, chosen, answer, "".join(dict.fromkeys(accuracies)))


def _repeated(answer: "Answer", sources: list[Source]) -> "Answer":
    """Return an answer that is the same from every source, as (n, k)."""
    import numpy as np

    field = answer.field
    return answer if field is None else replace(answer, field=np.repeat(field[:, None], len(sources), axis=1))


def check_values(*answers: "Answer") -> None:
    """Raise ParameterError for an answer that is shown in colours, and has no values."""
    for answer in answers:
        if answer.colours is not None:
            raise ParameterError(f"{answer.label} has labels, and no values.")


def _given(field: FieldArray, surface: "Surface") -> "Answer":
    """Return a field of the options; ParameterError unless it has a value for each vertex of the surface."""
    from ..session.array_store import ArrayStore

    store = ArrayStore()
    return store.answer(store.add_file(field), surface)
