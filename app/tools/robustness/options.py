"""A change to the mesh as figures are told of it."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.applications.changes import change_from_words, words_of_change

from ...document.option import Option, Row
from ...document.page import Recipe
from .perturbed_documents import split_perturbed, with_perturbed


def _get(recipe: Recipe) -> dict[str, Any]:
    from ...figures.one_line import mesh_word

    _, change = split_perturbed(recipe.document)
    if change is None:
        return {}
    return {"perturb": words_of_change(replace(change, pose=mesh_word(change.pose) if change.pose else ""))}


def _put(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    change = values["perturb"]
    change = change_from_words(change) if isinstance(change, str) else change
    return replace(recipe, document=with_perturbed(recipe.document, change))


ROWS = (
    Row(
        (
            Option(
                "perturb",
                "show each distance before and after a change to the mesh, and the difference: pose=FILE, cut=FACES, "
                "simplify=N, noise=S, along=normals, holes=N, radius=R, weld=I:J, handle=I:J, seed=K, with commas "
                "between them",
                "",
                group="",
                metavar="WORDS",
            ),
        ),
        get=_get,
        put=_put,
        made_from=split_perturbed,
    ),
)
