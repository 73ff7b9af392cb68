"""What moves in a movie, frame by frame: angles of the camera, fractions of a way, values of a parameter."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from bihdist_core import ParameterError
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.distance_types import Parameter, Value

RAMP = 0.2
"""The share of the time in which a movement becomes as fast as it will be, and that in which it ends."""

DIGITS = 3
"""Of values in headings, always as many, so that words stay where they are."""


def eased(times: FloatArray) -> FloatArray:
    """Return fractions of a way (k,) at fractions of the time (k,): even but for a slow start and a slow end."""
    to_end = np.minimum(times, 1 - times)
    way = np.where(to_end < RAMP, to_end**2 / (2 * RAMP), to_end - RAMP / 2) / (1 - RAMP)
    return np.where(times < 0.5, way, 1 - way)


def way(frames: int, is_loop: bool) -> FloatArray:
    """Return the fraction of a way (frames,) at each frame.

    One that ends where it began is gone at an even speed, and its end is left out: shown again and again, it does not
    halt.
    """
    return np.arange(frames) / frames if is_loop else eased(np.linspace(0, 1, frames))


def angles(turn: float, is_swing: bool, frames: int) -> FloatArray:
    """Return by how many degrees (frames,) the shape is turned in each frame."""
    if is_swing:
        return turn / 2 * np.sin(2 * np.pi * way(frames, is_loop=True))
    return turn * way(frames, is_loop=turn % 360 == 0)


def span(turn: float, is_swing: bool) -> tuple[float, float]:
    """Return the least and the largest of all angles between frames, in degrees."""
    return (-abs(turn) / 2, abs(turn) / 2) if is_swing else (min(turn, 0.0), max(turn, 0.0))


@dataclass(frozen=True)
class Sweep:
    """The values that a parameter takes in turn.

    Attributes
    ----------
    name
        The parameter's name.
    stops
        Values in words.
    is_range
        Whether it goes evenly from each value to the next, in equal ratios if the parameter is logarithmic, or stays at
        each for as many frames.
    """

    name: str
    stops: tuple[str, ...]
    is_range: bool

    @staticmethod
    def parse(text: str) -> Sweep:
        """Read "t=4..1/60", a range, or "t=4,1,1/4"; ParameterError for another text."""
        name, _, values = (word.strip() for word in text.partition("="))
        is_range = ".." in values
        stops = tuple(word.strip() for word in values.split(".." if is_range else ","))
        if not name or len(stops) < 2 or not all(stops):
            raise ParameterError(f"A sweep is a range like t=4..1/60 or values like t=4,1,1/4, not {text!r}.")
        return Sweep(name, stops, is_range)

    def values(self, parameter: Parameter, frames: int) -> list[Value]:
        """Return the value in each frame; ParameterError for one that is not allowed."""
        stops = [parameter.parsed(stop) for stop in self.stops]
        if not self.is_range:
            return [stops[k * len(stops) // frames] for k in range(frames)]
        if parameter.choices:
            raise ParameterError(f"{self.name} has no range; name some of {', '.join(parameter.choices)}.")
        # Slow at each value that is named, as it is looked at.
        place = (len(stops) - 1) * np.linspace(0, 1, frames, endpoint=stops[0] != stops[-1])
        leg = np.minimum(place.astype(int), len(stops) - 2)
        numbers, share = np.array(stops, float), eased(place - leg)
        low, high = numbers[leg], numbers[leg + 1]
        found = low * (high / low) ** share if parameter.logarithmic else low + (high - low) * share
        return [parameter.checked(round(value) if parameter.is_whole else value) for value in found.tolist()]


def with_digits(label: str, value: Value) -> str:
    """Return a label that holds a value with as many digits as all others have: "t = 0.250", "λ^1.50"."""
    if not isinstance(value, float):
        return label
    words = f"{value:#.{DIGITS}g}".rstrip(".")
    return re.sub(rf"(= |\^){re.escape(f'{value:g}')}(?![\d.])", rf"\g<1>{words}", label)
