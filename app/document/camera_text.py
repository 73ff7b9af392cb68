"""A camera as a line of text, to be sent to somebody, and read again from what they paste."""

import re

from bihdist_core.errors import ParameterError
from bihdist_core.file_content import json_value
from bihdist_core.sentences import shortened

from .camera import VIEWS, Camera, View
from .form import read_view

SHOWN = 60
"""Letters of a wrong text that its error repeats."""


def camera_text(camera: Camera) -> str:
    """Eleven numbers with commas between them, as `--camera` takes them."""
    numbers = (*camera.position, *camera.focal_point, *camera.up, *camera.extent)
    return ",".join(f"{x + 0.0:.9g}" for x in numbers)


def read_camera(text: str) -> View:
    """Eleven numbers, perhaps after `--camera`; a camera or a whole document as JSON; or the name of a standard view.

    ParameterError for anything else.
    """
    words = re.sub(r"^--(camera|cpos)[=\s]+", "", text.strip()).strip().strip("\"'")
    if words.lower() in VIEWS:
        return words.lower()
    if words.startswith("{"):
        return _from_json(words)
    try:
        numbers = [float(word) for word in re.split(r"[,;\s]+", words.strip("()[]"))]
    except ValueError:
        numbers = []
    if len(numbers) != 11:
        raise ParameterError(
            f"{shortened(words, SHOWN)!r} is not a camera; copy one with Copy camera, or paste eleven numbers: "
            "position, focal point, up and extent."
        )
    px, py, pz, fx, fy, fz, ux, uy, uz, wide, high = numbers
    return Camera((px, py, pz), (fx, fy, fz), (ux, uy, uz), (wide, high))


def _from_json(text: str) -> View:
    try:
        data = json_value(text)
    except ParameterError:
        raise ParameterError("The pasted text starts like JSON but is incomplete; copy all of it.") from None
    for part in ("document", "camera"):
        if isinstance(data.get(part), dict):
            data = data[part]
        elif part == "camera" and data.get(part) in VIEWS:
            return str(data[part])
    return read_view(data, "The camera")
