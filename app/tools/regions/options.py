"""Regions of pins as figures are told of them."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ...document.option import Option, Row
from ...document.page import Recipe
from .part import divide, divided_panels


def _panel_numbers(text: str) -> str | tuple[int, ...]:
    """Return "all", or the numbers of panels, from words."""
    try:
        return text if text == "all" else tuple(int(word) for word in text.split(","))
    except ValueError:
        raise ParameterError(f"{text!r} is not all, or numbers of panels such as 1,3") from None


def _regions_of(recipe: Recipe) -> dict[str, Any]:
    which = divided_panels(recipe.document)
    return {"regions": which} if which else {}


def _with_regions(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    return replace(recipe, document=divide(recipe.document, values["regions"]))


ROWS = (
    Row(
        (
            Option(
                "regions",
                "draw the boundaries of the regions nearest to each pin, on all panels or on some, counted from 1",
                (),
                metavar="all|N,…",
                read=_panel_numbers,
                write=lambda which: which if isinstance(which, str) else ",".join(map(str, which)),
            ),
        ),
        ("DividedPanels.regions",),
        _regions_of,
        _with_regions,
    ),
)
