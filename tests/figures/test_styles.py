"""Colours do what their styles promise, also for people with colour-vision deficiencies and in grey."""

import numpy as np
import pytest

from app.scene.style import DARK, LINES, PAPER, STYLES, UNIFORM
from tests.figures.colour_vision import DEFICIENCIES, lab, seen_with, steps, variants


def test_the_measure_knows_black_white_and_red():
    # CIELAB of sRGB red, as tables have it.
    assert lab(np.array([[0.0, 0, 0], [1, 1, 1], [1, 0, 0]])) == pytest.approx(
        np.array([[0, 0, 0], [100, 0, 0], [53.24, 80.09, 67.20]]), abs=0.05
    )
    # People without green cones see greys as everybody does.
    grey = np.full((1, 3), 0.5)
    for name in DEFICIENCIES:
        assert seen_with(name, grey) == pytest.approx(grey, abs=0.002)


def test_the_papers_colours_run_from_dark_blue_over_grey_to_dark_red():
    first, middle, last = PAPER.colours_at(np.array([0.0, 0.5, 1.0]))
    assert first[2] > 3 * max(first[:2])
    assert np.ptp(middle) < 0.1
    assert last[0] > 3 * max(last[1:])
    assert lab(PAPER.colours(3))[[0, 2], 0].max() < 30


def test_equal_steps_look_equal_in_the_uniform_style_to_everybody():
    for name, colours in variants(UNIFORM).items():
        size = steps(colours[::16])
        assert size.max() < (1.25 if name == "as it is" else 2) * size.min(), name


def test_the_uniform_style_gets_lighter_all_the_way_for_everybody():
    for name, colours in variants(UNIFORM).items():
        light = lab(colours)[:, 0]
        assert (np.diff(light[::4]) > 0).all(), name
        assert np.ptp(light) > 50, name
        # Straight within a few units: a share of the range is that share of the lightness.
        straight = np.linspace(light[0], light[-1], len(light))
        assert np.abs(light - straight).max() < 8, name


@pytest.mark.parametrize("style", [PAPER, UNIFORM, DARK])
def test_isolines_stand_out_from_every_colour(style):
    line = lab(np.array([style.isoline]))
    assert np.linalg.norm(lab(style.colours()) - line, axis=1).min() > 12


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_the_line_of_a_section_stands_out_from_the_ground_and_the_inside(style):
    line, *grounds = lab(np.array([style.section, style.background, style.back]))[:, 0]
    assert min(abs(line - ground) for ground in grounds) > 50


@pytest.mark.parametrize("name", STYLES)
def test_text_and_shape_stand_out_from_the_background(name):
    style = STYLES[name]
    ground = lab(np.array([style.background]))[0]
    assert abs(lab(np.array([style.text]))[0, 0] - ground[0]) > 70
    assert abs(lab(np.array([style.quiet_text]))[0, 0] - ground[0]) > 45
    if style.coloured:
        assert np.linalg.norm(lab(style.colours()) - ground, axis=1).min() > 12


def test_isolines_alone_need_no_colour():
    assert np.ptp(LINES.colours(), axis=1).max() == 0
    assert LINES.isoline == (0, 0, 0)
    assert LINES.outline > 0


def test_the_two_sides_of_a_diverging_map_are_told_apart_by_everybody_and_are_equally_light():
    shares = np.linspace(0.1, 1, 40)
    below, above = PAPER.colours_at(-shares, signed=True), PAPER.colours_at(shares, signed=True)
    for name in ("as it is", *DEFICIENCIES):
        sides = (below, above) if name == "as it is" else (seen_with(name, below), seen_with(name, above))
        apart = np.linalg.norm(lab(sides[0]) - lab(sides[1]), axis=1)
        # Brown and violet are for those who confuse red and green; blue and yellow are mixed up by one in 10,000.
        assert apart.min() > (8 if name == "tritanopia" else 18), name
        assert apart[-1] > (25 if name == "tritanopia" else 60), name
        for side in sides:
            assert (np.diff(lab(side)[:, 0]) < 0).all(), name  # darker away from 0
    assert np.abs(lab(below)[:, 0] - lab(above)[:, 0]).max() < 5


@pytest.mark.parametrize("style", [PAPER, UNIFORM, DARK])
def test_lines_and_words_stand_out_from_a_diverging_map(style):
    colours = lab(style.colours(401, signed=True))
    shares = np.linspace(-1, 1, 401)
    inks = [style.isoline_ink(True, share) for share in shares]
    lines = lab(np.array([ink.colour[:3] for ink in inks]))
    # Where a line is hardly seen, its rim is.
    rims = np.array([ink.rim or ink.colour for ink in inks])
    ground = style.colours(401, signed=True)
    rimmed = lab(rims[:, 3:] * rims[:, :3] + (1 - rims[:, 3:]) * ground)
    apart = np.maximum(np.abs(lines[:, 0] - colours[:, 0]), np.abs(rimmed[:, 0] - colours[:, 0]))
    assert apart.min() > 30
    assert {style.isoline_ink(True, share).colour for share in shares if share} == {style.isoline_ink().colour}
    assert np.linalg.norm(colours - lab(np.array([style.largest])), axis=1).min() > 20
