"""What pictures look like: the one place where colours and line widths are defined."""

from dataclasses import dataclass

import numpy as np

Colour = tuple[float, float, float]


DIVERGING: tuple[tuple[float, Colour], ...] = (
    (-1.0, (0.16, 0.39, 0.73)),
    (-0.6, (0.36, 0.62, 0.87)),
    (-0.25, (0.70, 0.84, 0.94)),
    (0.0, (0.95, 0.95, 0.94)),
    (0.25, (0.97, 0.80, 0.58)),
    (0.6, (0.89, 0.55, 0.20)),
    (1.0, (0.69, 0.30, 0.04)),
)
"""For values on both sides of 0: blue below and orange above, equally dark at equal distances, which also those who
confuse red and green tell apart; the ends are light enough for dark lines."""


@dataclass(frozen=True)
class Style:
    """Colours are RGB from 0 to 1; widths are in pixels at scale 1, which are 1/96 of an inch.

    outline: width of the line around the shape and along its folds; 0 for none.  Without `shading` the colours are
    drawn as they are, and without `coloured` isolines alone tell the field.  back: of the inside of a surface, where
    it is seen; edge, edge_on_dark: of the wireframe, on light and on dark colours.
    """

    stops: tuple[tuple[float, Colour], ...]
    background: Colour = (1, 1, 1)
    text: Colour = (0.13, 0.14, 0.16)
    quiet_text: Colour = (0.45, 0.47, 0.5)
    isoline: Colour = (1, 1, 1)
    isoline_width: float = 1.5
    outline: float = 0.0
    outline_colour: Colour = (0, 0, 0)
    shading: bool = True
    coloured: bool = True
    undefined: Colour = (0.72, 0.72, 0.7)
    back: Colour = (0.80, 0.74, 0.62)
    edge: Colour = (0.05, 0.06, 0.08)
    edge_on_dark: Colour = (0.62, 0.65, 0.70)
    source: Colour = (1.0, 0.86, 0.1)
    pointer: Colour = (1, 1, 1)
    largest: Colour = (0.10, 0.72, 0.50)
    marker_size: float = 15.0
    mark_edge: Colour = (0.1, 0.1, 0.12)
    diverging: tuple[tuple[float, Colour], ...] = DIVERGING
    signed_isoline: Colour = (0.16, 0.17, 0.19)

    def colours(self, count: int = 512, signed: bool = False) -> np.ndarray:
        """(count, 3) the colour map from 0 to the maximum; signed: from -maximum to maximum."""
        return self.colours_at(np.linspace(-1 if signed else 0, 1, count), signed)

    def colours_at(self, shares: np.ndarray, signed: bool = False) -> np.ndarray:
        """(k, 3) colours of values given as shares (k,) of the maximum, 0 to 1, or -1 to 1 if signed."""
        stops = self.diverging if signed else self.stops
        at = np.array([s for s, _ in stops])
        colours = np.array([c for _, c in stops])
        return np.stack([np.interp(shares, at, colours[:, k]) for k in range(3)], 1)

    def colour_of(self, value: float, top: float, signed: bool = False) -> Colour | np.ndarray:
        """The colour of one value where `top` is the end of the colour bar; what is undefined is grey."""
        if np.isnan(value):
            return self.undefined
        share = np.clip(value / top, -1 if signed else 0, 1) if top > 0 else 0.0
        return self.colours_at(np.array([share]), signed)[0]

    def line(self, signed: bool = False) -> Colour:
        """The colour of isolines; the middle of a diverging map is too light for white ones."""
        return self.signed_isoline if signed else self.isoline


def _even(*colours: Colour) -> tuple[tuple[float, Colour], ...]:
    """Stops at equal distances."""
    return tuple((k / (len(colours) - 1), colour) for k, colour in enumerate(colours))


PAPER = Style(
    stops=(
        (0.0, (0.03, 0.07, 0.42)),
        (0.17, (0.08, 0.32, 0.78)),
        (0.34, (0.33, 0.73, 0.90)),
        (0.50, (0.80, 0.82, 0.83)),
        (0.66, (0.95, 0.62, 0.66)),
        (0.84, (0.83, 0.18, 0.20)),
        (1.0, (0.45, 0.02, 0.06)),
    )
)
"""The paper's look: dark blue near, through cyan, grey and pink, to dark red far; white isolines."""

UNIFORM = Style(
    # viridis (Smith and van der Walt, CC0) from 0 to 0.82: beyond, white lines would no longer stand out.
    stops=_even(
        (0.267, 0.005, 0.329),
        (0.281, 0.079, 0.402),
        (0.282, 0.151, 0.465),
        (0.269, 0.219, 0.510),
        (0.247, 0.283, 0.536),
        (0.220, 0.343, 0.549),
        (0.194, 0.399, 0.556),
        (0.171, 0.453, 0.558),
        (0.150, 0.504, 0.557),
        (0.131, 0.556, 0.552),
        (0.120, 0.607, 0.540),
        (0.135, 0.659, 0.518),
        (0.191, 0.708, 0.482),
        (0.281, 0.755, 0.433),
        (0.395, 0.797, 0.368),
        (0.526, 0.833, 0.288),
    )
)
"""Equal steps of distance look equally large, also with colour-vision deficiencies and printed in grey."""

LINES = Style(
    stops=_even((1, 1, 1), (1, 1, 1)),
    isoline=(0, 0, 0),
    isoline_width=1.1,
    outline=1.6,
    shading=False,
    coloured=False,
    diverging=((-1.0, (1, 1, 1)), (1.0, (1, 1, 1))),
    signed_isoline=(0, 0, 0),
    largest=(1, 1, 1),
    text=(0, 0, 0),
    quiet_text=(0.25, 0.25, 0.25),
    undefined=(0.86, 0.86, 0.86),
    back=(0.93, 0.93, 0.93),
    edge=(0.55, 0.55, 0.55),
    source=(0, 0, 0),
    mark_edge=(0, 0, 0),
    marker_size=9.0,
)
"""Isolines and outlines only, for black-and-white print."""

DARK = Style(
    stops=(
        (0.0, (0.16, 0.28, 0.80)),
        (0.17, (0.16, 0.46, 0.90)),
        (0.34, (0.36, 0.76, 0.93)),
        (0.50, (0.80, 0.82, 0.83)),
        (0.66, (0.96, 0.64, 0.67)),
        (0.84, (0.92, 0.33, 0.33)),
        (1.0, (0.70, 0.10, 0.14)),
    ),
    background=(0.07, 0.08, 0.10),
    text=(0.93, 0.94, 0.95),
    quiet_text=(0.66, 0.68, 0.71),
    undefined=(0.45, 0.45, 0.45),
    back=(0.42, 0.38, 0.30),
    mark_edge=(0.05, 0.05, 0.06),
)
"""For slides: the paper's colours with lighter ends, which stay visible on a dark background."""

STYLES = {"paper": PAPER, "uniform": UNIFORM, "lines": LINES, "dark": DARK}
"""The words of the command line and of recipes."""
