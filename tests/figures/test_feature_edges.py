"""Lines along sharp edges: all that are seen, where they are seen, and none where there are none."""

from itertools import product

import numpy as np
import pytest

from app.document.looks import AS_IT_IS, Clip, Shading
from app.drawing.glyphs import FEATURE_EDGES
from app.figures.description import Figure, FigurePanel
from app.figures.draw import lay_out, save_figure
from app.figures.hidden_lines import HiddenLineRemoval
from app.figures.shots import take_shots
from app.figures.size import Size
from app.scene.camera import Projection, standard_camera
from app.scene.clipping import clip_plane
from app.scene.drawable import drawable, feature_edges, outward_faces
from app.scene.style import STYLES
from bihdist_core import Surface
from bihdist_core.progress import silent
from tests.figures.hidden_line_reference import seen_by_rays
from tests.shapes import bumpy
from tests.things import box, joined

LOW, HIGH = ((0, 0, 0), (2, 1.4, 1)), ((0.6, 0.5, 1.2), (1.2, 0.9, 1.8))
"""The corners of two boxes, the second over the first."""
BOXES = joined(box(*LOW), box(*HIGH))


def sides_of(low, high, steps=40):
    """Points along the twelve sides of a box, (480, 3)."""
    t, found = (np.arange(steps) + 0.5) / steps, []
    for k, one, other in product(range(3), (0, 1), (0, 1)):
        share = np.empty((steps, 3))
        share[:, k], share[:, k - 1], share[:, k - 2] = t, one, other
        found.append(low + share * np.subtract(high, low))
    return np.concatenate(found)


def lines_of(surface, clip=None, view="home"):
    camera = standard_camera(surface.vertices, 1.0, view)
    plane, mesh = clip_plane(clip, surface), drawable(surface)
    outward = outward_faces(mesh, clip is not None)
    sight = HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (500.0, 500.0), outward, plane)
    lines = sight.along(*feature_edges(surface, AS_IT_IS, whatever_shading=False))
    return sight, camera, [np.concatenate([points, points[:1]]) if closed else points for points, closed in lines]


def away(lines, places):
    """How far places (k, 2) are from lines."""
    pieces = np.concatenate([np.stack([points[:-1], points[1:]], 1) for points in lines])
    a, way = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
    arm = places[:, None] - a
    t = np.clip((arm * way).sum(axis=2) / np.maximum((way * way).sum(axis=1), 1e-300), 0, 1)
    return np.linalg.norm(arm - t[..., None] * way, axis=2).min(axis=1)


@pytest.mark.parametrize("view", ["home", "back", "high-left"])
def test_the_sides_of_boxes_are_drawn_where_rays_see_them(view):
    sight, camera, lines = lines_of(BOXES, view=view)
    places = np.concatenate([sides_of(*LOW), sides_of(*HIGH)])
    eye = np.array(camera.position)
    is_seen = seen_by_rays(BOXES, eye, places + 1e-5 * (eye - places))
    off = away(lines, sight.pixels(places)[:, :2])
    assert off[is_seen].max() < 1e-6
    # Those that are hidden are not drawn, but where another one passes before them.
    assert (off[~is_seen] < 0.3).mean() < 0.1
    on = sight.pixels(places[is_seen])[:, :2]
    for points in lines:
        middles = (points[1:] + points[:-1]) / 2
        assert np.linalg.norm(middles[:, None] - on, axis=2).min(axis=1).max() < 20


def test_the_inside_of_a_body_that_is_cut_shows_none():
    sight, _, lines = lines_of(joined(box(*LOW)), Clip((0.0, 0.0, 1.0), 0.5), "front")
    inner = sides_of(*LOW)
    at = sight.pixels(inner[inner[:, 2] < 0.01])[:, :2]
    drawn = away(lines, at) < 0.5 if lines else np.zeros(len(at), bool)
    assert not drawn.any()


@pytest.mark.parametrize(
    ("style", "shading", "asked", "are_drawn"),
    [
        ("paper", AS_IT_IS, False, False),
        ("paper", AS_IT_IS, True, True),
        ("paper", Shading("smooth"), True, True),
        ("cover", AS_IT_IS, False, True),
        ("cover", Shading("smooth"), False, False),
        ("cover", Shading("flat"), False, False),
        ("cover", Shading(feature_angle=100), True, False),
    ],
)
def test_who_asks_gets_them_and_a_cover_where_the_shading_has_creases(style, shading, asked, are_drawn):
    panel = FigurePanel(BOXES, BOXES.vertices[:, 1], shading=shading, feature_edges=asked)
    figure = Figure((panel,), size=Size.parse("200x200"), style=STYLES[style])
    assert (FEATURE_EDGES in take_shots(figure, lay_out(figure), silent)[0].lines) == are_drawn


def test_what_has_grown_has_none_and_roughness_is_not_drawn():
    smooth, little = bumpy(2000), joined(box((2, 0, 0), (2.005, 0.005, 0.005)))
    assert not len(feature_edges(smooth, AS_IT_IS, whatever_shading=True)[0])
    both = Surface(
        np.concatenate([smooth.vertices, little.vertices]),
        np.concatenate([smooth.faces, little.faces + len(smooth.vertices)]),
    )
    assert not len(feature_edges(both, AS_IT_IS, whatever_shading=True)[0])
    x = both.vertices.copy()
    x[len(smooth.vertices) :] = 10 * little.vertices - 18
    assert len(feature_edges(Surface(x, both.faces), AS_IT_IS, whatever_shading=True)[0]) == 24


def test_they_are_lines_of_a_vector_file(tmp_path):
    panel = FigurePanel(BOXES, BOXES.vertices[:, 1])
    for name in ("cover", "paper"):
        save_figure(Figure((panel,), size=Size.parse("200x200"), style=STYLES[name]), tmp_path / f"{name}.svg")
    assert 'id="feature-edges-0"' in (tmp_path / "cover.svg").read_text()
    assert "feature-edges" not in (tmp_path / "paper.svg").read_text()
