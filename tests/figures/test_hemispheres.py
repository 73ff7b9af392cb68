"""Views of brains by name, and lateral and medial views of each hemisphere."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.camera import ANATOMICAL
from app.document.document import comparison
from app.document.file import read_recipe
from app.document.page import Page, Recipe
from app.figures.export import compute, figure_of, open_document
from app.figures.layout import lay_out
from app.figures.one_line import command_line
from app.figures.picture import figure, figure_again
from app.figures.shots import take_shots
from app.main import main
from app.scene.camera import directions
from app.session.array_store import ArrayStore
from bihdist_core import ParameterError, Surface
from bihdist_core.progress import silent
from tests.figures.recipes import SMALL
from tests.shapes import sphere

BALL = sphere(200)
LEFT, RIGHT = (Surface(BALL.vertices * [0.6, 1, 1] + [x, 0, 0], BALL.faces) for x in (-2, 2))


def both():
    return Surface(
        np.concatenate([LEFT.vertices, RIGHT.vertices]), np.concatenate([LEFT.faces, RIGHT.faces + 200]), "both"
    )


@pytest.mark.parametrize("up", ["y", "z"])
@pytest.mark.parametrize(
    ("view", "towards", "above"),
    [
        ("lateral-left", (-1, 0, 0), (0, 0, 1)), ("medial-left", (1, 0, 0), (0, 0, 1)),
        ("lateral-right", (1, 0, 0), (0, 0, 1)), ("medial-right", (-1, 0, 0), (0, 0, 1)),
        ("anterior", (0, 1, 0), (0, 0, 1)), ("posterior", (0, -1, 0), (0, 0, 1)),
        ("dorsal", (0, 0, 1), (0, 1, 0)), ("ventral", (0, 0, -1), (0, 1, 0)),
    ],
)  # fmt: skip
def test_views_of_brains_are_in_ras_whatever_is_up(view, towards, above, up):
    assert view in ANATOMICAL
    direction, upright = directions(view, up)
    assert direction == pytest.approx(np.array(towards), abs=1e-12)
    assert upright == pytest.approx(np.array(above), abs=1e-12)


def drawn(mesh, views=(), layout=""):
    recipe, store = Recipe(comparison(mesh), Page(views=views, layout=layout)), ArrayStore()
    document, surfaces = open_document(recipe, store)
    return figure_of(Recipe(document, recipe.page), surfaces, compute(document, surfaces))


def test_a_lateral_view_is_of_the_hemisphere_that_the_name_says_or_x(mesh_file):
    for surface, name, side, why in (
        (LEFT, "brain.off", "left", "the sign of x"),
        (RIGHT, "brain.off", "right", "the sign of x"),
        (RIGHT, "sub_lh.pial.off", "left", "its name"),
        (BALL, "sub_rh.off", "right", "its name"),
    ):
        shown = drawn(mesh_file(surface, name), ("lateral", "medial"))
        assert shown.panels[0].views == (f"lateral-{side}", f"medial-{side}")
        assert any(f"the {side} hemisphere, by {why}" in text for text in shown.remarks)


def test_a_lateral_view_needs_one_hemisphere():
    with pytest.raises(ParameterError, match="both hemispheres; choose lateral-left"):
        figure(both(), ["biharmonic"], view={"cpos": "lateral"})
    with pytest.raises(ParameterError, match="tells its hemisphere"):
        figure(BALL, ["biharmonic"], view={"cpos": "medial"})
    figure(BALL, ["biharmonic"], view={"cpos": "medial-left"})


def test_two_files_as_one_mesh_have_four_views_each_of_its_hemisphere_alone(mesh_file):
    # Inflated hemispheres lie at the same place: their files tell them apart.
    first, second = mesh_file(BALL, "sub_lh.off"), mesh_file(BALL, "sub_rh.off")
    for panel in drawn(f"{first}+{second}", layout="hemispheres").panels:
        assert panel.views == ("lateral-left", "medial-left", "medial-right", "lateral-right")
        of = [np.unique(part.faces) for part in panel.parts]
        assert [(part.min(), part.max()) for part in of] == [(0, 199)] * 2 + [(200, 399)] * 2


def test_each_picture_shows_one_hemisphere_with_its_marks_and_a_line_draws_it_again(mesh_file, tmp_path):
    path = tmp_path / "f.png"
    words = ["--distance", "biharmonic", "--sources", "5+300", "--layout", "hemispheres", "--cpos", "front"]
    mesh = mesh_file(both(), "both.off")
    assert main(["figure", mesh, *words, *SMALL, "-o", str(path)]) == 0
    recipe = read_recipe(path.with_suffix(".json"))
    assert recipe.page.layout == "hemispheres"
    assert "--layout hemispheres" in command_line(recipe, "f.png")
    shown = figure_again(path.with_suffix(".json"))._figure
    assert [len(part.faces) for part in shown.panels[0].parts] == [len(BALL.faces)] * 4
    shots = take_shots(shown, lay_out(shown), silent)
    vertices = [[shown.panels[0].marks[k].vertex for k, *_ in (*shot.marks, *shot.ghosts)] for shot in shots]
    # A source that one view of its hemisphere shows is not dashed in the other.
    assert vertices == [[], [5], [300], []]
    free = replace(shown, size=replace(shown.size, height=None))
    usual = replace(free, panels=(replace(shown.panels[0], parts=()),))
    assert lay_out(free).height < lay_out(usual).height
