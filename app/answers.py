"""What became of a question: a field with its words, or the sentence why there is none."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bihdist_core import BihdistError, Cancelled, Distance, VertexError
from bihdist_core.distances.accuracy import Certificate
from bihdist_core.progress import Progress, part

NO_CERTIFICATE = Certificate()


@dataclass(frozen=True, eq=False, kw_only=True)
class Answer:
    """A field (n,) with NaN where undefined, or None and the failure in words.

    label and unit: the distance's; certificate: how accurate the field is.
    """

    label: str
    unit: str = ""
    field: np.ndarray | None = None
    failure: str = ""
    certificate: Certificate = NO_CERTIFICATE

    @property
    def maximum(self) -> float:
        return 0.0 if self.field is None else float(np.nanmax(self.field, initial=0.0))


def failure_in_words(error: Exception) -> str:
    """A sentence for the user."""
    if isinstance(error, BihdistError):
        return str(error)
    if isinstance(error, MemoryError):
        return "There is not enough memory for this mesh."
    return f"Something went wrong that should not have: {type(error).__name__}: {error}"


class Asked:
    """One distance for as many questions as there are: made when first asked, certified after its first answer.

    make(progress) gives the distance; word: what it is called where it cannot be made.  What cannot be done becomes an
    answer that says so, on the component it fails on; Cancelled and VertexError are raised as they are.
    """

    def __init__(self, make: Callable[[Progress], Distance], word: str) -> None:
        self._make, self._word = make, word
        self._distance: Distance | None = None
        self._failures: dict[int | None, str] = {}

    def answer(self, source: int, progress: Progress | None = None) -> Answer:
        component = None if self._distance is None else self._distance.laplacian.component_of(source).index
        try:
            if self._distance is None and None not in self._failures:
                self._distance = self._make(part(progress, 0, 0.9))
                component = self._distance.laplacian.component_of(source).index
            if component not in self._failures:
                return answered(self._distance, source, component, part(progress, 0.9, 1))
        except (Cancelled, VertexError):
            raise
        except (BihdistError, MemoryError) as error:
            # The same for every source of the component: what fails is the distance.
            self._failures[component] = failure_in_words(error)
        return Answer(label=self._word, failure=self._failures[component])


def answered(distance: Distance, source: int, component: int, progress: Progress | None) -> Answer:
    """A field with its certificate on the component of its source."""
    field = distance.from_source(source, progress)
    return Answer(label=distance.label, unit=distance.unit, field=field, certificate=distance.certificate([component]))
