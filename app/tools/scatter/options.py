"""Selections as figures are told of them."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.applications.changes import Runs

from ...document.lists import file_in
from ...document.option import NotExpressible, Option, Row, unsaid
from ...document.page import Recipe
from ...document.part import MARK_COLOURS

MAX_NAMED_IDS = 1000
"""Characters of selected vertices in a line that somebody is to read."""


def _selections_of(recipe: Recipe) -> dict[str, Any]:
    """Return the option for selections in their usual colours."""
    from bihdist_core.applications.changes import words_of_runs

    from ...document.shared_parts.selections import Selections

    selections = recipe.document[Selections].selections
    if any(each.surface != recipe.document.surfaces[0].name for each in selections):
        raise NotExpressible("Vertices of another mesh are selected.")
    if [each.colour for each in selections] != [k % MARK_COLOURS for k in range(len(selections))]:
        raise NotExpressible("Selections have colours of their own.")
    words = [words_of_runs(each.runs) for each in selections]
    if sum(map(len, words)) > MAX_NAMED_IDS:
        raise NotExpressible("More vertices are selected than a line can name.")
    return {"selections": words} if words else {}


def _with_selections(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    from ...document.shared_parts.selections import select_instead

    document = recipe.document
    selected = select_instead(document, map(_runs, values["selections"]), document.surfaces[0].name)
    return replace(recipe, document=selected)


def _runs(chosen: Any) -> Runs:
    """Return ids (k,), those of a file, or ids and ranges in words, as runs."""
    import numpy as np

    from bihdist_core.analysis.selecting import is_ids_file, read_ids

    from ...document.runs import runs_from_words, runs_of

    if not isinstance(chosen, str):
        return runs_of(np.asarray(chosen))
    return runs_of(read_ids(chosen)) if is_ids_file(chosen) else runs_from_words(chosen)


ROWS = (
    Row(
        (
            Option(
                "selections",
                "selected vertices: ids and ranges (12+40-77), or a .txt, .npy or .csv file of ids, "
                "@FILE; with commas for several selections",
                (),
                flag="select",
                metavar="IDS|@FILE,…",
                read=lambda word: file_in(word) or word,
                is_list=True,
            ),
        ),
        ("Selections.selections",),
        _selections_of,
        _with_selections,
    ),
    unsaid("for the window's chart", "Scatter.across", "Scatter.up", "Scatter.shares"),
)
