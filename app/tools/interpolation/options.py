"""Anchors and their weights as figures and commands are told of them, in words or by a file."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bihdist_core.errors import ParameterError

from ...document.document import Point, free_names
from ...document.lists import file_in, split_list, standard_input
from ...document.option import NotExpressible, Option, Row, attribute, digits, unsaid, vertex_of
from ...document.page import Recipe
from ...document.removal import without_orphans
from .part import Anchor, Anchors

if TYPE_CHECKING:
    from bihdist_core.formats.anchors import Anchors as FileAnchors
    from bihdist_core.surface import Surface

Marks = list[tuple[int, float | None]]


@dataclass(frozen=True)
class AnchorFile:
    """A file of anchors, or the text of standard input."""

    path: str
    text: str = ""

    def read(self, surface: "Surface") -> "FileAnchors":
        """Return its anchors at vertices of a surface; ParameterError as `read_anchors`."""
        from bihdist_core.formats.anchors import anchors_at, read_anchors
        from bihdist_core.formats.landmarks import LANDMARKS
        from bihdist_core.formats.pins import picked_from, pins_format

        if not self.text:
            return read_anchors(self.path, surface)
        format = pins_format(self.text) or ".csv"
        return anchors_at(picked_from(self.text, self.path, format), surface, format in LANDMARKS)


def anchors_from_words(text: str) -> Marks | AnchorFile:
    """Return vertices, some with a value, from `12=0,40`, @FILE, or - for standard input; ParameterError for other
    words."""
    path = file_in(text)
    if path:
        return AnchorFile("standard input", standard_input("anchors")) if path == "-" else AnchorFile(path)
    found: Marks = []
    for word in split_list(text):
        vertex, _, value = word.partition("=")
        try:
            found.append((int(vertex), float(value) if value else None))
            if value and not math.isfinite(float(value)):
                raise ValueError
        except ValueError:
            raise ParameterError(f"{word!r} is not a vertex id, or one with a value such as 12=0.5") from None
    return found


def anchors_on(asked: Marks | AnchorFile, surface: "Surface") -> "FileAnchors":
    """Return the anchors on a surface; ParameterError for one without a value, VertexError for one that is not
    there."""
    import numpy as np

    from bihdist_core.formats.anchors import Anchors as FileAnchors

    if isinstance(asked, AnchorFile):
        return asked.read(surface)
    seen: set[int] = set()
    for vertex, value in asked:
        if value is None:
            raise ParameterError(f"Anchor {vertex} has no value; write {vertex}=0.5, say.")
        if vertex in seen:
            raise ParameterError(f"Vertex {vertex} is named twice among the anchors.")
        seen.add(vertex)
    vertices = surface.check_vertices([vertex for vertex, _ in asked])
    values = np.array([value for _, value in asked], float)
    return FileAnchors(vertices, values, ("",) * len(asked), np.zeros(len(asked)))


def _anchors_of(recipe: Recipe) -> dict[str, Any]:
    document, anchors = recipe.document, recipe.document[Anchors].anchors
    marks = [(vertex_of(document.point(anchor.point)), anchor.value) for anchor in anchors]
    if len(dict(marks)) < len(marks) or None in dict(marks):
        raise NotExpressible("Two anchors are at one vertex, or one has not been placed.")
    if any(anchor.left_out for anchor in anchors):
        raise NotExpressible("An anchor is left out.")
    return {"anchors": dict(marks)} if marks else {}


def _with_anchors(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    document, marks = recipe.document, values["anchors"]
    if len(document.surfaces) != 1:
        raise ParameterError(f"--anchors are on one mesh, and this recipe has {len(document.surfaces)}.")
    if isinstance(marks, AnchorFile):
        from ...samples import mesh_path
        from ...session.chosen_sources import warn_of
        from ...session.repaired_surface import read_repaired

        mesh = document.surfaces[0]
        found = marks.read(read_repaired(mesh_path(mesh.path), mesh.repairs))
        warn_of(marks.path, found.facts)
        marks = dict(zip(found.vertices.tolist(), found.values.tolist(), strict=True))
    marks = marks.items() if isinstance(marks, Mapping) else [m if isinstance(m, tuple) else (m, None) for m in marks]
    document = without_orphans(document, document.with_changed(Anchors, anchors=()))
    names = free_names("anchor", len(marks), [point.name for point in document.points])
    surface = document.surfaces[0].name
    points = (Point(name, vertex, surface) for name, (vertex, _) in zip(names, marks, strict=True))
    anchors = tuple(Anchor(name, value) for name, (_, value) in zip(names, marks, strict=True))
    document = document.with_part(replace(document[Anchors], anchors=anchors), points=(*document.points, *points))
    return replace(recipe, document=document)


def _anchors_text(marks: Mapping[int, float | None]) -> str:
    return ",".join(f"{vertex}" if value is None else f"{vertex}={digits(value)}" for vertex, value in marks.items())


def _weights_of(recipe: Recipe) -> dict[str, Any]:
    weights, usual = recipe.document[Anchors].weights, Anchors().weights
    names = [name for name in ("exponent", "smoothness") if getattr(weights, name) != getattr(usual, name)]
    return {name: getattr(weights, name) for name in names}


def _with_weights(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    weights = replace(recipe.document[Anchors].weights, **values)
    return replace(recipe, document=recipe.document.with_changed(Anchors, weights=weights))


ROWS = (
    Row(
        (
            Option(
                "anchors",
                "mark vertices, coloured by a value (12=0,40=1), or those of a file, @FILE, or - for standard input",
                (),
                metavar="V[=VALUE],…|@FILE",
                read=anchors_from_words,
                write=_anchors_text,
            ),
        ),
        ("Anchors.anchors", "Anchor.point", "Anchor.value", "Anchor.left_out"),
        _anchors_of,
        _with_anchors,
    ),
    attribute("page.anchor_values", "write the values of anchors next to them (default: no)"),
    Row(
        (
            Option(
                "exponent",
                "the exponent of anchors' weights in interpolants (default: 1)",
                1.0,
                metavar="P",
                read=float,
            ),
            Option(
                "smoothness",
                "how far anchors' cones are rounded in interpolants, 0 to 1 (default: 0)",
                0.0,
                metavar="S",
                read=float,
            ),
        ),
        ("Anchors.weights",),
        _weights_of,
        _with_weights,
    ),
    unsaid("figures show colours", "Anchor.name"),
)
