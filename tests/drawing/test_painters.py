"""Shapes are painted alike by Qt and by matplotlib, and pages are told of the same paths."""

import re

import numpy as np
import pytest

from app.drawing.axes import axes_shapes
from app.drawing.colour_bar import BarColours, BarLine, across, bar_shapes, line_shapes, outline_shape
from app.drawing.glyphs import CROSS, DISC, PIN, RING, TRIANGLE_UP, glyph_shapes, label_boxes, ring_shapes
from app.drawing.painters.page import OWN, to_json
from app.drawing.shapes import Box, Gradient, Group, Image, Path, Pen, Text, disc, line, opaque, rectangle, rounded
from app.scene.style import PAPER

SIDE = 120
"""Pixels along the sides of a picture."""

RED, BLUE, BLACK = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)


def by_matplotlib(shapes):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from app.drawing.painters.mpl import paint

    figure = Figure((SIDE / 96, SIDE / 96), 96, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, SIDE)
    axes.set_ylim(SIDE, 0)
    axes.axis("off")
    paint(axes, shapes)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(int)


def by_qt(shapes):
    from qtpy import QtGui

    from app.drawing.painters.qt import paint

    image = QtGui.QImage(SIDE, SIDE, QtGui.QImage.Format.Format_RGB32)
    image.fill(QtGui.QColor("white"))
    painter = QtGui.QPainter(image)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    paint(painter, shapes)
    painter.end()
    return np.array([[image.pixelColor(x, y).getRgb()[:3] for x in range(SIDE)] for y in range(SIDE)])


BAR = BarColours(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), (0.0, 0.4), (True, True))

SCENES = {
    "rectangle": [Path(rectangle(Box(10, 20, 60, 40)), RED)],
    "rounded": [Path(rounded(Box(10, 20, 60, 40), 8), RED, Pen(BLACK, 3))],
    "disc": [disc((60, 60), 40, RED, Pen(BLUE, 6))],
    "line": [line((10, 10), (10, 100), Pen(BLACK, 4)), line((20, 60), (110, 60), Pen(RED, 8, (2.0, 1.0)))],
    "order": [Path(rectangle(Box(10, 10, 60, 60)), RED), Path(rectangle(Box(40, 40, 60, 60)), BLUE)],
    "clipped": [Group((disc((60, 60), 50, RED),), Box(60, 0, 60, 120))],
    "pixels": [Image(np.full((4, 4, 4), (0, 0, 255, 255), np.uint8), Box(20, 20, 80, 80))],
    "bar": [*bar_shapes(Box(20, 40, 80, 20), BAR, 12), *line_shapes(Box(20, 40, 80, 20), [BarLine(0.4, 4, BLACK)])],
    "upright bar": bar_shapes(Box(50, 20, 20, 80), BAR, 12, is_upright=True),
    "axes": [
        shape
        for shape in axes_shapes(np.eye(3), (40, 80), 20.0, 4.0, BLACK[:3])
        if isinstance(shape, Path)  # fonts differ
    ],
    "ring": ring_shapes((60, 60), True, scale=4.0),
    **{
        glyph.name: glyph_shapes(glyph, (60, 80), 20.0, PAPER.named_for("#1F7A3D"))
        for glyph in (DISC, RING, TRIANGLE_UP, CROSS, PIN)
    },
}


@pytest.mark.parametrize("name", SCENES)
def test_qt_and_matplotlib_paint_the_same(application, name):
    apart = np.abs(by_qt(SCENES[name]) - by_matplotlib(SCENES[name])).max(axis=2)
    # Edges are smoothed by each in its own way.
    assert (apart > 128).mean() < 0.005
    assert (apart > 40).mean() < 0.03


def test_a_gradient_goes_from_its_start_to_its_stop_by_both(application):
    box = Box(10, 40, 100, 40)
    colours = tuple((k / 255, 0.0, 1 - k / 255) for k in range(256))
    shapes = [Path(rectangle(box), Gradient((10, 40), (110, 40), colours))]
    for picture in (by_qt(shapes), by_matplotlib(shapes)):
        reds = picture[60, 12:108, 0]
        np.testing.assert_allclose(reds, 255 * (np.arange(12, 108) + 0.5 - 10) / 100, atol=4)


def test_what_is_hit_is_what_is_painted(application):
    from qtpy import QtCore

    from app.drawing.painters.qt import outline

    path = Path(PIN.outline, BLACK, at=(60, 90), scale=(25.0, 25.0))
    painted, hit = by_qt([path])[..., 0] < 128, outline(path)
    contains = [[hit.contains(QtCore.QPointF(x + 0.5, y + 0.5)) for x in range(SIDE)] for y in range(SIDE)]
    assert (painted != np.array(contains)).mean() < 0.005


def test_texts_stand_where_they_are_put_by_both(application):
    for align, start in (("left", 60), ("centre", 30), ("right", 0)):
        for picture in (by_qt, by_matplotlib):
            text = Text("HHHH", 60, 60, 18, BLACK, align=align, level="capitals")
            rows, columns = np.nonzero(picture([text])[..., 0] < 128)
            assert (rows.min() + rows.max()) / 2 == pytest.approx(60, abs=1.5)
            width = columns.max() - columns.min()
            assert columns.min() == pytest.approx(60 - {"left": 0, "centre": width / 2, "right": width}[align], abs=3)
            assert columns.min() >= start - 3


def test_a_turned_text_runs_upwards_by_both(application):
    for picture in (by_qt, by_matplotlib):
        rows, columns = np.nonzero(picture([Text("HHHH", 60, 100, 18, BLACK, angle=90.0)])[..., 0] < 128)
        assert rows.max() == pytest.approx(99, abs=2)
        assert np.ptp(rows) > 2 * np.ptp(columns)
        assert columns.max() <= 61


def test_without_transparency_all_colours_cover():
    from matplotlib.figure import Figure

    from app.drawing.painters.mpl import paint

    axes = Figure().add_subplot()
    for is_opaque, alpha in ((False, 0.5), (True, 1.0)):
        (patch,) = paint(axes, [disc((0, 0), 1, opaque((1, 0, 0), 0.5))], is_opaque=is_opaque)
        assert patch.get_facecolor() == (1, 0, 0, alpha)


# ---------------------------------------------------------------------- pages
def test_a_page_is_told_the_same_places():
    pin = Path(PIN.outline, OWN, Pen(RED, 2.0, (2.0, 1.0), "round", "round"), (10, 20), (3.0, -4.0))
    (told,) = to_json([pin])
    assert (told["fill"], told["line"], told["width"], told["dashes"]) == ("own", "rgb(255, 0, 0)", 2.0, [4.0, 2.0])
    numbers = np.array(re.findall(r"-?\d+\.\d+", told["path"]), float).reshape(-1, 2)
    (part,) = PIN.outline
    points = np.array([part.start, *(point for segment in part.segments for point in segment)])
    np.testing.assert_allclose(numbers, points * (3, -4) + (10, 20), atol=6e-4)
    assert told["path"].count("M") == told["path"].count("Z") == 1


def test_a_page_is_told_texts():
    (told,) = to_json([Text("7", 1.0, 2.0, 11.0, (1.0, 1.0, 1.0, 0.5), True, "centre", "capitals")])
    assert (told["text"], told["x"], told["y"], told["size"], told["weight"]) == ("7", 1.0, 2.0, 11.0, 600)
    assert (told["align"], told["level"], told["colour"]) == ("center", "middle", "rgba(255, 255, 255, 0.5)")


@pytest.mark.parametrize(
    "shape",
    [
        Group((), Box(0, 0, 1, 1)),
        Image(np.zeros((1, 1, 4), np.uint8), Box(0, 0, 1, 1)),
        Path(rectangle(Box(0, 0, 1, 1)), Gradient((0, 0), (1, 0), ((0.0, 0.0, 0.0),))),
    ],
)
def test_a_page_refuses_what_it_cannot_paint(shape):
    with pytest.raises(TypeError, match="A page paints no"):
        to_json([shape])


# ---------------------------------------------------------------------- bars and labels
def test_a_line_across_a_bar_covers_whole_pixels_at_any_ratio():
    box = Box(16, 25, 440, 10)
    for ratio in (1.0, 1.25, 1.5, 2.0):
        for at in np.linspace(0, 1, 23):
            drawn = across(box, at, 2.0, BLACK, pixel=1 / ratio)
            x, half = drawn.subpaths[0].start[0] * ratio, drawn.pen.width * ratio / 2
            assert x - half == pytest.approx(round(x - half))
            assert 2 * half == round(2 * ratio)
            assert abs(x / ratio - (16 + at * 440)) <= 0.5 / ratio + 1e-9


def test_the_outline_of_a_bar_has_points_where_it_goes_beyond():
    box = Box(10, 10, 80, 10)
    for below in (False, True):
        for above in (False, True):
            bar = BarColours(((0.0, 0.0, 0.0),), (), (below, above))
            path = outline_shape(box, bar, 6.0, Pen(BLACK), 2.0)
            xs = [point[0] for part in path.subpaths for segment in part.segments for point in segment]
            assert (min(xs), max(xs)) == (10 - 6 * below, 90 + 6 * above)


def test_labels_of_rank_0_stand_though_they_cover_places():
    crowd = [(50.0 + 3 * k, 50.0) for k in range(9)]
    boxes = label_boxes(crowd, [(40, 20)] * 9, [0] + [1] * 8, Box(0, 0, 200, 200))
    assert boxes[0] is not None
    assert None in boxes
