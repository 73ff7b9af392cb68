"""The option of figures that hides marks on the surface."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ...document.document import Document
from ...document.on_surface import Hidden, SurfaceItem, surface_items
from ...document.option import NotExpressible, Option, Row
from ...document.page import Recipe


def _named(document: Document) -> Iterator[tuple[str, SurfaceItem]]:
    """Yield the items that can be hidden under the words of the option: "source", "pins", "pins:2"."""
    for item in surface_items(document):
        yield item.word, item
        for number, member in enumerate(item.members, 1):
            if member.word:
                yield f"{item.word}:{number}", member


def _hidden_of(recipe: Recipe) -> dict[str, Any]:
    hidden = recipe.document[Hidden].hidden
    words = [word for word, item in _named(recipe.document) if item.word in hidden]
    if "pairs" in words:
        raise NotExpressible("Pairs are hidden.")
    return {"hide": words} if words else {}


def _with_hidden(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    document, found = recipe.document, dict[str, None]()
    known = dict(_named(document))
    for word in values["hide"]:
        if word not in known:
            raise ParameterError(
                f"There is no {word!r} on the surface to hide; there is {', '.join(known) or 'nothing'}."
            )
        found |= dict.fromkeys(leaf.word for leaf in known[word].leaves)
    return replace(recipe, document=document.with_part(Hidden(tuple(found))))


ROWS = (
    Row(
        (
            Option(
                "hide",
                "do not draw these marks on the surface: source, pins, selections, borders, anchors, extrema, path, "
                "isolines, or one of several, such as pins:2",
                (),
                metavar="NAME,…",
                is_list=True,
            ),
        ),
        ("Hidden.hidden",),
        _hidden_of,
        _with_hidden,
    ),
)
