"""The field of a command: of a distance, or of the difference of two, from a source or from several."""

import argparse
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..document.quantities import Quantity
from .mesh import read_laplacian
from .mesh_sources import sources_on
from .options import quantities
from .result import Facts, accuracy_facts
from .terminal import accuracy

if TYPE_CHECKING:
    from bihdist_core import Laplacian, Surface
    from bihdist_core.arrays import FloatArray
    from bihdist_core.distances.accuracy import ErrorEstimate
    from bihdist_core.progress import Progress
    from bihdist_core.sources.source import Source


@dataclass(frozen=True, eq=False)
class FieldOf:
    """field: (n,) from one source, or (n, k) from as many as there are, NaN where there is none; estimate: how accurate
    it is, in words, and error_estimate, of a difference that of both."""

    laplacian: "Laplacian"
    sources: "list[Source]"
    shows: Quantity
    field: "FloatArray"
    label: str
    unit: str
    estimate: str
    error_estimate: "ErrorEstimate"

    @property
    def facts(self) -> Facts:
        """What is said of it beside its values."""
        about = {"distance": str(self.shows), "label": self.label, "unit": self.unit}
        return {**about, **accuracy_facts(self.error_estimate)}

    @property
    def word(self) -> str:
        """Its name in letters, digits and `_`."""
        return "_minus_".join(spec.word for spec in self.shows.specs)

    @property
    def is_signed(self) -> bool:
        """Whether it has values on both sides of 0."""
        return self.shows.is_difference

    @property
    def surface(self) -> "Surface":
        """The surface that the field is on."""
        return self.laplacian.surface

    @property
    def scale(self) -> float:
        """What fractions of a maximum are multiplied by to be in its unit."""
        from bihdist_core.distances.difference import scale_of

        return scale_of(self.unit)

    @property
    def top(self) -> float:
        """The maximum of its size."""
        import numpy as np

        return float(np.nanmax(np.abs(self.field)))


def field_of(
    options: argparse.Namespace,
    words: str,
    progress: "Progress | None",
    before: FieldOf | None = None,
    several: bool = False,
) -> FieldOf:
    """What `words` say, from the sources that the options name, with the options beside them.

    before: another field of the same mesh from the same sources.  several: whether there may be several of them, a
    column each; ParameterError for several where there may not.
    """
    from bihdist_core.distances.accuracy import ErrorEstimate
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.difference import difference_in_unit
    from bihdist_core.sources.pieces import pieces_of

    (chosen,) = quantities(options, [words])
    laplacian = before.laplacian if before else read_laplacian(options)
    distances = Distances(laplacian)
    if before:
        sources = before.sources
    else:
        found = sources_on(options, laplacian.surface, lambda: distances.get(chosen.specs[0], progress), progress)
        sources = found.sources if several else [found.one()]
    pieces = [pieces_of(each, laplacian.surface) for each in sources]
    known = [distances.get(spec, progress) for spec in chosen.specs]
    if several:
        fields = [distance.from_sources(sources, progress) for distance in known]
    else:
        fields = [distance.from_source(sources[0], progress) for distance in known]
    unit, field = known[0].unit, fields[0]
    if chosen.is_difference:
        field, unit = difference_in_unit(fields[0], fields[1], (known[0].unit, known[1].unit), not chosen.in_percent)
    labels = [" or ".join(dict.fromkeys(distance.label_from(each) for each in pieces)) for distance in known]
    estimate = "".join(dict.fromkeys(accuracy(distance) for distance in known))
    estimates = [distance.error_estimate() for distance in known]
    combined = estimates[0] if len(estimates) == 1 else ErrorEstimate.of_difference(estimates[0], estimates[1])
    return FieldOf(laplacian, sources, chosen, field, " − ".join(labels), unit, estimate, combined)
