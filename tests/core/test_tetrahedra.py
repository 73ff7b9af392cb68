"""Tetrahedra: files, Laplacians against dense spectra, and the boundary."""

import pickle
import sys

import numpy as np
import pytest
from scipy.spatial import Delaunay

import bihdist_core as bihdist
from bihdist_core import MeshError, ParameterError, TetrahedralMesh, VertexError, read_surface, write_mesh
from bihdist_core.formats.field_output import write_fields
from bihdist_core.formats.vertex_arrays import read_vertex_arrays

CLOSE = 1e-9


def ball(n):
    """Random points in a ball, and their tetrahedra, as a mesher might give them."""
    random = np.random.default_rng(5)
    x = random.normal(size=(n, 3))
    x *= (random.random((n, 1)) ** (1 / 3)) / np.linalg.norm(x, axis=1, keepdims=True)
    x[: n // 3] /= np.linalg.norm(x[: n // 3], axis=1, keepdims=True)
    cells = Delaunay(x).simplices
    edges = x[cells[:, 1:]] - x[cells[:, :1]]
    return x, cells[np.abs(np.linalg.det(edges)) > 1e-6]


@pytest.fixture(scope="module")
def solid():
    return TetrahedralMesh(*ball(500), "ball")


@pytest.fixture(scope="module")
def dense(solid):
    """Eigenvalues and eigenvectors of linear elements, put together from gradients, without the constant."""
    x, cells = solid.vertices, solid.tetrahedra
    edges = x[cells[:, 1:]] - x[cells[:, :1]]
    inner = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1)
    volumes = np.abs(np.linalg.det(edges)) / 6
    stiffness = np.zeros((len(x), len(x)))
    np.add.at(
        stiffness, (cells[:, :, None], cells[:, None, :]), np.einsum("tix,tjx,t->tij", gradients, gradients, volumes)
    )
    root = np.sqrt(np.bincount(cells.ravel(), np.repeat(volumes / 4, 4)))
    values, vectors = np.linalg.eigh(stiffness / np.outer(root, root))
    return values[1:], (vectors / root[:, None])[:, 1:]


@pytest.mark.parametrize(
    ("make", "weight"),
    [
        (bihdist.BiharmonicDistance, lambda v: 1 / v**2),
        (bihdist.CommuteTimeDistance, lambda v: 1 / v),
        (lambda solid: bihdist.PowerDistance(solid, 3.0), lambda v: 1 / v**3),
        (lambda solid: bihdist.DiffusionDistance(solid, 0.25), lambda v: np.exp(-0.25 * v / v[0])),
        (lambda solid: bihdist.DiffusionDistance(solid, 4.0), lambda v: np.exp(-4 * v / v[0])),
    ],
)
def test_distances_are_those_of_the_dense_spectrum(solid, dense, make, weight):
    distance, (values, vectors) = make(solid), dense
    rows = vectors * np.sqrt(weight(values))
    for source in (0, 7, 400):
        wanted = np.linalg.norm(rows - rows[source], axis=1)
        off = np.abs(distance.from_source(source) - wanted).max() / wanted.max()
        assert off <= min(CLOSE, distance.accuracy)


def test_signatures_are_those_of_the_dense_spectrum(solid, dense):
    values, vectors = dense
    found = bihdist.biharmonic_kernel_signature(solid)
    np.testing.assert_allclose(found.values, (vectors**2 / values**2).sum(axis=1), rtol=CLOSE)
    assert found.unit == "mesh units"


@pytest.mark.parametrize("make", [bihdist.BiharmonicDistance, bihdist.CommuteTimeDistance, bihdist.DiffusionDistance])
def test_distances_scale_as_their_unit_says(solid, make):
    twice = TetrahedralMesh(2 * solid.vertices, solid.tetrahedra)
    one, other = (make(each).between(3, 77) for each in (solid, twice))
    power = {"mesh units^0.5": 0.5, "mesh units^-0.5": -0.5, "mesh units^-1.5": -1.5}[make(solid).unit]
    assert other == pytest.approx(2**power * one)


def test_the_boundary_is_closed_and_seen_from_outside(solid):
    boundary = solid.shape
    assert (len(boundary.boundary_edges), boundary.genus) == (0, 0)
    x = boundary.vertices[boundary.faces]
    enclosed = np.einsum("ij,ij->", np.cross(x[:, 0], x[:, 1]), x[:, 2]) / 6
    assert enclosed == pytest.approx(solid.volume)
    assert np.array_equal(boundary.vertices, solid.vertices)


def test_tetrahedra_may_be_turned_over_or_leave_vertices_out(solid):
    x, cells = solid.vertices, solid.tetrahedra
    other = TetrahedralMesh(np.vstack([x, [[9, 9, 9]]]), cells[:, [1, 0, 2, 3]])
    assert other.volume == pytest.approx(solid.volume)
    assert other.unreferenced_count == 1
    field = bihdist.BiharmonicDistance(other).from_source(3)
    assert np.isnan(field[-1])
    np.testing.assert_allclose(field[:-1], bihdist.BiharmonicDistance(solid).from_source(3), rtol=0, atol=1e-9)
    with pytest.raises(VertexError, match="vertex 500 belongs to no tetrahedron"):
        other.check_vertex(500)


def test_each_component_has_its_own_distances(solid):
    x, cells = solid.vertices, solid.tetrahedra
    both = TetrahedralMesh(np.vstack([x, x + 5]), np.vstack([cells, cells + len(x)]))
    field = bihdist.BiharmonicDistance(both).from_source(503)
    assert np.isnan(field[:500]).all()
    np.testing.assert_allclose(field[500:], bihdist.BiharmonicDistance(solid).from_source(3), rtol=0, atol=1e-9)


def test_a_part_can_be_cut_out_and_all_be_pickled(solid):
    left = solid.without(np.arange(20))
    assert "cut out" in left.facts[-1]
    assert len(left.tetrahedra) < len(solid.tetrahedra)
    again = pickle.loads(pickle.dumps(left))
    assert np.array_equal(again.tetrahedra, left.tetrahedra)
    assert bihdist.BiharmonicDistance(again).between(100, 200) == bihdist.BiharmonicDistance(left).between(100, 200)


FLAT = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    ("x", "cells", "words"),
    [
        (FLAT, [[0, 1, 2, 3]], r"tetrahedron 0, of the vertices \[0, 1, 2, 3\], has no volume"),
        (FLAT, [[0, 1, 2, 4]], r"tetrahedron 0 has the vertices \(0, 1, 2, 4\); ids run from 0 to 3"),
        (FLAT, [[0, 1, 2]], r"must have shape \(m, 4\)"),
        (FLAT, np.empty((0, 4), int), r"must have shape \(m, 4\)"),
        ([*FLAT[:3], [0, 0, np.inf]], [[0, 1, 2, 3]], "vertex 3 "),
    ],
)
def test_bad_tetrahedra_are_named(x, cells, words):
    with pytest.raises(MeshError, match=words):
        TetrahedralMesh(x, cells)


def test_geodesic_distance_needs_faces(solid):
    with pytest.raises(ParameterError, match="needs faces"):
        bihdist.GeodesicDistance(solid)


# ---------------------------------------------------------------------- files
@pytest.mark.parametrize("name", ["ball.vtu", "ball.vtk", "ball.mesh", "ball.msh"])
def test_files_are_read_as_meshio_writes_them(solid, tmp_path, name):
    meshio = pytest.importorskip("meshio")
    path = tmp_path / name
    more = {"file_format": "gmsh22"} if name.endswith("msh") else {}
    cells = [("tetra", solid.tetrahedra)]
    if name in ("ball.mesh", "ball.msh"):
        cells.insert(0, ("triangle", solid.shape.faces[:5]))
    meshio.write(path, meshio.Mesh(solid.vertices, cells), **more)
    found = read_surface(path)
    assert np.array_equal(found.tetrahedra, solid.tetrahedra)
    np.testing.assert_allclose(found.vertices, solid.vertices, atol=1e-12)
    assert found.facts == ("5 cells other than tetrahedra ignored",) * (len(cells) - 1)


def test_triangles_of_medit_are_a_surface(tmp_path):
    meshio = pytest.importorskip("meshio")
    meshio.write(tmp_path / "a.mesh", meshio.Mesh(np.array(FLAT, float), [("triangle", [[0, 1, 2], [2, 1, 3]])]))
    assert read_surface(tmp_path / "a.mesh").n_faces == 2


def test_objects_of_meshio_with_tetrahedra_are_taken(solid):
    meshio = pytest.importorskip("meshio")
    found = bihdist.Surface.of(meshio.Mesh(solid.vertices, [("tetra", solid.tetrahedra)]))
    assert np.array_equal(found.tetrahedra, solid.tetrahedra)


def test_damaged_files_and_a_missing_meshio_are_sentences(tmp_path, monkeypatch):
    path = tmp_path / "a.mesh"
    path.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0")
    with pytest.raises(MeshError, match=r"a\.mesh cannot be read: "):
        read_surface(path)
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(MeshError, match=r"a\.mesh is read by meshio; `pip install 'bihdist\[meshio\]'` brings it"):
        read_surface(path)


def test_fields_are_written_with_the_tetrahedra_and_read_again(solid, tmp_path):
    field = bihdist.BiharmonicDistance(solid).from_source(3)
    write_fields(tmp_path / "a.vtu", solid, {"distance": field})
    assert np.array_equal(read_surface(tmp_path / "a.vtu").tetrahedra, solid.tetrahedra)
    (values,) = read_vertex_arrays(tmp_path / "a.vtu")
    assert np.array_equal(values.values, field)
    write_fields(tmp_path / "b.vtu", solid.shape, {"distance": field})
    assert np.array_equal(read_surface(tmp_path / "b.vtu").faces, solid.shape.faces)
    write_mesh(tmp_path / "c.ply", solid)
    assert np.array_equal(read_surface(tmp_path / "c.ply").faces, solid.shape.faces)
