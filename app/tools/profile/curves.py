"""The curves of a profile: the fields of panels along its path, as the chart in the window and figures draw them."""

from collections.abc import Sequence
from dataclasses import dataclass

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.difference import PERCENTAGE_POINTS

from ...document.document import Document
from ...document.quantities import quantity_name


@dataclass(frozen=True, eq=False)
class ProfileCurve:
    """A field along the path, with values (k,) at its points in `unit`, NaN where it has none, and a colour #rrggbb.

    `whole` is the value that fractions are of. With `is_share` the values are percentage points, as a difference's
    may be; with `is_dashed` another curve has the same colour.
    """

    name: str
    colour: str
    values: FloatArray
    whole: float
    unit: str = ""
    is_signed: bool = False
    is_share: bool = False
    is_dashed: bool = False

    @property
    def shares(self) -> FloatArray:
        """The values (k,) as fractions of the greatest."""
        return self.values / 100 if self.is_share else self.values / self.whole if self.whole > 0 else 0 * self.values


def profile_curve(
    document: Document, panel: int, answer: Answer, values: FloatArray, colours: Sequence[str]
) -> ProfileCurve:
    """Return the curve of a panel, by its id, with the values (k,) of its field along the path.

    The colours are those of panels in the document's order.
    """
    place = next(k for k, each in enumerate(document.panels) if each.id == panel)
    shows = document.panels[place].shows
    return ProfileCurve(
        quantity_name(shows),
        colours[place % len(colours)],
        values,
        answer.maximum,
        answer.unit,
        answer.is_signed,
        answer.unit == PERCENTAGE_POINTS,
        place >= len(colours),
    )


def parted(curves: Sequence[ProfileCurve], in_shares: bool) -> list[tuple[str, bool, list[ProfileCurve]]]:
    """Return the curves of each chart, with its unit and whether fractions are drawn."""
    found: dict[tuple[str, bool], list[ProfileCurve]] = {}
    for curve in curves:
        are_shares = in_shares or curve.is_share
        found.setdefault(("" if are_shares else curve.unit, are_shares), []).append(curve)
    return [(*key, some) for key, some in found.items()]
