"""Pictures that there is no memory for are refused before anything is computed."""

import pytest

import app as bihdist
from app.batch import figures
from app.document.document import comparison
from app.document.page import Page, Recipe
from app.figures.movie import Movie, write_movie
from app.main import main
from bihdist_core import NotEnoughMemory, machine_memory
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy

HUGE = "20000x20000"


@pytest.fixture
def mesh(mesh_file, monkeypatch):
    """Its file, where a distance may not be asked for and 0.1 GB are free."""

    def get(*_):
        raise AssertionError("A distance was set up.")

    monkeypatch.setattr(Distances, "get", get)
    monkeypatch.setattr(machine_memory, "available", lambda: 10**8)
    return mesh_file(bumpy(200))


@pytest.mark.parametrize("name", ["a.png", "a.pdf"])
def test_a_figure_says_so_at_once(mesh, tmp_path, capsys, name):
    assert main(["figure", mesh, "--size", HUGE, "-o", str(tmp_path / name)]) == 2
    said = capsys.readouterr().err
    assert "A picture of 20,000 x 20,000 pixels needs about 8 GB of memory" in said
    assert "0.1 GB are free here; choose a smaller --size." in said
    assert not (tmp_path / name).exists()


def test_a_movie_and_a_figure_from_python_say_so_at_once(mesh, tmp_path):
    recipe = Recipe(comparison(mesh, (Spec.of("biharmonic"),), (4,)), Page(size=HUGE))
    with pytest.raises(NotEnoughMemory, match=r"20,000 x 20,000"):
        write_movie(Movie(recipe, frames=4), tmp_path / "a.gif")
    with pytest.raises(NotEnoughMemory, match=r"20,000 x 20,000"):
        bihdist.figure(mesh, ["biharmonic"], source=4, layout={"size": HUGE})


def test_a_figure_of_a_set_says_so_at_once(mesh, monkeypatch):
    recipe = Recipe(comparison(mesh, (Spec.of("biharmonic"),), (4,)), Page(size=HUGE))
    monkeypatch.setattr(figures, "recipe_for", lambda *_: recipe)
    with pytest.raises(NotEnoughMemory, match=r"20,000 x 20,000"):
        figures._computed(mesh, None)
