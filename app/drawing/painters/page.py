"""Shapes as JSON, for the canvas of a web page."""

from collections.abc import Iterable
from typing import Any

from ..shapes import RGBA, Path, Pen, Point, Shape, Text

Json = dict[str, Any]

OWN: RGBA = (0.0, 0.0, 0.0, 0.0)
"""The colour that the page chooses itself."""

LEVELS = {"baseline": "alphabetic", "capitals": "middle", "lowercase": "middle", "line": "middle"}


def to_json(shapes: Iterable[Shape]) -> list[Json]:
    """Return paths and texts as objects that `paintShapes` of the page knows, in thousandths of a pixel.

    Raises
    ------
    TypeError
        For a shape of which a page has no need: a group, an image, a gradient.
    """
    found = []
    for shape in shapes:
        if not isinstance(shape, Path | Text):
            raise TypeError(f"A page paints no {type(shape).__name__}.")
        found.append(_path(shape) if isinstance(shape, Path) else _text(shape))
    return found


def _path(shape: Path) -> Json:
    (wide, high), (left, top) = shape.scale, shape.at

    def written(command: str, *points: Point) -> str:
        places = (f"{left + wide * x:.3f} {top + high * y:.3f}" for x, y in points)
        return f"{command}{' '.join(places)}"

    commands = []
    for part in shape.subpaths:
        commands.append(written("M", part.start))
        commands += [written("L" if len(segment) == 1 else "C", *segment) for segment in part.segments]
        commands += ["Z"] if part.is_closed else []
    found: Json = {"path": "".join(commands)}
    if shape.fill is not None:
        if not isinstance(shape.fill, tuple):
            raise TypeError("A page paints no gradient.")
        found["fill"] = _colour(shape.fill)
    return found if shape.pen is None else found | _pen(shape.pen)


def _pen(pen: Pen) -> Json:
    dashes = [round(pen.width * dash, 3) for dash in pen.dashes]
    look = {"width": round(pen.width, 3), "dashes": dashes, "join": pen.join, "cap": pen.cap}
    return {"line": _colour(pen.colour), **look}


def _text(shape: Text) -> Json:
    align = {"left": "start", "centre": "center", "right": "end"}[shape.align]
    place = {"x": round(shape.x, 3), "y": round(shape.y, 3), "size": round(shape.size, 3)}
    look = {"weight": 600 if shape.is_bold else 400, "align": align, "level": LEVELS[shape.level]}
    return {"text": shape.text, **place, "colour": _colour(shape.colour), **look}


def _colour(colour: RGBA) -> str:
    if colour == OWN:
        return "own"
    red, green, blue = (round(255 * part) for part in colour[:3])
    return f"rgba({red}, {green}, {blue}, {colour[3]:g})" if colour[3] < 1 else f"rgb({red}, {green}, {blue})"
