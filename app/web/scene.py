"""What a page shows, as the JSON that its viewer reads: plain texts, finite numbers, the vertex ids of the file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ..document.camera import Camera, View
from ..document.document import Document, Panel
from ..document.looks import MOST_ISOLINES, Colours, Isolines
from ..document.page import Recipe
from ..document.quantities import own_fields
from ..document.shared_parts.pins import Pins
from ..figures.description import Figure, FigurePanel
from ..figures.export import Surfaces, figure_of
from ..scene.camera import outwards_at, standard_camera
from ..scene.drawable import crease_of
from ..scene.style import style_of
from ..session.questions import first_source, vertex_at
from .contents import Contents, notes_on

Json = dict[str, Any]

COLOURS = 256
"""Of a map, from one end to the other."""

BEYOND = 4
"""Isolines of a given spacing are listed up to so many times the maximum: from other sources it is larger."""

BY_DAY, BY_NIGHT = {"dark": "paper"}, {"paper": "dark"}
"""The styles that another one takes the place of on the other ground; the rest stay as they are."""


def scene_of(
    recipe: Recipe,
    contents: Contents,
    surfaces: Surfaces,
    answers: Sequence[Answer],
    stored: Mapping[str, object],
) -> Json:
    """The scene of a recipe whose document is that of the contents, with the answers of its panels.

    stored: what is said of the mesh beside its name and size: `bits`; `backs`, whether an inside can be seen; and
    `differs`, by how much each distance differs from that on the original, as a fraction of its maximum.
    ParameterError for a panel without a field, and for a number that is not finite.
    """
    document = recipe.document
    for panel, answer in zip(document.panels, answers, strict=True):
        if answer.field is None:
            raise ParameterError(f"The panel {panel.shows} has no field: {answer.failure}")
    figure = figure_of(recipe, surfaces, answers)
    surface = surfaces[document.surfaces[0].name].surface
    source = contents.source if contents.source is not None else first_source(surface, document.up)
    pins, notes = _pins(document, surface)
    notes += [f"{_text(own.name)} was given as it is: it stays the same from every source." for own in contents.own]
    if any(_ends_with_others(figure, k) for k in range(len(figure.panels))):
        notes.append(f"Colour bars of one unit end where the largest does from vertex {source}.")
    first = next((each for each in figure.panels if not each.signed), figure.panels[0])
    style = style_of(recipe.page.style, document.colours)
    scene = {
        "title": f"Distances on {_text(surface.name)}",
        "mesh": {
            "name": _text(surface.name),
            "vertices": int((surface.component_of_vertex >= 0).sum()),
            "faces": len(surface.faces),
            "unit": "mesh units",
            **stored,
        },
        "panels": [
            _panel(contents, panel, figure, k, answers[k], first) for k, panel in enumerate(contents.document.panels)
        ],
        "source": source,
        "pins": pins,
        "camera": _camera(figure.panels[0], surface),
        "colours": _colours(recipe.page.style, document.colours),
        "isolines": {**_isolines(first), "colour": _bytes(style.isoline), "width": style.isoline_width},
        "crease": crease_of(surface, document.shading),
        "areas": document.areas,
        "notes": [*_of_surface(surface), *notes_on(document, len(figure.panels[0].views)), *notes],
    }
    _check_numbers(scene, "the scene")
    return scene


def _of_surface(surface: Surface) -> list[str]:
    """What was done to the mesh on reading, and what is to be minded about it."""
    found = surface_notes(surface)
    return [f"{_text(surface.name)}: {text}" for text in (*found.repairs, *found.warnings)]


def _panel(contents: Contents, panel: Panel, figure: Figure, k: int, answer: Answer, usual: FigurePanel) -> Json:
    """usual: the panel whose isolines those of the scene are."""
    shown = figure.panels[k]
    names = list(map(contents.name_of, panel.shows.parts))
    is_difference = len(names) > 1
    end = _end(figure, k)
    lines = _isolines(shown)
    return {
        "distance": "difference" if is_difference else names[0],
        **({"of": names} if is_difference else {}),
        "label": answer.label,
        "parameters": {} if is_difference else _parameters(panel),
        "signed": answer.is_signed,
        "note": _note(panel),
        "range": None if end is None else [-end if answer.is_signed else 0.0, end],
        "unit": answer.unit,
        "shares": figure.is_in_shares(k),
        # Those of differences are in percentage points, where others are in mesh units.
        **({"isolines": lines} if lines != _isolines(usual) else {}),
    }


def _parameters(panel: Panel) -> Json:
    return {"time" if name == "t" else name: value for spec in panel.shows.specs for name, value in spec.values}


def _note(panel: Panel) -> str:
    """What of a panel does not move with the source."""
    own = own_fields(panel.shows)
    if not own:
        return ""
    return f"{_text(own[0].name)} is the same from every source" if panel.shows.points else "the same from every source"


def _end(figure: Figure, k: int) -> float | None:
    """Where the colour bar ends from any source; None if at the field's own maximum from each."""
    shown = figure.panels[k]
    if shown.maximum is not None:
        return shown.maximum
    return figure.tops()[k] if _ends_with_others(figure, k) else None


def _ends_with_others(figure: Figure, k: int) -> bool:
    if figure.range == "own" or figure.is_in_shares(k):
        return False
    kinds = [(panel.unit, panel.signed) for panel in figure.panels]
    return kinds.count(kinds[k]) > 1


def _isolines(panel: FigurePanel) -> Json:
    """About so many, or values; equal: so many equal steps from 0 to the end of the colour bar."""
    lines: Isolines = panel.isolines
    if lines.spacing is not None:
        most = min(math.floor(BEYOND * panel.own_top / lines.spacing), MOST_ISOLINES // 2)
        steps = range(-most if panel.signed else 1, most + 1)
        return {"count": None, "values": [float(f"{k * lines.spacing:.12g}") for k in steps], "equal": False}
    if lines.values:
        return {"count": None, "values": list(lines.values), "equal": False}
    return {"count": lines.count, "values": None, "equal": not lines.round}


def _pins(document: Document, surface: Surface) -> tuple[list[Json], list[str]]:
    """The pins, and sentences on those that stand elsewhere on a page."""
    pins, notes = [], []
    for number, pin in enumerate(document[Pins].pins, 1):
        at = document.point(pin.point).at
        vertex = vertex_at(at, surface)
        if not isinstance(at, int):
            notes.append(f"Pin {number} is in a face; on this page it is at the nearest corner, vertex {vertex}.")
        pins.append({"id": vertex, "name": _text(pin.name)})
    return pins, notes


def _camera(panel: FigurePanel, surface: Surface) -> Json:
    """That of the first view; what it is sure to see is seen of a panel of any form."""
    view: View = panel.views[0]
    if isinstance(view, str):
        points = surface.vertices[surface.component_of_vertex >= 0]
        outwards = None if panel.source is None else outwards_at(surface, panel.source)
        view = standard_camera(points, 1.0, view, up=panel.up, outwards=outwards, is_parallel=panel.is_parallel)
    camera: Camera = view
    high = camera.extent[1]
    distance = math.dist(camera.position, camera.focal_point)
    return {
        "position": list(camera.position),
        "focal": list(camera.focal_point),
        "up": list(camera.up),
        "angle": math.degrees(2 * math.atan(high)),
        "parallel": high * distance if panel.is_parallel else None,
    }


def _colours(word: str, colours: Colours) -> Json:
    """Of the page by day and, where these are others, by night; the ground is that of the reader's system."""
    light, dark = (style_of(twins.get(word, word), colours) for twins in (BY_DAY, BY_NIGHT))
    by_day, by_night = (_map(style.colours(COLOURS)) for style in (light, dark))
    return {
        "map": by_day,
        "dark_map": None if by_night == by_day else by_night,
        "diverging": _map(light.colours(COLOURS, signed=True)),
        "undefined": _bytes(light.undefined),
        "back": _bytes(light.back),
        "dark_back": _bytes(dark.back),
        "background": None,
        "dark_background": None,
    }


def _map(colours: FloatArray) -> list[list[int]]:
    rounded: list[list[int]] = np.rint(255 * colours).astype(int).tolist()
    return rounded


def _bytes(colour: Iterable[float]) -> list[int]:
    return [round(255 * share) for share in colour]


def _text(text: str) -> str:
    """What can be printed of a text."""
    return "".join(letter if letter.isprintable() else "�" for letter in text)


def _check_numbers(value: object, where: str) -> None:
    """ParameterError, with the place, for a number that is not finite."""
    if isinstance(value, Mapping):
        for name, each in value.items():
            _check_numbers(each, f"{where}.{name}")
    elif isinstance(value, list | tuple):
        for k, each in enumerate(value):
            _check_numbers(each, f"{where}[{k}]")
    elif isinstance(value, float) and not math.isfinite(value):
        raise ParameterError(f"A page has finite numbers only, and {where} is {value!r}.")
