"""How the dock lists pins, as a part of the document."""

from dataclasses import dataclass

from bihdist_core.distances.kinds import Spec

from ...document.part import Part


@dataclass(frozen=True)
class PinsListing(Part):
    """How pins are listed.

    distance: whose distances among them, the first panel's if None.  shares: of the maxima instead of values.
    positions: whether their coordinates are listed.
    """

    key = "pin_list"

    distance: Spec | None = None
    shares: bool = False
    positions: bool = False
