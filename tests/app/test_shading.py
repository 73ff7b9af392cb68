"""What faces look like: normals split at creases, sides that tell the inside from the outside, and edges."""

from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from app.document.document import comparison
from app.document.looks import AS_IT_IS, Isolines, Shading
from app.document.page import Recipe
from app.figures.options import with_options
from app.figures.raster import RenderWindow
from app.samples import mesh_path, sample_names
from app.scene.camera import Projection, standard_camera
from app.scene.creases import face_normals as normals_of_faces
from app.scene.drawable import copies_of, drawable, has_backs, poly_data
from app.scene.style import PAPER
from app.scene.winding import winding
from bihdist_core import ParameterError, Surface, read_surface
from tests.shapes import MESHES, bumpy, fin, grid, needs_meshes, slivers, sphere, torus, two_pieces

SMOOTH, CREASED, FLAT = Shading("smooth"), Shading("creased"), Shading("flat")


def box(per_side: int = 3) -> Surface:
    """A cube of squares cut in two, closed: its sides meet at right angles."""
    at = np.arange(per_side + 1.0)
    ids: dict[tuple, int] = {}
    faces = []
    for axis in range(3):
        for end in (0.0, float(per_side)):
            for i in range(per_side):
                for j in range(per_side):
                    square = [(at[i], at[j]), (at[i + 1], at[j]), (at[i + 1], at[j + 1]), (at[i], at[j + 1])]
                    corners = [np.roll([end, p, q], axis) for p, q in square]
                    a, b, c, d = (ids.setdefault(tuple(x), len(ids)) for x in corners)
                    faces += [[a, b, c], [a, c, d]] if end else [[a, c, b], [a, d, c]]
    return Surface(np.array(list(ids)), np.array(faces), "box")


def moebius(around: int = 60, across: int = 6) -> Surface:
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.linspace(-0.4, 0.4, across + 1), indexing="ij")
    r = 1 + v * np.cos(u / 2)
    x = np.stack([r * np.cos(u), r * np.sin(u), v * np.sin(u / 2)], -1).reshape(-1, 3)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))

    def at(i, j):
        return (i % around) * (across + 1) + np.where(i < around, j, across - j)

    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
    return Surface(x, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]), "moebius")


def without(surface: Surface, gone: np.ndarray) -> Surface:
    """The surface without the faces that have a vertex (n,) in a place."""
    return Surface(surface.vertices, surface.faces[~gone[surface.faces].any(axis=1)], surface.name)


def turned(surface: Surface, which: np.ndarray) -> Surface:
    return Surface(surface.vertices, np.where(which[:, None], surface.faces[:, ::-1], surface.faces), surface.name)


def holed() -> Surface:
    return without(sphere(2000), sphere(2000).vertices[:, 2] > 0.9)


def face_normals(surface: Surface) -> np.ndarray:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def drawn_faces(mesh) -> np.ndarray:
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def originals(mesh, n: int) -> np.ndarray:
    """(n + k,) of which vertex each point is."""
    return np.concatenate([np.arange(n), copies_of(mesh)])


# ---------------------------------------------------------------------- creases
@pytest.mark.parametrize("shading", [CREASED, AS_IT_IS], ids=["creased", "auto"])
def test_each_side_of_a_box_has_normals_of_its_own(shading):
    surface = box()
    mesh = drawable(surface, shading)
    faces, normals = drawn_faces(mesh), vtk_to_numpy(mesh.GetPointData().GetNormals())
    assert np.abs(normals[faces] - face_normals(surface)[:, None]).max() < 1e-6  # single precision
    # 12 edges of the box with two vertices inside each, which become two, and 8 corners, which become three.
    assert len(copies_of(mesh)) == 12 * 2 + 8 * 2


@pytest.mark.parametrize("surface", [bumpy(500), torus(), box(), holed(), fin(), slivers(), two_pieces()], ids=str)
@pytest.mark.parametrize("crease", [5.0, 40.0, 120.0])
def test_splitting_moves_nothing(surface, crease):
    mesh = drawable(surface, Shading("creased", crease))
    n, faces = len(surface.vertices), drawn_faces(mesh)
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    assert np.array_equal(np.sort(originals(mesh, n)[faces], axis=1), np.sort(surface.faces, axis=1))
    assert np.array_equal(points[faces], surface.vertices[originals(mesh, n)[faces]])


@pytest.mark.parametrize("crease", [10.0, 20.0, 30.0])
def test_faces_share_a_point_as_long_as_they_are_reached_without_crossing_a_crease(crease):
    surface = bumpy(400, seed=3)
    mesh = drawable(surface, Shading("creased", crease))
    faces, normal = drawn_faces(mesh), face_normals(surface)
    assert len(copies_of(mesh)) > 0
    of_edge: dict[tuple, list[int]] = {}
    for k, face in enumerate(surface.faces):
        for a, b in zip(face, np.roll(face, 1), strict=True):
            of_edge.setdefault((min(a, b), max(a, b)), []).append(k)
    for vertex in range(len(surface.vertices)):
        around = np.flatnonzero((surface.faces == vertex).any(axis=1)).tolist()
        group = {k: {k} for k in around}
        for (a, b), (f, g) in of_edge.items():
            if vertex in (a, b) and normal[f] @ normal[g] >= np.cos(np.radians(crease)):
                joined = group[f] | group[g]
                group.update(dict.fromkeys(joined, joined))
        point = {k: int(faces[k][surface.faces[k] == vertex][0]) for k in around}
        for f in around:
            assert {g for g in around if point[g] == point[f]} == group[f]


def test_only_what_is_made_has_creases_by_itself():
    split = {name: len(copies_of(drawable(read_surface(mesh_path(name))))) for name in sample_names()}
    assert {name for name, copies in split.items() if copies} == {"part"}
    assert split["part"] > 1000


@needs_meshes
def test_of_the_shared_meshes_the_car_and_the_aeroplanes_have():
    split = {path.name for path in MESHES.glob("*.o??") if len(copies_of(drawable(read_surface(path))))}
    assert split == {"beetle.off", "plane.obj", "plane_holes.obj"}


@pytest.mark.parametrize(
    ("before", "values", "after"),
    [
        (AS_IT_IS, {"feature_angle": 30.0}, Shading("creased", 30)),
        (AS_IT_IS, {"split_sharp_edges": True}, Shading("creased")),
        (AS_IT_IS, {"split_sharp_edges": False, "feature_angle": 30.0}, Shading("smooth", 30)),
        (AS_IT_IS, {"smooth_shading": False, "show_edges": True}, Shading("flat", show_edges=True)),
        (Shading("flat", 20, True), {"smooth_shading": True}, Shading("auto", 20, True)),
        (Shading("flat", 20, True), {"show_edges": False}, Shading("flat", 20)),
    ],
)
def test_options_change_the_shading_that_was(before, values, after):
    recipe = Recipe(replace(comparison("hand"), shading=before))
    assert with_options(recipe, values).document.shading == after


def test_flat_shading_has_no_edges_to_split():
    with pytest.raises(ParameterError, match="smooth_shading"):
        with_options(Recipe(comparison("hand")), {"smooth_shading": False, "split_sharp_edges": True})


# ---------------------------------------------------------------------- sides
@pytest.mark.parametrize("surface", [bumpy(300), torus(), holed(), two_pieces()], ids=str)
def test_however_faces_are_wound_the_outside_is_in_front(surface):
    expected = drawn_faces(drawable(surface, SMOOTH))
    outward = np.einsum("ij,ij->i", face_normals(surface), face_normals(Surface(surface.vertices, expected)))
    assert (outward > 0).all()
    some = np.random.default_rng(0).random(len(surface.faces)) < 0.4
    for which in (np.ones(len(some), bool), some):
        other = drawable(turned(surface, which), SMOOTH)
        assert (_sense(drawn_faces(other)) == _sense(expected)).all()
        assert has_backs(other) == has_backs(drawable(surface, SMOOTH)) == (surface.name == "sphere")


def _sense(faces: np.ndarray) -> np.ndarray:
    """The same for faces that see the same side, whichever corner comes first."""
    return np.take_along_axis(faces, (faces.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)


def test_what_has_one_side_only_is_cut_where_it_turns_over_and_has_no_back():
    surface = moebius()
    wound = winding(surface, normals_of_faces(surface.vertices, surface.faces))
    assert wound.is_turned.sum() == 6  # one row of edges, across
    assert not has_backs(drawable(surface, SMOOTH))
    mesh = drawable(surface, SMOOTH)
    normals, faces = vtk_to_numpy(mesh.GetPointData().GetNormals()), drawn_faces(mesh)
    own = face_normals(Surface(surface.vertices, originals(mesh, len(surface.vertices))[faces]))
    # Faces next to each other are nearly alike, and where they are wound against each other normals are apart.
    assert np.einsum("ijk,ik->ij", normals[faces], own).min() > 0.9


def test_sheets_have_two_equal_sides():
    low = without(sphere(2000), sphere(2000).vertices[:, 2] > -0.5)
    half = without(sphere(2000), sphere(2000).vertices[:, 2] > 0.05)
    everything = np.ones(10_000, bool)
    assert not has_backs(drawable(grid(4, 3)))
    assert not has_backs(drawable(low))
    assert has_backs(drawable(half))
    # A bowl that says it means its inside.
    bowl = turned(half, everything[: len(half.faces)])
    assert not has_backs(drawable(bowl))
    assert np.array_equal(drawn_faces(drawable(bowl, SMOOTH)), bowl.faces)


# ---------------------------------------------------------------------- pictures
def picture(surface, shading=AS_IT_IS, field=None, view="front", side=240, steps=0, style=PAPER):
    """(side, side, 4) of a field, of the height if none is given."""
    with closing(RenderWindow(style)) as render_window:
        render_window.shown.show_surface(drawable(surface, shading))
        render_window.shown.show_shading(shading)
        render_window.shown.show_field(np.full(len(surface.vertices), 0.3) if field is None else field, 1.0)
        render_window.shown.show_isolines(Isolines(steps))
        camera = standard_camera(surface.vertices, 1.0, view)
        return render_window.shade(Projection(camera, 1.0, surface.vertices, 0.03), (side, side), 1.0)


def warm(pixels: np.ndarray) -> np.ndarray:
    """Where the colour of backs is, in a picture of a field that is blue."""
    red, green, blue, alpha = np.moveaxis(pixels.astype(int), -1, 0)
    return (alpha == 255) & (red > blue) & (green > blue)


def test_the_inside_is_seen_in_a_colour_of_its_own_and_without_lines():
    surface = holed()
    inside, outside = picture(surface, view="front"), picture(surface, view="back")
    assert 0.05 < warm(inside).mean() < 0.5
    assert not warm(outside).any()
    field = (surface.vertices[:, 0] + 1) / 2 * 0.4
    lined = picture(surface, field=field, steps=40)
    plain = picture(surface, field=field)
    differs = (lined.astype(int) - plain).max(axis=-1) > 20
    well_inside = warm(plain) & np.roll(warm(plain), 3, 0) & np.roll(warm(plain), -3, 0)
    well_inside &= np.roll(warm(plain), 3, 1) & np.roll(warm(plain), -3, 1)
    assert differs.mean() > 0.03
    assert not differs[well_inside].any()


def test_faces_wound_anyhow_make_the_same_picture():
    surface = holed()
    some = np.random.default_rng(1).random(len(surface.faces)) < 0.5
    expected = picture(surface).astype(int)
    for which in (some, np.ones(len(some), bool)):
        assert np.abs(picture(turned(surface, which)) - expected).max() <= 2  # of 255: normals are added up otherwise


def test_faces_whose_normals_lean_away_are_lit_as_if_they_leant_towards_the_eye():
    """On rough scans they were dark specks."""
    surface = grid(1, 1)
    shades = []
    for depth in (0.8, -0.8):
        normals = np.tile(np.float32([0.0, -0.6, depth]), (4, 1))
        with closing(RenderWindow(PAPER)) as render_window:
            render_window.shown.show_surface(poly_data(surface.vertices, surface.faces, normals))
            render_window.shown.show_field(np.full(4, 0.5), 1.0)
            camera = standard_camera(surface.vertices, 1.0, "front")
            shades.append(
                render_window.shade(Projection(camera, 1.0, surface.vertices, 0.0), (40, 40), 1.0)[20, 20, :3]
            )
    assert np.abs(shades[1].astype(int) - shades[0]).max() <= 4  # seen in perspective, straight on only in the middle
    assert shades[0].min() > 100


def test_flat_faces_have_one_shade_each():
    surface = torus(12, 8)

    def even(name):
        """Of what is covered, the share where a pixel's neighbours on all sides have its colour."""
        pixels = picture(surface, Shading(name), side=300).astype(int)
        same = np.ones(pixels.shape[:2], bool)
        for axis in (0, 1):
            for step in (1, -1):
                same &= (np.roll(pixels, step, axis) == pixels).all(axis=-1)
        return same[pixels[..., 3] == 255].mean()

    assert even("flat") > 0.7
    assert even("smooth") < 0.4


def test_edges_are_seen_until_they_are_dense_and_move_no_isoline():
    surface, field = grid(8, 8), np.linspace(0, 1, 81)
    plain, wired = picture(surface, field=field), picture(surface, Shading(show_edges=True), field=field)
    differs = np.abs(wired.astype(int) - plain).max(axis=-1) > 8
    assert 0.05 < differs.mean() < 0.3
    fine = grid(150, 150)
    field = np.linspace(0, 1, 151**2)
    plain, wired = picture(fine, field=field), picture(fine, Shading(show_edges=True), field=field)
    assert np.abs(wired.astype(int) - plain).max() <= 1
    # The field reaches the fragments past the shader that makes the edges.
    surface, field = grid(8, 8), np.tile(np.linspace(0, 1, 9), 9)
    plain = picture(surface, field=field, steps=5)
    wired = picture(surface, Shading(show_edges=True), field=field, steps=5)
    lines = (plain[..., :3] > 240).all(axis=-1)
    assert lines.mean() > 0.01
    assert (wired[lines][:, :3] > 235).all()


def test_a_split_surface_shows_the_field_of_its_vertices():
    surface = box()
    field = surface.vertices[:, 2] / 3
    pixels = [picture(surface, shading, field, view="home") for shading in (SMOOTH, CREASED)]
    hue = [np.argsort(each[..., :3].astype(int), axis=-1)[pixels[0][..., 3] == 255] for each in pixels]
    assert (hue[0] == hue[1]).all(axis=1).mean() > 0.97
