"""The colour maps that come with the program: places from 0 to 1, and the colours there."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray

from ..document.looks import Stops

_CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
_FROM_CONES, _FROM_LAB = np.linalg.inv(_CONES), np.linalg.inv(_LAB)


def oklab(srgb: FloatArray) -> FloatArray:
    """Return lightness (0 to 1), green to red, and blue to yellow (k, 3) of sRGB colours (k, 3) from 0 to 1."""
    light = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    lab: FloatArray = np.cbrt(light @ _CONES.T) @ _LAB.T
    return lab


def srgb(lab: FloatArray) -> FloatArray:
    """Return sRGB colours (k, 3) from 0 to 1, as near as a screen can show them."""
    light = np.clip((lab @ _FROM_LAB.T) ** 3 @ _FROM_CONES.T, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


STOPS = 33
"""Stops of the maps made here: so many that steps between them are not seen."""


SEEN_ON_DARK = 0.36
"""The lightness in Oklab from which on a colour is seen on a dark ground."""


@dataclass(frozen=True)
class ColourMap:
    """A colour map, with a name and a hint for the user."""

    name: str
    hint: str
    stops: Stops


def _stops(colours: FloatArray, low: float = 0.0) -> Stops:
    """Return stops for colours (k, 3) at equal distances from `low` to 1."""
    places = np.linspace(low, 1, len(colours))
    return tuple(
        (float(place), (float(r), float(g), float(b))) for place, (r, g, b) in zip(places, colours, strict=True)
    )


def _hex(*words: str) -> FloatArray:
    """Return colours such as "#10265F" as RGB (k, 3)."""
    return np.array([[int(word[k : k + 2], 16) / 255 for k in (1, 3, 5)] for word in words])


def _straight(first: str, last: str) -> Stops:
    """Return the straight way from colour to colour, on which lightness, too, goes evenly."""
    ends = oklab(_hex(first, last))
    share = np.linspace(0, 1, STOPS)[:, None]
    return _stops(srgb(ends[:1] + share * (ends[1:] - ends[:1])))


def _arc() -> Stops:
    """Return a map of equal steps in lightness and hue, from dark violet through red to light yellow."""
    share = np.linspace(0, 1, STOPS)
    lightness, hue = 0.24 + 0.59 * share, np.radians(-55 + 148 * share)
    colour = 0.165 * np.sin(np.pi * (0.2 + 0.6 * share))
    return _stops(srgb(np.stack([lightness, colour * np.cos(hue), colour * np.sin(hue)], 1)))


def _both_ways(below: str, middle: str, above: str) -> Stops:
    """Return a map from the middle, at 0, to both ends, at -1 and 1: evenly darker, and soon coloured."""
    sides = []
    for end in (below, above):
        start, stop = oklab(_hex(middle, end))
        share = np.linspace(0, 1, STOPS // 2 + 1)[:, None]
        # More blue or yellow than red or green at first, which keeps brown and violet apart while they are light.
        sides.append(srgb(start + (stop - start) * share * (1 + (1 - share) * [0, 1.2, 2.2])))
    return _stops(np.concatenate([sides[0][:0:-1], sides[1]]), -1.0)


PAPER: Stops = (
    (0.0, (0.03, 0.07, 0.42)),
    (0.17, (0.08, 0.32, 0.78)),
    (0.34, (0.33, 0.73, 0.90)),
    (0.50, (0.80, 0.82, 0.83)),
    (0.66, (0.95, 0.62, 0.66)),
    (0.84, (0.83, 0.18, 0.20)),
    (1.0, (0.45, 0.02, 0.06)),
)

PAPER_ON_DARK: Stops = (
    (0.0, (0.16, 0.28, 0.80)),
    (0.17, (0.16, 0.46, 0.90)),
    (0.34, (0.36, 0.76, 0.93)),
    (0.50, (0.80, 0.82, 0.83)),
    (0.66, (0.96, 0.64, 0.67)),
    (0.84, (0.92, 0.33, 0.33)),
    (1.0, (0.70, 0.10, 0.14)),
)

UNIFORM: Stops = _stops(
    # viridis (Smith and van der Walt, CC0) from 0 to 0.82: beyond, white lines would no longer stand out.
    np.array(
        [
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
        ]
    )
)

DIVERGING: Stops = _both_ways("#543005", "#F5F5F2", "#3D1F66")
"""From -1 to 1, for values on both sides of 0: brown below and violet above, equally dark at equal distances, which
also those who confuse red and green tell apart; it shares no hue with the paper's map."""

MAPS = {
    "paper": ColourMap("Paper", "The paper's: dark blue near, through cyan, grey and pink, to dark red far", PAPER),
    "uniform": ColourMap("Uniform", "Violet to green; equal steps look equally large", UNIFORM),
    "ember": ColourMap("Ember", "Dark violet through red to yellow; equal steps look equally large", _arc()),
    "safe": ColourMap(
        "Safe",
        "Blue to yellow: the same for colour-blind eyes and, printed in grey, evenly lighter",
        _straight("#10265F", "#DFC24A"),
    ),
    "diverging": ColourMap(
        "Diverging",
        "Brown to violet, light in the middle",
        tuple(((place + 1) / 2, colour) for place, colour in DIVERGING),
    ),
}
"""By their words on the command line and in recipes."""


def lightened(stops: Stops) -> Stops:
    """Return the map without what is too dark at its beginning to be seen on a dark ground."""
    places = np.linspace(0, 1, 257)
    light = np.flatnonzero(oklab(colours_at(stops, places))[:, 0] >= SEEN_ON_DARK)
    return _stops(colours_at(stops, np.linspace(places[light[0]], 1, STOPS)))


def goes_both_ways(stops: Stops) -> bool:
    """Return whether the middle is much lighter or darker than both ends, so that the map also suits signed fields."""
    first, middle, last = oklab(colours_at(stops, np.array([0.0, 0.5, 1.0])))[:, 0]
    return bool(middle > max(first, last) + 0.15 or middle < min(first, last) - 0.15)


def colours_at(stops: Stops, shares: FloatArray) -> FloatArray:
    """Return the colours (k, 3) at fractions (k,)."""
    places, colours = (np.array(each) for each in zip(*stops, strict=True))
    return np.stack([np.interp(shares, places, each) for each in colours.T], 1)


def backwards(stops: Stops) -> Stops:
    """Return the same from the end."""
    first, last = stops[0][0], stops[-1][0]
    return tuple((first + last - place, colour) for place, colour in reversed(stops))
