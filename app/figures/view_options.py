"""What figures can be told of how a shape is seen: views and cameras, which way is up, insets."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ..document.camera import Camera, View
from ..document.document import Zoom
from ..document.edits import stand
from ..document.looks import UPS
from ..document.option import NotExpressible, Option, Row, attribute, digits, numbers, with_commas
from ..document.page import Recipe


# ---------------------------------------------------------------------- views
def _views_of(recipe: Recipe) -> dict[str, Any]:
    cameras = [view for view in recipe.views if isinstance(view, Camera)]
    if len(cameras) > 1 or (cameras and recipe.views[-1] is not cameras[0]):
        raise NotExpressible("There are several cameras.")
    names = [view for view in recipe.views if isinstance(view, str)]
    values: dict[str, Any] = {"views": names} if names and (names != ["auto"] or cameras) else {}
    for camera in cameras:
        values["camera"] = tuple(map(float, (*camera.position, *camera.focal_point, *camera.up, *camera.extent)))
    return values


def _with_views(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    asked = values.get("views", ())
    views: list[View] = [asked] if isinstance(asked, str | Camera) else list(asked)
    if "camera" in values:
        x = [float(number) for number in values["camera"]]
        if len(x) != 11:
            raise ParameterError(f"A camera is eleven numbers (position, focal point, up, extent), not {len(x)}.")
        views.append(Camera((x[0], x[1], x[2]), (x[3], x[4], x[5]), (x[6], x[7], x[8]), (x[9], x[10])))
    page = replace(recipe.page, views=tuple(views) if len(views) > 1 else ())
    return replace(recipe, document=replace(recipe.document, camera=views[0] if views else "auto"), page=page)


def _camera_numbers(text: str) -> tuple[float, ...]:
    found = numbers(text)
    if len(found) != 11:
        raise ParameterError(f"{text!r} is not 11 numbers with commas between them")
    return found


VIEWS = Row(
    (
        Option(
            "views",
            "home and high, each also with -right, -back or -left, front, back, left, right, top, bottom, source, or "
            "auto, the one of the first eight that shows most of the shape (default); with commas for several",
            "auto",
            flag="view",
            metavar="NAME,…",
            is_list=True,
            may_be_lone=True,
        ),
        Option(
            "camera",
            "position, focal point, up, extent: 11 numbers",
            metavar="X,Y,…",
            read=_camera_numbers,
            write=with_commas,
        ),
    ),
    ("Document.camera", "Page.views"),
    _views_of,
    _with_views,
)


def up_meaning(default: str) -> str:
    """What `--up` means; default: what is up without it, in words."""
    return f"which axis points up: {', '.join(UPS)} (default: {default}); write --up=-z for those with a sign"


UP = replace(
    attribute("document.up", up_meaning("guessed"), "AXIS", choices=UPS),
    # A camera that comes with a recipe would be askew.
    put=lambda recipe, values: replace(recipe, document=stand(recipe.document, values["up"])),
)


# ---------------------------------------------------------------------- insets
def _zooms_of(recipe: Recipe) -> dict[str, Any]:
    zooms = recipe.document.zooms
    if any(zoom.corner != "auto" for zoom in zooms):
        raise NotExpressible("An inset has a corner of its own.")
    values = [(zoom.vertex, zoom.factor, *(() if zoom.isolines is None else (zoom.isolines,))) for zoom in zooms]
    return {"zooms": values} if values else {}


def _with_zooms(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    found = (zoom if isinstance(zoom, tuple) else (zoom,) for zoom in values["zooms"])
    zooms = tuple(replace(Zoom(*each[:2]), isolines=each[2] if len(each) > 2 else None) for each in found)
    return replace(recipe, document=replace(recipe.document, zooms=zooms))


def _zoom(text: str) -> tuple[Any, ...]:
    words = text.split(":")
    try:
        vertex, factor, steps, *others = *words, *[""] * (3 - len(words))
        if others:
            raise ValueError
        return int(vertex), float(factor or 3), int(steps) if steps else None
    except ValueError:
        raise ParameterError(
            f"{text!r} is not a vertex id, or an id and a factor such as 12:3, or these and a number of steps: 12:3:60"
        ) from None


ZOOMS = Row(
    (
        Option(
            "zooms",
            "enlarge the places of vertices, perhaps so many times, and with N isolines",
            (),
            flag="zoom",
            metavar="V[:FACTOR[:N]],…",
            read=_zoom,
            write=lambda zoom: ":".join(map(digits, zoom)),
            is_list=True,
        ),
    ),
    ("Document.zooms", "Zoom.vertex", "Zoom.factor", "Zoom.corner", "Zoom.isolines"),
    _zooms_of,
    _with_zooms,
)
