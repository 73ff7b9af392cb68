"""Distances by rational functions of the Laplacian as a page holds them: poles, and weights for each step of a slider.

With eigenvalues in units of the first, the same numbers serve all meshes; see `bihdist_core.distances.rational`.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np

from bihdist_core import Laplacian
from bihdist_core.distances import diffusion, power
from bihdist_core.distances.distance import unit_of
from bihdist_core.distances.distance_types import PAPER_TIMES, Spec, distance_type
from bihdist_core.distances.rational import EXPONENTIAL, RationalFunction, fitted

Json = dict[str, Any]

SETS = tuple(float(diffusion.STEP) ** k for k in (1, 0, -1, -2, -3))
"""Times, each of which has a set of poles; those between are served by two neighbours."""
PER_SET = 8
"""Steps of the slider from one set to the next."""
POWERS = tuple(k / 20 for k in range(21, 61))
LARGEST = 1e9
"""The largest eigenvalue that counts for diffusion."""
LEAST = 1e-2
"""The least difference to the first eigenvalue, times the time."""


def stored_functions(laplacian: Laplacian, specs: Iterable[Spec], original: Laplacian) -> Json:
    """Return the functions by the words of their distances, with the parameters of some specs among the steps, and the
    first eigenvalue of each component, as parts of a scene.  Labels and units are those of the original Laplacian."""
    firsts = [float(component.spectrum(1).eigenvalues[0]) for component in laplacian.components]
    ratios = [each.largest_eigenvalue / first for each, first in zip(laplacian.components, firsts, strict=True)]
    last = 10 ** (np.ceil(2 * np.log10(max(ratios))) / 2)
    has_infinite = bool((laplacian.areas == 0).any())
    own = {(spec.word, float(value)) for spec in specs for _, value in spec.values}
    times, powers = (tuple(value for word, value in sorted(own) if word == each) for each in ("diffusion", "power"))
    of = (original.surface.dimension - 2) / 2, original.operator_words
    made = {"diffusion": _diffusion(times, of), "power": _power(powers, float(last), has_infinite, of)}
    for word, function in made.items():
        (parameter,) = distance_type(word).parameters
        function["meaning"] = parameter.meaning
    return {"functions": made, "firsts": firsts}


@cache
def _diffusion(own: tuple[float, ...], of: tuple[float, str]) -> Json:
    """Return poles and steps for exp(-t x), x >= 1; errors are compared with exp(-t).

    `of` is what the power of lengths in units is less than on surfaces, and words that labels end with.
    """
    count = PER_SET * (len(SETS) - 1) + 1
    steps = {float(f"{SETS[0] / diffusion.STEP ** (k / PER_SET):.2g}") for k in range(count)}
    steps |= {*PAPER_TIMES, *own}
    sets = [*SETS, *(t for t in own if not SETS[-1] <= t <= SETS[0])]
    rows = []
    for t in sorted(steps):
        near = np.argsort([abs(np.log(t / each)) for each in sets])[:2]
        for some in (near[:1].tolist(), sorted(near.tolist())):
            function = _exponential(t, [sets[k] for k in some])
            if t * function.bounds[0, 1] <= diffusion.CLOSE:
                break
        row = _row(t, diffusion.LABEL, -1.0, function, of)
        # The root of exp(-t), by which distances are multiplied in the end, for its square may be no number.
        rows.append({**row, "first": len(EXPONENTIAL) * some[0], "root": float(np.exp(-t / 2))})
    return {"poles": [_pair(1 + z / each) for each in sets for z in EXPONENTIAL], "steps": rows}


def _exponential(t: float, sets: list[float]) -> RationalFunction:
    poles = [z / each for each in sets for z in EXPONENTIAL]
    return fitted(diffusion.exponential(t), LEAST / t, LARGEST, poles, lambda y: 1 / (1 / t + y), has_infinite=True)


@cache
def _power(own: tuple[float, ...], last: float, has_infinite: bool, of: tuple[float, str]) -> Json:
    """Return poles and steps for 1 / x^alpha, 1 <= x <= last."""
    rows = []
    for alpha in sorted({*POWERS, *own}):
        poles, scale = power.power_poles(alpha, 1.0, last), None if alpha <= 2 else power.local(1.0)
        function = fitted(power.power(alpha), 1.0, last, poles, scale, True, has_infinite)
        row = _row(alpha, power.LABEL, alpha - 1, function, of)
        ends = {"inverse": function.inverse, "inverse_square": function.inverse_square}
        rows.append({**row, **ends, "power": alpha})
    return {"poles": [_pair(pole) for pole in power.power_poles(1.5, 1.0, last)], "steps": rows}


def _row(value: float, label: str, length_power: float, function: RationalFunction, of: tuple[float, str]) -> Json:
    """Return a step of a slider; the weights are of poles from `first` on."""
    (less, words), weights = of, list(map(_pair, function.weights))
    shown = {"label": label.format(value) + words, "unit": unit_of(length_power - less)}
    return {"value": value, **shown, "first": 0, "weights": weights}


def _pair(z: complex) -> tuple[float, float]:
    return float(z.real), float(z.imag)
