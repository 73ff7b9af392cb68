"""Sessions and recipes that an earlier program saved: they open, and are drawn as they were.

`saved/` has three sessions of the window (`looks`, `height`, `pairs`) and three recipes (`marks`, `prediction`,
`change`), which together use each tool that figures draw and most looks, and what was drawn of them, at a quarter of
its size.
"""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.document.file import read_recipe, recipe_from_text, recipe_text
from app.main import main

SAVED = Path(__file__).parent / "saved"
PIXELS = 4
"""So many of a drawing, in each direction, are averaged in the stored pictures."""
SIZE = "400x300@96dpi"

FILES = sorted(path.stem for path in SAVED.glob("*.json"))
AWAY = 3.0
"""Of 255, in the mean of a picture: text and lines may be set otherwise by another version of a library."""


def reduced(path):
    image = Image.open(path).convert("RGBA")
    return image.resize((image.width // PIXELS, image.height // PIXELS), Image.Resampling.BOX)


@pytest.mark.parametrize("name", FILES)
def test_what_was_saved_before_opens_and_is_drawn_as_it_was(name, tmp_path):
    recipe = read_recipe(SAVED / f"{name}.json")
    again = recipe_from_text(recipe_text(recipe, ""))
    assert (again.document, again.page) == (recipe.document, recipe.page)
    out = tmp_path / f"{name}.png"
    assert main(["figure", "--recipe", str(SAVED / f"{name}.json"), "--size", SIZE, "-o", str(out)]) == 0
    found, wanted = (np.asarray(image, dtype=float) for image in (reduced(out), Image.open(SAVED / f"{name}.png")))
    assert found.shape == wanted.shape
    assert np.abs(found - wanted).mean() < AWAY
    blank = np.full_like(wanted, np.median(wanted.reshape(-1, wanted.shape[-1]), axis=0))
    assert np.abs(blank - wanted).mean() > 3 * AWAY  # the tolerance tells a drawing from none


def test_the_files_together_say_most_looks():
    recipes = [read_recipe(SAVED / f"{name}.json") for name in FILES]
    documents = [recipe.document for recipe in recipes]
    for says in (
        lambda d: d.colours.bands,
        lambda d: d.colours.reversed,
        lambda d: d.shading.show_edges,
        lambda d: d.parallel_projection,
        lambda d: d.axes,
        lambda d: d.extrema,
        lambda d: d.insets,
        lambda d: d.warp_factor,
        lambda d: d.isolines.labels,
        lambda d: d.isolines.through,
        lambda d: d.up != "auto",
        lambda d: len(d.surfaces) == 2,
    ):
        assert any(says(document) for document in documents)
    kinds = {type(part).__name__ for document in documents for part in document.parts}
    assert {"Anchors", "DividedPanels", "Hidden", "Pairs", "Pins", "Profile", "Selections"} <= kinds
