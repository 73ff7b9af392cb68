"""The letters of a figure: which fonts there are, and how wide a text is in one."""

from __future__ import annotations

from contextlib import suppress
from difflib import get_close_matches
from functools import cache

from bihdist_core import ParameterError

FONT = "DejaVu Sans"
"""The usual family, which comes with matplotlib; it also stands in for signs that another does not have."""

SLACK = 1.02
"""Factor by which a text may be wider than its outlines say: small letters are set on whole pixels."""


def check_font(family: str) -> None:
    """Raise ParameterError, with similar names, if no font of this family is installed; "" is the usual one."""
    if not family or _is_there(family):
        return
    known = _families()
    near = [known[name] for name in get_close_matches(family.lower(), known, 3, 0.5)]
    there = f"there is {' or '.join(near)}" if near else f"the default is {FONT}"
    raise ParameterError(f"No font {family!r} is installed; {there}.")


def families(family: str) -> list[str]:
    """Return the families that are looked for, in order."""
    if family:
        _is_there(family)
    return list(dict.fromkeys([family or FONT, FONT]))


@cache
def has_cff_outlines(family: str) -> bool:
    """Return whether letters of a family are PostScript outlines (CFF), as those of many .otf files are."""
    from matplotlib.font_manager import FontProperties, findfont

    for weight in ("normal", "bold"):
        with open(findfont(FontProperties(family=families(family), weight=weight)), "rb") as file:
            if file.read(4) == b"OTTO":
                return True
    return False


def text_width(text: str, size: float, bold: bool = False, family: str = "") -> float:
    """Return the width of a line of text, in the unit of its size."""
    return _width(text, bold, family) * size * SLACK / 100 if text else 0.0


@cache
def _is_there(family: str) -> bool:
    return family.lower() in _families() or family.lower() in _families(anew=True)


def _families(anew: bool = False) -> dict[str, str]:
    """Return the names of fonts by their names in lower case.

    Matplotlib lists the fonts that there were when it was first used; with `anew`, those installed since are added.
    """
    from matplotlib.font_manager import findSystemFonts, fontManager

    known = {font.fname for font in fontManager.ttflist}
    for path in findSystemFonts() if anew else ():
        if path not in known:
            with suppress(OSError, RuntimeError):  # what is no font, or one of an unknown kind
                fontManager.addfont(path)
    return {name.lower(): name for name in fontManager.get_font_names()}


@cache
def _width(text: str, bold: bool, family: str) -> float:
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(family=families(family), weight="bold" if bold else "normal", size=100)
    return float(text_to_path.get_text_width_height_descent(text, font, False)[0])
