"""How figures are told of the circle."""

from dataclasses import replace

from bihdist.document.option import Option, Row, vertex
from bihdist.document.page import Recipe

from .part import Circle, with_circle


def _circle_of(recipe: Recipe) -> dict[str, int]:
    name = recipe.document[Circle].through
    return {"circle": recipe.document.point(name).at} if name else {}


def _with_circle(recipe: Recipe, values: dict[str, int]) -> Recipe:
    document = recipe.document
    return replace(recipe, document=with_circle(document, values["circle"], document.surfaces[0].name))


ROWS = (
    Row(
        (Option("circle", "the geodesic circle through a vertex, with its length and area", metavar="V", read=vertex),),
        ("Circle.through",),
        _circle_of,
        _with_circle,
    ),
)
