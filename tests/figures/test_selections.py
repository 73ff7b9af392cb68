"""Selections in figures: where they are drawn, that the field stays to be read, and what says them."""

import re

import numpy as np
import pytest
from PIL import Image

from app.document.file import read_recipe
from app.document.runs import ids_of
from app.document.shared_parts.selections import Selections
from app.figures.picture import figure
from app.main import main
from app.marks.primitives import AreaMark
from app.scene.selected import selected_colours
from app.scene.style import PINS
from tests.figures.recipes import SMALL
from tests.shapes import bumpy

PLAIN = ["--distance", "biharmonic", "--sources", "4", "--isolines", "0", *SMALL]
GREEN = np.array([int(PINS[0][k : k + 2], 16) for k in (1, 3, 5)])


def picture(path):
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def test_vertices_have_the_colour_of_the_last_selection_that_they_are_in():
    colours = selected_colours([AreaMark(np.array([1, 2]), PINS[0]), AreaMark(np.array([2, 9]), PINS[1])], 4)
    assert colours[:, 3].tolist() == [0, 255, 255, 0]
    assert colours[1, :3].tolist() == GREEN.tolist()
    assert colours[2, :3].tolist() == [int(PINS[1][k : k + 2], 16) for k in (1, 3, 5)]
    assert selected_colours([AreaMark(np.array([9]), PINS[0])], 4) is None


def test_what_is_selected_has_a_rim_and_hatching_and_the_field_is_seen_between(mesh, tmp_path):
    top = np.flatnonzero(bumpy(300).vertices[:, 1] > 0.3)
    np.savetxt(tmp_path / "top.txt", top, fmt="%d")
    assert main(["figure", mesh, *PLAIN, "-o", str(tmp_path / "plain.png")]) == 0
    words = ["--select", f"@{tmp_path}/top.txt"]
    assert main(["figure", mesh, *PLAIN, *words, "-o", str(tmp_path / "top.png")]) == 0
    plain, shown = (picture(tmp_path / f"{name}.png") for name in ("plain", "top"))
    differs = (plain != shown).any(axis=2)
    rows = np.flatnonzero(differs.any(axis=1))
    area = differs[rows[0] : rows[-1] + 1, np.flatnonzero(differs.any(axis=0))[0] :]
    assert 0.1 < area.mean() < 0.6
    # Where it is changed there is much of the colour, and only above.
    assert (np.abs(shown[differs] - GREEN).max(axis=1) < 40).mean() > 0.1
    assert rows[-1] < 0.62 * len(plain)
    assert ids_of(read_recipe(tmp_path / "top.json").document[Selections].selections[0].runs).tolist() == top.tolist()


def test_python_and_the_command_draw_the_same(mesh, tmp_path):
    words = ["--select", "3+5-90,200-299"]
    assert main(["figure", mesh, *PLAIN, *words, "-o", str(tmp_path / "a.png")]) == 0
    size = SMALL[SMALL.index("--size") + 1]
    for chosen in (["3+5-90", "200-299"], [[3, *range(5, 91)], np.arange(200, 300)]):
        drawn = figure(mesh, ["biharmonic"], source=4, isolines=0, layout={"size": size}, marks={"selections": chosen})
        assert np.array_equal(drawn.pixels, picture(tmp_path / "a.png"))


@pytest.mark.parametrize("words", ["299-300", "ear", "7-5"])
def test_what_cannot_be_selected_is_refused(mesh, words, tmp_path, capsys):
    assert main(["figure", mesh, *PLAIN, "--select", words, "-o", str(tmp_path / "a.png")]) != 0
    said = capsys.readouterr().err
    assert re.search(r"300|ear|7-5", said)
    assert not (tmp_path / "a.png").exists()
