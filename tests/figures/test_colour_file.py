"""Colour maps from files are read as they are meant, and what is none is refused by file, line and value."""

import json

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from app.document.looks import Colours
from app.scene.colour_file import colours_named, read_stops
from app.scene.colour_maps import colours_at
from bihdist_core import ParameterError

THREE = ((0.0, (0.0, 0.0, 0.2)), (0.5, (1.0, 0.4, 0.2)), (1.0, (1.0, 1.0, 1.0)))


@pytest.mark.parametrize(
    "text",
    [
        "0 0 0.2\n1 0.4 0.2\n1 1 1\n",
        "# mine\n0,0,0.2\n\n1, 0.4, 0.2  # the middle\n1;1;1",
        "0 0 51\r\n255 102 51\r\n255 255 255\r\n",
        "\ufeffr,g,b\n0,0,51\n255,102,51\n255,255,255\n",
        "0 0 0 0.2\n0.5 1 0.4 0.2\n1 1 1 1\n",
        "-10 0 0 51\n0 255 102 51\n10 255 255 255\n",
        'x\tred\tgreen\tblue\n2\t"0"\t"0"\t"51"\n3\t255\t102\t51\n4\t255\t255\t255\n',
    ],
)
@pytest.mark.parametrize("name", ["map.txt", "map.csv"])
def test_rows_of_numbers_are_read(tmp_path, text, name):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    stops = read_stops(path)
    assert [place for place, _ in stops] == pytest.approx([place for place, _ in THREE])
    assert np.array([c for _, c in stops]) == pytest.approx(np.array([c for _, c in THREE]))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", r"map\.txt: there are 0 colours; a map has 2 to 1024"),
        ("0 0 0", "there are 1 colours"),
        ("0 0 0\n" * 1025, "there are 1025 colours"),
        ("0 0 0\n1 1 red", r"map\.txt, line 2: 'red' is not a number"),
        ("0 0 0\n1 1 nan", r"line 2: 'nan' is not a number"),
        ("0 0 0\n\n1 1", r"line 3: there are 2 numbers, not 3 as above"),
        ("0 0\n1 1", r"line 1: there are 2 numbers, not 3 or 4"),
        ("0 0 0\n1 1.2 1", r"line 2: 1\.2 is not a part of a colour, from 0 to 1\."),
        ("0 0 0\n255 256 1", r"line 2: 256 is not a part of a colour, from 0 to 255\."),
        ("0 0 0\n1 -0.1 1", r"line 2: -0\.1 is not a part"),
        ("0 0 0 0\n2 1 1 1\n1 1 1 1", r"line 3: the place 1 is not beyond 2"),
        ("1 0 0 0\n1 1 1 1", r"line 2: all places are 1\."),
    ],
)
def test_what_is_no_map_is_refused_with_its_line(tmp_path, text, sentence):
    path = tmp_path / "map.txt"
    path.write_text(text)
    with pytest.raises(ParameterError, match=sentence):
        read_stops(path)


def test_files_that_cannot_be_read_are_named(tmp_path):
    with pytest.raises(ParameterError, match=r"gone\.txt cannot be read"):
        read_stops(tmp_path / "gone.txt")
    (tmp_path / "image.txt").write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(ParameterError, match=r"image\.txt cannot be read: it is not a text file"):
        read_stops(tmp_path / "image.txt")


def paraview(tmp_path, **more):
    path = tmp_path / "map.json"
    path.write_text(json.dumps([{"Name": "mine", "RGBPoints": [-1, 0, 0, 0.2, 0, 1, 0.4, 0.2, 1, 1, 1, 1], **more}]))
    return path


def test_paraviews_maps_are_read(tmp_path):
    assert read_stops(paraview(tmp_path)) == THREE
    assert read_stops(paraview(tmp_path, ColorSpace="RGB")) == THREE


@pytest.mark.parametrize("space", ["Lab", "HSV", "Diverging"])
def test_a_way_that_is_straight_in_another_space_is_kept(tmp_path, space):
    stops = read_stops(paraview(tmp_path, ColorSpace=space))
    way = vtkColorTransferFunction()
    getattr(way, f"SetColorSpaceTo{space}")()
    for place, colour in THREE:
        way.AddRGBPoint(place, *colour)
    shares = np.linspace(0, 1, 33)
    assert colours_at(stops, shares) == pytest.approx(np.array([way.GetColor(x) for x in shares]), abs=0.01)
    straight = colours_at(THREE, shares)
    assert np.abs(colours_at(stops, shares) - straight).max() > 0.02


@pytest.mark.parametrize(
    ("data", "sentence"),
    [
        ("{", "is not JSON"),
        ("[" * 1000 + "]" * 1000, "nested more than 64 deep"),
        ([{"RGBPoints": [10**400, 0, 0, 0]}], "not a list of numbers"),
        ([{"RGBPoints": ["red", "green", "blue", 0]}], "not a list of numbers"),
        ([], "has no RGBPoints"),
        ([{"IndexedColors": [0, 0, 0]}], "has no RGBPoints"),
        ([{"Name": "a", "RGBPoints": []}, {"Name": "b", "RGBPoints": []}], r"has 2 colour maps \(a, b\); keep one"),
        ([{"RGBPoints": [0, 0, 0]}], "not a list of numbers, four for each colour"),
        ([{"RGBPoints": [0, 0, 0, "1"]}], "not a list of numbers"),
        (
            [{"RGBPoints": [0, 0, 0, 0, 1, 1, 1, 1.5]}],
            r"colour 2 of RGBPoints, \[1\.0, 1\.0, 1\.5\], is not from 0 to 1",
        ),
        ([{"RGBPoints": [1, 0, 0, 0, 0, 1, 1, 1]}], "do not go up"),
        ([{"RGBPoints": [0, 0, 0, 0, 1, 1, 1, 1], "ColorSpace": "Mine"}], "ColorSpace 'Mine' is not one of ParaView's"),
    ],
)
def test_json_that_is_no_map_is_refused(tmp_path, data, sentence):
    path = tmp_path / "map.json"
    path.write_text(data if isinstance(data, str) else json.dumps(data))
    with pytest.raises(ParameterError, match=rf"map\.json.*{sentence}"):
        read_stops(path)


def test_a_name_is_a_map_or_a_file(tmp_path):
    path = tmp_path / "my map.txt"
    path.write_text("0 0 0\n1 1 1\n")
    now = Colours(reversed=True, bands=True)
    assert colours_named("safe", now) == Colours("safe", (), True, True)
    assert colours_named("", now) == now
    assert colours_named("viridis", now) == Colours("uniform", (), True, True)
    assert colours_named("Viridis") == colours_named("uniform")
    assert colours_named("inferno_r") == Colours("ember", reversed=True)
    assert colours_named(str(path)) == Colours("my map", ((0.0, (0.0, 0.0, 0.0)), (1.0, (1.0, 1.0, 1.0))))
    with pytest.raises(ParameterError, match="no colour map 'jet', and no such file; choose one of paper"):
        colours_named("jet")
