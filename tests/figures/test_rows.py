"""Rows of panels by what they differ in, their headings, and charts at their ends."""

from dataclasses import replace

import numpy as np
import pytest

import app
from app.drawing.shapes import Box, Image, Path, Text, moved, opaque
from app.figures.captions import caption_shapes
from app.figures.layout import lay_out
from app.figures.page_layout import ComposedPage
from bihdist_core import ParameterError, field_agreement
from tests.shapes import sphere

BALL = sphere(120)
TWO = ("biharmonic", "geodesic")
TIMES = ("diffusion(t=1/4)", "diffusion(t=4)")
PATH = {"pins": (3, 90), "profile": True}


def drawn(distances=TWO, source=(3, 50), *, marks=None, look=None, **layout):
    """The figure of a call, and its layout."""
    layout = {"size": "500x600", **layout}
    figure = app.figure(BALL, distances, source, layout=layout, marks=marks, look=look)._figure
    return figure, lay_out(figure)


def heads_of(layout):
    return [[words.lines for words in cell.words if words.is_bold] for cell in layout.cells]


def test_rows_of_sources_have_their_words_at_the_left_and_columns_theirs_on_top():
    figure, layout = drawn(rows="source")
    assert figure.row_heads == ("from 3", "from 50")
    assert heads_of(layout) == [[("biharmonic, exact",)], [("geodesic, exact",)], [], []]
    assert [words.lines for words in layout.heads] == [("from 3",), ("from 50",)]
    for words, cell in zip(layout.heads, layout.cells[::2], strict=True):
        assert words.turned
        assert words.x < cell.box.x
        half = layout.lettering.width(words.lines[0], words.size, True) / 2
        assert cell.box.y <= words.y - half < words.y + half <= cell.box.bottom
    # Headings that later rows have not leave their room to shapes, which are as high in all rows.
    assert layout.cells[2].box.height < layout.cells[0].box.height
    heights = [cell.views[0].height for cell in layout.cells]
    assert max(heights) - min(heights) <= 1 / layout.scale + 1e-9


@pytest.mark.parametrize(
    ("rows", "distances", "row_heads", "column_heads", "order"),
    [
        ("distance", TWO, ("biharmonic, exact", "geodesic, exact"), ("from 3", "from 50"), (0, 2, 1, 3)),
        ("t", TIMES, ("t = 1/4", "t = 4"), ("diffusion, from 3", "diffusion, from 50"), (0, 2, 1, 3)),
        (
            "method",
            ("geodesic(method=heat)", "geodesic(method=dijkstra)"),
            ("heat", "dijkstra"),
            ("geodesic, from 3", "geodesic, from 50"),
            (0, 2, 1, 3),
        ),
        ("alpha", ("power(alpha=3)",), ("α = 3",), ("1/λ^α family, from 3", "1/λ^α family, from 50"), (0, 1)),
    ],
)
def test_rows_of_what_else_panels_differ_in(rows, distances, row_heads, column_heads, order):
    picture = app.figure(BALL, distances, (3, 50), layout={"rows": rows})
    figure = picture._figure
    assert (figure.row_heads, figure.column_heads, figure.order) == (row_heads, column_heads, order)
    for k, panel in zip(figure.order, figure.panels, strict=True):
        assert panel.field is picture.answers[k].field


def test_rows_of_meshes_are_named_by_them():
    other = replace(BALL, vertices=2 * BALL.vertices, name="large.off")
    figure = app.figure(replace(BALL, name="small"), TWO, 3, second_mesh=other, layout={"rows": "mesh"})._figure
    assert figure.row_heads == ("small", "large")
    assert figure.column_heads == ("biharmonic, exact", "geodesic, exact")


def test_differences_lose_the_parameter_of_the_row_on_both_sides():
    figure = app.figure(BALL, [f"{each} - biharmonic" for each in TIMES], 3, layout={"rows": "t"})._figure
    assert figure.row_heads == ("t = 1/4", "t = 4")
    assert figure.column_heads == ("diffusion - biharmonic",)


@pytest.mark.parametrize(
    ("rows", "distances", "part"),
    [
        ("t", TWO, "no parameter t"),
        ("t", (*TIMES, "diffusion(t=1) - biharmonic"), "do not fill"),
        ("colour", TWO, "colour"),
    ],
)
def test_panels_that_do_not_fill_rows_are_refused(rows, distances, part):
    with pytest.raises(ParameterError, match=part):
        drawn(distances, rows=rows)


def test_without_headings_over_panels_there_are_none_of_rows():
    layout = drawn(rows="source", title="none")[1]
    assert heads_of(layout) == [[], [], [], []]
    assert layout.heads == ()


def test_letters_count_charts():
    layout = drawn(rows="source", chart="histogram", panel_letters=True)[1]
    assert [words[-1] for words in heads_of(layout)] == [("(a)",), ("(b)",), ("(d)",), ("(e)",)]
    assert [words.lines[0] for words in layout.heads if not words.turned] == ["(c)", "(f)"]


# ---------------------------------------------------------------------- charts
@pytest.mark.parametrize("size", ["500x600", "178mm", "column", ""])
@pytest.mark.parametrize("chart", ["profile", "scatter", "histogram"])
def test_charts_stand_beside_their_rows_within_the_page(chart, size):
    figure, layout = drawn(chart=chart, size=size, rows="source", marks=PATH)
    assert len(figure.charts) == len(layout.charts) == 2
    for row, box in enumerate(layout.charts):
        left, right = layout.cells[2 * row : 2 * row + 2]
        assert left.box.right <= right.box.x + 1e-6
        assert right.box.right <= box.x + 1e-6 < box.right <= layout.width + 1e-6
        assert left.box.y <= box.y < box.bottom <= left.box.bottom + 1e-6
    plain = caption_shapes(ComposedPage(replace(figure, charts=()), replace(layout, charts=()), []))
    texts = [each for each in caption_shapes(ComposedPage(figure, layout, [])) if isinstance(each, Text)]
    texts = [each for each in texts if each not in plain and not each.angle]
    assert len(texts) > 8
    for text in texts:
        wide = layout.lettering.width(text.text, text.size, text.is_bold)
        start = text.x - {"left": 0, "centre": 0.5, "right": 1}[text.align] * wide
        assert any(
            box.x - 1e-6 <= start and start + wide <= box.right + 1 and box.y <= text.y <= box.bottom
            for box in layout.charts
        )


def test_the_profile_of_a_row_is_of_its_panels():
    figure, _ = drawn(chart="profile", rows="source", marks=PATH)
    for row, (profile,) in enumerate(figure.charts):
        assert [curve.name for curve in profile.curves] == ["Biharmonic", "Geodesic"]
        assert [curve.colour for curve in profile.curves] == [curve.colour for curve in figure.charts[0][0].curves]
        for curve, panel in zip(profile.curves, figure.panels[2 * row : 2 * row + 2], strict=True):
            assert curve.values[[0, -1]] == pytest.approx(panel.field[[3, 90]], abs=1e-12)


def test_the_profile_on_another_pose_is_along_the_path_through_the_same_vertices():
    other = replace(BALL, vertices=BALL.vertices * (1, 1, 3), name="long")
    layout = {"rows": "mesh", "chart": "profile"}
    charts = app.figure(BALL, TWO, 3, second_mesh=other, marks=PATH, layout=layout)._figure.charts
    assert charts[1][0].arcs[-1] > charts[0][0].arcs[-1]
    with pytest.raises(ParameterError, match="other faces"):
        app.figure(BALL, TWO, 3, second_mesh=sphere(200), marks=PATH, layout=layout)
    with pytest.raises(ParameterError, match="--rows mesh"):
        app.figure(BALL, TWO, 3, second_mesh=other, marks=PATH, layout={"chart": "profile"})


def test_the_scatter_of_a_row_is_of_its_first_two_panels():
    figure, _ = drawn((*TWO, "commute-time"), chart="scatter", rows="source")
    for row, (scatter,) in enumerate(figure.charts):
        one, other = figure.panels[3 * row : 3 * row + 2]
        assert scatter.correlation == field_agreement(BALL, one.field, other.field, True).spearman
        assert np.allclose(np.sort(scatter.scatter.x), np.sort(one.field / one.field.max()))


def test_histograms_end_in_the_colours_of_their_bars():
    figure, _ = drawn(chart="histogram", source=3, look={"clim": "shared"})
    tops = figure.upper_limits()
    assert tops[0] == tops[1] > figure.panels[0].own_maximum
    (row,) = figure.charts
    assert [chart.name for chart in row] == ["biharmonic, exact", "geodesic, exact"]
    for chart, top in zip(row, tops, strict=True):
        assert np.array_equal(chart.colours, figure.style.bin_colours(chart.ends, top))


def test_errors_are_of_the_maps_shown(tmp_path):
    np.save(tmp_path / "shifted.npy", np.roll(np.arange(120), 1))
    maps = ("identity", str(tmp_path / "shifted.npy"))
    (row,) = app.figure(BALL, second_mesh=replace(BALL), maps=maps, layout={"chart": "errors"})._figure.charts
    right, wrong = row[0].curves.values()
    assert right.mean == 0 < wrong.mean


@pytest.mark.parametrize(
    ("chart", "distances", "part"),
    [
        ("profile", TWO, "its path"),
        ("scatter", ("biharmonic",), "two panels"),
        ("errors", TWO, "two meshes"),
        ("pie", TWO, "pie"),
    ],
)
def test_charts_that_cannot_be_are_refused_before_the_long_work(chart, distances, part):
    with pytest.raises(ParameterError, match=part):
        app.figure(BALL, distances, 3, layout={"chart": chart})


def test_moved_shapes_keep_all_but_their_places():
    path, text = Path((), at=(1.0, 2.0), scale=(3.0, 3.0)), Text("a", 1.0, 2.0, 8.0, opaque((0, 0, 0)))
    image = Image(np.zeros((1, 1, 4), np.uint8), Box(1, 2, 3, 4))
    found = moved([path, text, image], 10, 20)
    assert found[:2] == [replace(path, at=(11.0, 22.0)), replace(text, x=11.0, y=22.0)]
    assert found[2].box == Box(11, 22, 3, 4)
    assert found[2].pixels is image.pixels


@pytest.mark.parametrize("extension", ["png", "pdf", "svg"])
def test_a_recipe_draws_rows_and_charts_again(tmp_path, extension):
    picture = app.figure(BALL, TIMES, 3, marks=PATH, layout={"size": "300x300", "rows": "t", "chart": "profile"})
    first = picture.save(tmp_path / f"one.{extension}")
    again = app.figure_again(tmp_path / "one.json").save(tmp_path / f"two.{extension}")
    assert first.read_bytes() == again.read_bytes()
