"""Meshes of other libraries, wherever a surface is asked for."""

from pathlib import Path

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    BihdistError,
    MeshError,
    MissingFileError,
    ParameterError,
    Surface,
    read_map,
    read_pins,
    source_from_words,
    write_mesh,
)
from tests.shapes import bumpy

BUMPY = bumpy(60)
V, F = BUMPY.vertices, BUMPY.faces


def of_pyvista(vertices, faces):
    return pytest.importorskip("pyvista").PolyData.from_regular_faces(vertices, faces)


def of_trimesh(vertices, faces):
    return pytest.importorskip("trimesh").Trimesh(vertices, faces, process=False)


def of_meshio(vertices, faces):
    return pytest.importorskip("meshio").Mesh(vertices, [("vertex", [[0]]), ("triangle", faces)])


def of_nibabel(vertices, faces):
    gifti = pytest.importorskip("nibabel").gifti
    arrays = [(vertices.astype(np.float32), "pointset"), (faces.astype(np.int32), "triangle")]
    return gifti.GiftiImage(darrays=[gifti.GiftiDataArray(array, intent) for array, intent in arrays])


def of_open3d(vertices, faces):
    # Its import fails where the system lacks libusb.
    open3d = pytest.importorskip("open3d", exc_type=ImportError)
    arrays = open3d.utility.Vector3dVector(vertices.copy()), open3d.utility.Vector3iVector(faces.astype(np.int32))
    return open3d.geometry.TriangleMesh(*arrays)


def of_open3d_tensors(vertices, faces):
    made = of_open3d(vertices, faces)
    return pytest.importorskip("open3d").t.geometry.TriangleMesh.from_legacy(made)


def of_nilearn(vertices, faces):
    return pytest.importorskip("nilearn.surface").InMemoryMesh(vertices, faces)


def of_lists(vertices, faces):
    return vertices.tolist(), faces.tolist()


@pytest.mark.parametrize(
    "made", [of_pyvista, of_trimesh, of_meshio, of_nibabel, of_open3d, of_open3d_tensors, of_nilearn, of_lists]
)
def test_each_is_the_surface_with_its_ids(made):
    mesh = made(V, F)
    surface = Surface.of(mesh)
    assert np.array_equal(surface.faces, F)
    assert np.allclose(surface.vertices, V, atol=1e-6)
    assert np.allclose(BiharmonicDistance(mesh).from_source(3), BiharmonicDistance(BUMPY).from_source(3), atol=1e-5)


def test_paths_surfaces_and_two_arrays(tmp_path):
    write_mesh(tmp_path / "a.off", BUMPY)
    assert Surface.of(tmp_path / "a.off").name == "a.off"
    assert Surface.of(BUMPY) is BUMPY
    assert np.array_equal(BiharmonicDistance(V, F).from_source(3), BiharmonicDistance(BUMPY).from_source(3))
    with pytest.raises(FileNotFoundError, match=r"There is no file .*b.off"):
        Surface.of(tmp_path / "b.off")
    assert issubclass(MissingFileError, MeshError)


@pytest.mark.parametrize(
    "read",
    [
        lambda folder: read_pins(folder / "none.csv", BUMPY),
        lambda folder: read_map(folder / "none.txt", BUMPY, BUMPY),
        lambda folder: read_map(folder / "none.npy", BUMPY, BUMPY),
        lambda folder: source_from_words(str(folder / "none.json")),
    ],
)
def test_a_missing_file_is_a_wrong_parameter_and_a_missing_file(read, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"none\.\w+ cannot be read: No such file or directory\.$") as caught:
        read(tmp_path)
    assert isinstance(caught.value, ParameterError)
    (tmp_path / "none.csv").mkdir()
    with pytest.raises(ParameterError, match="cannot be read") as caught:
        read_pins(tmp_path / "none.csv", BUMPY)
    assert not isinstance(caught.value, FileNotFoundError)


def test_polygons_are_divided_and_said():
    pyvista, meshio = pytest.importorskip("pyvista"), pytest.importorskip("meshio")
    assert Surface.of(pyvista.Box(quads=True)).facts == ("6 quads divided into 12 triangles",)
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    mixed = meshio.Mesh(square, [("triangle", [[0, 1, 2]]), ("quad", [[0, 1, 2, 3]]), ("line", [[0, 1]])])
    assert Surface.of(mixed).facts == ("1 quad divided into 2 triangles",)


def test_what_does_not_fit_is_one_sentence():
    pyvista, meshio = pytest.importorskip("pyvista"), pytest.importorskip("meshio")
    nibabel = pytest.importorskip("nibabel")
    for mesh, words in (
        (12, "not int"),
        (None, "not NoneType"),
        ((1, 2, 3), "not a tuple of 3"),
        (np.zeros((3, 3)), "not ndarray"),
        (pyvista.ImageData(), "take mesh.extract_surface"),
        (pyvista.PolyData(V), "PolyData has no faces"),
        (of_pyvista(V, F).strip(), "take mesh.triangulate"),
        (meshio.Mesh(V, [("pyramid", [[0, 1, 2, 3, 4]])]), "cells of the type pyramid only"),
        (nibabel.gifti.GiftiImage(), "no array of points"),
    ):
        with pytest.raises(BihdistError, match=words) as caught:
            BiharmonicDistance(mesh)
        assert "\n" not in str(caught.value)


def test_a_file_has_its_own_faces():
    for path in ("x.ply", Path("x.ply")):
        with pytest.raises(ParameterError, match=r"^'x.ply' names a file, .* leave out 3, or take what `read_surface`"):
            BiharmonicDistance(path, 3)


def test_of_several_meshes_one_has_to_be_chosen():
    both = pytest.importorskip("nilearn.surface").PolyMesh(of_nilearn(V, F), of_nilearn(V, F))
    with pytest.raises(MeshError, match=r"PolyMesh has several parts; take one of mesh.parts: 'left', 'right'."):
        Surface.of(both)
    assert np.array_equal(Surface.of(both.parts["left"]).faces, F)


def test_and_back():
    pytest.importorskip("trimesh")
    mesh = BUMPY.to_pyvista({"distance": np.arange(60.0)})
    assert np.array_equal(mesh.regular_faces, F)
    assert mesh["distance"][7] == 7
    assert np.array_equal(BUMPY.to_trimesh().vertices, V)
    assert (BUMPY.n_vertices, BUMPY.n_faces) == (len(V), len(F))
    assert BUMPY.area == pytest.approx(BUMPY.to_trimesh().area)
    assert np.allclose(BUMPY.bounds, BUMPY.to_trimesh().bounds)


@pytest.mark.parametrize(
    ("vertices", "faces", "words"),
    [
        (V + 0j, F, "vertices are not an array of numbers .*complex"),
        (V.astype(str), F, "vertices are not an array of numbers"),
        ([[0, 0, 0], [1, 2]], F, "vertices are not an array of numbers"),
        (V, F + 0j, "faces are not an array of vertex ids .*complex"),
        (V, F > 3, "faces are not an array of vertex ids .*bool"),
    ],
)
def test_arrays_of_other_types_are_refused(vertices, faces, words):
    with pytest.raises(MeshError, match=words):
        Surface(vertices, faces)
