"""The figures of scatters and histograms: what is in their files, and where."""

import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.figures.chart_look import ChartLook
from app.figures.histogram_figure import HistogramFigure, save_histogram_figure
from app.figures.scatter_figure import ScatterAxis, ScatterFigure, save_scatter_figure
from app.scene.density import density_picture
from app.scene.style import DARK
from bihdist_core import BihdistError, field_scatter, field_statistics
from tests.shapes import bumpy

GREEN, ORANGE = "#1F7A3D", "#A84A00"


@pytest.fixture(scope="module")
def scatter():
    surface = bumpy(300)
    x = surface.vertices
    return field_scatter(surface, x[:, 0] - x[:, 0].min(), np.abs(x[:, 1]), normalised=True)


@pytest.fixture
def figure(scatter):
    axes = [ScatterAxis(name, "% of the maximum", 0, 1.03) for name in ("one", "other")]
    chosen = scatter.ids[scatter.x > 0.8]
    selections = (("ear & tail", chosen, GREEN), ("<b>", scatter.ids[:4], ORANGE))
    return ScatterFigure(scatter, *axes, selections=selections, correlation=-0.5, largest=7)


def test_a_cell_is_dark_by_what_is_in_it_and_coloured_where_it_is_selected(scatter):
    grid = 40, 30, (0.0, 1.0), (0.0, 1.0)
    picture = density_picture(scatter, grid, (1, 2, 3), [(scatter.ids[:50], (9, 8, 7)), (scatter.ids[:1], (6, 6, 6))])
    number = scatter.density(*grid)[::-1]
    assert np.array_equal(picture[..., 3] > 0, number > 0)
    for k in range(50):
        row, column = 29 - min(int(scatter.y[k] * 30), 29), min(int(scatter.x[k] * 40), 39)
        expected = (6, 6, 6) if (row, column) == place(scatter, 0) else (9, 8, 7)
        assert tuple(picture[row, column]) == (*expected, 255)
    plain = density_picture(scatter, grid, (1, 2, 3))[..., 3]
    fullest = number == number.max()
    assert (plain[fullest] == plain.max()).all()
    assert plain[~fullest].max() < plain.max()


def place(scatter, k):
    return 29 - min(int(scatter.y[k] * 30), 29), min(int(scatter.x[k] * 40), 39)


@pytest.mark.parametrize("extension", ["png", "pdf", "svg", "eps"])
def test_scatters_and_histograms_are_written_in_each_format_and_alike_each_time(figure, extension, tmp_path):
    histogram = HistogramFigure(np.array([0.0, 1.0, 3.0]), np.array([0.25, 0.75]), np.eye(3)[:2], "field", mean=1.5)
    for name, save, it in (("s", save_scatter_figure, figure), ("h", save_histogram_figure, histogram)):
        files = [tmp_path / f"{name}{k}.{extension}" for k in (1, 2)]
        for file in files:
            save(it, file)
        assert files[0].stat().st_size > 2000
        assert files[0].read_bytes() == files[1].read_bytes()


def test_the_words_of_a_scatter(figure, tmp_path):
    save_scatter_figure(figure, tmp_path / "s.svg")
    text = (tmp_path / "s.svg").read_text()
    words = re.findall(r"<text[^>]*>([^<]*)</text>", text)
    for each in ("one (% of the maximum)", "other (% of the maximum)", "rank correlation −0.5000"):
        assert each in words
    chosen = len(figure.selections[0][1])
    assert f"ear &amp; tail ({chosen})" in words
    assert "&lt;b&gt; (4)" in words
    assert 'id="diagonal"' in text
    assert 'id="largest"' in text
    save_scatter_figure(replace(figure, is_common=False, largest=None), tmp_path / "s.svg")
    assert "diagonal" not in (tmp_path / "s.svg").read_text()


def test_selected_points_have_their_colour_on_the_page_and_its_ground(figure, tmp_path):
    save_scatter_figure(replace(figure, look=ChartLook(DARK, inches=3.0)), tmp_path / "s.png")
    pixels = np.asarray(Image.open(tmp_path / "s.png").convert("RGB")).astype(int)
    assert pixels.shape[1] == 900
    for colour in (GREEN, ORANGE):
        rgb = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
        assert (np.abs(pixels - rgb).max(axis=2) < 3).sum() > 300
    assert np.abs(pixels[2, 2] - 255 * np.array(DARK.background)).max() < 1


def test_the_bars_of_a_histogram_are_as_high_as_their_share(tmp_path):
    surface = bumpy(300)
    found = field_statistics(surface, surface.vertices[:, 2], 12)
    shares = found.areas / found.areas.sum()
    colours = np.column_stack([np.linspace(0, 1, 12), np.zeros(12), np.ones(12)])
    save_histogram_figure(HistogramFigure(found.bins, shares, colours, "z"), tmp_path / "h.svg")
    paths = re.findall(r'<path d="([^"]*)"[^>]*style="fill: #..00ff', (tmp_path / "h.svg").read_text())
    heights = []
    for path in paths:
        y = [float(pair[1]) for pair in re.findall(r"(-?[\d.]+) (-?[\d.]+)", path)]
        heights.append(max(y) - min(y))
    assert len(heights) == 12
    assert np.allclose(np.array(heights) / max(heights), shares / shares.max(), atol=1e-4)


def test_what_cannot_be_written_says_why(figure, tmp_path):
    with pytest.raises(BihdistError, match=r"\.bmp"):
        save_scatter_figure(figure, tmp_path / "s.bmp")
    with pytest.raises(BihdistError, match="No font"):
        save_scatter_figure(replace(figure, look=ChartLook(font="No such font")), tmp_path / "s.pdf")
    assert not (tmp_path / "s.pdf").exists()
