"""The pins of a document on a surface: where they are, their values in the panels, and both as text."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import Surface, SurfacePoint
from bihdist_core.analysis.places import weighted
from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.answers import Answer
from bihdist_core.formats import pins as pin_files
from bihdist_core.sources.words import words_of

from ...document.document import Document
from ...document.shared_parts.pins import Pin, Pins, add_pins, change_pin
from ...session.questions import pieces_at


@dataclass(frozen=True, eq=False)
class LocatedPin:
    """A pin on a surface, numbered from 1 in the order of the document.

    It is at a vertex or, if `vertex` is None, in a face with corners (3,) and weights (3,).
    """

    number: int
    pin: Pin
    vertex: int | None
    face: int
    corners: IntArray
    weights: FloatArray

    @property
    def point(self) -> str:
        """The name of its point in the document."""
        return self.pin.point

    @property
    def at(self) -> int | SurfacePoint:
        """The vertex, or the point in the face."""
        if self.vertex is not None:
            return self.vertex
        first, second, third = self.weights.tolist()
        return SurfacePoint(self.face, (first, second, third))

    @property
    def words(self) -> str:
        """The vertex or the face, in few characters."""
        return str(self.vertex) if self.vertex is not None else f"f{self.face}"

    @property
    def name(self) -> str:
        """The name for the user, the number if there is none."""
        return self.pin.name or str(self.number)

    def position(self, vertices: FloatArray) -> FloatArray:
        """Return the position (3,) among the vertices (n, 3)."""
        at: FloatArray = vertices[self.vertex] if self.vertex is not None else self.weights @ vertices[self.corners]
        return at

    def value(self, field: FloatArray) -> float:
        """Return the value of a field (n,), linear in the face; NaN where it is undefined."""
        return float(weighted(field, self.corners[None], self.weights[None])[0])


def located_pins(document: Document, name: str, surface: Surface) -> tuple[LocatedPin, ...]:
    """Return the pins on a surface; a source with several places counts at its first."""
    found = []
    for number, pin in enumerate(document[Pins].pins, 1):
        point = document.point(pin.point)
        if point.surface != name:
            continue
        if isinstance(point.at, int):
            vertex, face, corners, weights = point.at, -1, np.array([point.at] * 3), np.array([1.0, 0.0, 0.0])
        else:
            pieces = pieces_at(point.at, surface)
            vertex, face, corners, weights = None, int(pieces.faces[0]), pieces.corners[0], pieces.start[0]
            if not isinstance(point.at, SurfacePoint) and weights.max() == 1:
                vertex = int(corners[weights.argmax()])
        found.append(LocatedPin(number, pin, vertex, face, corners, weights))
    return tuple(found)


def pins_to_write(places: Sequence[LocatedPin], surface: Surface) -> pin_files.Pins:
    """Return the pins for a file, which has vertices only, each at its nearest corner, with how far that is.

    Ids are the numbers that the window shows. Raises ParameterError if there are none.
    """
    vertices, moved = [], []
    for place in places:
        away = np.linalg.norm(surface.vertices[place.corners] - place.position(surface.vertices), axis=1)
        vertices.append(int(place.corners[away.argmin()]) if place.vertex is None else place.vertex)
        moved.append(float(away.min()) if place.vertex is None else 0.0)
    pins = pin_files.Pins.of(
        surface, vertices, [place.pin.name for place in places], [place.number for place in places]
    )
    return replace(pins, moved=np.array(moved))


def with_pins(document: Document, pins: pin_files.Pins, surface: str = "A") -> Document:
    """Return the document with the pins of a file, under their names."""
    document = add_pins(document, [int(vertex) for vertex in pins.vertices], surface)
    names = dict(zip(pins.vertices.tolist(), pins.names, strict=True))
    for pin in document[Pins].pins:
        point = document.point(pin.point)
        name = names.get(point.at, "") if isinstance(point.at, int) and point.surface == surface else ""
        if name and name != pin.name:
            document = change_pin(document, replace(pin, name=name))
    return document


def pins_text(places: Sequence[LocatedPin], surface: Surface, answers: Sequence[tuple[str, Answer]]) -> str:
    """Return a table of pins with tabs: number, name, vertex, position, and each answer's value and fraction of the
    maximum.

    The answers come with the heads of their columns; numbers have all their digits.
    """
    head = ["pin", "name", "vertex", "x", "y", "z"]
    head += [text for title, _ in answers for text in (title, f"{title}, fraction of the maximum")]
    lines = ["\t".join(head)]
    for place in places:
        vertex = words_of(place.at)
        row = [str(place.number), place.pin.name, vertex, *map(repr, place.position(surface.vertices).tolist())]
        for _, answer in answers:
            value = np.nan if answer.field is None else place.value(answer.field)
            share = value / answer.maximum if answer.maximum > 0 and not answer.signs else np.nan
            row += ["" if np.isnan(number) else repr(float(number)) for number in (value, share)]
        lines.append("\t".join(row))
    return "\n".join(lines) + "\n"


def matrix_text(places: Sequence[LocatedPin], matrix: FloatArray) -> str:
    """Return the distances (k, k) among k pins, with tabs between columns and the names before rows and columns."""
    lines = ["\t".join(["", *(place.name for place in places)])]
    for place, row in zip(places, matrix.tolist(), strict=True):
        lines.append("\t".join([place.name, *("" if np.isnan(number) else repr(number) for number in row)]))
    return "\n".join(lines) + "\n"
