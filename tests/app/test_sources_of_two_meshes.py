"""Where distances start on each of two meshes: vertex ids are of one of them."""

import json

import pytest

import app
from app.document.document import starting_points
from app.document.file import read_recipe
from app.main import main
from bihdist_core import ParameterError
from tests.shapes import bumpy

SMALL = ["--distance", "biharmonic", "--size", "200x100"]


@pytest.fixture
def meshes(mesh_file):
    return [mesh_file(bumpy(60), "a.off"), mesh_file(bumpy(80), "b.off")]


def starts(path):
    return [(point.at, point.surface) for point in starting_points(read_recipe(path).document)]


def test_the_second_source_is_of_the_second_mesh(meshes, tmp_path, capsys):
    assert main(["figure", *meshes, "--sources", "7,70", *SMALL, "-o", str(tmp_path / "x.png")]) == 0
    assert starts(tmp_path / "x.json") == [(7, "A"), (70, "B")]
    assert "--sources" not in capsys.readouterr().err
    picture = app.figure(meshes[0], ["biharmonic"], ["7", 70], beside=meshes[1], size="200x100")
    assert [(point.at, point.surface) for point in starting_points(picture.document)] == [(7, "A"), (70, "B")]


def test_one_source_is_of_the_first_mesh_which_is_said(meshes, tmp_path, capsys):
    assert main(["figure", *meshes, "--sources", "7", *SMALL, "-o", str(tmp_path / "x.png"), "--json"]) == 0
    printed = capsys.readouterr()
    assert "starts from its highest vertex; one of each is named as 7,40" in printed.err
    assert json.loads(printed.out)["sources"][0] == 7
    assert starts(tmp_path / "x.json")[1][0] != 7
    picture = app.figure(meshes[0], ["biharmonic"], [7], beside=meshes[1], size="200x100")
    assert starting_points(picture.document)[1].at == starts(tmp_path / "x.json")[1][0]


@pytest.mark.parametrize("command", ["figure", "view"])
@pytest.mark.parametrize("words", ["1,2,3", "farthest:2", "random:3"])
def test_more_than_one_of_each_mesh_is_refused(meshes, tmp_path, capsys, words, command):
    output = ["-o", str(tmp_path / "x.png")] if command == "figure" else ["--screenshot", str(tmp_path / "x.png")]
    assert main([command, *meshes, "--sources", words, "--distance", "biharmonic", *output]) == 2
    assert "Two meshes have a source each" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.png"))


def test_more_than_one_of_each_mesh_is_refused_in_python(meshes):
    with pytest.raises(ParameterError, match="Two meshes have a source each, not 3"):
        app.figure(meshes[0], ["biharmonic"], [1, 2, 3], beside=meshes[1])


def test_a_vertex_that_the_second_mesh_lacks_is_named_with_it(meshes, tmp_path, capsys):
    assert main(["figure", *meshes, "--sources", "7,80", *SMALL, "-o", str(tmp_path / "x.png")]) == 2
    assert "b.off has no vertex 80" in capsys.readouterr().err


def test_a_recipe_of_two_meshes_takes_a_source_for_each(meshes, tmp_path, capsys):
    first, second = tmp_path / "x.json", tmp_path / "y.json"
    assert main(["figure", *meshes, "--sources", "7,7", *SMALL, "-o", str(tmp_path / "x.png")]) == 0
    again = ["figure", "--recipe", str(first), "-o", str(tmp_path / "y.png")]
    assert main([*again, "--sources", "3,50"]) == 0
    assert starts(second) == [(3, "A"), (50, "B")]
    assert main([*again, "--sources", "3"]) == 2
    assert "start from 2 sources, and --sources names 1; name as many" in capsys.readouterr().err
    assert main([*again, "--distance", "geodesic"]) == 2
    assert "--distance makes the panels of one mesh; this recipe has 2" in capsys.readouterr().err
