"""What figures can do: sizes, tiles, transparency, cropping, insets, reliefs, views, ranges, marks."""

import re

import numpy as np
import pytest

from app.figures import raster
from app.figures.draw import Figure, FigurePanel, Inset, draw_figure, save_figure
from app.figures.layout import lay_out
from app.figures.picture import figure
from app.figures.size import Size
from app.marks.marked_panel import source_lines
from app.marks.primitives import PointMark
from app.scene.camera import Camera
from app.scene.style import DARK, PAPER, STYLES
from bihdist_core import Curve, ParameterError, Surface, SurfacePoint
from bihdist_core.sources.pieces import pieces_of
from tests.shapes import bumpy, fin, grid, slivers, tetrahedron, two_pieces

SIZE = Size(400, 400, dpi=96)


@pytest.mark.parametrize(
    ("text", "same"),
    [("8.5cm", "85mm"), ("3.5in", "88.9mm"), ("3.5in@600", "88.9mm@600dpi"), ("16x8cm", "160x80mm"), ("85 mm", "85mm")],
)
def test_sizes_in_centimetres_and_inches(text, same):
    assert Size.parse(text) == Size.parse(same)


def test_an_unknown_argument_of_the_function_is_answered_by_the_one_that_is_meant():
    meant = {
        "colors": "look={'cmap': …}",
        "cmap": "look={'cmap': …}",
        "dpi": "layout={'size': …}",
        "wireframe": "look={'show_edges': …}",
        "isolins": "isolines={'count': …}",
        "pins": "marks={'pins': …}",
    }
    for name, written in meant.items():
        with pytest.raises(TypeError, match=rf"figure\(\) got .* '{name}'; did you mean {re.escape(written)}\?$"):
            figure(bumpy(60), **{name: 1})
    with pytest.raises(TypeError, match=r"unknown key 'colors' in look; did you mean look=\{'cmap': …\}\?$"):
        figure(bumpy(60), look={"colors": "ember"})
    with pytest.raises(TypeError, match=r"argument 'frobnicate'$"):
        figure(bumpy(60), frobnicate=1)


def one(surface, field, size=SIZE, figure=None, **options):
    return draw_figure(Figure((FigurePanel(surface, field, **options),), size=size, **(figure or {})))


@pytest.fixture(scope="module")
def ball():
    return bumpy(600)


def test_a_picture_drawn_in_tiles_has_no_seams(ball, monkeypatch):
    field = ball.vertices[:, 1] + 2
    whole = one(ball, field, Size(500, 500, dpi=96)).astype(int)
    monkeypatch.setattr(raster, "TILE", 97)
    tiled = one(ball, field, Size(500, 500, dpi=96)).astype(int)
    # A sample at an edge may fall to its other side; a seam would be whole rows of them.
    different = np.abs(whole - tiled).max(axis=2) > 16
    assert different.sum() < 50
    assert max(different.sum(axis=0).max(), different.sum(axis=1).max()) < 4


def test_lines_keep_their_printed_width(ball):
    flat = grid(20, 20)
    widths = []
    for dpi in (96, 384):
        picture = one(flat, flat.vertices[:, 1], Size(100, 100, "mm", dpi), isolines=8, figure={"style": DARK})
        column = picture[:, round(picture.shape[1] * 0.4)].astype(float)
        inside = column[: round(0.8 * len(column))].min(axis=1)
        # The area of a line's profile over its ground, as a width in millimetres.
        line = np.clip((inside - 170) / (255 - 170), 0, 1)
        widths.append(line.sum() / dpi * 25.4)
    assert widths[0] == pytest.approx(widths[1], rel=0.2)


def test_eight_thousand_pixels_are_the_same_figure_finer(ball):
    panels = (FigurePanel(ball, ball.vertices[:, 1] + 2, "a heading", "a hint", "d", "mesh units"),)
    small = draw_figure(Figure(panels, size=Size(800, 100, dpi=96)))
    large = draw_figure(Figure(panels, size=Size(8000, 1000, dpi=960)))
    assert large.shape == (1000, 8000, 3)
    shrunk = large.reshape(100, 10, 800, 10, 3).mean(axis=(1, 3))
    assert np.abs(shrunk - small).mean() < 1.5


def test_transparent_pictures_are_the_opaque_ones_on_their_background(ball):
    field = ball.vertices[:, 1] + 2
    opaque = one(ball, field, label="d").astype(float)
    clear = one(ball, field, label="d", figure={"transparent": True}).astype(float)
    assert clear.shape[2] == 4
    assert (clear[0, 0] == 0).all()
    alpha = clear[..., 3:] / 255
    assert np.abs(clear[..., :3] * alpha + 255 * (1 - alpha) - opaque).max() <= 3


def spans(alive):
    """The first and last index that is true."""
    found = np.flatnonzero(alive)
    return found[0], found[-1]


def test_a_cropped_page_is_filled_and_its_shapes_are_larger(ball):
    lying = Surface(ball.vertices * (2.5, 1, 1), ball.faces)
    for surface, size in ((ball, Size(85, unit="mm", dpi=96)), (lying, Size(700, 400, dpi=96)), (lying, Size())):
        panels = tuple(FigurePanel(surface, surface.vertices[:, 1] + 2, views=("front",)) for _ in range(3))
        whole, cropped = (draw_figure(Figure(panels, size=size, crop=crop)) for crop in (False, True))
        sheets = [(picture != 255).any(axis=2) for picture in (whole, cropped)]
        # Nothing is empty but a narrow margin.
        for axis in (0, 1):
            low, high = spans(sheets[1].any(axis=1 - axis))
            assert low <= 18
            assert high >= sheets[1].shape[axis] - 19
        coloured = [(np.ptp(picture.astype(int), axis=2) > 40).mean() for picture in (whole, cropped)]
        assert coloured[1] > 1.05 * coloured[0]
    assert cropped.shape[0] < whole.shape[0]


def test_a_zoom_shows_its_vertex_enlarged(ball):
    field = ball.vertices[:, 1] + 2
    vertex = int(ball.vertices[:, 2].argmax())
    plain = one(ball, field, views=("front",), isolines=8)
    zoomed = one(ball, field, views=("front",), isolines=8, insets=(Inset(vertex, 3, "top right"),))
    changed = (plain != zoomed).any(axis=2)
    assert changed[:200, 250:].mean() > 0.2
    inset = zoomed[10:120, 260:380].astype(float)
    assert inset.std() > 20
    away = Camera((0, 0, 5), (9, 0, 0), (0, 1, 0), (0.1, 0.1))
    with pytest.raises(ParameterError, match="outside the picture"):
        one(ball, field, views=(away,), insets=(Inset(vertex),))
    with pytest.raises(ParameterError, match="not 1"):
        Inset(vertex, 1)
    with pytest.raises(ParameterError, match="corner 'middle'"):
        Inset(vertex, 2, "middle")


def test_insets_hide_nothing_and_stay_where_they_are_while_a_shape_turns(ball):
    vertices = [int(ball.vertices[:, k].argmax()) for k in (0, 2)]
    field = ball.vertices[:, 1] + 2
    insets = tuple(Inset(vertex, 4) for vertex in vertices)
    places = set()
    for view in ("front", "home", "right"):
        panel = FigurePanel(ball, field, views=(view,), insets=insets)
        for is_moving in (False, True):
            cell = lay_out(Figure((panel,), size=SIZE, is_moving=is_moving)).cells[0]
            # A ball leaves no corner free: they stand beside it.
            assert not any(inset.meets(other) for inset in cell.insets for other in cell.views)
            assert not cell.insets[0].meets(cell.insets[1])
        places.add(cell.insets)
    assert len(places) == 1


def test_a_relief_rises_where_the_field_does():
    flat = grid(20, 20)
    field = np.linalg.norm(flat.vertices[:, :2] - 10, axis=1)
    plain, raised = (one(flat, field, warp_factor=h, views=("relief",)) for h in (0.0, 0.5))
    assert (plain != raised).any(axis=2).mean() > 0.1
    with pytest.raises(ParameterError, match="flat surface"):
        FigurePanel(bumpy(100), None, warp_factor=0.3)


def test_two_views_show_two_sides_of_one_field(ball):
    field = ball.vertices[:, 0] + 2
    picture = one(ball, field, Size(800, 400, dpi=96), views=("left", "right"), isolines=0)
    left, right = (picture[100:300, a : a + 200].reshape(-1, 3).astype(int) for a in (100, 500))
    assert left[:, 2].sum() > left[:, 0].sum()  # near, blue
    assert right[:, 0].sum() > right[:, 2].sum()  # far, red


def test_a_shared_range_ends_at_the_largest_maximum(ball):
    field = ball.vertices[:, 1] + 2
    panels = tuple(FigurePanel(ball, k * field, unit="mesh units", isolines=0) for k in (1, 2))
    own = draw_figure(Figure(panels, size=Size(800, 400, dpi=96)))
    shared = draw_figure(Figure(panels, size=Size(800, 400, dpi=96), range="shared"))
    part = np.s_[100:250]
    assert np.abs(own[part, :400].astype(int) - own[part, 400:]).mean() < 2
    assert np.abs(shared[part, :400].astype(int) - shared[part, 400:]).mean() > 10
    with pytest.raises(ParameterError, match="cannot share a range"):
        Figure((FigurePanel(ball, field, unit="a"), FigurePanel(ball, field, unit="b")), range="shared")


def test_a_hidden_mark_is_a_ghost_and_is_spoken_of(ball, tmp_path):
    vertex = int(ball.vertices[:, 2].argmax())
    field = ball.vertices[:, 1] + 2
    yellow = np.round(255 * np.array(PAPER.source))
    for views, seen in ((("front",), True), (("back",), False), (("back", "front"), True)):
        without = one(ball, field, views=views)
        marked = one(ball, field, views=views, marks=(PointMark(vertex),))
        changed = (without != marked).any(axis=2)
        assert changed.any()
        has_yellow = (np.abs(marked - yellow) <= 20).all(axis=2).any()
        assert has_yellow == seen
        panel = FigurePanel(ball, field, views=views, marks=(PointMark(vertex),), heading="a name")
        said = save_figure(Figure((panel,), size=SIZE), tmp_path / "f.png")
        assert bool(said) == (not seen)
        if said:
            assert said == [
                f"Vertex {vertex} is hidden in the view back: a dashed ring; try --cpos source or --cpos front,back."
            ]


def test_a_line_that_is_hidden_all_along_is_spoken_of(ball, tmp_path):
    nearest = np.argsort(-ball.vertices[ball.faces].mean(axis=1)[:, 2])[:20]
    curve = Curve((SurfacePoint.of(int(nearest[0]), 0.3, 0.3), SurfacePoint.of(int(nearest[-1]), 0.3, 0.3)))
    lines = tuple(source_lines(pieces_of(curve, ball), "The curve of 2 points"))
    field = ball.vertices[:, 1] + 2
    for views, said in (
        (("front",), []),
        (("back", "front"), []),
        (("back",), ["The curve of 2 points is hidden in the view back; try --cpos source or --cpos front,back."]),
    ):
        panel = FigurePanel(ball, field, views=views, lines=lines, heading="a name")
        assert save_figure(Figure((panel,), size=SIZE), tmp_path / "f.png") == said


def test_rows_and_columns(ball):
    panels = tuple(FigurePanel(ball, None, f"panel {k}") for k in range(5))
    assert Figure(panels, columns=2).grid == (3, 2)
    assert draw_figure(Figure(panels, columns=2, size=Size(1680))).shape == (round(1680 * 3 * 640 / 2 / 560), 1680, 3)
    for wrong in ({"panels": ()}, {"panels": panels, "columns": 0}):
        with pytest.raises(ParameterError):
            Figure(**wrong)


@pytest.mark.parametrize(
    ("text", "pixels"),
    [
        ("1680x640", (1680, 640, 1.0)),
        ("3360", (3360, 1280, 2.0)),
        ("160mm", (1890, 720, 300 / 96)),
        ("160x80mm@600dpi", (3780, 1890, 600 / 96)),
        ("1000px@192dpi", (1000, 381, 2.0)),
    ],
)
def test_sizes_as_one_writes_them(text, pixels):
    assert Size.parse(text).pixels((1680, 640)) == pytest.approx(pixels)


@pytest.mark.parametrize("text", ["", "wide", "0x10", "10mm@3dpi", "-5", "1e3px", "160 km", "99999"])
def test_sizes_that_are_none(text):
    with pytest.raises(ParameterError):
        Size.parse(text).pixels((1680, 640))


def test_a_bad_panel_is_refused(ball):
    for wrong, words in [
        ({"field": np.zeros(3)}, "600 vertices"),
        ({"maximum": 0.0}, "positive"),
        ({"views": ()}, "at least one view"),
        ({"views": ("inside",)}, "no view 'inside'"),
        ({"isolines": -1}, "not -1"),
        ({"marks": (PointMark(600),)}, "no vertex 600"),
    ]:
        with pytest.raises((ParameterError, ValueError), match=words):
            FigurePanel(ball, **wrong)
    with pytest.raises(ParameterError, match="A camera needs"):
        Camera((0, 0, 1), (0, 0, 0), (0, 0, 1), (1, 1))


@pytest.mark.parametrize("style", STYLES)
def test_every_style_draws(ball, style):
    picture = one(ball, ball.vertices[:, 1] + 2, figure={"style": STYLES[style]}, marks=(PointMark(0),))
    assert np.abs(picture[0, 0] / 255 - STYLES[style].background).max() < 0.01
    assert picture.std() > 10


def test_odd_surfaces_and_fields_are_drawn(tmp_path):
    for surface in (fin(), slivers(), two_pieces(), tetrahedron()):
        count = len(surface.vertices)
        vertex = int(surface.faces[0, 0])
        inside = Camera(tuple(surface.vertices[vertex] + 0.1), tuple(surface.vertices.mean(axis=0)), (0, 1, 0), (1, 1))
        field = np.where(surface.component_of_vertex == 0, np.arange(count) / 3.0, np.nan)
        panels = (
            FigurePanel(
                surface, field, "a heading far too long for its panel " * 3, "words " * 60, marks=(PointMark(vertex),)
            ),
            FigurePanel(surface, np.zeros(count)),
            FigurePanel(surface, np.full(count, np.nan)),
            FigurePanel(surface, None),
            FigurePanel(surface, field, views=(inside,)),
        )
        figure = Figure(panels, columns=3, size=Size(240, 200, dpi=96), style=STYLES["lines"], crop=True)
        assert draw_figure(figure).std() > 1
        save_figure(figure, tmp_path / "odd.svg")
        assert (tmp_path / "odd.svg").read_text().count("<image") == 5


def test_in_a_narrow_column_of_print_the_pictures_still_have_most_of_the_room():
    surface = bumpy(100)
    field = np.linspace(0, 1, 100)
    for width, count, views in [("85mm", 1, 1), ("160mm@300dpi", 3, 2), ("174mm", 3, 1)]:
        panels = tuple(
            FigurePanel(surface, field, "heading", "a hint", views=("front", "back")[:views]) for _ in range(count)
        )
        layout = lay_out(Figure(panels, size=Size.parse(width)))
        assert layout.cells[0].views[0].height > 0.5 * layout.height
        assert layout.smallest >= 6  # points: words stay readable
