"""A mesh without its degenerate faces: what is left has none, and every place is where it was."""

import numpy as np
import pytest

from bihdist_core.distances import proper_faces
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.distances.unfolding_mesh import UnfoldingMesh
from bihdist_core.sources.pieces import Pieces
from bihdist_core.surface import Surface
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import bumpy, caps, folded, grid, needles, needs_kernel, slivers

pytestmark = needs_kernel

NEAR = 1e-11
"""Of the size of the mesh: of some degenerate faces, one upon the other, each moves places by 2e-13 of its edges."""


def rough(columns, rows):
    flat, rng = grid(columns, rows), np.random.default_rng(0)
    return Surface(flat.vertices + 0.3 * rng.normal(size=(len(flat.vertices), 1)) * [0, 0, 1], flat.faces)


SOUND = [
    slivers(),
    caps(bumpy(60), 0.0, 1),
    needles(bumpy(60), 0.0, 2),
    needles(caps(rough(5, 4), 0.0, 1), 0.0, 1),
]
"""Without their degenerate faces; some of the others would have new ones for those that are taken out."""

SHAPES = [
    *SOUND,
    folded(rough(5, 4), 0.0, 3),
    *(Surface(*nasty_mesh(seed, 60)) for seed in range(12)),
]


def placed(mesh, faces, weights):
    """(k, 3) where weights are on the kernel's mesh."""
    x = mesh._proper.points if mesh._proper is not None else mesh.surface.vertices / mesh.unit
    corners = mesh._proper.faces[faces] if mesh._proper is not None else mesh.surface.faces[faces]
    return np.einsum("kc,kcx->kx", weights, x[corners]) * mesh.unit


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: f"{shape.name}-{len(shape.faces)}")
def test_places_and_pieces_stay_where_they_are(shape):
    mesh, rng = UnfoldingMesh(shape), np.random.default_rng(1)
    size = np.abs(shape.vertices).max()
    faces = np.repeat(np.arange(len(shape.faces)), 3)
    proper = np.array([len({*face}) == 3 for face in shape.faces.tolist()])
    faces = faces[proper[faces]]
    begin, end = rng.dirichlet([1, 1, 1], (2, len(faces)))
    lengths = np.linalg.norm(np.einsum("kc,kcx->kx", end - begin, shape.vertices[shape.faces[faces]]), axis=1)
    for stop in (begin, end):
        found = mesh.at_pieces(Pieces(faces, shape.faces[faces], begin, stop, (begin != stop).any(axis=1)))
        assert found.begin.min() >= 0
        assert np.abs(found.begin.sum(axis=1) - 1).max() < 1e-12
        (ways,) = np.diff([placed(mesh, found.faces, weights) for weights in (found.begin, found.end)], axis=0)
        parts = np.bincount(found.rows, np.linalg.norm(ways, axis=1), len(faces))
        assert np.abs(parts - (lengths if stop is end else 0)).max() < NEAR * size
        # There and back.
        rows, at = found.rows, placed(mesh, found.faces, found.begin)
        back, weights, _ = mesh.outside(found.faces.copy(), found.begin.copy(), found.end.copy())
        there = np.einsum("kc,kcx->kx", weights, shape.vertices[shape.faces[back]])
        assert np.abs(there - at).max() < NEAR * size
        if stop is begin:
            here = np.einsum("kc,kcx->kx", begin[rows], shape.vertices[shape.faces[faces[rows]]])
            assert np.abs(here - at).max() < NEAR * size


@pytest.mark.parametrize("shape", SOUND, ids=lambda shape: f"{shape.name}-{len(shape.faces)}")
def test_no_degenerate_face_is_left(shape):
    mesh = UnfoldingMesh(shape)
    sides = mesh.sides.reshape(-1, 3)
    there = sides["length"].max(axis=1) > 0
    height, longest = sides["y"][there, 0] * sides["length"][there, 0], sides["length"][there].max(axis=1)
    assert (height > 2e-13 * longest**2).all()


def test_it_is_the_same_with_less_room_at_first(monkeypatch):
    shape = needles(caps(rough(8, 8), 0.0, 1), 0.0, 1)
    expected = UnfoldingMesh(shape)
    rooms, made = [], proper_faces._cells
    monkeypatch.setattr(proper_faces, "CELLS_EACH", 1)
    monkeypatch.setattr(proper_faces, "_cells", lambda *given: (rooms.append(given[4]), made(*given))[1])
    found = UnfoldingMesh(shape)
    assert len(rooms) > 1
    used = expected.first[-1]
    assert np.array_equal(found.sides, expected.sides)
    assert np.array_equal(found.corner[:used], expected.corner[:used])


def test_a_face_that_is_a_point_is_one():
    """Its three corners are at one place, where another face begins."""
    shape = Surface(np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), [[0, 1, 2], [2, 3, 4]])
    mesh = UnfoldingMesh(shape)
    assert mesh.number[:3].tolist() == [mesh.number[0]] * 3
    assert np.isfinite(mesh.sides["x"]).all()
    field = ExactGeodesic(shape).field(0)
    assert field.distances.tolist() == [0, 0, 0, 1, 1]
    assert len(field.path(2).faces) == 0
    alone = Surface(np.zeros((3, 3)), [[0, 1, 2]])
    assert ExactGeodesic(alone).distances(0).tolist() == [0, 0, 0]


@pytest.mark.parametrize("damage", [caps, needles])
def test_a_mesh_of_many_degenerate_faces_has_the_distances_without_them(damage):
    sound = rough(40, 40)
    found = ExactGeodesic(damage(sound, 0.0, 1)).distances(5)[: len(sound.vertices)]
    expected = ExactGeodesic(sound).distances(5)
    assert np.abs(found - expected).max() < 1e-12 * expected.max()
