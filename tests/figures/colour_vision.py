"""How colours look: lightness, differences, and what people with colour-vision deficiencies see of them.

    python -m tests.figures.colour_vision OUT.png

draws every style's colour map as it is, as seen with the three deficiencies and printed in grey, above its lightness
and the size of its steps.
"""

import sys

import numpy as np

from app.scene.style import STYLES, Style

DEFICIENCIES = {
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""Full dichromacy on linear RGB: Machado, Oliveira and Fernandes, IEEE TVCG 15(6), 2009, table 1."""

_TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)

_OKLAB_CONES = [
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
]
_OKLAB = [
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
]
"""Björn Ottosson, A perceptual color space for image processing, 2020."""


def linear(srgb: np.ndarray) -> np.ndarray:
    """(k, 3) sRGB, 0 to 1, as light."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def encoded(light: np.ndarray) -> np.ndarray:
    """(k, 3) light as sRGB."""
    light = np.clip(light, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def seen_with(deficiency: str, srgb: np.ndarray) -> np.ndarray:
    """(k, 3) sRGB colours that look to everybody as these look to people with the deficiency."""
    return encoded(linear(srgb) @ np.array(DEFICIENCIES[deficiency]).T)


def lab(srgb: np.ndarray) -> np.ndarray:
    """(k, 3) CIELAB, white point D65; the first is lightness, 0 to 100."""
    xyz = linear(srgb) @ _TO_XYZ.T / _TO_XYZ.sum(axis=1)
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], 1)


def steps(srgb: np.ndarray) -> np.ndarray:
    """(k - 1,) differences from colour to colour, times 100, in Oklab: CIELAB makes too much of saturated colours."""
    cones = np.cbrt(linear(srgb) @ np.array(_OKLAB_CONES).T)
    return 100 * np.linalg.norm(np.diff(cones @ np.array(_OKLAB).T, axis=0), axis=1)


def variants(style: Style, count: int = 256) -> dict[str, np.ndarray]:
    """The style's colours (count, 3) as everybody sees them, with each deficiency, and in grey."""
    colours = style.colours(count)
    grey = linear(colours) @ _TO_XYZ[1]
    return {
        "as it is": colours,
        **{name: seen_with(name, colours) for name in DEFICIENCIES},
        "grey": encoded(np.repeat(grey[:, None], 3, axis=1)),
    }


def draw(path: str) -> None:
    """The figure that shows it."""
    from matplotlib.figure import Figure

    styles = {name: style for name, style in STYLES.items() if style.coloured}
    page = Figure(figsize=(11, 5.2), layout="constrained")
    rows = page.subplots(3, len(styles), height_ratios=[1.3, 1, 1])
    for k, (name, style) in enumerate(styles.items()):
        bars, lightness, sizes = rows[:, k]
        shown = variants(style)
        bars.imshow(np.stack(list(shown.values())), aspect="auto", interpolation="nearest")
        bars.set_yticks(range(len(shown)), list(shown) if k == 0 else [""] * len(shown))
        bars.set_xticks([])
        bars.set_title(name)
        share = np.linspace(0, 1, 256)
        for label, colours in shown.items():
            look = {"color": "black" if label == "as it is" else None, "linewidth": 1.0, "label": label}
            lightness.plot(share, lab(colours)[:, 0], **look)
            sizes.plot(share[1:], 255 * steps(colours), **look)
        lightness.axhline(100, color="0.7", linewidth=0.8)  # white isolines
        lightness.set_ylim(0, 105)
        sizes.set_ylim(0, None)
        sizes.set_xlabel("fraction of the maximum")
    rows[1, 0].set_ylabel("lightness L*")
    rows[2, 0].set_ylabel("difference per\nwhole range")
    rows[1, -1].legend(fontsize=7, loc="lower right")
    page.savefig(path, dpi=120)


if __name__ == "__main__":
    draw(sys.argv[1])
