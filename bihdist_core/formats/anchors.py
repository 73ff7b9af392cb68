"""Files of anchors, vertices with a value: the files of pins, with a column `value`."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..file_output import check_output
from ..sentences import shortened
from ..surface import Surface
from .landmarks import LANDMARKS, Picked
from .pins import PIN_FORMATS, picked_in, pins_extension, placed, write_rows

COLUMNS = ("vertex", "value", "x", "y", "z", "name")


@dataclass(frozen=True, eq=False)
class Anchors:
    """Anchors: k vertices of a surface with values (k,), and names, which may be empty.

    `moved` (k,) is how far each vertex is from the position that the file gave, in the mesh's unit; 0 where it gave
    none. `facts` are those of `Pins`.
    """

    vertices: IntArray
    values: FloatArray
    names: tuple[str, ...]
    moved: FloatArray
    facts: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.vertices)


def read_anchors(path: str | os.PathLike[str], surface: Surface) -> Anchors:
    """Read anchors at vertices of a surface; the extension names the format.

    ``.csv``: a header of `value` with `vertex`, or `x,y,z`, or both, and maybe `name`, in any order, then a line for
    each.
    ``.json``: ``{"anchors": [{"vertex", "position": [x, y, z], "value", "name"}, ...]}``.
    Landmarks of other programs (`LANDMARKS`) have the values for names. An anchor is at its vertex or, where the file
    names none, at the one nearest to its position. Raises ParameterError, with the file, the place in it and the
    value, for anything else, and for the same vertex twice.
    """
    return anchors_at(picked_in(path), surface, pins_extension(path) in LANDMARKS)


def anchors_at(found: list[Picked], surface: Surface, are_named: bool = False) -> Anchors:
    """Put the anchors of a file at vertices of a surface; if `are_named`, a name stands for a missing value."""
    values = []
    for pin in found:
        value = pin.value
        if value is None and are_named:
            try:
                value = float(pin.name)
            except ValueError:
                name = shortened(repr(pin.name), 60)
                raise ParameterError(f"{pin.where}: the name {name} of an anchor must be a number.") from None
        if value is None:
            raise ParameterError(f"{pin.where}: an anchor needs a value.")
        values.append(value)
    pins = placed(found, surface)
    first: dict[int, str] = {}
    for pin, vertex in zip(found, pins.vertices.tolist(), strict=True):
        if vertex in first:
            raise ParameterError(f"{pin.where}: vertex {vertex} is an anchor already, {first[vertex]}.")
        first[vertex] = f"in {pin.where}"
    return Anchors(pins.vertices, np.array(values), pins.names, pins.moved, pins.facts)


def write_anchors(
    path: str | os.PathLike[str],
    surface: Surface,
    vertices: npt.ArrayLike,
    values: npt.ArrayLike,
    names: tuple[str, ...] = (),
) -> None:
    """Write anchors in a form that `read_anchors` reads, with the positions of their vertices, exactly.

    Raises OutputError if the file cannot be written; what was there then stays.
    """
    check_output(path, ANCHOR_FORMATS)
    ids = surface.check_vertices(vertices)
    numbers = np.asarray(values, np.float64)
    if numbers.shape != ids.shape or not np.isfinite(numbers).all():
        raise ParameterError(f"{len(ids)} anchors need as many finite values, not {numbers.shape}.")
    points = surface.vertices[ids].tolist()
    rows = [
        {"vertex": vertex, "position": point, "value": value, "name": name}
        for vertex, value, point, name in zip(
            ids.tolist(), numbers.tolist(), points, names or ("",) * len(ids), strict=True
        )
    ]
    write_rows(path, COLUMNS, "anchors", rows, surface.name)


ANCHOR_FORMATS = tuple(each for each in PIN_FORMATS if each not in LANDMARKS or LANDMARKS[each].has_names)
"""The extensions that `read_anchors` and `write_anchors` know: those that have a place for values, or for names."""
