"""The scene of a page, as the JSON that its viewer reads."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.vertex_arrays import VertexArray
from bihdist_core.version import VERSION

from ..citation import bibtex
from ..document.camera import Camera, View
from ..document.document import Document, Panel
from ..document.looks import MOST_ISOLINES, Colours, Isolines
from ..document.on_surface import Hidden
from ..document.page import Recipe
from ..document.quantities import own_fields
from ..document.shared_parts.pins import Pins
from ..drawing.glyphs import DISC, PIN, SCREEN_NUMERAL, glyph_shapes, ring_shapes
from ..drawing.painters.page import OWN, to_json
from ..drawing.shapes import RGBA, opaque
from ..figures.description import Figure, FigurePanel
from ..figures.export import Surfaces, figure_of
from ..scene.camera import outwards_at, standard_camera
from ..scene.clipping import clip_plane
from ..scene.drawable import crease_of
from ..scene.style import PINS, Style, style_of
from ..session.questions import first_source, vertex_at
from .contents import Contents, notes_on

Json = dict[str, Any]

COLOURS = 256
"""Number of colours of a colour map."""

SOURCE_SIZE = 13.0
"""Diameter of the source's mark, in logical pixels."""

MAXIMUM_FACTOR = 4
"""Isolines of a given spacing are listed up to this many times the maximum, which is larger from other sources."""

BY_DAY, BY_NIGHT = {"dark": "paper"}, {"paper": "dark"}
"""Styles that are replaced on a light and on a dark page; others stay."""


def scene_of(
    recipe: Recipe,
    contents: Contents,
    surfaces: Surfaces,
    answers: Sequence[Answer],
    stored: Mapping[str, object],
    credit: str = "",
) -> Json:
    """Return the scene of a recipe.

    Parameters
    ----------
    recipe : Recipe
        What to show; its document is that of the contents.
    contents : Contents
        The distances under the page's names.
    surfaces, answers
        The meshes by name, and the answers of the panels.
    stored : mapping
        More about the mesh: `counts` of its vertices and faces; `operator`, what it is if not by cotangents of the
        faces; `bits` of a coordinate; `backs`, whether its inside can be seen; `differs`, by how much
        each distance differs from that on the original, as a fraction of its maximum; `sources`, the number of sources
        for which that was computed.
    credit : str
        Shown under the panels.

    Raises
    ------
    ParameterError
        If a panel has no field, or a number is not finite.
    """
    document = recipe.document
    for panel, answer in zip(document.panels, answers, strict=True):
        if answer.field is None and answer.labels is None:
            raise ParameterError(f"The panel {panel.shows} has no field: {answer.failure}")
    figure = figure_of(replace(recipe, page=replace(recipe.page, rows="", chart="")), surfaces, answers)
    surface = surfaces[document.surfaces[0].name].surface
    source = contents.source if contents.source is not None else first_source(surface, document.up)
    pins, notes = _pins(document, surface)
    notes += [f"{_text(own.name)} is a field of the user's own, the same from every source." for own in contents.own]
    if any(_ends_with_others(figure, k) for k in range(len(figure.panels))):
        notes.append(f"Colour bars of one unit end at their largest maximum from vertex {source}.")
    first = min(figure.panels, key=lambda each: (each.field is None, each.signed))
    style = style_of(recipe.page.style, document.colours)
    clip = clip_plane(document.clip, surface)
    scene = {
        "title": f"Distances on {_text(surface.name)}",
        "credit": _text(credit),
        "version": VERSION,
        "cite": bibtex(),
        "mesh": {
            "name": _text(surface.name),
            "unit": "mesh units",
            **stored,
        },
        "panels": [
            _panel(contents, panel, figure, k, answers[k], first) for k, panel in enumerate(contents.document.panels)
        ],
        "offered": [],
        "source": source,
        "pins": pins,
        "marks": _marks(style),
        "camera": _camera(figure.panels[0], surface),
        "colours": _colours(recipe.page.style, document.colours),
        "isolines": {**_isolines(first), "colour": _bytes(style.isoline), "width": style.isoline_width},
        "crease": crease_of(surface, document.shading),
        "clip": None if clip is None else [*clip.normal, clip.offset],
        "opacity": document.opacity,
        "areas": document.areas,
        "notes": [*_of_surface(surface), *notes_on(document, len(figure.panels[0].views)), *notes],
    }
    _check_numbers(scene, "the scene")
    return scene


def _of_surface(surface: Surface) -> list[str]:
    """Return sentences on repairs of the mesh, and warnings about it."""
    found = surface_notes(surface)
    return [f"{_text(surface.name)}: {text}" for text in (*found.repairs, *found.warnings)]


def _panel(contents: Contents, panel: Panel, figure: Figure, k: int, answer: Answer, usual: FigurePanel) -> Json:
    """Return the record of panel k; `usual` is the panel whose isolines the scene has."""
    shown = figure.panels[k]
    names = list(map(contents.name_of, panel.shows.parts))
    is_difference = len(names) > 1
    end = _end(figure, k)
    range = None if end is None else [-end if answer.is_signed else 0.0, end]
    labels = [] if answer.labels is None else _labels(answer.labels)
    lines = _isolines(shown)
    return {
        "distance": "difference" if is_difference else names[0],
        **({"of": names} if is_difference else {}),
        "label": answer.label,
        "parameters": {} if is_difference else _parameters(panel.shows.specs),
        "signed": answer.is_signed,
        "note": _note(panel),
        "range": [-0.5, len(labels) - 0.5] if labels else range,
        "unit": answer.unit,
        "shares": figure.is_in_shares(k),
        **({"labels": labels} if labels else {}),
        # Those of differences are in percentage points, where others are in mesh units.
        **({"isolines": lines} if lines != _isolines(usual) else {}),
    }


def _labels(labels: VertexArray) -> list[Json]:
    """Return the names and colours of the labels that vertices have, in the order of their table."""
    assert labels.colours is not None
    there = np.flatnonzero(labels.counts).tolist()
    return [{"name": _text(labels.names[k]), "colour": _bytes(labels.colours[k])} for k in there]


def offered_panel(name: str, spec: Spec, label: str, unit: str, range: str) -> Json:
    """Return a panel of a distance that the reader has chosen; its colour bar ends at its own maximum."""
    return {
        "distance": name,
        "label": label,
        "parameters": _parameters([spec]),
        "signed": False,
        "note": "",
        "range": None,
        "unit": unit,
        "shares": range == "fraction",
    }


def _parameters(specs: Iterable[Spec]) -> Json:
    return {"time" if name == "t" else name: value for spec in specs for name, value in spec.values}


def _note(panel: Panel) -> str:
    """Return the note on a panel of which a part does not depend on the source."""
    own = own_fields(panel.shows)
    if not own:
        return ""
    return f"{_text(own[0].name)} is the same from every source" if panel.shows.points else "the same from every source"


def _end(figure: Figure, k: int) -> float | None:
    """Return the upper colour limit from all sources, None for the field's own maximum from each source."""
    shown = figure.panels[k]
    if shown.maximum is not None:
        return shown.maximum
    return figure.upper_limits()[k] if _ends_with_others(figure, k) else None


def _ends_with_others(figure: Figure, k: int) -> bool:
    if figure.range == "own" or figure.is_in_shares(k):
        return False
    kinds = [(panel.unit, panel.signed) for panel in figure.panels]
    return kinds.count(kinds[k]) > 1


def _isolines(panel: FigurePanel) -> Json:
    """Return the number of isolines or their values; with `equal`, the number of equal steps up to the colour limit."""
    lines: Isolines = panel.isolines
    if panel.field is None:
        return {"count": 0, "values": None, "equal": False}
    if lines.spacing is not None:
        most = min(math.floor(MAXIMUM_FACTOR * panel.own_maximum / lines.spacing), MOST_ISOLINES // 2)
        steps = range(-most if panel.signed else 1, most + 1)
        return {"count": None, "values": [float(f"{k * lines.spacing:.12g}") for k in steps], "equal": False}
    if lines.values:
        return {"count": None, "values": list(lines.values), "equal": False}
    return {"count": lines.count, "values": None, "equal": not lines.round}


def _pins(document: Document, surface: Surface) -> tuple[list[Json], list[str]]:
    """Return the visible pins, and notes on pins that move to a vertex or get another number on a page."""
    shown = [pin for pin in document[Pins].pins if not document[Hidden].hides(["pins"], pin.point)]
    pins, notes = [], []
    if shown != list(document[Pins].pins[: len(shown)]):
        notes.append("Pins after those that are hidden have lower numbers on this page.")
    for number, pin in enumerate(shown, 1):
        at = document.point(pin.point).at
        vertex = vertex_at(at, surface)
        if not isinstance(at, int):
            notes.append(f"Pin {number} is in a face; on this page it is at the nearest corner, vertex {vertex}.")
        pins.append({"id": vertex, "name": _text(pin.name)})
    return pins, notes


def _marks(style: Style) -> Json:
    """Return the shapes of marks about their places, and the colours of pins in turn."""

    def colour_of(name: str) -> RGBA:
        return OWN if name == "own" else opaque(style.named(name))

    at = 0.0, 0.0
    source = glyph_shapes(DISC, at, DISC.reach_of(SOURCE_SIZE, 0.0), style.named_for("source"))
    pin = glyph_shapes(PIN, at, PIN.pixels, colour_of, 1, PIN.screen, numerals=SCREEN_NUMERAL)
    ring, echo = (ring_shapes(at, is_own) for is_own in (True, False))
    shapes = {"source": source, "pin": pin, "ring": ring, "echo": echo}
    return {**{name: to_json(each) for name, each in shapes.items()}, "colours": list(PINS)}


def _camera(panel: FigurePanel, surface: Surface) -> Json:
    """Return the camera of the first view; what it shows is visible in a panel of any aspect ratio."""
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
    """Return the colours of the page in light and, where they differ, in dark; the reader's system chooses."""
    light, dark = (style_of(twins.get(word, word), colours) for twins in (BY_DAY, BY_NIGHT))
    by_day, by_night = (_map(style.colours(COLOURS)) for style in (light, dark))
    return {
        "map": by_day,
        "dark_map": None if by_night == by_day else by_night,
        "diverging": _map(light.colours(COLOURS, signed=True)),
        "undefined": _bytes(light.undefined),
        "back": _bytes(light.back),
        "dark_back": _bytes(dark.back),
        "section": _bytes(light.section),
        "dark_section": _bytes(dark.section),
        "background": None,
        "dark_background": None,
    }


def _map(colours: FloatArray) -> list[list[int]]:
    rounded: list[list[int]] = np.rint(255 * colours).astype(int).tolist()
    return rounded


def _bytes(colour: Iterable[float]) -> list[int]:
    return [round(255 * part) for part in colour]


def _text(text: str) -> str:
    """Return a text with a replacement character for each one that cannot be printed."""
    return "".join(character if character.isprintable() else "�" for character in text)


def _check_numbers(value: object, where: str) -> None:
    """Raise ParameterError, with the place, for a number that is not finite."""
    if isinstance(value, Mapping):
        for name, each in value.items():
            _check_numbers(each, f"{where}.{name}")
    elif isinstance(value, list | tuple):
        for k, each in enumerate(value):
            _check_numbers(each, f"{where}[{k}]")
    elif isinstance(value, float) and not math.isfinite(value):
        raise ParameterError(f"A page needs finite numbers, and {where} is {value!r}.")
