"""A base: greys instead of the field's colours, under isolines that have these."""

import re

import numpy as np
import pytest

from app.document.document import Document, FieldArray, MeshFile, Panel
from app.document.edits import open_mesh
from app.document.file import read_recipe
from app.document.looks import CURVATURE, Base
from app.document.quantities import quantity
from app.figures.one_line import command_line
from app.figures.picture import figure
from app.main import main
from app.scene.style import PAPER
from app.session.array_store import ArrayStore
from app.session.base import BaseGreys
from app.session.loaded_mesh import LoadedMesh
from bihdist_core import ParameterError
from tests.figures.recipes import SMALL
from tests.shapes import torus

RING = torus(60, 30)
OUT = np.hypot(*RING.vertices[:, :2].T) - 2
"""1 at the outer equator, where the torus is most convex, -1 at the inner one."""

DISTANCE = quantity("biharmonic")


def greys(values=None, **base):
    """The greys of a panel of the distance, on a field of these values, on curvature if None."""
    given = ArrayStore()
    mesh = given.add_surface(RING)
    fields = () if values is None else (given.add_field("mine", values),)
    shown = Base("mine" if fields else CURVATURE, **base)
    document = Document((mesh,), fields=fields, base=shown)
    return BaseGreys().greys(document, Panel(1, DISTANCE), LoadedMesh(mesh, RING, given))


@pytest.mark.parametrize("values", [OUT, -OUT, OUT + 5, 5 - OUT])
def test_what_is_concave_is_dark_whichever_sign_a_file_gives_to_it(values):
    found = greys(values)
    assert found.are_two == bool(values.min() < 0)
    assert (found.shares[OUT < -0.1] > 0.5).all()
    assert (found.shares[OUT > 0.1] < 0.5).all()


def test_two_greys_meet_where_the_values_change_sign_and_gradual_ones_go_over():
    assert greys(OUT - 0.5).shares[np.argmin(np.abs(OUT - 0.5))] == pytest.approx(0.5, abs=0.1)
    gradual = greys(OUT - 0.5, gradual=True)
    assert not gradual.are_two
    assert len(np.unique(np.round(gradual.shares, 3))) > 10


def test_curvature_is_a_base_and_labels_and_fields_that_are_gone_are_none():
    # On this torus H = (1 + OUT) / (2 + OUT): 0 at the inner equator, positive elsewhere.
    found = greys()
    assert np.corrcoef(found.shares, OUT)[0, 1] < -0.9
    field = FieldArray("mine", "")
    document = Document((MeshFile("A", "x.off"),), fields=(field,), base=Base("mine"))
    assert open_mesh(document, MeshFile("A", "y.off")).base == Base()


def test_the_surface_is_grey_and_its_isolines_have_the_colours_of_the_field():
    look = {"look": {"base": CURVATURE}, "layout": {"size": "400x400", "title": "none"}, "isolines": 6}
    shown = figure(RING, ["biharmonic"], 5, **look).pixels[:300].astype(int)
    plain = figure(RING, ["biharmonic"], 5, layout=look["layout"], isolines=6).pixels[:300].astype(int)
    drawn = (np.ptp(plain, axis=2) > 20) | (plain.min(axis=2) < 240)
    is_grey = np.ptp(shown, axis=2) < 6
    assert 0.7 < (is_grey & drawn).sum() / drawn.sum() < 0.99  # the rest are lines
    white = figure(RING, ["biharmonic"], 5, **{**look, "look": {**look["look"], "white_isolines": True}}).pixels[:300]
    assert (np.ptp(white.astype(int), axis=2) > 20).sum() < 0.1 * (np.ptp(shown, axis=2) > 20).sum()


def test_isolines_of_a_vector_figure_have_the_colours_at_their_values(mesh_file, tmp_path):
    words = ["--distance", "biharmonic", "--sources", "5", "--isoline-values", "0.3,0.6", "--base", CURVATURE]
    path = tmp_path / "f.svg"
    assert main(["figure", mesh_file(RING), *words, "--clim", "1.2", *SMALL, "-o", str(path)]) == 0
    strokes = re.findall(r'id="isoline-0-\d".*?stroke: (#\w+)', path.read_text(), re.DOTALL)
    expected = [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in np.round(255 * PAPER.colours_at(np.array([0.25, 0.5])))
                .astype(int).tolist()]  # fmt: skip
    assert strokes[1::2] == expected  # each above its rim


def test_a_field_that_is_the_base_has_no_panel_and_its_line_draws_it_again(mesh_file, tmp_path):
    np.save(tmp_path / "out.npy", OUT)
    path = tmp_path / "f.png"
    words = ["--distance", "biharmonic", "--field", f"out={tmp_path / 'out.npy'}", "--base", "out", "--gradual-base"]
    assert main(["figure", mesh_file(RING), *words, *SMALL, "-o", str(path)]) == 0
    recipe = read_recipe(path.with_suffix(".json"))
    assert [panel.shows.word for panel in recipe.document.panels] == ["biharmonic"]
    assert recipe.document.base == Base("out", gradual=True)
    line = command_line(recipe, "f.png")
    assert "--base out --gradual-base" in line
    assert f"--field out={tmp_path / 'out.npy'}" in line


def test_a_base_that_there_is_not_is_refused():
    with pytest.raises(ParameterError, match="no base 'sulc'; choose curvature"):
        figure(RING, ["biharmonic"], look={"base": "sulc"})
