"""Where cameras stand: standard views turn with what is up, lines of sight may be parallel, and text holds a camera."""

import argparse
import json
import shutil
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

import app
from app.commands.figure import add_figure_options, chosen_recipe
from app.document.camera import ANATOMICAL, VIEWS, Camera
from app.document.camera_text import camera_text, read_camera
from app.document.document import Document, comparison
from app.document.file import read_recipe, recipe_text
from app.document.form import written
from app.document.looks import UPS
from app.document.page import Recipe
from app.document.second_mesh_edits import set_up_axis
from app.drawing.axes import BEYOND, arms, middle
from app.figures.draw import Figure, FigurePanel, draw_figure
from app.figures.hidden_lines import HiddenLineRemoval
from app.figures.raster import RenderWindow
from app.figures.turning import start_and_axis
from app.figures.worker import Worker
from app.main import main
from app.paper import reproduce
from app.samples import mesh_path
from app.scene.camera import Projection, directions, frame, outwards_at, standard_camera
from app.scene.drawable import drawable
from app.scene.style import PAPER
from app.session.questions import first_source
from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.upright import axes_of, axis_of
from tests.shapes import bumpy, grid, sphere

AXES = [up for up in UPS if up != "auto"]
SEEN = [view for view in VIEWS if view not in ("relief", "source", *ANATOMICAL)]


# ---------------------------------------------------------------------- which way is up
@pytest.mark.parametrize("up", AXES)
def test_standard_views_see_of_a_turned_shape_what_they_see_of_it_where_y_is_up(up):
    surface, rotation = bumpy(200), axes_of(up)
    assert np.isclose(np.linalg.det(rotation), 1)
    for view in SEEN:
        usual = standard_camera(surface.vertices, 1.3, view)
        camera = standard_camera(surface.vertices @ rotation.T, 1.3, view, up=up)
        assert np.allclose(camera.position, rotation @ usual.position)
        assert np.allclose(camera.up, rotation @ usual.up)


def test_a_flat_domain_is_looked_at_straight_whatever_is_up_in_it():
    flat = grid(6, 5).vertices
    assert np.ptp(flat[:, 2]) == 0
    for up in ("y", "-y", "x", "-x"):
        seen = frame(standard_camera(flat, 1.0, "home", up=up))
        assert np.allclose(seen[:, 2], [0, 0, 1])
        assert np.allclose(seen[:, 1], axis_of(up))


def test_another_way_up_leaves_standard_views_and_ends_others():
    document = replace(comparison("hand"), up="y", camera="left")
    assert set_up_axis(document, "z").camera == "left"
    free = replace(document, camera=Camera((0.0, 0, 5), (0.0, 0, 0), (0.0, 1, 0), (0.2, 0.2)))
    assert set_up_axis(free, "z") == replace(free, up="z", camera="auto")
    assert set_up_axis(replace(document, camera="high-left"), "z") == replace(document, up="z", camera="auto")
    assert set_up_axis(free, "y") is free


def test_the_highest_vertex_is_along_what_is_up():
    surface = bumpy(300)
    for up in AXES:
        heights = surface.vertices @ axis_of(up)
        assert heights[first_source(surface, up)] == heights.max()


def test_a_movie_turns_about_what_is_up():
    surface = bumpy(200)
    for up in ("y", "z", "-x"):
        camera, axis = start_and_axis("home", surface, (0.0, 360.0), 0.0, [], up)
        assert np.allclose(axis / np.linalg.norm(axis), axis_of(up))
        assert np.dot(camera.up, axis_of(up)) > 0.9


# ---------------------------------------------------------------------- from the source
def test_outwards_is_the_normal_of_a_ball_and_of_one_turned_inside_out():
    ball = sphere(600)
    for surface in (ball, Surface(ball.vertices, ball.faces[:, ::-1])):
        for vertex in (0, 7, 123):
            assert outwards_at(surface, vertex) @ ball.vertices[vertex] > 0.995


def test_outwards_of_something_thin_is_that_of_its_own_side():
    sheet = grid(12, 12)
    x, count = sheet.vertices, len(sheet.vertices)
    lower = x - [0, 0, 0.01]
    both = Surface(np.concatenate([x, lower]), np.concatenate([sheet.faces, sheet.faces[:, ::-1] + count]))
    inside = int(np.linalg.norm(x - x.mean(axis=0), axis=1).argmin())
    first, second = (outwards_at(both, vertex) for vertex in (inside, inside + count))
    assert np.allclose(first, -second)
    assert np.isclose(abs(first[2]), 1)


def test_the_view_from_the_source_has_it_in_front():
    surface = bumpy(600)
    for vertex in (3, 50, 400):
        outwards = outwards_at(surface, vertex)
        for up in ("y", "z"):
            camera = standard_camera(surface.vertices, 1.0, "source", up=up, outwards=outwards)
            assert np.allclose(frame(camera)[:, 2], outwards)
            assert frame(camera)[:, 1] @ axis_of(up) >= 0
            sight = HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (300, 300))
            assert sight.sees(surface.vertices[vertex])
    top = directions("source", "z", np.array([0.0, 0, 1]))
    assert np.allclose(top, directions("top", "z"))
    assert np.allclose(directions("source", "z", np.array([0.0, 0, -1])), directions("bottom", "z"))
    assert np.allclose(directions("source"), directions("home"))


# ---------------------------------------------------------------------- parallel lines of sight
def test_without_perspective_equal_lengths_are_seen_as_equal():
    surface = bumpy(300)
    camera = standard_camera(surface.vertices, 1.5, "home", is_parallel=True)
    seen = Projection(camera, 1.5, surface.vertices, is_parallel=True)
    x, y, depth = seen(surface.vertices).T
    assert (depth > 0).all()
    # What the camera is sure to see, which has margins of its own, is filled in one of the directions.
    assert np.isclose(max(np.abs(x).max(), np.abs(y).max()), 1)
    step = frame(camera) @ [0.01, 0.02, 3.0]
    moved = seen(surface.vertices + step)[:, :2] - np.stack([x, y], 1)
    assert np.allclose(moved, moved[0], atol=1e-12)


@pytest.mark.parametrize("view", ["home", "front", "top"])
def test_pixels_and_curves_agree_on_where_things_are(view):
    """The silhouette that OpenGL draws is that of the vertices as `Projection` sees them."""
    surface, side = bumpy(2000), 300
    for is_parallel in (False, True):
        camera = standard_camera(surface.vertices, 1.0, view, is_parallel=is_parallel)
        projection = Projection(camera, 1.0, surface.vertices, 0.03, is_parallel)
        with closing(RenderWindow(PAPER)) as render_window:
            render_window.shown.show_surface(drawable(surface))
            alpha = render_window.shade(projection, (side, side), 1.0)[..., 3]
        rows, columns = np.flatnonzero(alpha.any(axis=1)), np.flatnonzero(alpha.any(axis=0))
        at = HiddenLineRemoval(surface, projection, (side, side)).pixels(surface.vertices)
        ends = [*at[:, :2].min(axis=0), *at[:, :2].max(axis=0)]
        # A pixel either way, for those that are only touched.
        assert np.allclose([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1], ends, atol=1.01)


# ---------------------------------------------------------------------- the axes
def test_arms_point_where_the_axes_do():
    camera = standard_camera(np.eye(3), 1.0, "front", up="z")
    found = {arm.name: arm for arm in arms(frame(camera))}
    assert np.allclose([found["x"].x, found["x"].y], [1, 0])
    assert np.allclose([found["z"].x, found["z"].y], [0, 1])
    assert found["y"].letter_at is None
    assert found["y"].opacity < found["x"].opacity == 1
    assert next(arm.name for arm in arms(frame(camera))) == "y"


def test_the_cross_stands_in_a_corner_that_is_free():
    assert middle(300, 200, ()) == (BEYOND, 200 - BEYOND)
    assert middle(300, 200, {"bottom left"}) == (300 - BEYOND, 200 - BEYOND)
    assert middle(300, 200, {"bottom left", "bottom right"}) == (BEYOND, BEYOND)


def test_axes_are_drawn_once_for_pictures_that_are_seen_alike():
    surface = bumpy(300)
    panel = FigurePanel(surface, views=("home", "left"))
    plain, crossed = (draw_figure(Figure((replace(panel, axes=a),) * 2)) for a in (False, True))
    columns = np.flatnonzero((plain != crossed).any(axis=(0, 2)))
    width = plain.shape[1]
    assert len(columns)
    assert columns.max() < width / 2
    assert (columns < width / 4).any()
    assert (columns > width / 4).any()


# ---------------------------------------------------------------------- cameras as text
CAMERA = Camera((1.5, -2.25, 3.0), (0.0, 0.125, 0.0), (0.0, 0.0, 1.0), (0.25, 0.2))


def test_a_camera_comes_back_from_text():
    line = camera_text(CAMERA)
    assert line.count(",") == 10
    document = json.dumps({"format": 3, "document": {"camera": written(CAMERA)}})
    for text in (
        line,
        f"--camera {line}",
        f" --camera={line}\n",
        f"'{line}'",
        line.replace(",", " "),
        json.dumps(written(CAMERA)),
        json.dumps({"camera": written(CAMERA)}),
        document,
    ):
        assert read_camera(text) == CAMERA
    assert read_camera("--cpos top") == "top"
    assert read_camera(json.dumps({"document": {"camera": "left"}})) == "left"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is not a camera"),
        ("1,2,3", "'1,2,3' is not a camera"),
        ("hello " * 50, r"\.\.\..*' is not a camera"),
        ("nan," * 10 + "1", "eleven numbers"),
        ("{", "starts like JSON"),
        ('{"position": [1, 2]}', "extent"),
        ('{"document": {}}', "extent"),
        (",".join("0" * 11), "focal point away"),
        ("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]", "is not a camera"),
    ],
)
def test_other_texts_are_no_cameras(text, words):
    with pytest.raises(ParameterError, match=words) as error:
        read_camera(text)
    assert len(str(error.value)) < 250


def test_the_usual_document_leaves_up_to_be_guessed():
    assert Document().up == "auto"


# ---------------------------------------------------------------------- the commands
@pytest.fixture
def scan(tmp_path):
    """The hare, lying on its back in the eyes of whoever takes y for up; a file without a guess of its own."""
    path = tmp_path / "scan.ply"
    shutil.copy(mesh_path("hare"), path)
    return path


def document_of(path):
    return read_recipe(path.with_suffix(".json")).document


def test_a_figure_stands_as_it_is_told_or_as_it_is_guessed(scan, tmp_path):
    first, second, third = (tmp_path / f"{k}.png" for k in range(3))
    few = ["--distance", "geodesic", "--method", "dijkstra", "--size", "200x200"]
    assert main(["figure", str(scan), *few, "-o", str(first)]) == 0
    assert document_of(first).up == "z"
    assert main(["figure", str(scan), *few, "--viewup=-y", "--parallel-projection", "--axes", "-o", str(second)]) == 0
    found = document_of(second)
    assert (found.up, found.parallel_projection, found.axes) == ("-y", True, True)
    assert first.read_bytes() != second.read_bytes()
    # A recipe from before ways up were known was drawn with y up, and is.
    data = json.loads(first.with_suffix(".json").read_text())
    del data["document"]["up"]
    first.with_suffix(".json").write_text(json.dumps(data))
    assert main(["figure", "--recipe", str(first.with_suffix(".json")), "-o", str(third)]) == 0
    assert document_of(third).up == "y"


def test_a_camera_of_a_recipe_is_left_for_another_way_up(scan, tmp_path):
    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    recipe = tmp_path / "r.json"
    shown = replace(comparison(str(scan)), camera=CAMERA, up="y")
    recipe.write_text(recipe_text(Recipe(shown), "0.2"))

    def chosen(*words):
        return chosen_recipe(parser.parse_args(["--recipe", str(recipe), "-o", "x.png", *words])).document

    assert chosen().camera == CAMERA
    assert (chosen("--viewup", "z").camera, chosen("--viewup", "z").up) == ("auto", "z")
    assert chosen("--viewup", "z", "--camera", camera_text(CAMERA)).camera == CAMERA


def test_the_papers_pictures_of_a_mesh_of_ones_own_stand(scan, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(Worker, "ask", lambda self, function, figure: drawn.append(figure) or b"")
    for up, expected in (("auto", "z"), ("x", "x")):
        drawn.clear()
        reproduce.reproduce(str(tmp_path / up), ["fig1"], str(scan), quick=True, say=lambda line: None, up=up)
        assert {panel.up for figure in drawn for panel in figure.panels} == {expected}


def test_python_says_what_is_up(scan):
    picture = app.figure(
        scan, ["geodesic(method=dijkstra)"], view={"viewup": "-z", "axes": True, "parallel_projection": True}
    )
    assert (picture.document.up, picture.document.axes) == ("-z", True)
    with pytest.raises(ParameterError, match="no direction 'sideways'"):
        app.figure(scan, view={"viewup": "sideways"})
