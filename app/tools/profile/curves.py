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
    """A field along the path.

    values: (k,) at its points, NaN where it has none, in `unit`; colour: as #rrggbb.  whole: what a share of 1 is.
    is_share: the values are percentage points, as a difference's may be.  is_dashed: the colour is another curve's.
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
        """(k,) the values as shares of the greatest."""
        return self.values / 100 if self.is_share else self.values / self.whole if self.whole > 0 else 0 * self.values


def profile_curve(
    document: Document, panel: int, answer: Answer, values: FloatArray, colours: Sequence[str]
) -> ProfileCurve:
    """values: (k,) of the answer's field at the points of the path.  colours: for the panels, in the document's order.

    panel: its id.
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
    """What goes into one chart each: a unit, whether shares are drawn, and the curves."""
    found: dict[tuple[str, bool], list[ProfileCurve]] = {}
    for curve in curves:
        are_shares = in_shares or curve.is_share
        found.setdefault(("" if are_shares else curve.unit, are_shares), []).append(curve)
    return [(*key, some) for key, some in found.items()]
