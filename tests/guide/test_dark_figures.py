"""Figures of dark pages, drawn again from the recipes of the light ones."""

import bihdist
import numpy as np
import pytest
from PIL import Image

from tests.shapes import bumpy

dark_figures = pytest.importorskip("assets.guide.building.dark_figures")


@pytest.mark.parametrize(
    ("layout", "is_drawn"), [({}, True), ({"style": "uniform"}, False), ({"transparent": True}, False)]
)
def test_a_figure_that_chooses_no_style_has_a_dark_one(layout, is_drawn, mesh_file, tmp_path):
    light, dark = tmp_path / "one.png", dark_figures.dark_name(tmp_path / "one.png")
    bihdist.figure(mesh_file(bumpy(200)), ["biharmonic"], 5, layout={"size": "200x200", **layout}).save(light)
    dark_figures.draw_dark(light, dark)
    assert dark.exists() == is_drawn
    if is_drawn:
        with Image.open(light) as one, Image.open(dark) as other:
            assert one.size == other.size
            assert (np.asarray(one.convert("L"))[0, 0] > 240, np.asarray(other.convert("L"))[0, 0] < 60) == (True, True)


def test_a_picture_without_a_recipe_has_none(tmp_path):
    Image.new("RGB", (4, 4)).save(tmp_path / "chart.png")
    dark_figures.draw_dark(tmp_path / "chart.png", tmp_path / "dark.png")
    assert not (tmp_path / "dark.png").exists()
