"""Anchors as an option says them: vertices with values, or a file of them."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bihdist_core.errors import ParameterError

from ...document.lists import file_in, split_list, standard_input

if TYPE_CHECKING:
    from bihdist_core.formats.anchors import Anchors
    from bihdist_core.surface import Surface

Marks = list[tuple[int, float | None]]


@dataclass(frozen=True)
class AnchorFile:
    """A file of anchors, or the text of standard input."""

    path: str
    text: str = ""

    def read(self, surface: "Surface") -> "Anchors":
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


def anchors_on(asked: Marks | AnchorFile, surface: "Surface") -> "Anchors":
    """Return the anchors on a surface; ParameterError for one without a value, VertexError for one that is not
    there."""
    import numpy as np

    from bihdist_core.formats.anchors import Anchors

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
    return Anchors(vertices, values, ("",) * len(asked), np.zeros(len(asked)))
