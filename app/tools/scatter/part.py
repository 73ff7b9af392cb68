"""Which panels the chart shows against each other."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ...document.part import Part


@dataclass(frozen=True)
class Scatter(Part):
    """One panel's field against another's, by the panels' ids; the first two panels' if None."""

    key = "scatter"

    across: int | None = None
    up: int | None = None
    shares: bool = True

    def renumbered(self, numbers: Mapping[int, int]) -> "Scatter":
        across, up = (None if id is None else numbers.get(id) for id in (self.across, self.up))
        return replace(self, across=across, up=up)
