"""Colour maps do what they promise, bands end where the isolines are, and what a document says of colours is drawn."""

from dataclasses import replace

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from app.document.looks import Colours, Isolines
from app.scene.bands import band_edges, bar_colours, beyond
from app.scene.colour_maps import MAPS, backwards, colours_at, goes_both_ways, lightened, oklab, srgb
from app.scene.drawable import drawable
from app.scene.field_actor import FieldActor
from app.scene.levels import levels
from app.scene.offscreen_renderer import OffscreenRenderer
from app.scene.style import DARK, INK, LINES, PAPER, STYLES, WHITE, line_on, style_of
from bihdist_core import ParameterError
from bihdist_core.surface import Surface
from tests.figures.colour_vision import lab, steps, variants

UNIFORM = ("uniform", "ember", "safe")
BLACK_TO_WHITE = ((0.0, (0.0, 0.0, 0.0)), (1.0, (1.0, 1.0, 1.0)))


def colours_of(word, count=256):
    return colours_at(MAPS[word].stops, np.linspace(0, 1, count))


def test_oklab_is_that_of_its_author_and_goes_back():
    # His table: XYZ (0.950, 1, 1.089), white, is (1, 0, 0).
    assert oklab(np.ones((1, 3))) == pytest.approx(np.array([[1, 0, 0]]), abs=1e-3)
    colours = np.random.default_rng(0).uniform(size=(50, 3))
    assert srgb(oklab(colours)) == pytest.approx(colours, abs=1e-6)


@pytest.mark.parametrize("word", UNIFORM)
def test_equal_steps_of_a_uniform_map_look_equally_large_and_are_lighter_and_lighter(word):
    colours = colours_of(word)
    for every in (4, 16):
        sizes = steps(colours[::every])
        # viridis as it was published reaches 1.25 over steps of 16.
        assert sizes.max() < 1.3 * sizes.min(), every
    for name, seen in variants(replace(PAPER, stops=MAPS[word].stops)).items():
        light = lab(seen)[:, 0]
        assert (np.diff(light[::4]) > 0).all(), name
        assert np.ptp(light) > 50, name


def test_the_safe_map_is_uniform_to_everybody_and_evenly_lighter_in_grey():
    for name, seen in variants(replace(PAPER, stops=MAPS["safe"].stops)).items():
        sizes, light = steps(seen[::16]), lab(seen)[:, 0]
        assert sizes.max() < 1.6 * sizes.min(), name
        assert np.abs(light - np.linspace(light[0], light[-1], len(light))).max() < 3, name


@pytest.mark.parametrize("word", MAPS)
@pytest.mark.parametrize("reversed", [False, True])
def test_isolines_stand_out_from_each_map(word, reversed):
    style = style_of("paper", Colours(word, reversed=reversed))
    ground = lab(style.colours())
    assert np.linalg.norm(ground - lab(np.array([style.isoline])), axis=1).min() > 12
    assert style.isoline == (INK if word == "diverging" else WHITE)


def test_lines_on_a_map_from_black_to_white_are_neither():
    assert line_on(BLACK_TO_WHITE) not in (WHITE, INK)
    assert line_on(((0.0, (1.0, 1.0, 1.0)), (1.0, (0.8, 0.9, 1.0)))) == INK


@pytest.mark.parametrize("word", MAPS)
def test_maps_are_seen_on_a_dark_ground(word):
    colours = style_of("dark", Colours(word)).colours()
    assert np.abs(lab(colours)[:, 0] - lab(np.array([DARK.background]))[0, 0]).min() > 12
    assert style_of("dark", Colours("paper")).stops == DARK.stops
    first = oklab(np.array([lightened(MAPS["ember"].stops)[0][1]]))[0, 0]
    assert first == pytest.approx(0.36, abs=0.01)


def test_differences_share_no_colour_with_the_papers_map():
    shares = np.concatenate([np.linspace(-1, -0.3, 50), np.linspace(0.3, 1, 50)])
    apart = np.linalg.norm(
        lab(PAPER.colours_at(shares, signed=True))[:, None] - lab(PAPER.colours(200))[None], axis=2
    ).min(axis=1)
    assert apart.min() > 10


def test_a_map_of_ones_own_that_is_lightest_in_its_middle_colours_differences_too():
    stops = ((0.0, (0.0, 0.2, 0.5)), (0.5, (1.0, 1.0, 0.9)), (1.0, (0.6, 0.1, 0.0)))
    assert goes_both_ways(stops)
    style = style_of("paper", Colours("mine", stops))
    assert style.colours(3, signed=True) == pytest.approx(np.array([c for _, c in stops]))
    assert [style.isoline_ink(True, value).colour[:3] for value in (0.0, 0.7)] == [INK, style.isoline]
    assert not goes_both_ways(MAPS["ember"].stops)
    assert style_of("paper", Colours("mine", MAPS["ember"].stops)).diverging == PAPER.diverging


def test_what_is_reversed_goes_the_other_way_on_both_sides():
    style, other = style_of("uniform"), style_of("uniform", Colours(reversed=True))
    for signed in (False, True):
        assert other.colours(65, signed) == pytest.approx(style.colours(65, signed)[::-1])
    assert backwards(backwards(MAPS["safe"].stops)) == MAPS["safe"].stops


def test_the_style_of_lines_has_no_colours_and_unknown_words_are_named():
    assert style_of("lines", Colours("ember", bands=True)) == LINES
    for word, style in STYLES.items():
        assert style_of(word) == style
    with pytest.raises(ParameterError, match=r"no style 'pink'; choose one of paper"):
        style_of("pink")
    with pytest.raises(ParameterError, match=r"no colour map 'jet'; choose one of paper, uniform"):
        style_of("paper", Colours("jet"))


# ---------------------------------------------------------------------- bands
@pytest.mark.parametrize("signed", [False, True])
@pytest.mark.parametrize("count", [0, 1, 2, 7, 20, 31])
def test_bands_end_at_the_isolines(count, signed):
    values = levels(Isolines(count), 3.0, 3.0, signed).values
    assert 3.0 * band_edges(Isolines(count), 3.0, signed) == pytest.approx(values)


def test_bands_end_at_multiples_and_at_typed_values():
    assert band_edges(Isolines(spacing=0.3), 1.0) == pytest.approx([0.3, 0.6, 0.9])
    assert band_edges(Isolines(spacing=0.25), 1.0) == pytest.approx([0.25, 0.5, 0.75])
    assert band_edges(Isolines(spacing=0.4), 1.0, True) == pytest.approx([-0.8, -0.4, 0, 0.4, 0.8])
    assert band_edges(Isolines(values=(-1.0, 0.2, 1.0, 7.0)), 2.0) == pytest.approx([0.1, 0.5])
    assert band_edges(Isolines(values=(-1.0, 0.2, 1.0, 7.0)), 2.0, True) == pytest.approx([-0.5, 0.1, 0.5])
    assert not len(band_edges(Isolines(spacing=1e-9), 1.0))  # nobody could tell them apart
    assert not len(band_edges(Isolines(5), 0.0))


def test_each_band_has_the_colour_of_its_middle():
    style = style_of("paper", Colours("ember", bands=True))
    edges = np.array([0.2, 0.5])
    assert style.band_colours(edges) == pytest.approx(style.colours_at(np.array([0.1, 0.35, 0.75])))
    assert bar_colours(style, edges).starts == (0.0, 0.2, 0.5)
    assert bar_colours(style, np.array([-0.5, 0.0, 0.5]), signed=True).starts == (0.0, 0.25, 0.5, 0.75)
    for even in (bar_colours(PAPER, edges), bar_colours(style, np.empty(0))):
        assert not even.starts
        assert len(even.colours) > 100


def test_a_bar_says_whether_the_field_goes_on_beyond_it():
    field = np.array([-1.0, np.nan, 3.0])
    assert beyond(field, 3.0) == (True, False)
    assert beyond(field, 2.0, signed=True) == (False, True)
    assert beyond(field, 0.5, signed=True) == (True, True)
    assert beyond(field, 3.0 * (1 - 1e-9), signed=True) == (False, False)
    assert beyond(None, 1.0) == beyond(field, 0.0) == (False, False)


def painted(style, values, edges, width=1000):
    """(width, 3) the colours of a strip whose field goes evenly from the first of two values to the second."""
    low, high = values
    strip = Surface(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0.2, 0], [0, 0.2, 0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    actor = FieldActor(style)
    actor.show_surface(drawable(strip))
    actor.show_field(np.array([low, high, high, low]), 1.0, low < 0)
    actor.show_bands(edges)
    actor.show_isolines(Isolines(0))
    OffscreenRenderer().close()  # which finds out what can be drawn with here
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.AddActor(actor.actor)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(width, 200)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(100 / width)
    camera.SetPosition(0.5, 0.1, 1)
    camera.SetFocalPoint(0.5, 0.1, 0)
    window.Render()
    read = vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, width - 1, 199, 0, read)
    pixels = vtk_to_numpy(read).reshape(200, width, 4)[100, :, :3].copy()
    window.Finalize()
    return pixels


@pytest.mark.parametrize("low", [0.0, -1.0])
def test_a_surface_changes_its_colour_at_the_edges_to_the_pixel(low):
    style = replace(LINES, stops=MAPS["ember"].stops, diverging=PAPER.diverging, bands=True)
    edges = np.array([0.1003, 0.25, 0.333, 0.5, 0.7707])
    pixels = painted(style, (low, 1.0), edges)
    changes = np.flatnonzero((np.diff(pixels.astype(int), axis=0) != 0).any(axis=1)) + 1
    assert changes == pytest.approx(1000 * (edges - low) / (1 - low), abs=1)
    expected = np.round(255 * style.band_colours(edges, low < 0))
    shown = pixels[[0, *changes]]
    assert np.abs(shown - expected).max() <= 1
