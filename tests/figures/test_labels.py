"""Labels on a surface: one colour each, with borders that are smooth and lie between vertices."""

import numpy as np

from app.document.looks import Shading
from app.figures.description import Figure, FigurePanel
from app.figures.draw import lay_out
from app.figures.shots import take_shots
from app.figures.size import Size
from app.scene.style import LINES
from bihdist_core.progress import silent
from tests.shapes import grid

COLOURS = np.array([[1, 0, 0], [0, 0.6, 0], [0, 0, 1], [np.nan] * 3])
SHEET = grid(12, 10)


def picture(labels, **more):
    """The sheet without light, seen from the front, cropped to it."""
    panel = FigurePanel(
        SHEET, None, colours=COLOURS[labels], are_labels=True, views=("front",), up="y", is_parallel=True, **more
    )
    image = take_shots(figure := Figure((panel,), size=Size.parse("500x500"), style=LINES), lay_out(figure), silent)[
        0
    ].image
    rows, columns = (np.flatnonzero((image[..., 3] == 255).any(axis=k)) for k in (1, 0))
    return image[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1, :3] / 255


def weights(labels):
    """How likely three steps to neighbours stay in a vertex's label, by matrices; not less than a quarter."""
    steps = np.eye(len(labels))
    for face in SHEET.faces:
        for k in range(3):
            steps[face[k], face[k - 1]] += 1
            steps[face[k - 1], face[k]] += 1
    steps /= steps.sum(axis=1, keepdims=True)
    steps *= labels[:, None] == labels
    return np.maximum(np.linalg.matrix_power(steps, 3).sum(axis=1), 0.25)


def expected(labels, shape):
    """The colours of pixels, face by face: of the label with most of the corners' weight there."""
    rows, columns = shape
    y, x = np.mgrid[:rows, :columns]
    at = np.stack([(x + 0.5) / columns * 12, 10 - (y + 0.5) / rows * 10, np.ones(shape)], -1)
    colours = np.where(np.isnan(COLOURS), LINES.undefined, COLOURS)
    found, weight = np.zeros((*shape, 3)), weights(labels)
    for face in SHEET.faces:
        corners = np.column_stack([SHEET.vertices[face][:, :2], np.ones(3)])
        shares = at @ np.linalg.inv(corners)
        votes = np.stack([shares @ (weight[face] * (labels[face] == label)) for label in range(4)], -1)
        inside = (shares >= 0).all(axis=-1)
        found[inside] = colours[votes.argmax(axis=-1)][inside]
    return found


def test_each_place_has_the_label_of_most_weight():
    rng = np.random.default_rng(5)
    apart = np.linalg.norm(SHEET.vertices[:, None] - SHEET.vertices[rng.integers(0, 143, 4)], axis=-1)
    labels = np.where(rng.random(143) < 0.1, 1, apart.argmin(axis=1))
    for shading in (Shading(), Shading(show_edges=True)):
        shown = picture(labels, shading=shading)
        is_other = np.abs(shown - expected(labels, shown.shape[:2])).max(axis=-1) > 0.02
        # Borders are blended over a pixel, and edges, where they are drawn, cover some of the rest.
        assert is_other.mean() < (0.2 if shading.show_edges else 0.02)


def test_a_straight_border_is_drawn_straight():
    labels = (SHEET.vertices[:, 0] > 6.2).astype(int)
    shown = picture(labels)
    ends = (shown[..., 0] > 0.5).sum(axis=1) / shown.shape[1] * 12
    inner = ends[len(ends) // 6 : -len(ends) // 6]
    assert np.ptp(inner) < 0.1
    assert abs(inner.mean() - 6.5) < 0.05


def test_a_label_of_one_vertex_is_seen():
    labels = np.zeros(len(SHEET.vertices), int)
    labels[70] = 2
    shown = picture(labels)
    assert 0.0005 < (shown[..., 2] > 0.9).mean() < 0.005
