"""What the modules of a page's viewer compute, run by node: fields, isolines, the camera, picking, links."""

import json
import math
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv

from app.document.document import comparison
from app.document.looks import Clip, Isolines, Shading
from app.marks.primitives import PointMark, cut_away_words
from app.samples import mesh_path
from app.scene.camera import Projection, standard_camera
from app.scene.clipping import clip_plane, cut_through
from app.scene.drawable import copies_of, crease_of, drawable
from app.scene.levels import levels
from app.scene.splats import at_corners
from app.web.export import _cut
from app.web.stored_mesh import StoredMatrices, StoredMesh
from bihdist_core import Laplacian, PointCloud, TetrahedralMesh, read_surface
from bihdist_core.distances.difference import difference_in_unit
from tests.core.test_tetrahedra import ball
from tests.shapes import bumpy, grid, sphere, torus

VIEWER = Path(__file__).parents[2] / "app" / "web" / "viewer"
NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="there is no node")


def ask(question, **given):
    script = Path(__file__).with_name("viewer.mjs")
    text = json.dumps({"question": question, **given})
    return json.loads(
        subprocess.run([NODE, script, VIEWER], input=text, capture_output=True, text=True, check=True).stdout
    )


def as_mesh(s):
    return {"vertices": s.vertices.tolist(), "faces": s.faces.tolist()}


def view_of(s, parallel=False):
    camera = standard_camera(s.vertices, 1.0, "home", is_parallel=parallel)
    high = camera.extent[1] * math.dist(camera.position, camera.focal_point)
    angle = math.degrees(2 * math.atan(camera.extent[1]))
    place = {"position": camera.position, "focal": camera.focal_point, "up": camera.up}
    return camera, {**place, "angle": angle, "parallel": high if parallel else None}


# ---------------------------------------------------------------------- numbers, fields and isolines
def test_numbers_have_four_digits_and_a_true_minus():
    values = [0.35674, 1.1573, 12345, -0.023, 1.2e-7, 0, 99999.96, 3.2e8, 0.00099996]
    said = ["0.3567", "1.157", "12,345", "−0.02300", "1.200e−7", "0", "100,000", "3.200e8", "0.001000"]
    assert ask("numbers", values=values) == said


@pytest.mark.parametrize(("low", "high", "most"), [(0, 0.6931, 6), (-28.6, 28.6, 6), (0, 1.781, 4), (0, 100, 3)])
def test_ticks_are_round_and_few(low, high, most):
    found = np.array(ask("ticks", low=low, high=high, most=most))
    assert 2 <= len(found) <= max(most, 2)
    assert found[0] >= low - 1e-9
    assert found[-1] <= high + 1e-9
    step = np.diff(found)[0]
    assert np.allclose(np.diff(found), step)
    assert round(step / 10 ** math.floor(math.log10(step)), 6) in (1, 2, 2.5, 5)


@pytest.mark.parametrize("signed", [False, True])
@pytest.mark.parametrize(
    "isolines", [Isolines(), Isolines(7), Isolines(12, round=False), Isolines(values=(0.1, 0.4, 3.0))]
)
@pytest.mark.parametrize(("own", "high"), [(0.6931, 0.6931), (1.781, 1.0), (0.3, 4.0)])
def test_isolines_are_at_the_windows_values(isolines, own, high, signed):
    given = {"count": isolines.count, "values": list(isolines.values) or None, "equal": not isolines.round}
    found = ask("levels", isolines=given, own=own, high=high, signed=signed)
    np.testing.assert_allclose(found, levels(isolines, high, own, signed).values, atol=1e-12)


def test_without_isolines_there_are_none():
    assert ask("levels", isolines={"count": 0, "values": None}, own=1.0, high=1.0, signed=False) == []
    assert ask("levels", isolines={"count": 20, "values": None}, own=0.0, high=0.0, signed=False) == []


@pytest.mark.parametrize(("unit", "raw"), [("percentage points", False), ("mesh units", True)])
def test_a_difference_is_the_librarys(unit, raw):
    a, b = np.random.default_rng(3).random((2, 50))
    a[:5] = b[:5] = np.nan
    fields = {name: [None if np.isnan(x) else x for x in field] for name, field in (("a", a), ("b", b))}
    panel = {"distance": "difference", "of": ["a", "b"], "unit": unit, "range": None, "signed": True, "note": ""}
    said = ask("panel", panel=panel, fields=fields)
    expected = difference_in_unit(a, b, ("mesh units", "mesh units"), raw)[0]
    np.testing.assert_allclose(np.array(said["values"], float), expected, atol=1e-12)
    top = np.nanmax(np.abs(expected))
    assert said["signed"]
    assert (said["low"], said["high"]) == pytest.approx((-top, top))


def test_a_panels_range_is_its_own_maximum_or_what_it_is_given():
    fields, panel = (
        {"biharmonic": [0.0, 2.0, None]},
        {"distance": "biharmonic", "unit": "", "range": None, "signed": False, "note": ""},
    )
    said = ask("panel", panel=panel, fields=fields)
    assert (said["low"], said["high"], said["own"], said["signed"]) == (0, 2, 2, False)
    said = ask("panel", panel={**panel, "range": [0.5, 5]}, fields=fields)
    assert (said["low"], said["high"], said["own"]) == (0.5, 5, 2)


# ---------------------------------------------------------------------- questions to the solver
def test_no_distance_waits_for_exact_geodesic_distance():
    answer = ask("lanes", questions=[{"vertex": 4, "isFinal": True}], answered=[])
    assert answer["told"] == [[4, "biharmonic"]]
    answer = ask("lanes", questions=[{"vertex": 4, "isFinal": True}], answered=[1])
    assert answer["told"] == [[4, "biharmonic"], [4, "geodesic"]]
    assert answer["resolved"] == [["biharmonic", "geodesic"]]


def test_a_click_gives_up_the_geodesic_distance_of_the_click_before():
    clicks = [{"vertex": vertex, "isFinal": True} for vertex in (4, 7, 9)]
    answer = ask("lanes", questions=clicks, answered=[1, 3])  # what is given up says nothing any more
    assert answer["told"] == [[4, "biharmonic"], [7, "biharmonic"], [9, "biharmonic"], [9, "geodesic"]]
    assert answer["resolved"] == [None, None, ["biharmonic", "geodesic"]]


def test_a_drag_finishes_one_geodesic_distance_and_skips_to_the_latest():
    passing = [{"vertex": vertex, "isFinal": False} for vertex in (4, 7, 9)]
    answer = ask("lanes", questions=passing, answered=[1, 1])
    assert answer["told"][3:] == [[4, "geodesic"], [9, "geodesic"]]
    # Where the drag ends, what is computed already is waited for.
    answer = ask("lanes", questions=[passing[0], {"vertex": 4, "isFinal": True}], answered=[1])
    assert answer["workers"] == 2
    assert answer["told"][2:] == [[4, "geodesic"]]
    assert answer["resolved"] == [None, ["biharmonic", "geodesic"]]


# ---------------------------------------------------------------------- camera and picking
@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.5])
def test_vertices_are_drawn_where_marks_are_and_all_are_in_the_picture(parallel, aspect):
    s = bumpy(300)
    said = ask("projected", mesh=as_mesh(s), view=view_of(s, parallel)[1], aspect=aspect, acts=[])
    drawn, placed = (np.array([each[name] for each in said]) for name in ("drawn", "placed"))
    np.testing.assert_allclose(placed[:, 0], 50 * aspect * (drawn[:, 0] + 1), atol=1e-3)
    np.testing.assert_allclose(placed[:, 1], 50 * (1 - drawn[:, 1]), atol=1e-3)
    assert np.abs(drawn).max() <= 1
    # The shape fills the panel, in one direction at least.
    assert np.abs(drawn[:, :2]).max() > 0.9


@pytest.mark.parametrize("parallel", [False, True])
def test_the_camera_sees_what_the_windows_does(parallel):
    s = bumpy(300)
    camera, view = view_of(s, parallel)
    said = ask("projected", mesh=as_mesh(s), view=view, aspect=1.0, acts=[])
    drawn = np.array([each["drawn"] for each in said])[:, :2]
    expected = Projection(camera, 1.0, s.vertices, is_parallel=parallel)(s.vertices)[:, :2]
    scale = np.abs(drawn).max() / np.abs(expected).max()  # the page leaves another margin
    np.testing.assert_allclose(drawn, scale * expected, atol=1e-4)


def test_of_a_convex_surface_half_is_seen_and_met():
    s = sphere(400)
    camera, view = view_of(s)
    said = ask("projected", mesh=as_mesh(s), view=view, aspect=1.0, acts=[])
    toward = np.subtract(camera.position, s.vertices)
    cosine = (s.vertices * toward).sum(axis=1) / np.linalg.norm(s.vertices, axis=1) / np.linalg.norm(toward, axis=1)
    seen = np.array([each["seen"] for each in said])
    assert seen[cosine > 0.2].all()
    assert not seen[cosine < -0.2].any()
    met = np.array([-1 if each["hit"] is None else each["hit"] for each in said])
    front = cosine > 0.2
    assert (met[front] == np.flatnonzero(front)).all()


def test_what_is_under_the_pointer_stays_there_when_it_is_zoomed():
    s = grid(10, 10)
    view = {"position": [0.5, 0.5, 3], "focal": [0.5, 0.5, 0], "up": [0, 1, 0], "angle": 60, "parallel": None}
    s_mesh = {"vertices": (s.vertices / np.ptp(s.vertices, axis=0).max()).tolist(), "faces": s.faces.tolist()}
    before = ask("projected", mesh=s_mesh, view=view, aspect=1.0, acts=[])[17]["placed"]
    after = ask("projected", mesh=s_mesh, view=view, aspect=1.0, acts=[["zoom", 0, 1.5, *before]])
    assert after[17]["placed"] == pytest.approx(before, abs=1e-3)
    assert math.dist(after[18]["placed"], before) > 1.4 * math.dist(
        ask("projected", mesh=s_mesh, view=view, aspect=1.0, acts=[])[18]["placed"], before
    )


def test_the_view_is_home_again_after_any_moves():
    s = bumpy(100)
    acts = [["turn", 0, 30, -12], ["pan", 0, 5, 5], ["zoom", 0, 2, 10, 60], ["home"]]
    first, last = (ask("projected", mesh=as_mesh(s), view=view_of(s)[1], aspect=1.3, acts=a) for a in ([], acts))
    assert first == last
    moved = ask("projected", mesh=as_mesh(s), view=view_of(s)[1], aspect=1.3, acts=acts[:1])
    assert moved[0]["placed"] != first[0]["placed"]


def test_rays_meet_the_nearest_of_all_faces():
    s, rng = bumpy(500), np.random.default_rng(5)
    origins = 4 * rng.normal(size=(60, 3))
    directions = -origins + 0.4 * rng.normal(size=(60, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    said = ask(
        "hits", mesh=as_mesh(s), rays=[[o.tolist(), d.tolist()] for o, d in zip(origins, directions, strict=True)]
    )
    a, b, c = (s.vertices[s.faces[:, k]] for k in range(3))
    assert any(said)
    assert not all(said)
    for o, d, hit in zip(origins, directions, said, strict=True):
        with np.errstate(all="ignore"):
            p = np.cross(d, c - a)
            size = np.einsum("ij,ij->i", b - a, p)
            u = np.einsum("ij,ij->i", o - a, p) / size
            q = np.cross(o - a, b - a)
            v, away = q @ d / size, np.einsum("ij,ij->i", c - a, q) / size
        away = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (away > 0), away, np.inf)
        if hit is None:
            assert np.isinf(away).all()
            continue
        np.testing.assert_allclose(hit["point"], o + away.min() * d, atol=1e-5)
        corners = s.faces[away.argmin()]
        nearest = corners[np.linalg.norm(s.vertices[corners] - hit["point"], axis=1).argmin()]
        assert hit["vertex"] == nearest


def test_closed_surfaces_have_an_outside():
    ball = sphere(100)
    side = ask("outside", mesh=as_mesh(ball))
    assert abs(side) == 1
    assert ask("outside", mesh={**as_mesh(ball), "faces": ball.faces[:, ::-1].tolist()}) == -side
    assert abs(ask("outside", mesh=as_mesh(torus()))) == 1
    assert ask("outside", mesh={**as_mesh(ball), "faces": ball.faces[1:].tolist()}) == 0
    turned = np.concatenate([ball.faces[:1, ::-1], ball.faces[1:]])
    assert ask("outside", mesh={**as_mesh(ball), "faces": turned.tolist()}) == 0
    assert ask("outside", mesh=as_mesh(grid(4, 4))) == 0


def test_components_that_disagree_have_no_outside():
    ball = sphere(60)
    twice = np.concatenate([ball.vertices, ball.vertices + 3])
    for second, has_outside in ((ball.faces, True), (ball.faces[:, ::-1], False)):
        faces = np.concatenate([ball.faces, second + len(ball.vertices)])
        mesh = {"vertices": twice.tolist(), "faces": faces.tolist(), "components": [0, len(ball.faces), len(faces)]}
        assert bool(ask("outside", mesh=mesh)) == has_outside


def test_a_camera_far_from_the_shape_is_not_taken():
    s = bumpy(100)
    far, near = ([[x, 0, 0], [0, 0, 0], [0, 1, 0]] for x in (1e30, 6.0))
    first, same, other = (
        ask("projected", mesh=as_mesh(s), view=view_of(s)[1], aspect=1.0, acts=acts)
        for acts in ([], [["look", far]], [["look", near]])
    )
    assert first == same != other


# ---------------------------------------------------------------------- creases
def test_creases_part_the_faces_that_they_part_in_the_window():
    s = read_surface(mesh_path("part"))
    window = drawable(s, Shading())
    crease = crease_of(s, Shading())
    said = ask("drawn", mesh={**as_mesh(s), "crease": crease})
    corners, copies = np.array(said["corners"]), np.array(said["copies"])
    assert len(copies)
    assert (np.sort(copies) == np.sort(copies_of(window))).all()
    theirs = pv.wrap(window).regular_faces.ravel()
    pairs = np.unique(np.stack([corners, theirs]), axis=1)
    assert pairs.shape[1] == len(np.unique(corners)) == len(np.unique(theirs))
    # Copies are in the place of their vertices, and on flat sides have the normals of these.
    places, normals = (np.reshape(said[name], (-1, 3)) for name in ("places", "normals"))
    assert (places[len(s.vertices) :] == places[copies]).all()
    theirs = pv.wrap(window).point_data.active_normals[pairs[1]]
    cosine = (normals[pairs[0]] / np.linalg.norm(normals[pairs[0]], axis=1)[:, None] * theirs).sum(axis=1)
    assert np.quantile(np.abs(cosine), 0.01) > 0.95


def test_each_face_of_a_flat_surface_has_corners_of_its_own_and_of_a_smooth_one_none():
    s = bumpy(200)
    assert len(ask("drawn", mesh={**as_mesh(s), "crease": 0.0})["copies"]) == 3 * len(s.faces) - 200
    assert ask("drawn", mesh={**as_mesh(s), "crease": None})["copies"] == []


# ---------------------------------------------------------------------- points without faces
@pytest.fixture(scope="module")
def cloud():
    """Points at random on a wave, with normals as pages have them."""
    x, y = np.random.default_rng(3).random((2, 600))
    cloud = PointCloud(np.stack([x, y, 0.1 * np.sin(4 * x)], axis=1), "wave")
    rounded = np.rint(127 * cloud.normals)
    vars(cloud)["normals"] = rounded / np.linalg.norm(rounded, axis=1)[:, None]
    return cloud


def as_points(cloud):
    entries = StoredMatrices.of(Laplacian(cloud), np.arange(len(cloud.vertices)))
    return {
        "vertices": cloud.vertices.tolist(),
        "normals": np.rint(127 * cloud.normals).astype(int).tolist(),
        "start": entries.start.tolist(),
        "index": entries.index.tolist(),
    }


def test_points_are_the_hexagons_of_the_window(cloud):
    said, window = ask("drawn", mesh=as_points(cloud)), pv.wrap(drawable(cloud))
    assert said["copies"] == copies_of(window).tolist()
    assert said["corners"] == window.regular_faces.ravel().tolist()
    x = cloud.vertices
    radius = np.linalg.norm(np.ptp(x, axis=0)) / 2
    places = np.reshape(said["places"], (-1, 3)) * radius + (x.min(axis=0) + x.max(axis=0)) / 2
    away = np.abs(places - window.points).max(axis=1)
    # Pages count neighbours whose entry in the matrix is tiny.
    assert np.mean(away < 1e-6) > 0.97
    assert away.max() < 1e-2


def test_fields_are_continued_over_hexagons_as_in_the_window(cloud):
    field = np.hypot(cloud.vertices[:, 0], cloud.vertices[:, 1])
    field[cloud.vertices[:, 1] > 0.8] = -1000
    found = np.array(ask("continued", mesh=as_points(cloud), values=field.tolist(), none=-1000))
    there = at_corners(drawable(cloud), field, -1000.0)
    assert (there == -1000).sum() > 300
    assert np.abs(found - there).max() < 1e-5


def test_the_nearest_point_is_hit(cloud):
    found = ask("projected", mesh=as_points(cloud), view=view_of(cloud)[1], aspect=1.0, acts=[])
    hits = np.array([each["hit"] for each in found], float)
    assert (hits == np.arange(600)).mean() > 0.98
    assert np.mean([each["seen"] for each in found]) > 0.98


# ---------------------------------------------------------------------- clip planes
@pytest.fixture(scope="module")
def solid():
    """A solid that a plane cuts, as it is on a page, and where."""
    surface, clip = TetrahedralMesh(*ball(300), "ball").shape, Clip((0.0, 0.0, 1.0), 0.6)
    plane = clip_plane(clip, surface)
    mesh = StoredMesh.of(surface, "float32", Laplacian(TetrahedralMesh(*ball(300))))
    stored, at = mesh.surface, _cut(surface, replace(comparison("ball"), clip=clip), mesh)
    given = {**as_mesh(stored), "clip": [*plane.normal, plane.offset], "cut": at}
    return mesh, given, cut_through(surface, plane)


def test_a_cut_through_a_solid_is_the_windows_with_the_values_between(solid):
    mesh, given, cut = solid
    k, x = len(cut.points), mesh.surface.vertices
    said = ask("drawn", mesh=given)
    assert np.reshape(said["corners"], (-1, 3))[-len(cut.faces) :].tolist() == (cut.faces + len(x)).tolist()
    places = np.reshape(said["places"], (-1, 3))[-k:] * np.linalg.norm(np.ptp(x, axis=0)) / 2
    assert np.abs(places + (x.min(axis=0) + x.max(axis=0)) / 2 - cut.points).max() < 3e-4
    assert np.allclose(np.reshape(said["normals"], (-1, 3))[-k:], cut.normal, atol=1e-6)
    values = np.sin(3 * np.arange(len(x)))
    values[::7] = -1000
    original = np.empty(len(x))
    original[mesh.ids] = values
    found = ask("between", mesh=given, values=values.tolist(), none=-1000)
    np.testing.assert_allclose(found, cut.at_points(original, -1000.0), atol=1e-5)


def test_what_is_behind_a_cut_is_neither_hit_nor_seen(solid):
    mesh, given, _ = solid
    x, plane = mesh.surface.vertices, given["clip"]
    view = {"position": [0, 0, 9], "focal": [0, 0, 0], "up": [0, 1, 0], "angle": 20, "parallel": None}
    found = ask("projected", mesh=given, view=view, aspect=1.0, acts=[])
    behind = (x[:, 2] < plane[3] - 0.2) & (np.hypot(x[:, 0], x[:, 1]) < 0.5)
    assert behind.sum() > 30
    assert not any(each["hit"] is not None or each["seen"] for each, k in zip(found, behind, strict=True) if k)


@pytest.mark.parametrize(("source", "pins"), [(0, []), (0, [1]), (0, [1, 2]), (3, [1]), (3, [1, 0]), (3, [])])
def test_what_is_cut_away_is_said_as_in_the_window(source, pins):
    vertices = [[9.0, 0, 0], [8.0, 1, 0], [7.0, 0, 1], [0.0, 0, 0]]
    mesh = {"vertices": vertices, "faces": [[0, 1, 2], [1, 2, 3]], "clip": [1, 0, 0, 4]}
    marks = [PointMark(source), *(PointMark(vertex, number=k) for k, vertex in enumerate(pins, 1))]
    gone = [mark for mark in marks if mark.vertex != 3]
    words = cut_away_words(gone) if gone else ""
    expected = [words, words.replace(" by the clip plane", "")] if gone else []
    assert ask("cut_away", mesh=mesh, source=source, pins=pins) == expected


# ---------------------------------------------------------------------- links and colours
def test_a_link_holds_source_pins_camera_and_panels():
    state = {
        "source": 7,
        "pins": [{"id": 3, "name": "a, b:&=#<é"}, {"id": 9, "name": ""}],
        "camera": [[1, 2, 3.25], [0, 0, -1e-7], [0, 1, 0]],
        "panels": ["2", "0:0.25"],
    }
    said = ask("address", hash=ask("written_address", state=state), ids=[3, 7, 9], choices=3)
    assert said == {**state, "ignored": []}


@pytest.mark.parametrize(
    ("hash", "ignored"),
    [
        ("#source=8", "source"), ("#source=-7", "source"), ("#source=7e0", "source"), ("#source=", "source"),
        ("#source", "source"), ("#source=<script>", "source"), ("#pins=3,,9", "pins"), ("#pins=3:%E0%A4", "pins"),
        ("#pins=3:" + 81 * "x", "pins"), ("#pins=" + ",".join(101 * "3"), "pins"), ("#camera=1,2,3", "camera"),
        ("#camera=1,1,1,1,1,1,0,0,1", "camera"), ("#camera=0,0,1,0,0,0,0,0,1", "camera"),
        ("#camera=NaN,0,1,0,0,0,0,1,0", "camera"), ("#camera=0x1,0,1,0,0,0,0,1,0", "camera"),
        ("#camera=1e999,0,1,0,0,0,0,1,0", "camera"),
        ("#panels=0,3", "panels"), ("#panels=", "panels"), ("#panels=0x1", "panels"), ("#panels=-1", "panels"),
        ("#panels=0:,1", "panels"), ("#panels=0:x", "panels"), ("#panels=0:0.25:1", "panels"),
        ("#__proto__=1", "an unknown part"), ("#toString=1", "an unknown part"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_link_is_named_and_left_out(hash, ignored):
    said = ask("address", hash=f"{hash}&source=7" if ignored != "source" else hash, ids=[3, 7, 9], choices=3)
    assert said.pop("ignored") == [ignored]
    assert said == ({} if ignored == "source" else {"source": 7})


def test_maps_are_stretched_and_follow_the_theme():
    scene = {"colours": {
        "map": [[0, 0, 0], [255, 0, 0]], "dark_map": [[0, 0, 255], [255, 255, 255]], "diverging": None,
        "undefined": [1, 2, 3], "background": None, "dark_background": None, "back": [4, 4, 4], "dark_back": [5, 5, 5],
        "section": [6, 6, 6], "dark_section": [7, 7, 7],
    }}  # fmt: skip
    light, dark = (ask("colours", scene=scene, isDark=is_dark) for is_dark in (False, True))
    assert light["map"] == [[k, 0, 0] for k in range(256)] == light["diverging"]
    assert dark["map"][0] == [0, 0, 255]
    assert dark["map"][-1] == [255, 255, 255]
    assert dark["background"] == [22, 24, 27]
    assert dark["undefined"] == [1, 2, 3]
    assert (light["section"], dark["section"]) == ([6, 6, 6], [7, 7, 7])
    assert (light["back"], dark["back"]) == ([4, 4, 4], [5, 5, 5])
    scene["colours"]["background"] = [9, 9, 9]
    assert ask("colours", scene=scene, isDark=False)["background"] == [9, 9, 9]


# ---------------------------------------------------------------------- layout
@pytest.mark.parametrize(
    ("count", "width", "height", "columns"),
    [
        (2, 1280, 650, 2),
        (6, 1280, 650, 3),
        (2, 600, 310, 2),
        (2, 400, 230, 2),
        (2, 390, 430, 2),
        (2, 390, 770, 1),
        (3, 390, 770, 2),
        (2, 300, 230, 1),
        (1, 300, 100, 1),
    ],
)
def test_there_are_as_many_columns_as_make_the_views_largest(count, width, height, columns):
    assert ask("columns", count=count, width=width, height=height) == columns


# ---------------------------------------------------------------------- words
def test_the_guide_lists_what_the_page_does():
    guide = (VIEWER.parents[2] / "assets/guide/reference/files.md").read_text(encoding="utf-8")
    for keys, meaning in ask("help"):
        assert f"\n| {keys} | {meaning} |" in guide


# ---------------------------------------------------------------------- labels
@pytest.mark.parametrize("crease", [None, 40.0])
def test_faces_between_labels_have_corners_of_their_own_that_know_all_three(crease):
    s = bumpy(300)
    values = np.digitize(s.vertices[:, 0], [-0.3, 0.4]).astype(float)
    values[s.vertices[:, 1] > 0.7] = np.nan
    found = ask("labels", mesh=as_mesh(s) | {"crease": crease}, values=[None if np.isnan(v) else v for v in values])
    places, labels, shares = (np.array(found[name]).reshape(-1, 3) for name in ("places", "labels", "shares"))
    corners = np.array(found["corners"]).reshape(-1, 3)
    at = labels[corners]
    wanted = np.nan_to_num(values, nan=-1)[s.faces]
    is_between = (wanted != wanted[:, :1]).any(axis=1)
    assert 10 < is_between.sum() < len(s.faces) / 2
    # All corners of a face tell the same three, so that it does not matter which of them the shader takes.
    np.testing.assert_array_equal(at[is_between], np.repeat(wanted[is_between, None], 3, axis=1))
    np.testing.assert_array_equal(shares[corners[is_between]], np.tile(np.eye(3), (is_between.sum(), 1, 1)))
    np.testing.assert_array_equal(
        at[~is_between], np.broadcast_to(wanted[~is_between, :1, None], (sum(~is_between), 3, 3))
    )
    assert len(np.unique(corners[is_between])) == 3 * is_between.sum()
    drawn = ask("drawn", mesh=as_mesh(s) | {"crease": crease})
    before = np.array(drawn["places"]).reshape(-1, 3)[np.array(drawn["corners"]).reshape(-1, 3)]
    np.testing.assert_array_equal(places[corners], before)


def test_labels_are_read_by_their_names():
    labels = [{"name": "low", "colour": [1, 2, 3]}, {"name": "high", "colour": [4, 5, 6]}]
    panel = {"distance": "field a", "signed": False, "note": "the same", "range": [-0.5, 1.5], "labels": labels}
    assert ask("words", panel=panel, fields=[0, 1, None]) == ["low", "high", "no label", "low, high"]
