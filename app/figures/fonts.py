"""The letters of a figure: which fonts there are, and how wide a text is in one."""

from __future__ import annotations

from difflib import get_close_matches
from functools import cache

from bihdist_core import ParameterError

FONT = "DejaVu Sans"
"""The usual family, which comes with matplotlib; it also stands in for signs that another does not have."""

SLACK = 1.02
"""By how much a text may be wider than its outlines say: small letters are set on whole pixels."""


def check_font(family: str) -> None:
    """ParameterError, with names like it, if no font of this family is installed; "" is the usual one."""
    known = _families()
    if not family or family.lower() in known:
        return
    near = [known[name] for name in get_close_matches(family.lower(), known, 3, 0.5)]
    there = f"there is {' or '.join(near)}" if near else f"without one it is {FONT}"
    raise ParameterError(f"No font {family!r} is installed; {there}.")


def families(family: str) -> list[str]:
    """What is looked for, in order."""
    return list(dict.fromkeys([family or FONT, FONT]))


def text_width(text: str, size: float, bold: bool = False, family: str = "") -> float:
    """Units a line of text takes at a size in units."""
    return _width(text, bold, family) * size * SLACK / 100 if text else 0.0


@cache
def _families() -> dict[str, str]:
    from matplotlib.font_manager import fontManager

    return {name.lower(): name for name in fontManager.get_font_names()}


@cache
def _width(text: str, bold: bool, family: str) -> float:
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(family=families(family), weight="bold" if bold else "normal", size=100)
    return float(text_to_path.get_text_width_height_descent(text, font, False)[0])
