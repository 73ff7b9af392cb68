"""What becomes of one attack on the program, and of many."""

from dataclasses import asdict, dataclass, field, fields
from typing import Any

OPENED, REFUSED, CRASHED, HUNG, LOST, WRONG = KINDS = ("opened", "refused", "crashed", "hung", "lost", "wrong")
FAULTS = KINDS[2:]
MOST_FAULTS = 20
"""That a block of cases tells in words; it counts all of them."""


@dataclass(frozen=True)
class Outcome:
    """kind: of KINDS.  text: what a fault is, in a line.  ratio: the worst error as a multiple of its estimate.
    seconds: the longest that a window let one wait.
    """

    kind: str
    text: str = ""
    ratio: float = 0.0
    seconds: float = 0.0


@dataclass
class Tally:
    """Outcomes counted.  memory: peak bytes of a process; faults: number of the case, kind and text of each."""

    opened: int = 0
    refused: int = 0
    crashed: int = 0
    hung: int = 0
    lost: int = 0
    wrong: int = 0
    ratio: float = 0.0
    seconds: float = 0.0
    memory: int = 0
    faults: list[list[Any]] = field(default_factory=list)

    @property
    def tried(self) -> int:
        return sum(getattr(self, kind) for kind in KINDS)

    @property
    def faulty(self) -> int:
        return sum(getattr(self, kind) for kind in FAULTS)

    def add(self, outcome: Outcome, number: int) -> None:
        """Count an outcome, of the case with this number."""
        setattr(self, outcome.kind, getattr(self, outcome.kind) + 1)
        self.ratio = max(self.ratio, outcome.ratio)
        self.seconds = max(self.seconds, outcome.seconds)
        if outcome.kind in FAULTS and len(self.faults) < MOST_FAULTS:
            self.faults.append([number, outcome.kind, outcome.text])

    def join(self, other: "Tally") -> None:
        """Count all that another has counted."""
        for kind in KINDS:
            setattr(self, kind, getattr(self, kind) + getattr(other, kind))
        self.ratio, self.memory = max(self.ratio, other.ratio), max(self.memory, other.memory)
        self.seconds = max(self.seconds, other.seconds)
        self.faults += other.faults

    def as_json(self) -> dict[str, Any]:
        return asdict(self)

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> "Tally":
        """What `as_json` wrote, with whatever else stands beside it left out and 0 for what is not there."""
        return cls(**{each.name: data[each.name] for each in fields(cls) if each.name in data})
