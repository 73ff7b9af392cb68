"""Colours as they look: Oklab, in which equal distances are equally large differences to the eye.

Björn Ottosson, A perceptual color space for image processing, 2020.
"""

import numpy as np

from bihdist_core.arrays import FloatArray

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
