"""`bihdist.figure`: the command's pictures from Python."""

import doctest
import io
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import app
from app.document.camera import Camera
from app.document.file import read_recipe
from app.figures import picture
from app.main import main
from bihdist_core import BiharmonicDistance, OutputError, ParameterError, VertexError
from tests.shapes import bumpy, grid


def test_it_is_the_picture_of_the_command(mesh_file, tmp_path):
    mesh = mesh_file(bumpy(300))
    words = [
        "--distance",
        "biharmonic,biharmonic - diffusion(t=1/4)",
        "--sources",
        "4,9",
    ]
    looks = [
        "--cpos",
        "left,top",
        "--insets",
        "7:4",
        "--anchors",
        "3=0.2,8",
        "--isolines",
        "9",
        "--no-hints",
    ]
    more = ["--areas", "barycentric", "--size", "500x300", "--style", "uniform", "--crop", "--transparent"]
    assert main(["figure", mesh, *words, *looks, *more, "-o", str(tmp_path / "a.png")]) == 0
    drawn = app.figure(
        mesh,
        ["biharmonic", "biharmonic - diffusion(t=1/4)"],
        [4, 9],
        areas="barycentric",
        view={"cpos": ("left", "top"), "insets": [(7, 4.0)]},
        marks={"anchors": {3: 0.2, 8: None}},
        isolines=9,
        layout={"hints": False, "size": "500x300", "style": "uniform", "crop": True, "transparent": True},
    )
    drawn.save(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert read_recipe(tmp_path / "a.json") == read_recipe(tmp_path / "b.json")


def test_a_notebook_draws_it_by_itself(mesh_file):
    drawn = app.figure(mesh_file(bumpy(200)), ["biharmonic"], 4, layout={"size": "300x200"})
    shown = np.asarray(Image.open(io.BytesIO(drawn._repr_png_())))
    assert np.array_equal(shown, drawn.pixels)
    assert shown.shape == (200, 300, 3)
    assert repr(drawn) == "Picture(biharmonic, exact, of mesh.off)"


@pytest.mark.parametrize("as_arrays", [True, False])
def test_a_surface_or_arrays_are_saved_beside_and_drawn_again(tmp_path, as_arrays):
    surface = bumpy(200)
    mesh = (surface.vertices, surface.faces) if as_arrays else surface
    camera = Camera((0.0, 0.0, 9.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.4, 0.3))
    fields = {"height": surface.vertices[:, 1]}
    drawn = app.figure(
        mesh, ["biharmonic", "biharmonic - height"], 4, fields=fields, view={"cpos": camera}, layout={"size": "600x200"}
    )
    assert np.array_equal(drawn.answers[0].field, BiharmonicDistance(surface).from_source(4))
    assert drawn.save(tmp_path / "f.png").stat().st_size > 1000
    archive = Path(read_recipe(tmp_path / "f.json").arrays)
    assert sorted(path.name for path in tmp_path.iterdir()) == [archive.name, "f.json", "f.png"]
    assert main(["figure", "--recipe", str(tmp_path / "f.json"), "-o", str(tmp_path / "again.png")]) == 0
    assert (tmp_path / "again.png").read_bytes() == (tmp_path / "f.png").read_bytes()
    assert Path(read_recipe(tmp_path / "again.json").arrays).read_bytes() == archive.read_bytes()


def test_a_field_can_be_named_where_a_recipe_is_drawn_again_and_a_movie_made(tmp_path):
    surface = bumpy(100)
    drawn = app.figure(
        surface, ["biharmonic"], 4, fields={"height": surface.vertices[:, 1]}, layout={"size": "300x200"}
    )
    drawn.save(tmp_path / "f.png")
    words = ["--recipe", str(tmp_path / "f.json"), "--distance", "geodesic - height,height"]
    assert main(["figure", *words, "-o", str(tmp_path / "g.png")]) == 0
    again = [str(panel.shows) for panel in read_recipe(tmp_path / "g.json").document.panels]
    assert again == ["geodesic - height", "height"]
    assert main(["movie", *words, "--frames", "2", "--size", "200x100", "-o", str(tmp_path / "g.gif")]) == 0


def test_an_archive_that_is_gone_gets_a_sentence(tmp_path, capsys):
    app.figure(bumpy(100), ["biharmonic"], 4, layout={"size": "300x200"}).save(tmp_path / "f.png")
    archive = Path(read_recipe(tmp_path / "f.json").arrays)
    archive.unlink()
    assert main(["figure", "--recipe", str(tmp_path / "f.json"), "-o", str(tmp_path / "g.png")]) == 2
    assert str(archive) in capsys.readouterr().err
    assert not (tmp_path / "g.png").exists()


def test_a_flat_surface_becomes_a_relief():
    drawn = app.figure(grid(8, 8), ["biharmonic"], look={"warp_factor": 0.4}, layout={"size": "300x200"})
    flat = app.figure(grid(8, 8), ["biharmonic"], layout={"size": "300x200"})
    assert (drawn.pixels != flat.pixels).any()


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"source": 5000}, VertexError, "no vertex 5000"),
        ({"distances": ["euclidean"]}, ParameterError, "no distance 'euclidean'"),
        ({"layout": {"style": "pink"}}, ParameterError, "no style 'pink'"),
        ({"layout": {"size": "huge"}}, ParameterError, "not a size"),
        ({"view": {"cpos": "inside"}}, ParameterError, "no view 'inside'"),
        ({"distances": []}, ParameterError, "no panels"),
    ],
)
def test_what_makes_no_figure_gets_a_sentence(options, error, words):
    with pytest.raises(error, match=words):
        app.figure(bumpy(60), **options)


def test_what_is_no_mesh_and_a_recipe_that_is_not_there_are_told(tmp_path):
    with pytest.raises(ParameterError, match="not dict"):
        app.figure({}, ["biharmonic"])
    with pytest.raises(FileNotFoundError, match=r"none\.json cannot be read: No such file or directory\.$"):
        app.figure_again(tmp_path / "none.json")


def test_another_extension_is_refused(tmp_path):
    with pytest.raises(OutputError, match=r"\.bmp"):
        app.figure(bumpy(60), ["biharmonic"], layout={"size": "300x200"}).save(tmp_path / "f.bmp")


@pytest.mark.parametrize("name", ["figure", "figure_again", "Picture"])
def test_the_example_in_the_docstring_runs(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # In a checkout the package has another name.
    monkeypatch.setitem(sys.modules, "bihdist", app)
    (test,) = doctest.DocTestFinder(recurse=False).find(getattr(picture, name), name)
    assert doctest.DocTestRunner().run(test) == (0, len(test.examples))


def test_a_picture_turns_as_the_command_turns_it(mesh_file, tmp_path):
    path = mesh_file(bumpy(300))
    words = ["--distance", "biharmonic", "--sources", "4", "--size", "120x120", "--frames", "3", "--fps", "5"]
    assert main(["movie", path, *words, "--turn", "90", "-o", str(tmp_path / "command.gif")]) == 0
    made = app.figure(path, ["biharmonic"], source=4, layout={"size": "120x120"})
    assert made.save_movie(tmp_path / "python.gif", turn=90, frames=3, fps=5) == tmp_path / "python.gif"
    assert (tmp_path / "python.gif").read_bytes() == (tmp_path / "command.gif").read_bytes()
    with pytest.raises(ParameterError, match="2 to 10,000 frames, not 1"):
        made.save_movie(tmp_path / "one.gif", frames=1)
