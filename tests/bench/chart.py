"""A chart of the ratios to other programs, as SVG."""

import math
from collections.abc import Sequence
from html import escape

from .table import Line

INK, QUIET, RULE, OURS, OVER = "#1D2125", "#5B626B", "#DFE3E7", "#0A7358", "#B45309"
FONT = "system-ui, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif"
GROUPS = {
    "Set up a mesh": (1, 23),
    "One field": (2,),
    "Many fields": (3, 4),
    "Geodesics": (6, 27),
    "Spectrum": (5,),
    "Files": (24,),
}
WIDTH, LEFT, RIGHT, ROW = 940, 480, 870, 22
LEAST, MOST = 0.02, 2.0
TICKS = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)


def chart(lines: Sequence[Line]) -> str:
    """SVG with a bar for each line that is a ratio of times to another program; a tick where its bound is."""
    parts: list[str] = []
    y = 74.0
    for name, rows in GROUPS.items():
        shown = [line for line in lines if line.row in rows and _is_to_peer(line)]
        if shown:
            parts.append(_text(24, y, name, INK, "600"))
            y += ROW
        for line in shown:
            parts += _bar(y, line)
            y += ROW
        y += 8 if shown else 0
    axis = [_text(24, 30, "Time taken, as a ratio to other programs (shorter is faster)", INK, "600", size=16)]
    for tick in TICKS:
        x, colour = _x(tick), INK if tick == 1 else RULE
        axis.append(f'<path d="M{x:.1f} 60V{y - 16:.0f}" stroke="{colour}"/>')
        axis.append(_text(x, 52, "1 = the peer" if tick == 1 else f"{tick:g}", QUIET, anchor="middle"))
    note = "Upright tick: the bound that the benchmark judges by. Amber: over its bound."
    axis.append(_text(24, y + 8, note, QUIET))
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + 24:.0f}" font-family="{FONT}">'
    return "\n".join(
        [head, f'<rect width="{WIDTH}" height="{y + 24:.0f}" fill="#FFFFFF"/>', *axis, *parts, "</svg>", ""]
    )


def _is_to_peer(line: Line) -> bool:
    """Whether it is a ratio of times to another program; the accuracy and diffusion are measured by our own."""
    own = line.work.startswith(("accuracy", "diffusion"))
    return not own and "peer: " in line.note and None not in (line.ours, line.peer, line.value)


def _bar(y: float, line: Line) -> list[str]:
    assert line.value is not None
    end, colour = _x(line.value), OVER if line.holds is False else OURS
    parts = [
        _text(36, y, line.work, QUIET),
        f'<rect x="{LEFT}" y="{y - 10:.0f}" width="{end - LEFT:.1f}" height="11" rx="2" fill="{colour}"/>',
    ]
    if line.bound is not None:
        parts.append(f'<path d="M{_x(line.bound):.1f} {y - 13:.0f}v17" stroke="{INK}" stroke-width="1.5"/>')
    return [*parts, _text(WIDTH - 24, y, f"{line.value:.2f}", INK, anchor="end")]


def _x(ratio: float) -> float:
    share = math.log(min(max(ratio, LEAST), MOST) / LEAST) / math.log(MOST / LEAST)
    return LEFT + share * (RIGHT - LEFT)


def _text(
    x: float, y: float, words: str, colour: str, weight: str = "400", anchor: str = "start", size: int = 12
) -> str:
    place = f'x="{x:.1f}" y="{y:.0f}" text-anchor="{anchor}"'
    return f'<text {place} font-size="{size}" font-weight="{weight}" fill="{colour}">{escape(words)}</text>'
