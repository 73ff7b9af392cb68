"""What is seen of the inside: of surfaces that are cut, and of those that are translucent.

What is cut away leaves no pixel, no line and no mark, and the section line is where it must be; what is translucent is
blended by depth.
"""

from dataclasses import replace

import numpy as np
import pytest

import app
from app.document.document import comparison
from app.document.file import recipe_from_text, recipe_text
from app.document.looks import AXES, NO_LINES, Clip
from app.document.page import Recipe
from app.drawing.glyphs import PATH, SECTION
from app.figures.description import Figure, FigurePanel
from app.figures.draw import lay_out, save_figure
from app.figures.hidden_lines import Curve, HiddenLineRemoval
from app.figures.shots import take_shots
from app.figures.size import Size
from app.marks.primitives import LineMark, PointMark
from app.scene.camera import Projection, standard_camera
from app.scene.clipping import clip_plane
from app.scene.drawable import drawable, has_backs, outward_faces
from app.scene.style import STYLES
from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.progress import silent
from tests.figures.hidden_line_reference import seen_by_rays
from tests.shapes import bumpy, grid, sphere, torus

OBLIQUE = Clip((0.3, -0.2, 0.9), 0.45)


def shot_of(surface, clip=None, style="paper", **more):
    """The picture of a surface with its height as the field, seen along z without perspective."""
    field = surface.vertices[:, 1] - surface.vertices[:, 1].min()
    panel = FigurePanel(surface, field, clip=clip, is_parallel=True, up="y", **{"views": ("front",), **more})
    figure = Figure((panel,), size=Size.parse("300x300"), style=STYLES[style])
    return take_shots(figure, lay_out(figure), silent)[0]


def sight_of(surface, clip, view="home"):
    camera = standard_camera(surface.vertices, 1.0, view)
    projection = Projection(camera, 1.0, surface.vertices)
    mesh = drawable(surface)
    outward = outward_faces(mesh, is_cut=clip is not None)
    plane = clip_plane(clip, surface)
    return HiddenLineRemoval(surface, projection, (500.0, 500.0), outward, plane), camera, plane


# ---------------------------------------------------------------------- words
@pytest.mark.parametrize(
    ("words", "clip"),
    [
        ("x", Clip()),
        ("-y@0.3", Clip((0.0, -1.0, 0.0), 0.3)),
        ("z@1", Clip((0.0, 0.0, 1.0), 1.0)),
        ("0.2,0.1,0.9@0.4", Clip((0.2, 0.1, 0.9), 0.4)),
    ],
)
def test_a_plane_is_written_and_read(words, clip):
    assert Clip.from_words(words) == clip
    assert Clip.from_words(str(clip)) == clip
    document = replace(comparison("hand"), clip=clip)
    assert recipe_from_text(recipe_text(Recipe(document), "")).document == document


@pytest.mark.parametrize("words", ["", "w", "x@2", "x@-0.1", "x@nan", "0,0,0", "1,2", "1,2,inf", "x@half"])
def test_what_is_no_plane_is_refused(words):
    with pytest.raises(ParameterError, match=r"clip plane"):
        Clip.from_words(words)


def test_a_plane_is_where_the_fraction_says_and_turned_over_keeps_the_rest():
    surface = bumpy(300)
    for normal in (*AXES.values(), OBLIQUE.normal, (1e-200, 0.0, 2e-200), (0.0, 3e90, -4e90)):
        plane = clip_plane(Clip(normal, 0.3), surface)
        other = clip_plane(Clip(tuple(-x for x in normal), 0.7), surface)
        assert np.linalg.norm(plane.normal) == pytest.approx(1)
        depths = plane.depths(surface.vertices)
        assert depths.max() / np.ptp(depths) == pytest.approx(0.3)
        np.testing.assert_allclose(other.depths(surface.vertices), -depths, atol=1e-12)


# ---------------------------------------------------------------------- figures
def test_no_pixel_no_line_and_no_mark_is_left_of_what_is_cut_away():
    surface = bumpy(2000)
    x = surface.vertices[:, 0]
    left, right = int(x.argmin()), int(x.argmax())
    across = isolines(surface, surface.vertices[:, 2] - surface.vertices[:, 0] * 1e-3, [0.1])[0]
    path = LineMark(
        np.column_stack([across.edges, across.edges[:, 0]]),
        np.column_stack([*_weights(surface, across), np.zeros(len(across.points))]),
        across.closed,
        PATH,
    )
    marks = PointMark(left), PointMark(right)
    shown = {"marks": marks, "lines": (path,), "views": (standard_camera(surface.vertices, 1.0, "front", "y"),)}
    whole = shot_of(surface, None, "lines", **shown)
    cut = shot_of(surface, Clip(kept=0.4), "lines", **shown)
    plane = clip_plane(Clip(kept=0.4), surface)
    # Along z, x in the picture is x on the shape.
    low, high = (next(mark[1] for mark in whole.marks if mark[0] == k) for k in (0, 1))
    edge = low + (plane.offset - x[left]) / (x[right] - x[left]) * (high - low)
    pixel = whole.box.width / whole.image.shape[1]
    beyond = int(np.ceil((edge - whole.box.x) / pixel)) + 1
    assert whole.image[:, beyond:, 3].any()
    assert not cut.image[:, beyond:, 3].any()
    assert cut.image[:, : beyond - 2, 3].any()
    drawn = {
        "isolines": [part for line in cut.isolines for part in line.parts],
        "outlines": cut.outlines,
        "path": [*cut.lines[PATH].seen, *cut.lines[PATH].course],
        "section": cut.lines[SECTION].seen,
    }
    for name, lines in drawn.items():
        assert lines, name
        assert max(points[:, 0].max() for points, _ in lines) <= edge + 1e-6, name
    # Up to the plane, and not to the vertex before it.
    assert max(points[:, 0].max() for points, _ in drawn["path"]) == pytest.approx(edge, abs=1e-6)
    assert [mark[0] for mark in (*cut.marks, *cut.ghosts)] == [0]
    assert SECTION not in whole.lines


def _weights(surface, line):
    a, b = surface.vertices[line.edges[:, 0]], surface.vertices[line.edges[:, 1]]
    share = np.linalg.norm(line.points - a, axis=1) / np.maximum(np.linalg.norm(b - a, axis=1), 1e-300)
    return 1 - share, share


@pytest.mark.parametrize("clip", [Clip(), OBLIQUE, Clip((0.0, 0.0, -1.0), 0.7)], ids=str)
@pytest.mark.parametrize("surface", [bumpy(1500), torus(48, 24)], ids=["bumpy", "torus"])
def test_the_section_line_goes_through_all_crossings_of_edges_and_plane_that_are_seen(surface, clip):
    sight, camera, plane = sight_of(surface, clip)
    drawn = [np.concatenate([points, points[:1]]) if closed else points for points, closed in sight.section()]
    a, b = surface.vertices[surface.edges.T]
    normal = np.array(plane.normal)
    da, db = plane.offset - a @ normal, plane.offset - b @ normal
    crosses = (da > 0) != (db > 0)
    a, b, da, db = (each[crosses] for each in (a, b, da, db))
    crossing = a + (da / (da - db))[:, None] * (b - a)
    at = sight.pixels(crossing)[:, :2]
    vertices = np.concatenate([points[1:-1] for points in drawn])
    off = np.array([np.abs(at - vertex).max(axis=1).min() for vertex in vertices])
    # Each inner vertex of the line is on an edge and on the plane; in pixels, to rounding.
    assert off.max() < 1e-9
    # Which of the crossings are seen says a ray to each face of what is left.
    eye = np.array(camera.position)
    points, faces = _left(surface, plane)
    seen = seen_by_rays(Surface(points, faces), eye, crossing + 1e-6 * (eye - crossing))
    pieces = np.concatenate([np.stack([points[:-1], points[1:]], 1) for points in drawn])
    from_line = np.array([_away(pieces, place) for place in at])
    assert seen.any()
    assert from_line[seen].max() < 0.3
    # Those that are hidden are not drawn, but near where the line comes out.
    assert (from_line[~seen] < 0.3).sum() <= 0.1 * len(seen)


def _left(surface, plane):
    """What is left of a surface, cut face by face."""
    points, faces = [], []
    for face in surface.faces:
        corners = surface.vertices[face]
        depth = plane.offset - corners @ np.array(plane.normal)
        polygon = []
        for k in range(3):
            p, q, dp, dq = corners[k], corners[(k + 1) % 3], depth[k], depth[(k + 1) % 3]
            if dp > 0:
                polygon.append(p)
            if (dp > 0) != (dq > 0):
                polygon.append(p + dp / (dp - dq) * (q - p))
        for k in range(1, len(polygon) - 1):
            faces.append([len(points), len(points) + 1, len(points) + 2])
            points += [polygon[0], polygon[k], polygon[k + 1]]
    return np.array(points), np.array(faces)


def _away(pieces, place):
    a, way = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
    t = np.clip(((place - a) * way).sum(axis=1) / np.maximum((way * way).sum(axis=1), 1e-300), 0, 1)
    return np.linalg.norm(a + t[:, None] * way - place, axis=1).min()


def test_what_is_left_hides_and_what_is_cut_away_does_not():
    surface = bumpy(1200)
    clip = Clip((0.0, 0.0, 1.0), 0.5)
    sight, camera, plane = sight_of(surface, clip, "front")
    kept = np.flatnonzero(plane.depths(surface.vertices) > 0.05)
    points, faces = _left(surface, plane)
    eye = np.array(camera.position)
    wanted = seen_by_rays(Surface(points, faces), eye, surface.vertices[kept] + 1e-6 * (eye - surface.vertices[kept]))
    found = np.array([sight.sees(surface.vertices[k]) for k in kept])
    assert (found == wanted).mean() > 0.995
    before = sight_of(surface, None, "front")[0]
    assert sum(before.sees(surface.vertices[k]) for k in kept) < 0.2 * wanted.sum()


def test_the_inside_of_a_closed_body_shows_no_isolines_once_it_is_cut():
    closed, sheet = sphere(800), grid(6, 6)
    assert not has_backs(drawable(closed))
    assert has_backs(drawable(closed), is_cut=True)
    assert not has_backs(drawable(sheet), is_cut=True)
    clip = Clip((0.0, 0.0, 1.0), 0.5)
    field = closed.vertices[:, 1]
    lines = isolines(closed, field, np.linspace(-0.8, 0.8, 9))
    sight = sight_of(closed, clip, "front")[0]
    parts = sight.visible(Curve(line.points, line.edges, line.closed) for line in lines)
    # From the front only the inside of the half behind the plane is seen.
    assert sum(map(len, parts)) == 0
    assert sight.section()


def test_marks_that_are_cut_away_are_named(tmp_path):
    surface = bumpy(300)
    order = surface.vertices[:, 0].argsort()
    far, near = int(order[-1]), int(order[0])
    marks = PointMark(far), PointMark(near), PointMark(far, number=2)

    def line(name, vertices):
        return LineMark(np.repeat(vertices[:, None], 3, 1), np.array([[1.0, 0, 0]] * len(vertices)), name=name)

    gone, partly, unnamed = line("The curve", order[-3:]), line("Half", order[[0, -1]]), line("", order[-3:])
    for given, lines, said in (
        (marks[1:2], (partly, unnamed), []),
        (marks[:2], (), [f"Vertex {far} is cut away by the clip plane."]),
        (marks, (), [f"Vertex {far} and 1 other mark are cut away by the clip plane."]),
        (marks[1:2], (gone, partly), ["The curve is cut away by the clip plane."]),
        (marks[2:], (gone,), ["The curve and 1 other mark are cut away by the clip plane."]),
    ):
        panel = FigurePanel(surface, None, views=("left", "right"), marks=given, lines=lines, clip=Clip())
        assert save_figure(Figure((panel,), size=Size.parse("200x200")), tmp_path / "cut.png") == said


def test_figures_take_a_plane_in_python_and_draw_it_again(tmp_path):
    picture = app.figure("hand", ["biharmonic"], 12, view={"clip": "-z@0.4"}, layout={"size": "160x160"})
    pixels = picture.pixels
    assert (pixels != app.figure("hand", ["biharmonic"], 12, layout={"size": "160x160"}).pixels).any()
    picture.save(tmp_path / "cut.png")
    np.testing.assert_array_equal(app.figure_again(tmp_path / "cut.json").pixels, pixels)


def test_what_is_left_fills_the_picture():
    whole, cut = (shot_of(bumpy(2000), clip).image[..., 3] for clip in (None, Clip((0.0, 1.0, 0.0), 0.3)))
    assert cut.any(axis=0).mean() > 0.9 > whole.any(axis=0).mean()
    rows = np.flatnonzero(cut.any(axis=1))
    assert abs(rows[0] + rows[-1] - len(cut)) < 0.02 * len(cut)


# ---------------------------------------------------------------------- translucency
def sheets(*heights):
    """Squares on top of each other, the first the largest, so that parts of it lie under none, one or more of them."""
    flat = [grid(6, 6).vertices * [1 / (k + 1), 1, 0] + [0, 0, z] for k, z in enumerate(heights)]
    faces = [grid(6, 6).faces + k * len(flat[0]) for k in range(len(flat))]
    return Surface(np.concatenate(flat), np.concatenate(faces))


@pytest.mark.parametrize("opacity", [0.2, 0.5, 0.8])
def test_layers_let_through_what_they_should(opacity):
    shot = shot_of(sheets(0.0, 1.0, 2.0), opacity=opacity, isolines=NO_LINES)
    values, counts = np.unique(shot.image[..., 3], return_counts=True)
    common = {int(value) for value, count in zip(values, counts, strict=True) if count > 500 and value}
    wanted = [255 * (1 - (1 - opacity) ** layers) for layers in (1, 2, 3)]
    assert len(common) == 3
    # Of each layer the graphics round.
    np.testing.assert_allclose(sorted(common), wanted, atol=2)
    assert shot.cover.max() == 255
    inside = shot.image[..., 3] >= min(common)
    assert shot.cover[inside].min() >= 254


def test_the_order_of_faces_does_not_matter_to_what_is_seen_through():
    surface = torus(48, 24)
    turned = Surface(surface.vertices, surface.faces[np.random.default_rng(3).permutation(len(surface.faces))])
    tilted = {"opacity": 0.4, "isolines": NO_LINES, "views": ("home",)}
    one, other = (shot_of(each, **tilted).image.astype(int) for each in (surface, turned))
    assert np.abs(one - other).max() <= 3
    assert len(np.unique(one[..., 3])) > 3
    opaque = shot_of(surface, **{**tilted, "opacity": 1.0}).image.astype(int)
    assert np.abs(one - opaque).mean() > 5


def test_what_is_behind_a_translucent_surface_is_drawn():
    surface = bumpy(2000)
    z = surface.vertices[:, 2]
    marks = (PointMark(int(z.argmin())),)
    field = surface.vertices[:, 0] + 0.01 * z
    across = isolines(surface, field, [float(np.median(field))])[0]
    corners = np.column_stack([across.edges, across.edges[:, 0]])
    path = LineMark(corners, np.column_stack([*_weights(surface, across), np.zeros(len(corners))]), across.closed, PATH)
    solid, glass = (shot_of(surface, opacity=opacity, marks=marks, lines=(path,)) for opacity in (1.0, 0.4))
    assert [mark[0] for mark in solid.marks] == []
    assert [mark[0] for mark in glass.marks] == [0]

    def drawn(lines):
        parts = [np.concatenate([p, p[:1]]) if closed else p for p, closed in lines]
        return sum(np.linalg.norm(np.diff(p, axis=0), axis=1).sum() for p in parts)

    length = drawn(solid.lines[PATH].course)
    assert drawn(glass.lines[PATH].course) == pytest.approx(length)
    # What is behind the surface is drawn paler.
    assert drawn(glass.lines[PATH].seen) == pytest.approx(drawn(solid.lines[PATH].seen))
    assert drawn(solid.lines[PATH].seen) < 0.7 * length
    # Isolines before it are curves all the same, and those behind it are painted.
    assert len(glass.isolines) == len(solid.isolines)
    bare = shot_of(surface, opacity=0.4, isolines=NO_LINES)
    assert np.abs(glass.image.astype(int) - bare.image).max() > 20


@pytest.mark.parametrize("opacity", [0.0, -0.5, 1.5, float("nan")])
def test_what_is_no_opacity_is_refused(opacity):
    with pytest.raises(ParameterError, match="opacity"):
        replace(comparison("hand"), opacity=opacity)
