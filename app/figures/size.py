"""The size of a figure, as one writes it: 1680x640, 8000px, 160mm@300dpi, 160x80mm, 8.5cm, column, slide."""

import re
from dataclasses import dataclass

from bihdist_core import ParameterError

MM_PER_INCH = 25.4
MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "in": MM_PER_INCH}
UNITS_PER_INCH = 96
"""Lengths in a figure are in pixels of a page at 96 dpi, which is what a pixel is in SVG and on the web."""

PRINT_DPI = 300.0
"""Dots per inch of a size in millimetres without a resolution."""

LEAST_DPI, MOST_DPI = 10, 2400

LARGEST = 32_000
"""Pixels along a side."""

NAMED = {"column": "85mm", "double": "178mm", "slide": "1920x1080@288dpi", "A0": "1189x841mm@150dpi"}
"""Sizes by what they are for: one or two columns of a journal, a screen that is looked at from afar, a poster."""

_WRITTEN = re.compile(
    r"(?P<width>\d+(?:\.\d+)?)(?:x(?P<height>\d+(?:\.\d+)?))?(?P<unit>px|mm|cm|in)?(?:@(?P<dpi>\d+(?:\.\d+)?)(?:dpi)?)?"
)


def is_column(text: str) -> bool:
    """Return whether a size is written as one column of a journal, whose figures are cropped and share a colour bar."""
    return text.strip().lower() == "column"


@dataclass(frozen=True)
class Size:
    """Width and height in `unit`, "px" or "mm"; what is None follows from the panels.

    With dpi, text and lines have their printed size.  Without, pixels enlarge the whole: a figure of twice the width
    is the same figure, drawn finer, as long as its words stay readable.
    """

    width: float | None = None
    height: float | None = None
    unit: str = "px"
    dpi: float | None = None

    def __post_init__(self) -> None:
        if self.unit not in ("px", "mm"):
            raise ParameterError(f"A size is in px or mm, not in {self.unit!r}.")
        for number in (self.width, self.height, self.dpi):
            if number is not None and not 0 < number < 1e6:
                raise ParameterError(f"A size and its resolution are positive numbers, not {number!r}.")
        if self.dpi is not None and not LEAST_DPI <= self.dpi <= MOST_DPI:
            raise ParameterError(f"A resolution is from {LEAST_DPI} to {MOST_DPI} dpi, not {self.dpi:g}.")

    @classmethod
    def parse(cls, text: str) -> "Size":
        """Return the size written as `text`; raise ParameterError if it is none."""
        named = {name.lower(): written for name, written in NAMED.items()}
        found = _WRITTEN.fullmatch(named.get(text.strip().lower(), text).replace(" ", "").replace("×", "x"))
        if not found:
            raise ParameterError(
                f"{text!r} is not a size such as 1680x640, 8000px, 160mm@300dpi, 160x80mm, 8.5cm or 3.5in, "
                f"nor one of {', '.join(NAMED)}."
            )
        width, height, dpi = (None if found[k] is None else float(found[k]) for k in ("width", "height", "dpi"))
        if (unit := found["unit"] or "px") == "px":
            return cls(width, height, unit, dpi)
        width, height = (side and round(side * MM_PER_UNIT[unit], 9) for side in (width, height))
        return cls(width, height, "mm", dpi)

    @property
    def resolution(self) -> float | None:
        """Pixels an inch of paper; None where pixels say how large the page is."""
        return self.dpi or (PRINT_DPI if self.unit == "mm" else None)

    def pixels_of(self, length: float) -> float:
        """Return a width or height of this size in pixels."""
        return length * (self.resolution or 0) / MM_PER_INCH if self.unit == "mm" else length

    def pixels(self, usual: tuple[float, float]) -> tuple[int, int, float]:
        """Return width, height and pixels per unit, for panels that would usually take this many units."""
        dpi = self.resolution
        if self.width is not None:
            width = self.pixels_of(self.width)
            height = width * usual[1] / usual[0] if self.height is None else self.pixels_of(self.height)
        elif self.height is not None:
            height = self.pixels_of(self.height)
            width = height * usual[0] / usual[1]
        else:
            width, height = (side * (dpi or UNITS_PER_INCH) / UNITS_PER_INCH for side in usual)
        check_pixels(width, height)
        # On a small screen panels are small, but words stay readable.
        scale = dpi / UNITS_PER_INCH if dpi else max(min(width / usual[0], height / usual[1]), 1.0)
        return round(width), round(height), scale


def check_pixels(width: float, height: float) -> None:
    """Raise ParameterError for a picture that is too small or too large."""
    if not (16 <= width <= LARGEST and 16 <= height <= LARGEST):
        raise ParameterError(
            f"A picture has 16 to {LARGEST} pixels along a side; this would have {width:.0f} x {height:.0f}."
        )
