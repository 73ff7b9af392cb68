"""Options of figures and commands for a mesh before it is measured: what is cut out of it, and merged."""

import os
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ..document.option import Option, Row, digits
from ..document.page import Recipe
from ..document.repairs import OPERATORS, Repairs, with_repairs

COTAN = next(iter(OPERATORS))


def _get(recipe: Recipe) -> dict[str, Any]:
    repairs = recipe.document.surfaces[0].repairs if recipe.document.surfaces else Repairs()
    values: dict[str, Any] = {"cut": os.path.abspath(repairs.cut)} if repairs.cut else {}
    values |= {} if repairs.merge is None else {"merge": repairs.merge}
    values |= {} if repairs.operator == COTAN else {"operator": repairs.operator}
    return values | ({LARGEST.name: True} if repairs.largest_component else {})


def _put(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    return replace(recipe, document=with_repairs(recipe.document, **values))


def _tolerance(text: str) -> float:
    try:
        return Repairs(merge=float(text)).merge or 0.0
    except (ValueError, ParameterError):
        raise ParameterError(f"{text!r} is not a length, a number from 0") from None


MERGE = "merge vertices no farther apart than this, in mesh units, after --cut; vertices are then renumbered"
"""What merging does, in words."""

CUT = Option(
    "cut",
    "cut out vertices with their faces, so that no distance crosses them: a file with 1 for each vertex to keep and "
    "0 for each to remove (.npy, .txt, .gii, .annot, .label or another of FreeSurfer's); {name} is the mesh's name",
    "",
    group="",
    metavar="MASK",
)

LARGEST = Option(
    "largest_component",
    "keep only the connected component with most vertices, after --cut and --merge; vertex ids stay as they are",
    False,
    group="",
)

OPERATOR = Option(
    "operator",
    "operator of the distances, the same for all meshes: by the faces, as in the paper; of an intrinsic Delaunay "
    f"triangulation, for thin faces; or of the tufted cover, for edges of more than two faces (default: {COTAN})",
    COTAN,
    group="",
    choices=tuple(OPERATORS),
)

REPAIRS = Row(
    (
        CUT,
        Option(
            "merge",
            f"{MERGE}; OUT.ids.csv next to the output lists the new ids",
            group="",
            metavar="TOLERANCE",
            read=_tolerance,
            write=digits,
        ),
        LARGEST,
        OPERATOR,
    ),
    ("Repairs.cut", "Repairs.merge", "Repairs.largest_component", "Repairs.operator"),
    _get,
    _put,
)
