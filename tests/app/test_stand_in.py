"""What is drawn instead of a large surface while the camera moves."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from app.document.looks import Shading
from app.scene.drawable import drawable, faces_of, has_backs
from app.scene.field_actor import UNDEFINED
from app.scene.offscreen_renderer import OffscreenRenderer
from app.scene.stand_in import stand_in
from bihdist_core import Surface
from bihdist_core.applications.correspondence import position_colours
from tests.app.test_shading import box, turned, without
from tests.shapes import bumpy, grid, sphere

CLUSTERS = 1500


SMOOTH = Shading("smooth")


def made(surface, shading=SMOOTH, clusters=CLUSTERS):
    return stand_in(drawable(surface, shading), clusters)


def arrays(standing):
    mesh = standing.mesh
    return (
        vtk_to_numpy(mesh.GetPoints().GetData()),
        faces_of(mesh),
        vtk_to_numpy(mesh.GetPointData().GetNormals()),
    )


@pytest.fixture(scope="module")
def ball():
    return sphere(20_000)


def test_there_are_about_as_many_clusters_as_asked_for_and_none_for_small_surfaces(ball):
    x, faces, _ = arrays(made(ball))
    assert 0.6 * CLUSTERS < len(x) < 1.6 * CLUSTERS
    assert len(faces) < 3 * CLUSTERS
    assert made(ball, clusters=12_000) is None
    assert made(Surface(ball.vertices * 1e-200, ball.faces)) is None  # of no area, as far as numbers go
    assert made(Surface(ball.vertices * [1, 1e-9, 1e-9], ball.faces)) is not None


def test_it_lies_where_the_surface_does_and_looks_the_same_way(ball):
    x, faces, normals = arrays(made(ball))
    side = np.sqrt(1.5 * 4 * np.pi / CLUSTERS)
    length = np.linalg.norm(x, axis=1)
    # The mean of points within a cell's diagonal lies below the sphere by less than its sagitta.
    assert length.max() <= 1 + 1e-12
    assert length.min() > 1 - (np.sqrt(3) * side) ** 2 / 2
    assert np.einsum("ij,ij->i", normals, x / length[:, None]).min() > 0.98
    a, b, c = (x[faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    assert (np.einsum("ij,ij->i", normal, a + b + c) > 0).all()
    area = np.linalg.norm(normal, axis=1).sum() / 2
    assert area == pytest.approx(4 * np.pi, rel=0.03)
    assert len(np.unique(np.sort(faces, axis=1), axis=0)) == len(faces)


def test_two_sheets_in_one_cell_stay_two():
    thin = sphere(20_000)
    thin = Surface(thin.vertices * [1, 1, 0.01], thin.faces, "thin")
    x, faces, normals = arrays(made(thin))
    front = normals[:, 2] > 0.5
    assert front.sum() > CLUSTERS / 4
    assert (normals[:, 2] < -0.5).sum() > CLUSTERS / 4
    assert (x[front, 2] > -1e-9).all()
    a, b, c = (x[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert area == pytest.approx(2 * np.pi, rel=0.05)


def test_creases_stay():
    surface = box(60)
    _, faces, normals = arrays(made(surface, Shading("creased")))
    # At a corner of the box two of its sides are one cluster.
    assert (np.abs(normals).max(axis=1) > 0.999).mean() > 0.99
    assert (np.abs(normals[faces].sum(axis=1)).max(axis=1) > 2.99).mean() > 0.98


def test_fields_are_means_and_undefined_only_where_nothing_is_defined(ball):
    standing = made(ball)
    x, _, _ = arrays(standing)
    field = ball.vertices @ [0.3, -0.2, 0.5]
    means = standing.averaged(field.astype(np.float32), UNDEFINED)
    # A linear field's mean is its value in the middle.
    assert np.abs(means - x @ [0.3, -0.2, 0.5]).max() < 1e-6
    half = np.where(ball.vertices[:, 0] < 0, UNDEFINED, field).astype(np.float32)
    means = standing.averaged(half, UNDEFINED)
    side = np.sqrt(1.5 * 4 * np.pi / CLUSTERS)
    assert (means[x[:, 0] < -side] == UNDEFINED).all()
    assert (np.abs(means[x[:, 0] >= 0]) <= 1).all()
    assert (standing.averaged(np.full(len(field), UNDEFINED, np.float32), UNDEFINED) == UNDEFINED).all()


def test_points_of_no_face_are_in_no_cluster(ball):
    far = Surface(np.concatenate([[[9.0, 9, 9]], ball.vertices]), ball.faces + 1, "far")
    standing = made(far)
    x, _, _ = arrays(standing)
    assert np.abs(x).max() <= 1
    values = np.append(1e9, np.zeros(len(ball.vertices))).astype(np.float32)
    assert (standing.averaged(values, UNDEFINED) == 0).all()


def test_an_inside_that_can_be_seen_is_seen(ball):
    holed = without(ball, ball.vertices[:, 2] > 0.9)
    for surface in (holed, turned(holed, np.ones(len(holed.faces), bool))):
        standing = made(surface)
        assert has_backs(standing.mesh)
        x, faces, _ = arrays(standing)
        a, b, c = (x[faces[:, k]] for k in range(3))
        assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).mean() > 0.999
    assert not has_backs(made(ball).mesh)
    assert not has_backs(made(grid(200, 100)).mesh)


def test_a_scene_draws_it_only_while_it_is_told_to():
    surface = bumpy(20_000)
    mesh = drawable(surface, SMOOTH)
    offscreen = OffscreenRenderer()
    try:
        scene = offscreen.new_scene()
        scene.show_surface(mesh, mesh.GetBounds())
        scene.field_actor.show_field(surface.vertices[:, 2] + 2)
        scene.field_actor.show_stand_in(True)  # there is none yet
        assert not scene.field_actor.stand_in.is_shown
        scene.renderer.ResetCamera(*scene.bounds)

        def picture():
            return offscreen.picture(scene, (300, 300)).astype(int)

        full = picture()
        scene.field_actor.stand_in.take(stand_in(mesh, CLUSTERS))
        assert np.array_equal(picture(), full)
        scene.field_actor.show_stand_in(True)
        standing = picture()
        assert scene.field_actor.stand_in.is_shown
        assert 0.02 < (np.abs(standing - full).max(axis=-1) > 3).mean() < 0.5
        assert np.abs(standing - full).mean() < 6  # of 255: the same shape, colours and lines
        # What the field becomes meanwhile is seen, too.
        scene.field_actor.show_field(surface.vertices[:, 0] + 2)
        scene.field_actor.show_stand_in(True)
        changed = picture()
        scene.field_actor.show_stand_in(False)
        assert np.abs(changed - picture()).mean() < 6 < np.abs(changed - standing).mean()
        scene.field_actor.show_field(surface.vertices[:, 2] + 2)
        assert np.array_equal(picture(), full)
        # Another surface has nothing that stands in until it is given.
        scene.field_actor.show_stand_in(True)
        scene.show_surface(mesh, mesh.GetBounds())
        assert not scene.field_actor.stand_in.is_shown
        assert scene.field_actor.stand_in.stand_in is None
    finally:
        offscreen.close()


def test_colours_of_vertices_are_drawn_in_means_too():
    surface = bumpy(20_000)
    mesh = drawable(surface, SMOOTH)
    offscreen = OffscreenRenderer()
    try:
        scene = offscreen.new_scene()
        scene.show_surface(mesh, mesh.GetBounds())
        scene.renderer.ResetCamera(*scene.bounds)
        scene.field_actor.stand_in.take(stand_in(mesh, CLUSTERS))

        def picture(colours=None):
            if colours is not None:
                scene.field_actor.show_colours(colours)
            return offscreen.picture(scene, (300, 300)).astype(int)

        scene.field_actor.show_bare()
        bare = picture()
        colours = position_colours(surface)
        full = picture(colours)
        assert np.abs(full - bare).mean() > 6
        scene.field_actor.show_stand_in(True)
        standing = picture()
        assert scene.field_actor.stand_in.is_shown
        assert np.abs(standing - full).mean() < 6
        scene.field_actor.show_stand_in(False)
        assert np.array_equal(picture(), full)
        # What is mapped nowhere is as bare as the rest was, and a field takes the place of colours.
        assert np.array_equal(picture(np.full((20_000, 3), np.nan)), bare)
        red = picture(np.tile([1.0, 0, 0], (20_000, 1)))[150, 150]
        assert red[0] > 2 * red[1]
        scene.field_actor.show_field(surface.vertices[:, 2] + 2)
        assert np.abs(picture() - full).mean() > 6
    finally:
        offscreen.close()
