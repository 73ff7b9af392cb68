"""Meshes that were changed on purpose: by how much, where, and with which vertices."""

import numpy as np
import pytest

from bihdist_core import ParameterError, Surface, noisy, read_surface, with_holes, write_mesh
from bihdist_core.applications.changes import change_from_words, runs_from_words, words_of_change
from bihdist_core.applications.perturbation import (
    Perturbation,
    face_at,
    image_of,
    perturbed,
    posed,
    without,
    without_faces,
)
from bihdist_core.surface import vertex_normals
from tests.shapes import bumpy, sphere, two_pieces


def test_noise_along_normals_is_along_them_and_as_large_as_said():
    s = bumpy(3000)
    moved = noisy(s, 0.4, seed=3, along="normals").vertices - s.vertices
    normals = vertex_normals(s)
    along = (moved * normals).sum(axis=1)
    assert moved == pytest.approx(along[:, None] * normals, abs=1e-12)
    assert along.std() == pytest.approx(0.4 * s.mean_edge_length, rel=0.05)
    everywhere = noisy(s, 0.4, seed=3).vertices - s.vertices
    assert everywhere.std(axis=0) == pytest.approx(3 * [0.4 * s.mean_edge_length], rel=0.05)


def test_normals_of_a_sphere_point_outward():
    s = sphere(800)
    centred = s.vertices - s.vertices.mean(axis=0)
    outward = centred / np.linalg.norm(centred, axis=1, keepdims=True)
    assert np.abs((vertex_normals(s) * outward).sum(axis=1)).min() > 0.99


def test_the_seed_decides():
    s = bumpy(300)
    assert (noisy(s, 1, 5).vertices == noisy(s, 1, 5).vertices).all()
    assert (noisy(s, 1, 5).vertices != noisy(s, 1, 6).vertices).any()
    assert np.array_equal(with_holes(s, 3, 0.1, 5).faces, with_holes(s, 3, 0.1, 5).faces)


def test_holes_are_as_wide_as_said():
    s = bumpy(3000)
    one = with_holes(s, 1, 0.2, seed=4)
    lost = s.face_areas.sum() - one.face_areas.sum()
    assert one.boundary_loop_count == 1
    assert 0.5 * np.pi * 0.2**2 < lost / s.face_areas.sum() < 1.2 * np.pi * 0.2**2
    assert len(one.vertices) == len(s.vertices)
    with pytest.raises(ParameterError, match="larger radius"):
        with_holes(s, 1, 0.001)
    with pytest.raises(ParameterError, match="left of bumpy"):
        without(s, np.arange(3000))


def test_what_is_brushed_is_taken_out():
    s = bumpy(300)
    brushed = np.unique(s.faces[(s.faces == 7).any(axis=1)])
    rest = without(s, brushed)
    assert not (rest.faces == 7).any()
    assert len(s.faces) - len(rest.faces) == np.isin(s.faces, brushed).all(axis=1).sum()


def test_changes_are_made_in_order_and_vertices_are_known_again():
    s = bumpy(600)
    change = Perturbation(simplify=400, noise=0.01, holes=1, radius=0.1, handle=(5, 300), seed=2)
    result, ids = perturbed(s, change)
    old = ids >= 0
    assert old.sum() == 400
    assert len(ids) == len(result.vertices)
    apart = np.linalg.norm(result.vertices[old] - s.vertices[ids[old]], axis=1)
    assert 0 < apart.max() < 0.1 * s.mean_edge_length
    assert image_of(s, ids, int(ids[7]), result) == 7 or result.component_of_vertex[7] < 0
    assert "simplified to 400" in str(change)
    assert "seed 2" in str(change)


def test_a_handle_between_two_vertices_makes_the_genus_one():
    s = bumpy(600)
    low, high = int(s.vertices[:, 2].argmin()), int(s.vertices[:, 2].argmax())
    for change in (Perturbation(handle=(low, high)), Perturbation(weld=(low, high))):
        result, _ = perturbed(s, change)
        assert result.genus == 1
    assert s.face_areas[face_at(s, low)] == s.face_areas[(s.faces == low).any(axis=1)].max()


@pytest.mark.parametrize(("share", "along", "words"), [(-1, "xyz", "-1"), (1, "z", "'z'"), (np.inf, "xyz", "inf")])
def test_noise_that_cannot_be_is_refused(share, along, words):
    with pytest.raises(ParameterError, match=words):
        noisy(bumpy(60), share, along=along)


@pytest.mark.parametrize("name", ["m.off", "m.obj", "m.ply", "m.vtp"])
def test_meshes_are_read_as_they_were_written(tmp_path, name):
    s = bumpy(150)
    lonely = Surface(np.concatenate([s.vertices, [[1e-30, 0.1, 1 / 3]]]), s.faces)
    write_mesh(tmp_path / name, lonely)
    again = read_surface(tmp_path / name)
    assert np.array_equal(again.vertices, lonely.vertices)
    assert np.array_equal(again.faces, lonely.faces)


def test_holes_leave_other_components_and_take_islands():
    s = two_pieces()
    far = np.flatnonzero(s.component_of_vertex == 1)
    rest = without(s, s.faces[np.flatnonzero(s.component_of_vertex[s.faces[:, 0]] == 0)[0]])
    assert rest.n_components == 2
    assert np.isin(far, rest.faces).all()
    ball = bumpy(600)
    band = np.flatnonzero(np.abs(ball.vertices[:, 1] - 0.4 * ball.vertices[:, 1].max()) < 0.25)
    inside = np.isin(ball.faces, band).all(axis=1)
    assert Surface(ball.vertices, ball.faces[~inside]).n_components > 1  # a cap is parted from the rest
    assert without(ball, band).n_components == 1


def test_faces_are_cut_out_and_everything_else_stays():
    s = bumpy(300)
    rest = without_faces(s, ((3, 5), (100, 100)))
    assert np.array_equal(rest.faces, np.delete(s.faces, [3, 4, 5, 100], axis=0))
    assert np.array_equal(rest.vertices, s.vertices)
    ring = np.flatnonzero((s.faces == s.faces[0, 0]).sum(axis=1) == 0)
    isolated = without_faces(s, tuple((int(f), int(f)) for f in ring[:40]))
    assert len(isolated.faces) == len(s.faces) - 40
    with pytest.raises(ParameterError, match=f"so no face {len(s.faces)}"):
        without_faces(s, ((len(s.faces), len(s.faces)),))
    with pytest.raises(ParameterError, match="left of bumpy"):
        without_faces(s, ((0, len(s.faces) - 1),))


def test_cut_faces_are_those_of_the_mesh_as_it_was_and_loose_vertices_are_not_counted():
    s = bumpy(600)
    fan = np.flatnonzero((s.faces == 7).any(axis=1))
    cut = tuple((int(face), int(face)) for face in fan)
    result, ids = perturbed(s, Perturbation(cut=cut, simplify=300))
    assert len(result.vertices) == 300
    assert (result.component_of_vertex >= 0).all()
    assert 7 not in ids
    assert result.boundary_loop_count == 1
    assert np.array_equal(result.vertices, s.vertices[ids])


def test_another_pose_has_the_same_faces(tmp_path):
    s = bumpy(300)
    other = Surface(s.vertices[:, ::-1] * (1, 2, 3), np.roll(s.faces[::-1], 1, axis=1), "other")
    assert np.array_equal(posed(s, other).faces, s.faces)
    path = str(tmp_path / "pose.off")
    write_mesh(path, other)
    result, ids = perturbed(s, Perturbation(pose=path))
    assert np.array_equal(result.vertices, other.vertices)
    assert np.array_equal(ids, np.arange(300))
    with pytest.raises(ParameterError, match="bumpy has 200 vertices and bumpy 300"):
        posed(s, bumpy(200))
    swapped = s.faces.copy()
    swapped[swapped == 0], swapped[swapped == 299] = -1, 0
    swapped[swapped == -1] = 299
    with pytest.raises(ParameterError, match="join other vertices"):
        posed(s, Surface(s.vertices, swapped))


@pytest.mark.parametrize(
    "change",
    [
        Perturbation(cut=((3, 3), (10, 20)), pose="a, b=c/d.obj", noise=0.5),
        Perturbation(pose="x,y.off", simplify=7),
        Perturbation(cut=((0, 0),)),
    ],
)
def test_words_of_poses_and_cut_faces_are_read_as_they_are_written(change):
    assert change_from_words(words_of_change(change)) == change


def test_runs_are_put_in_order():
    assert runs_from_words("40+3-5+6+10-12+11-15") == ((3, 6), (10, 15), (40, 40))
    for words in ("5-3", "-2", "x", ""):
        with pytest.raises(ValueError, match=r"ascend|invalid literal"):
            runs_from_words(words)
    with pytest.raises(ParameterError, match="cut is faces such as"):
        change_from_words("cut=5-3")
    with pytest.raises(ParameterError, match="pose is a mesh file"):
        change_from_words("pose=")
