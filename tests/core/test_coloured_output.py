"""Surfaces with a colour at each vertex: other programs read back the colours and the fields that were written."""

import json
import struct

import numpy as np
import pytest

from bihdist_core import OutputError, ParameterError, Surface, read_surface
from bihdist_core.formats.field_output import write_fields
from bihdist_core.formats.surface_output import COLOURED_FORMATS, UNDEFINED, write_coloured
from tests.shapes import bumpy, two_pieces

SHAPE = bumpy(60)
COLOURS = np.random.default_rng(4).integers(0, 256, (60, 3)).astype(np.uint8)
COLOURS[:2] = [[0, 255, 10], [11, 12, 254]]
FIELD = np.append(SHAPE.vertices[:-1, 0], np.nan)


@pytest.fixture(params=COLOURED_FORMATS)
def path(request, tmp_path):
    path = tmp_path / f"a{request.param}"
    write_coloured(path, SHAPE, COLOURS, {"red": FIELD, "x, of it": 2 * FIELD})
    return path


def parsed(path):
    """The JSON of a .glb, and its arrays by the names of their attributes."""
    content = path.read_bytes()
    magic, version, length, size, kind = struct.unpack("<4sIII4s", content[:20])
    assert (magic, version, length, kind) == (b"glTF", 2, len(content), b"JSON")
    data, rest = json.loads(content[20 : 20 + size]), content[20 + size :]
    assert struct.unpack("<I4s", rest[:8]) == (len(rest) - 8, b"BIN\0")
    assert len(rest) - 8 == data["buffers"][0]["byteLength"]
    (primitive,) = data["meshes"][0]["primitives"]
    arrays = {}
    for name, k in (primitive["attributes"] | {"indices": primitive["indices"]}).items():
        accessor = data["accessors"][k]
        view = data["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        start = 8 + view["byteOffset"]
        array = np.frombuffer(rest[start : start + view["byteLength"]], kind)
        arrays[name] = array.reshape(accessor["count"], {"VEC3": 3, "SCALAR": 1}[accessor["type"]])
    return data, arrays


def in_srgb(linear):
    """Bytes of linear RGB, by IEC 61966-2-1."""
    return np.rint(255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055))


def test_the_surface_is_read_back(path):
    read = read_surface(path)
    assert np.array_equal(read.faces, SHAPE.faces)
    near = 1e-6 if path.suffix == ".glb" else 0
    assert np.abs(read.vertices - SHAPE.vertices).max() <= near


def test_trimesh_reads_the_colours(path):
    (mesh,) = pytest.importorskip("trimesh").load_scene(path, process=False).geometry.values()
    if path.suffix == ".glb":
        assert np.allclose(mesh.vertex_attributes["_X_OF_IT"][:-1].ravel(), 2 * FIELD[:-1], rtol=1e-6)
        assert np.array_equal(in_srgb(np.asarray(mesh.visual.vertex_attributes["color"], float)), COLOURS)
    else:
        assert np.array_equal(mesh.visual.vertex_colors[:, :3], COLOURS)


def test_vtk_reads_the_colours(path):
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.read(path)
    if path.suffix == ".glb":
        (mesh,) = (block for block in mesh.recursive_iterator() if block.n_points)
        assert np.array_equal(in_srgb(np.asarray(mesh.point_data["COLOR_0"])), COLOURS)
        assert np.allclose(np.asarray(mesh.point_data["_RED"])[:-1], FIELD[:-1], rtol=1e-6)
    else:
        assert np.array_equal(mesh.point_data["RGB"], COLOURS)


def test_ply_has_the_fields_beside_the_colours(tmp_path):
    write_coloured(tmp_path / "a.ply", SHAPE, COLOURS, {"red": FIELD, "x, of it": 2 * FIELD})
    head, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n")
    lines = [line.split() for line in head.decode().splitlines()]
    names = [line[2] for line in lines if line[0] == "property" and line[1] != "list"]
    assert names == ["x", "y", "z", "red", "green", "blue", "red_2", "x_of_it"]
    row = np.dtype([("xyz", "<f8", 3), ("rgb", "u1", 3), ("fields", "<f8", 2)])
    rows = np.frombuffer(body, row, 60)
    assert np.array_equal(rows["rgb"], COLOURS)
    assert np.array_equal(rows["fields"], np.column_stack([FIELD, 2 * FIELD]), equal_nan=True)


def test_obj_has_each_colour_beside_its_vertex(tmp_path):
    write_coloured(tmp_path / "a.obj", SHAPE, COLOURS, {"x": FIELD})
    rows = [line.split() for line in (tmp_path / "a.obj").read_text().splitlines()]
    table = np.array([row[1:] for row in rows if row[0] == "v"], float)
    assert np.array_equal(table[:, :3], SHAPE.vertices)
    # Some readers round, some cut off.
    for as_byte in (np.rint, np.floor):
        assert np.array_equal(as_byte(255 * table[:, 3:]), COLOURS)


def test_glb_is_what_gltf_demands(tmp_path):
    moved = Surface(SHAPE.vertices + np.array([1e6, 0, 0]), SHAPE.faces, "moved.off")
    write_coloured(tmp_path / "a.glb", moved, COLOURS, {"biharmonic from 12": FIELD, "Biharmonic from 12": FIELD})
    data, arrays = parsed(tmp_path / "a.glb")
    assert data["nodes"][0]["name"] == "moved"
    points = arrays["POSITION"]
    assert data["accessors"][0]["min"] == points.min(axis=0).tolist()
    assert data["accessors"][0]["max"] == points.max(axis=0).tolist()
    # Far from the origin, too, where single precision has steps of 0.06.
    assert np.abs(points + data["nodes"][0]["translation"] - moved.vertices).max() < 1e-6
    assert np.allclose(np.linalg.norm(arrays["NORMAL"], axis=1), 1, atol=1e-6)
    assert np.array_equal(arrays["indices"].reshape(-1, 3), SHAPE.faces)
    assert np.array_equal(in_srgb(arrays["COLOR_0"].astype(float)), COLOURS)
    assert {"_BIHARMONIC_FROM_12", "_BIHARMONIC_FROM_12_2"} <= arrays.keys()
    assert all(np.isfinite(array).all() for array in arrays.values())
    values = arrays["_BIHARMONIC_FROM_12"].ravel()
    assert np.array_equal(values[:-1], FIELD[:-1].astype("f4"))
    assert values[-1] == np.float32(UNDEFINED)


def test_a_vertex_without_a_face_has_a_normal(tmp_path):
    surface = two_pieces()
    write_coloured(
        tmp_path / "a.glb", surface, np.zeros((surface.n_vertices, 3), np.uint8), {"x": surface.vertices[:, 0]}
    )
    _, arrays = parsed(tmp_path / "a.glb")
    assert np.allclose(np.linalg.norm(arrays["NORMAL"], axis=1), 1, atol=1e-6)


def test_what_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(OutputError, match=r"\.ply, \.obj, \.glb"):
        write_coloured(tmp_path / "a.vtp", SHAPE, COLOURS, {"a": FIELD})
    with pytest.raises(ParameterError, match="needs a real number for each of the 60 vertices"):
        write_coloured(tmp_path / "a.ply", SHAPE, COLOURS, {"a": FIELD[1:]})
    for factor in (1e-40, 1e40):
        small = Surface(factor * SHAPE.vertices, SHAPE.faces, "small")
        with pytest.raises(
            ParameterError, match=r"single precision, and small is [\d.e+-]+ large; write \.ply instead"
        ):
            write_coloured(tmp_path / "a.glb", small, COLOURS, {"a": FIELD})
    with pytest.raises(OutputError, match=r"\.func\.gii"):
        write_fields(tmp_path / "a.glb", SHAPE, {"a": FIELD})
    assert not [*tmp_path.iterdir()]
