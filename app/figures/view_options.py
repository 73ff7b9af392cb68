"""Options of figures for the view of a shape: views and cameras, the axis that points up, insets."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ..document.camera import SAME_VIEWS, Camera, View
from ..document.document import Inset
from ..document.looks import UPS, Clip
from ..document.option import NotExpressible, Option, Row, attribute, digits, numbers, with_attribute, with_commas
from ..document.page import Recipe
from ..document.second_mesh_edits import set_up_axis


# ---------------------------------------------------------------------- views
def _views_of(recipe: Recipe) -> dict[str, Any]:
    cameras = [view for view in recipe.views if isinstance(view, Camera)]
    if len(cameras) > 1 or (cameras and recipe.views[-1] is not cameras[0]):
        raise NotExpressible("There are several cameras.")
    names = [view for view in recipe.views if isinstance(view, str)]
    values: dict[str, Any] = {"cpos": names} if names and (names != ["auto"] or cameras) else {}
    for camera in cameras:
        values["camera"] = tuple(map(float, (*camera.position, *camera.focal_point, *camera.up, *camera.extent)))
    return values


def _with_views(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    asked = values.get("cpos", ())
    views: list[View] = [asked] if isinstance(asked, str | Camera) else list(asked)
    views = [SAME_VIEWS.get(view, view) if isinstance(view, str) else view for view in views]
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
            "cpos",
            "camera position: home and high, each also with -right, -back or -left, front, back, left, right, top, "
            "bottom, source, or auto, home, another side or high, by which shows most of the shape (default); of "
            "brains lateral, medial, dorsal, ventral, anterior, posterior; with commas for several",
            "auto",
            group="view",
            metavar="NAME,…",
            is_list=True,
            may_be_lone=True,
        ),
        Option(
            "camera",
            "camera position, focal point, up direction and extent: 11 numbers",
            group="view",
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
    """Return the help of `--viewup`, with what is up without it in words."""
    return f"the axis that points up: {', '.join(UPS)} (default: {default}); write --viewup=-z for those with a sign"


UP = replace(
    attribute("document.up", up_meaning("guessed"), "AXIS", name="viewup", group="view", choices=UPS),
    # A camera that comes with a recipe would be askew.
    put=lambda recipe, values: replace(recipe, document=set_up_axis(recipe.document, values["viewup"])),
)


CLIP = Row(
    (
        Option(
            "clip",
            "cut the surface by a plane and show its inside: an axis or a normal X,Y,Z, beyond which it is cut away, "
            "and the fraction to keep (without: 0.5), such as x, x@0.3 or 0,1,1@0.7; write --clip=-y for those with a "
            "sign",
            "",
            group="view",
            metavar="AXIS[@FRACTION]",
            read=lambda text: str(Clip.from_words(text)),
        ),
    ),
    ("Document.clip",),
    lambda recipe: {"clip": str(recipe.document.clip)} if recipe.document.clip else {},
    lambda recipe, values: with_attribute(recipe, "document.clip", Clip.from_words(values["clip"])),
)


# ---------------------------------------------------------------------- insets
def _insets_of(recipe: Recipe) -> dict[str, Any]:
    insets = recipe.document.insets
    if any(each.corner != "auto" for each in insets):
        raise NotExpressible("An inset has a corner of its own.")
    values = [(each.vertex, each.factor, *(() if each.isolines is None else (each.isolines,))) for each in insets]
    return {"insets": values} if values else {}


def _with_insets(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    found = (each if isinstance(each, tuple) else (each,) for each in values["insets"])
    insets = tuple(replace(Inset(*each[:2]), isolines=each[2] if len(each) > 2 else None) for each in found)
    return replace(recipe, document=replace(recipe.document, insets=insets))


def _inset(text: str) -> tuple[Any, ...]:
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


INSETS = Row(
    (
        Option(
            "insets",
            "enlarge around these vertices, by a factor and with N isolines if given",
            (),
            group="view",
            metavar="V[:FACTOR[:N]],…",
            read=_inset,
            write=lambda inset: ":".join(map(digits, inset)),
            is_list=True,
        ),
    ),
    ("Document.insets", "Inset.vertex", "Inset.factor", "Inset.corner", "Inset.isolines"),
    _insets_of,
    _with_insets,
)
