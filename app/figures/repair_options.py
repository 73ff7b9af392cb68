"""What figures and commands can be told of a mesh before it is measured: what is cut out of it, and merged."""

import os
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ..document.option import Option, Row, digits
from ..document.page import Recipe
from ..document.repairs import Repairs, with_repairs


def _get(recipe: Recipe) -> dict[str, Any]:
    repairs = recipe.document.surfaces[0].repairs if recipe.document.surfaces else Repairs()
    values: dict[str, Any] = {"cut": os.path.abspath(repairs.cut)} if repairs.cut else {}
    return values if repairs.merge is None else {**values, "merge": repairs.merge}


def _put(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    return replace(recipe, document=with_repairs(recipe.document, values.get("cut"), values.get("merge")))


def _tolerance(text: str) -> float:
    try:
        return Repairs(merge=float(text)).merge or 0.0
    except (ValueError, ParameterError):
        raise ParameterError(f"{text!r} is not a length, a number from 0") from None


MERGE = "make vertices one that are no farther apart, in mesh units, after --cut; they are then numbered anew"
"""What merging does, in words."""

CUT = Option(
    "cut",
    "cut vertices out with their faces, which nothing then crosses: a file of 1 for each that stays and 0 for "
    "each that goes (.npy, .txt, .gii, .annot, .label or another of FreeSurfer's); {name} is the mesh's name",
    "",
    metavar="MASK",
)

REPAIRS = Row(
    (
        CUT,
        Option(
            "merge",
            f"{MERGE}; OUT.ids.csv beside the output has their new ids",
            metavar="TOLERANCE",
            read=_tolerance,
            write=digits,
        ),
    ),
    ("Repairs.cut", "Repairs.merge"),
    _get,
    _put,
)
