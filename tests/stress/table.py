"""The report of a run, as a table that is Markdown too."""

from .log import Log
from .outcome import KINDS

COLUMNS = ("attack", "tried", *KINDS, "worst error / its estimate", "longest wait", "peak memory")


def render(log: Log, parts: dict[str, str]) -> str:
    """The table; parts: the words of each, by name."""
    rows = [COLUMNS]
    for name, words in parts.items():
        tally = log.of(name)
        counts = [f"{getattr(tally, kind):,}" for kind in KINDS]
        ratio = f"{tally.ratio:.2g}" if tally.ratio else ""
        wait = f"{tally.seconds:.2f} s" if tally.seconds else ""
        rows.append((words, f"{tally.tried:,}", *counts, ratio, wait, f"{tally.memory / 1e6:,.0f} MB"))
    widths = [max(len(row[k]) for row in rows) for k in range(len(COLUMNS))]
    # Words to the left, numbers to the right.
    lines = [
        " | ".join(
            cell.rjust(width) if k else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    ]
    rule = "|" + "|".join("-" * (w + 2) if not k else "-" * (w + 1) + ":" for k, w in enumerate(widths)) + "|"
    first, *others = (f"| {line} |" for line in lines)
    return "\n".join([first, rule, *others])


def faults(log: Log, parts: dict[str, str]) -> list[str]:
    """A line for each fault that is told, with the words by which it is tried again."""
    return [
        f"{name} {seed} {number}: {kind}: {text}" for name in parts for seed, number, kind, text in log.of(name).faults
    ]
