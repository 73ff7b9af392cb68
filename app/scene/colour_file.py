"""Colour maps from files: rows of numbers, and ParaView's JSON."""

import os
import re
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core.errors import ParameterError
from bihdist_core.file_content import file_text, json_value
from bihdist_core.sentences import shortened

from ..document.looks import Colours, Stops
from ..document.synonyms import COLOUR_MAPS
from .colour_maps import MAPS

MOST_COLOURS = 1024
MOST_BYTES = 1 << 24

WAY = 65
"""Colours that stand for a way between stops which is not straight in red, green and blue."""

READ_AS = 'rows of "red green blue" (0 to 1, or 0 to 255) or "place red green blue", or ParaView\'s .json'


def colours_named(text: str, now: Colours | None = None) -> Colours:
    """Return the map that a word or a file means, reversed and in bands as now; ParameterError if it is neither."""
    now = now or Colours()
    base = text.lower().removesuffix("_r")
    if base in COLOUR_MAPS:
        return Colours(COLOUR_MAPS[base], (), now.reversed or text.lower() != base, now.bands)
    if text in MAPS or not text:
        return Colours(text, (), now.reversed, now.bands)
    if not os.path.exists(text):
        raise ParameterError(f"There is no colour map {text!r}, and no such file; choose one of {', '.join(MAPS)}.")
    return Colours(Path(text).stem, read_stops(text), now.reversed, now.bands)


def read_stops(path: str | os.PathLike[str]) -> Stops:
    """Return the stops in a file; ParameterError that names the file, the line and what is wrong there."""
    text = file_text(path, "colours", MOST_BYTES)
    try:
        return _of_json(text) if str(path).lower().endswith(".json") else _of_rows(text)
    except ParameterError as error:
        raise ParameterError(f"{path}{error}") from None


# ---------------------------------------------------------------------- rows of numbers
def _of_rows(text: str) -> Stops:
    rows: list[tuple[int, list[float]]] = []
    is_first = True
    for number, line in enumerate(text.splitlines(), 1):
        words = [word for word in re.split(r"[\s,;]+", line.partition("#")[0]) if word]
        if not words:
            continue
        values = [_number(word.strip("\"'")) for word in words]
        is_heading = is_first and all(value is None for value in values)
        is_first = False
        if is_heading:
            continue
        for word, value in zip(words, values, strict=True):
            if value is None:
                raise ParameterError(
                    f", line {number}: {shortened(repr(word), 60)} is not a number; colours are {READ_AS}."
                )
        if len(values) not in (3, 4) or (rows and len(values) != len(rows[0][1])):
            wanted = f"{len(rows[0][1])} as above" if rows else "3 or 4"
            raise ParameterError(f", line {number}: there are {len(values)} numbers, not {wanted}; {READ_AS}.")
        rows.append((number, [value for value in values if value is not None]))
    return _stops(rows)


def _number(word: str) -> float | None:
    try:
        value = float(word)
    except ValueError:
        return None
    return value if np.isfinite(value) else None


def _stops(rows: list[tuple[int, list[float]]]) -> Stops:
    """Return the stops from lines by their numbers, each with three or four values."""
    if not 2 <= len(rows) <= MOST_COLOURS:
        raise ParameterError(f": there are {len(rows)} colours; a map has 2 to {MOST_COLOURS}, as {READ_AS}.")
    largest = max(max(values[-3:]) for _, values in rows)
    # Up to 2 of 255 all would be black: somebody meant 1.
    whole = 255.0 if largest > 2 else 1.0
    for number, values in rows:
        for value in values[-3:]:
            if not 0 <= value <= whole:
                raise ParameterError(f", line {number}: {value:g} is not a part of a colour, from 0 to {whole:g}.")
    if len(rows[0][1]) == 3:
        places = np.linspace(0, 1, len(rows)).tolist()
    else:
        given = [values[0] for _, values in rows]
        for (number, _), before, after in zip(rows[1:], given[:-1], given[1:], strict=True):
            if after < before:
                raise ParameterError(f", line {number}: the place {after:g} is not beyond {before:g} above it.")
        if given[-1] == given[0]:
            raise ParameterError(f", line {rows[-1][0]}: all places are {given[0]:g}.")
        places = [(place - given[0]) / (given[-1] - given[0]) for place in given]
    colours = [(values[-3] / whole, values[-2] / whole, values[-1] / whole) for _, values in rows]
    return tuple(zip(places, colours, strict=True))


# ---------------------------------------------------------------------- ParaView
def _of_json(text: str) -> Stops:
    try:
        data: Any = json_value(text)
    except ParameterError as error:
        raise ParameterError(f": {error}") from None
    maps = [each for each in (data if isinstance(data, list) else [data]) if isinstance(each, dict)]
    maps = [each for each in maps if "RGBPoints" in each]
    if len(maps) != 1:
        names = ", ".join(str(each.get("Name", "without a name")) for each in maps)
        found = f"has {len(maps)} colour maps ({names}); keep one of them" if maps else "has no RGBPoints"
        raise ParameterError(f" {found}; ParaView writes one colour map with RGBPoints.")
    numbers = maps[0]["RGBPoints"]
    is_flat = isinstance(numbers, list) and all(type(x) in (int, float) and abs(x) < 1e300 for x in numbers)
    if not is_flat or len(numbers) % 4:
        raise ParameterError(": RGBPoints is not a list of numbers, four for each colour.")
    rows = [(k // 4 + 1, [float(x) for x in numbers[k : k + 4]]) for k in range(0, len(numbers), 4)]
    for number, values in rows:
        if not all(0 <= value <= 1 for value in values[1:]):
            raise ParameterError(f": colour {number} of RGBPoints, {values[1:]}, is not from 0 to 1.")
    if [values[0] for _, values in rows] != sorted(values[0] for _, values in rows):
        raise ParameterError(": the places in RGBPoints do not go up.")
    return _along(_stops(rows), str(maps[0].get("ColorSpace", "RGB")))


def _along(stops: Stops, space: str) -> Stops:
    """Add colours between stops, where the interpolation is linear in another colour space."""
    if space == "RGB":
        return stops
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

    way = vtkColorTransferFunction()
    choose = getattr(way, f"SetColorSpaceTo{space}", None) if space.isalnum() else None
    if choose is None:
        raise ParameterError(f": the ColorSpace {space!r} is not one of ParaView's.")
    choose()
    for place, colour in stops:
        way.AddRGBPoint(place, *colour)
    places = sorted({*(place for place, _ in stops), *np.linspace(0, 1, WAY).tolist()})
    # Rounding in other spaces may leave the range by a hair.
    return tuple((place, tuple(min(max(x, 0.0), 1.0) for x in way.GetColor(place))) for place in places)  # type: ignore[misc]
