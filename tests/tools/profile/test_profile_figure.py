"""The figure of a profile: a plot for each unit, and words that neither touch nor leave the page."""

import re

import numpy as np
import pytest

from app.drawing.shapes import Box, Text
from app.figures.chart_look import ChartLook
from app.tools.profile.curves import ProfileCurve
from app.tools.profile.figure import ProfileFigure, ProfileKnot, save_profile_figure
from bihdist_core import ParameterError

ARCS = np.linspace(0, 2, 50)
CURVES = (
    ProfileCurve("Biharmonic", "#0A7358", 1 + ARCS, 3.0, "mesh units"),
    ProfileCurve("Geodesic", "#B45309", 1.01 + ARCS, 3.01, "mesh units"),
    ProfileCurve("Diffusion", "#6D4AC7", 9 - ARCS, 9.0, "1 / mesh units"),
    ProfileCurve("Biharmonic − Geodesic", "#1D2125", ARCS / 9, 1.0, is_share=True),
)
KNOTS = (ProfileKnot(0, "1", "#1F7A3D"), ProfileKnot(1.99, "2", "#A84A00"), ProfileKnot(2, "", "#FFDB1A"))


def drawn(tmp_path, figure):
    save_profile_figure(figure, tmp_path / "it.svg")
    return (tmp_path / "it.svg").read_text()


def boxes(tmp_path, figure):
    """(k, 4) of all words of the page in points, and its size."""
    import shutil
    import subprocess

    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is not installed")
    save_profile_figure(figure, tmp_path / "it.pdf")
    said = subprocess.run(
        ["pdftotext", "-bbox", str(tmp_path / "it.pdf"), "-"], check=True, capture_output=True, text=True
    ).stdout
    page = [float(x) for x in re.search(r'<page width="([\d.]+)" height="([\d.]+)"', said).groups()]
    words = re.findall(r'<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">', said)
    return np.array(words, float), page


def test_values_of_several_units_have_a_plot_each(tmp_path):
    figure = ProfileFigure(ARCS, CURVES, False, "mesh units", KNOTS)
    assert [[curve.name for curve in plot] for *_, plot in figure.plots] == [
        ["Biharmonic", "Geodesic"],
        ["Diffusion"],
        ["Biharmonic − Geodesic"],
    ]
    text = drawn(tmp_path, figure)
    for unit in (">mesh units<", ">1 / mesh units<", ">% of the maximum<"):
        assert text.count(unit) == 1
    assert {f"curve-{k}" for k in range(4)} <= set(re.findall(r'id="(curve-\d)"', text))
    # Discs that would lie on each other: the ends go first.
    assert [text.count(f"fill: {colour}") for colour in ("#1f7a3d", "#ffdb1a", "#a84a00")] == [1, 1, 0]


@pytest.mark.parametrize("mm", [60, 85, 140, 178])
def test_no_word_is_off_the_page_or_on_another(tmp_path, mm):
    words, (width, height) = boxes(
        tmp_path, ProfileFigure(ARCS, CURVES, False, "mesh units", KNOTS, look=ChartLook(inches=mm / 25.4))
    )
    assert width == pytest.approx(72 * mm / 25.4, abs=0.01)
    # The boxes have empty rims.
    words += (1.2, 1.2, -1.2, -1.2)
    assert words[:, :2].min() >= 0
    assert (words[:, 2:].max(axis=0) <= (width, height)).all()
    low, high = words[:, None, :2], words[:, None, 2:]
    both = np.minimum(high, high.swapaxes(0, 1)) - np.maximum(low, low.swapaxes(0, 1))
    assert not np.triu((both > 0).all(axis=2), 1).any()


@pytest.mark.parametrize("mm", [60, 85, 140, 178])
@pytest.mark.parametrize("in_shares", [False, True])
def test_words_keep_their_places_on_the_page_and_off_each_other(mm, in_shares):
    figure = ProfileFigure(ARCS, CURVES, in_shares, "mesh units", KNOTS, look=ChartLook(inches=mm / 25.4))
    height = figure.height
    found = []
    for text in (shape for shape in figure.shapes(height) if isinstance(shape, Text)):
        width = figure.look.text_width(text.text, text.size, text.is_bold)
        left = text.x - {"left": 0.0, "centre": 0.5, "right": 1.0}[text.align] * width
        box = Box(left, text.y - 0.75 * text.size, width, 0.75 * text.size)
        if text.level == "capitals":
            box = Box(left, text.y - 0.37 * text.size, width, 0.75 * text.size)
        if text.angle:
            box = Box(text.x - 0.75 * text.size, text.y - width / 2, 0.75 * text.size, width)
        found.append(box)
    page = Box(0, 0, figure.look.width, height)
    assert all(page.contains(box) for box in found)
    assert not any(a.meets(b) for k, a in enumerate(found) for b in found[:k])


def test_on_narrow_pages_plots_stand_below_each_other(tmp_path):
    heights = [
        boxes(tmp_path, ProfileFigure(ARCS, CURVES[:3], False, "m", look=ChartLook(inches=mm / 25.4)))[1][1]
        for mm in (85, 178)
    ]
    assert heights[0] > 1.8 * 72 * 1.5
    assert heights[1] < 2.3 * 72


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="no field along the path"):
        save_profile_figure(ProfileFigure(ARCS, ()), tmp_path / "it.pdf")
