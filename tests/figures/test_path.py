"""The path of a profile in figures: where it lies, dark on white, dotted where it is hidden."""

import re

import numpy as np
import pytest
from PIL import Image

import app
from app.document.page import Recipe
from app.figures.draw import FIGURE_FORMATS
from app.main import main
from app.tools.profile.part import Profile, profile_words, with_profile, words_in
from bihdist_core import ParameterError, Surface, SurfacePoint
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from tests.figures.recipes import SMALL
from tests.shapes import bumpy, two_pieces

SEEN = [
    "--distance",
    "biharmonic",
    "--sources",
    "4",
    "--cpos",
    "front",
    "--isolines",
    "0",
    "--parallel-projection",
]


@pytest.fixture(scope="module")
def ball():
    return bumpy(600)


def ends(ball):
    """Two vertices of the front, far apart, and one of the back."""
    x = ball.vertices
    front = np.flatnonzero(x[:, 2] > 0.5)
    return int(front[x[front, 0].argmin()]), int(front[x[front, 0].argmax()]), int(x[:, 2].argmin())


def strokes(text):
    """The lines of the path in an SVG, each a list of points (k, 2), by their widths in points."""
    found = {}
    for group in re.findall(r'<g id="path-0">(.*?)</g>', text, re.DOTALL):
        points = np.array(re.findall(r"[ML] (\S+) (\S+)", group), float)
        width, dots = (re.search(f'stroke-{word}: ([^;"]*)', group) for word in ("width", "dasharray"))
        found.setdefault((float(width[1]), bool(dots)), []).append(points)
    return found


def test_it_lies_where_the_path_is(ball, mesh_file, tmp_path):
    a, b, _ = ends(ball)
    path = GeodesicPaths(ball).path([a, b])
    assert main(["figure", mesh_file(ball), *SEEN, "--profile", f"{a},{b}", "-o", str(tmp_path / "f.svg")]) == 0
    found = strokes((tmp_path / "f.svg").read_text())
    widths = sorted(found)
    # Dotted below, then white and dark, in steps of a page of 560 pixels.
    assert [dotted for _, dotted in widths] == [True, False, True, False]
    assert np.array([width for width, _ in widths]) == pytest.approx(0.75 * np.array([1.5, 2.0, 4.0, 4.5]), rel=1e-3)
    (line,) = found[widths[1]]
    # The front, seen in parallel: x to the right, y up, in one scale.
    x = path.points[:, :2]
    scale = np.linalg.norm(line[-1] - line[0]) / np.linalg.norm(x[-1] - x[0])
    placed = (x - x[0]) * (scale, -scale) + line[0]
    assert np.allclose(placed[-1], line[-1], 0, 0.05)
    # Of the exact course it may leave out what is not seen.
    nearest = np.linalg.norm(line[:, None] - placed[None], axis=2).min(axis=1)
    assert nearest.max() < 0.05


def test_what_is_hidden_is_dotted(ball, mesh_file, tmp_path):
    a, _, back = ends(ball)
    path, files = mesh_file(ball), {}
    for name, words in (("bare", []), ("path", ["--profile", f"{a},{back}"])):
        assert main(["figure", path, *SEEN, *words, "--size", "500x500", "-o", str(tmp_path / f"{name}.png")]) == 0
        files[name] = np.asarray(Image.open(tmp_path / f"{name}.png")).astype(int)
        assert main(["figure", path, *SEEN, *words, "-o", str(tmp_path / f"{name}.svg")]) == 0
    changed = np.abs(files["path"] - files["bare"]).max(axis=2) > 60
    assert changed.sum() > 300
    found = strokes((tmp_path / "path.svg").read_text())
    widths = sorted(found)
    lengths = [sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in found[key]) for key in widths]
    assert lengths[1] == pytest.approx(lengths[3])
    assert 0 < lengths[1] < 0.8 * lengths[0]


@pytest.mark.usefixtures("unmeasured_fonts")
def test_all_formats_movies_and_python_have_it(ball, mesh_file, tmp_path):
    a, b, _ = ends(ball)
    path = mesh_file(ball)
    for extension in FIGURE_FORMATS:
        sizes = []
        for words in ([], ["--profile", f"{a},{b}"]):
            out = tmp_path / f"f{extension}"
            assert main(["figure", path, *SEEN, *words, *SMALL, "-o", str(out)]) == 0
            sizes.append(out.read_bytes())
        assert sizes[0] != sizes[1]
    common = {"source": 4, "layout": {"size": "200x200"}}
    bare, drawn = (
        app.figure(path, ["biharmonic"], marks={"profile": points}, **common) for points in (False, ["source", b])
    )
    assert (bare.pixels != drawn.pixels).any()
    for words in ([], ["--profile", f"source,{b}"]):
        out = tmp_path / f"m{len(words)}.gif"
        go = ["movie", path, "--distance", "biharmonic", "--path", f"4,{a}", "--turn", "0", "--frames", "3"]
        assert main([*go, *words, "--size", "120x120", "-o", str(out)]) == 0
    assert (tmp_path / "m0.gif").read_bytes() != (tmp_path / "m2.gif").read_bytes()


def test_where_there_is_none_a_sentence_says_why(mesh_file, tmp_path, capsys):
    both = two_pieces()
    path = mesh_file(Surface(both.vertices, both.faces))
    assert main(["figure", path, "--distance", "biharmonic", "--profile", "0,63", "-o", str(tmp_path / "f.png")]) == 0
    said = capsys.readouterr().err
    assert "There is no path from vertex 0 to vertex 63: they are on" in said


def test_the_words_of_a_path(ball):
    assert words_in("source,pin:2 f3:0.2,0.5,40") == ["source", "pin:2", "f3:0.2,0.5", "40"]
    picture = app.figure(
        "hand",
        ["biharmonic"],
        source=12,
        marks={"pins": [9, 40], "profile": ["pin:2", 7, SurfacePoint.of(3, 0.2, 0.5)]},
    )
    document = picture._recipe.document
    assert isinstance(picture._recipe, Recipe)
    assert profile_words(document) == ["pin:2", 7, "f3:0.2,0.5"]
    assert with_profile(document)[Profile].points == ()
    for words, said in (
        (["pin:3", 4], "no pin 3 for a profile to go through; there are 2"),
        (["source:2", 4], "no source 2"),
        (["loop:0", 4], "vertices and places in faces, not loop:0"),
        ([4], "two points or more"),
    ):
        with pytest.raises(ParameterError, match=said):
            with_profile(document, words)
    with pytest.raises(ParameterError, match="needs a direction"):
        with_profile(document, way="section")
    with pytest.raises(ParameterError, match="only sections have one"):
        with_profile(document, across=(0, 0, 1))


@pytest.mark.parametrize("words", [["--way", "edges"], ["--profile", "3,4", "--across", "1,2"]])
def test_options_that_make_no_sense_are_refused(mesh, tmp_path, words, capsys):
    try:
        code = main(["figure", mesh, *words, "-o", str(tmp_path / "f.png")])
    except SystemExit as stop:
        code = stop.code
    assert code
    assert "--across" in capsys.readouterr().err
