"""Pins in figures: drops with numerals in colours of their own, dashed where the shape hides them."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb

import app
from app.document.shared_parts.pins import Pins
from app.drawing.glyphs import PIN
from app.figures.description import FigurePanel
from app.figures.draw import Figure, draw_figure
from app.figures.size import Size
from app.marks.primitives import PointMark
from app.scene.style import PINS
from bihdist_core import ParameterError
from tests.shapes import bumpy


@pytest.fixture(scope="module")
def ball():
    return bumpy(600)


def picture(ball, *marks):
    panel = FigurePanel(ball, ball.vertices[:, 1] + 2, marks=marks)
    return draw_figure(Figure((panel,), size=Size(400, 400, dpi=96)))


def painted(pixels, colour):
    """Where a picture has a colour, as rows and columns."""
    near = np.abs(pixels / 255 - to_rgb(colour)).max(axis=2) < 0.03
    return np.argwhere(near)


def pin(vertex, number=1):
    return PointMark(vertex, PIN, PINS[number - 1], number=number)


def test_a_pin_is_a_drop_over_its_place(ball):
    place = int((ball.vertices[:, 2] - np.abs(ball.vertices[:, :2]).sum(axis=1)).argmax())
    ring = np.argwhere(np.any(picture(ball, PointMark(place)) != picture(ball), axis=2)).mean(axis=0)
    drop = painted(picture(ball, pin(place)), PINS[0])
    assert len(drop) > 60
    assert drop[:, 0].max() < ring[0] + 2  # all above the place
    assert abs(drop[:, 1].mean() - ring[1]) < 2


def test_a_hidden_pin_is_hollow(ball):
    front, back = (int(end) for end in (ball.vertices[:, 2].argmax(), ball.vertices[:, 2].argmin()))
    bare, whole, hollow = picture(ball), picture(ball, pin(front)), picture(ball, pin(back))
    assert 0 < len(painted(hollow, PINS[0])) < 0.5 * len(painted(whole, PINS[0]))
    white = [(each[np.any(each != bare, axis=2)].min(axis=1) > 240).sum() for each in (whole, hollow)]
    assert white[1] > 1.1 * white[0] > 0


def test_python_draws_them_and_their_colours_say_the_order(tmp_path):
    figures = {
        pins: app.figure("hand", ["biharmonic"], source=12, layout={"size": "300x300"}, marks={"pins": pins})
        for pins in ((9, 40), ())
    }
    changed = np.any(figures[(9, 40)].pixels != figures[()].pixels, axis=2)
    assert changed.any()
    with pytest.raises(ParameterError, match="at most 200 pins"):
        app.figure("hand", ["biharmonic"], source=12, marks={"pins": range(201)})


def test_a_recipe_keeps_its_pins_and_the_option_puts_others(tmp_path, capsys):
    from app.document.file import read_recipe
    from app.main import main

    first, second = str(tmp_path / "a.png"), str(tmp_path / "b.png")
    small = ["--size", "200x200"]
    assert main(["figure", "hand", "--distance", "biharmonic", "--pins", "9,40", *small, "-o", first]) == 0
    recipe = str(tmp_path / "a.json")
    assert [read_recipe(recipe).document.point(pin.point).at for pin in read_recipe(recipe).document[Pins].pins] == [
        9,
        40,
    ]
    # Another distance, and the pins stay; then others.
    for options, expected in ((["--distance", "diffusion"], [9, 40]), (["--pins", "7"], [7])):
        assert main(["figure", "--recipe", recipe, *options, "-o", second]) == 0
        document = read_recipe(str(tmp_path / "b.json")).document
        assert [document.point(pin.point).at for pin in document[Pins].pins] == expected
    assert main(["figure", "hand", "--pins", "100000", *small, "-o", first]) != 0
    assert "100000" in capsys.readouterr().err


def test_many_hidden_pins_are_said_in_one_sentence(ball):
    from app.figures.draw import save_figure

    back = np.argsort(ball.vertices[:, 2])[:5]
    marks = tuple(replace(pin(int(vertex)), number=k + 1) for k, vertex in enumerate(back))
    figure = Figure((FigurePanel(ball, ball.vertices[:, 1] + 2, marks=marks),), size=Size(200, 200, dpi=96))
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        said = save_figure(figure, f"{folder}/a.png")
    assert any("Pin 1 and 4 other pins are hidden" in sentence for sentence in said)


@pytest.mark.parametrize("crop", [True, False])
@pytest.mark.parametrize("title", ["heading", "caption"])
def test_a_drop_at_the_top_is_under_the_heading_and_on_the_page(ball, crop, title):
    from app.figures.layout import lay_out

    top = int(ball.vertices[:, 1].argmax())
    panel = FigurePanel(ball, ball.vertices[:, 1] + 2, heading="biharmonic", marks=(pin(top),))
    figure = Figure((panel,), size=Size(400, 440, dpi=96), crop=crop, title=title)
    layout, pixels = lay_out(figure), draw_figure(figure)
    drop = painted(pixels, PINS[0])
    heading = max((words.y for words in layout.cells[0].words if words.is_bold), default=0.0)
    assert drop[:, 0].min() > heading + 2
    # None of it is cut off: the whole of the head is there.
    assert np.ptp(drop[:, 0]) > 0.7 * (PIN.rise + 0.7) * PIN.reach_of(layout.mark, layout.label)


def test_a_drop_at_the_side_of_a_cropped_page_is_not_cut_off(ball):
    from app.figures.layout import lay_out

    for side in (ball.vertices[:, 0].argmin(), ball.vertices[:, 0].argmax()):
        panel = FigurePanel(ball, ball.vertices[:, 1] + 2, marks=(pin(int(side)),))
        figure = Figure((panel,), size=Size(400, 440, dpi=96), crop=True)
        drop = painted(draw_figure(figure), PINS[0])
        layout = lay_out(figure)
        assert np.ptp(drop[:, 1]) > 1.35 * PIN.reach_of(layout.mark, layout.label)


def test_pages_without_pins_are_as_they_were(ball):
    from app.figures.layout import lay_out
    from app.figures.overhang import overhang

    figure = Figure((FigurePanel(ball, ball.vertices[:, 1] + 2, marks=(PointMark(3),)),), size=Size(400, 440, dpi=96))
    assert overhang(figure, lay_out(figure)) == (0.0, 0.0)


def test_names_stand_at_the_ends_of_lines_and_leave_the_far_side(ball, tmp_path):
    import re

    from app.document.file import read_recipe
    from app.figures.export import figure_of

    front, back = (int(end) for end in (ball.vertices[:, 2].argmax(), ball.vertices[:, 2].argmin()))
    mesh, how = (ball.vertices, ball.faces), {"layout": {"size": "300x300"}, "view": {"cpos": "front"}}

    def texts(pins):
        shot = app.figure(mesh, ["biharmonic"], front, marks={"pins": pins}, **how).save(tmp_path / "a.svg").read_text()
        return set(re.findall(r"<text[^>]*>([^<]*)", shot))

    plain = texts([])
    assert texts({front: "the nose", back: "the tail"}) - plain == {"the nose"}
    recipe = read_recipe(str(tmp_path / "a.json"))
    assert recipe.page.pin_names
    assert [pin.name for pin in recipe.document[Pins].pins] == ["the nose", "the tail"]
    # Pins without names have numbers, and a place in a face has a name like a vertex.
    face = int(np.flatnonzero((ball.faces == front).any(axis=1))[0])
    assert texts({front: "", f"f{face}:0.3,0.3": "here"}) - plain == {"1", "here"}
    # A recipe whose pins have names draws their numbers, as it did, where no names are asked for.
    picture = app.figure(mesh, ["biharmonic"], front, marks={"pins": {front: "the nose"}}, **how)
    page = replace(picture._recipe.page, pin_names=False)
    figure = figure_of(replace(picture._recipe, page=page), picture._surfaces, picture.answers)
    assert [mark.text for mark in figure.panels[0].marks if mark.glyph is PIN] == [""]


def test_a_name_stands_beside_the_shape_where_there_is_room(ball):
    from app.drawing.glyphs import DISC, NAMED

    x, y, z = ball.vertices.T
    right = int(np.where(z > 0, np.hypot(x - 0.5 * x.max(), y - 0.5 * y.max()), np.inf).argmin())
    bare = picture(ball)
    covered = np.any(bare != bare[0, 0], axis=2)

    def share(glyph):
        changed = np.any(picture(ball, PointMark(right, glyph, PINS[0], "the right ear")) != bare, axis=2)
        return changed[covered].sum() / changed.sum()

    assert share(replace(NAMED)) < 0.5 < share(DISC)  # a copy, as movies have from other processes
