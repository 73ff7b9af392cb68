"""One field for a command: of a distance, or of the difference of two, from a source."""

import argparse
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .mesh import read_laplacian
from .options import quantities
from .terminal import accuracy

if TYPE_CHECKING:
    from bihdist_core import Laplacian, Surface
    from bihdist_core.arrays import FloatArray
    from bihdist_core.progress import Progress


@dataclass(frozen=True, eq=False)
class FieldOf:
    """field: (n,), NaN where there is none; word: of letters, digits and `_`; estimate: how accurate it is, in words.

    is_signed: it has values on both sides of 0.
    """

    laplacian: "Laplacian"
    field: "FloatArray"
    label: str
    word: str
    unit: str
    estimate: str
    is_signed: bool

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
    options: argparse.Namespace, words: str, progress: "Progress | None", laplacian: "Laplacian | None" = None
) -> FieldOf:
    """What `words` say, from the source, with the options beside them; laplacian: of the mesh if it is there."""
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.difference import difference_in_unit
    from bihdist_core.sources.pieces import pieces_of

    (chosen,) = quantities(options, [words])
    laplacian = read_laplacian(options) if laplacian is None else laplacian
    pieces, distances = pieces_of(options.source, laplacian.surface), Distances(laplacian)
    known = [distances.get(spec, progress) for spec in chosen.specs]
    fields = [distance.from_source(options.source, progress) for distance in known]
    unit, field = known[0].unit, fields[0]
    if chosen.is_difference:
        field, unit = difference_in_unit(fields[0], fields[1], (known[0].unit, known[1].unit), not chosen.in_percent)
    return FieldOf(
        laplacian,
        field,
        " − ".join(distance.label_from(pieces) for distance in known),
        "_minus_".join(spec.word for spec in chosen.specs),
        unit,
        "".join(dict.fromkeys(accuracy(distance) for distance in known)),
        chosen.is_difference,
    )
