"""The lines of the benchmark and how they are printed."""

from dataclasses import asdict, dataclass, fields
from typing import Any

from .timing import Comparison


@dataclass(frozen=True)
class Line:
    """One measured line.  Times in seconds; None where something does not apply.

    value: what is judged, most often the ratio of the two times; effort: the ratio of the processors' times, told
    for machines that are busy; bound: what the value may be at most.  limit: the share of
    the machine's own limit that was reached; memory: peak bytes of a process that did only this; error: the largest
    relative difference from the reference; tolerance: what that may be at most;
    before: seconds of an earlier commit, in the same run.
    """

    row: int
    work: str
    ours: float | None = None
    peer: float | None = None
    value: float | None = None
    effort: float | None = None
    bound: float | None = None
    limit: float | None = None
    memory: float | None = None
    error: float | None = None
    tolerance: float | None = None
    before: float | None = None
    note: str = ""

    @property
    def holds(self) -> bool | None:
        """Whether the value is within its bound; None if there is nothing to judge."""
        return None if self.value is None or self.bound is None else bool(self.value <= self.bound)

    @property
    def is_accurate(self) -> bool | None:
        return None if self.error is None or self.tolerance is None else bool(self.error <= self.tolerance)


def compared(row: int, work: str, result: Comparison, **told: Any) -> Line:
    """The line of a comparison, which is judged by its ratio; told: more of the line's fields."""
    return Line(row, work, result.our_time, result.peer_time, result.ratio, result.effort, **told)


COLUMNS = (
    "row",
    "work",
    "ours",
    "peer",
    "value",
    "bound",
    "",
    "effort",
    "limit",
    "memory",
    "error",
    "before",
    "ratio",
    "note",
)

BEFORE = ("before", "ratio")
"""Those of another commit, which stand only where that was measured."""


def render(lines: list[Line]) -> str:
    """The table as text; it is Markdown too."""
    rows = [COLUMNS, *map(_cells, lines)]
    if all(line.before is None for line in lines):
        rows = [tuple(cell for name, cell in zip(COLUMNS, row, strict=True) if name not in BEFORE) for row in rows]
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    padded = [[cell.ljust(width) for cell, width in zip(row, widths, strict=True)] for row in rows]
    texts = ["| " + " | ".join(row) + " |" for row in padded]
    return "\n".join([texts[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *texts[1:]])


def as_json(lines: list[Line]) -> list[dict]:
    return [asdict(line) | {"holds": line.holds, "is_accurate": line.is_accurate} for line in lines]


def from_json(written: list[dict]) -> list[Line]:
    """The lines that `as_json` wrote, perhaps that of an older benchmark."""
    known = {field.name for field in fields(Line)}
    return [Line(**{name: value for name, value in line.items() if name in known}) for line in written]


def _cells(line: Line) -> tuple[str, ...]:
    return (
        str(line.row),
        line.work,
        _seconds(line.ours),
        _seconds(line.peer),
        "" if line.value is None else f"{line.value:.3g}",
        "" if line.bound is None else f"≤ {line.bound:g}",
        {None: "", True: "yes", False: "NO"}[line.holds],
        "" if line.effort is None else f"{line.effort:.3g}",
        "" if line.limit is None else f"{line.limit:.0%}",
        "" if line.memory is None else f"{line.memory / 1e6:,.0f} MB",
        "" if line.error is None else f"{line.error:.1e}" + ("" if line.is_accurate is not False else " BAD"),
        _seconds(line.before) or "–",
        "–" if not line.before or line.ours is None else f"{line.ours / line.before:.3g}",
        line.note,
    )


def _seconds(time: float | None) -> str:
    if time is None:
        return ""
    return f"{time:.2f} s" if time >= 1 else f"{1000 * time:.3g} ms"
