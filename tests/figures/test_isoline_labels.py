"""Values on isolines: on their own lines, apart from each other, in gaps."""

import re
from itertools import combinations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from app.document.looks import Isolines
from app.figures.description import Figure, FigurePanel
from app.figures.draw import described, draw_figure, preview, save_figure
from app.figures.isoline_labels import labelled
from app.figures.layout import lay_out
from app.figures.shots import take_shots
from app.figures.size import Size
from app.scene.line_labels import value_text
from bihdist_core.progress import silent
from tests.shapes import sphere

SIZE = 10.0


def figure(labels=True, count=8):
    ball = sphere(3000)
    field = ball.vertices @ np.array([0.3, 1.0, 0.5]) + 1.2
    return Figure((FigurePanel(ball, field, isolines=Isolines(count, labels=labels)),))


def test_labels_stand_on_their_lines_in_gaps_and_clear_of_each_other():
    of = figure()
    layout = lay_out(of)
    (shot,) = take_shots(of, layout, silent)

    def width(text):
        return layout.lettering.width(text, SIZE)

    lines, labels = labelled(shot, SIZE, width, 10.0)
    assert len(labels) >= 5
    assert len({label.text for label in labels}) == len(labels)
    for label in labels:
        assert label.text == value_text(lines[label.contour].value)
        assert -90 < label.angle <= 90
        whole, rest = (
            np.concatenate([dense(part) for part in each.parts])
            for each in (shot.isolines[label.contour], lines[label.contour])
        )
        middle = np.array([label.x, label.y])
        assert cKDTree(whole).query(middle)[0] <= 0.35 * SIZE + 0.1
        assert cKDTree(rest).query(middle)[0] >= width(label.text) / 2
        others = [dense(p) for k, line in enumerate(lines) if k != label.contour for p in line.parts]
        assert cKDTree(np.concatenate(others)).query(middle)[0] > 0.7 * SIZE
    for one, other in combinations(labels, 2):
        apart = np.hypot(one.x - other.x, one.y - other.y)
        assert apart > (width(one.text) + width(other.text)) / 2


def dense(part):
    points, closed = part
    ring = np.concatenate([points, points[:1]]) if closed else points
    at = np.append(0.0, np.cumsum(np.hypot(*np.diff(ring, axis=0).T)))
    where = np.linspace(0, at[-1], int(4 * at[-1]) + 2)
    return np.stack([np.interp(where, at, ring[:, k]) for k in (0, 1)], 1)


def test_where_lines_are_close_nothing_stands():
    of = figure(count=1000)
    layout = lay_out(of)
    (shot,) = take_shots(of, layout, silent)
    assert labelled(shot, SIZE, lambda text: layout.lettering.width(text, SIZE), 10.0)[1] == []


def narrow(count, width="85mm"):
    """Two panels in a column of a journal, with letters of 8 points."""
    (panel,) = figure(count=count).panels
    return Figure((panel, panel), size=Size.parse(width), crop=True, text=8.0)


def test_values_are_smaller_where_isolines_are_close(tmp_path):
    path = tmp_path / "f.svg"
    assert save_figure(narrow(44), path) == []
    sizes = re.findall(r'id="isoline-label">\s*<text style="[^"]*font-size: ([\d.]+)px', path.read_text())
    assert len(sizes) >= 6
    assert all(0.75 * 0.85 * 8 - 0.01 <= float(size) < 0.85 * 8 for size in sizes)


def test_it_is_said_where_values_have_no_room_at_all(tmp_path):
    said = ["The isolines of panels 1 and 2 are too close for their values; choose fewer isolines or a larger size."]
    assert save_figure(narrow(60, "30mm"), tmp_path / "f.png") == said
    assert list(preview(narrow(60, "30mm"), (300, 300)).remarks) == said
    assert preview(narrow(20), (300, 300)).remarks == ()


@pytest.mark.parametrize(("file", "size"), [("f.pdf", "85.0 x "), ("f.svg", "85.0 x "), ("f.png", "1004 x ")])
def test_the_size_of_a_page_is_in_the_unit_of_its_file(file, size):
    text = described(narrow(8), file)
    assert text.startswith(f"2 panels on {size}")
    assert text.endswith("pixels" if file == "f.png" else "mm")


def test_pictures_have_them_on_wish():
    bare, with_labels = draw_figure(figure(labels=False)), draw_figure(figure())
    assert 200 < (bare != with_labels).any(axis=2).sum() < 0.05 * bare[..., 0].size


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (0.05, "0.05"),
        (1234.6, "1235"),
        (-0.25, "\N{MINUS SIGN}0.25"),
        (3.967, "3.97"),
        (1e-9, "1e\N{MINUS SIGN}09"),
    ],
)
def test_values_have_three_digits(value, text):
    assert value_text(value) == text
