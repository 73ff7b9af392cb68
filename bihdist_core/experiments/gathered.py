"""Numbers gathered source by source, or start by start, for the parts of statements."""

from collections.abc import Mapping

from .result import Claim
from .statements import STATEMENTS
from .verdicts import BySource, Numbers


class Gathered:
    """Numbers by the names of statements' parts, of pictured and of random sources."""

    def __init__(self) -> None:
        self._pictured: dict[str, list[float]] = {}
        self._random: dict[str, list[float]] = {}

    def add(self, part: str, number: float, is_pictured: bool) -> None:
        """Add a number to the part of a statement, or to parts of several statements, with that name."""
        (self._pictured if is_pictured else self._random).setdefault(part, []).append(float(number))

    def numbers(self, name: str) -> BySource | None:
        """What was gathered under a name; None if nothing was."""
        if name not in self._pictured and name not in self._random:
            return None
        return BySource(tuple(self._pictured.get(name, ())), tuple(self._random.get(name, ())))

    def claim(self, id: str, note: str = "", more: Mapping[str, Numbers] | None = None, failure: str = "") -> Claim:
        """The claim of a statement with what was gathered of its parts; `more`: numbers of other parts.

        failure: why some, or all, are not there.
        """
        numbers: dict[str, Numbers] = dict(more or {})
        for name in STATEMENTS[id].names:
            found = self.numbers(name)
            if found is not None:
                numbers[name] = found
        return Claim(id, numbers, note, failure=failure)
