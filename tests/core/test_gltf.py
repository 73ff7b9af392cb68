"""glTF and GLB files: where nodes place meshes, which ids vertices have, and what is refused."""

import json
import random

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats import gltf_file as reader
from bihdist_core.formats.mesh_io import mesh_content, read_surface, surface_in
from tests.core.mesh_samples import FACES, VERTICES, assert_same, glb, gltf, gltf_parts, message_of

SINGLE = VERTICES.astype(np.float32)


def made(nodes=None, primitives=None, **others):
    """The sample with other nodes or primitives."""
    data, buffer = gltf_parts()
    data |= others
    if nodes is not None:
        data["nodes"] = nodes
    if primitives is not None:
        data["meshes"] = [{"primitives": primitives}]
    return gltf(data, buffer)


def refused(content, name="a.gltf"):
    with pytest.raises(MeshError) as caught:
        surface_in(content, name)
    message = str(caught.value)
    assert message.startswith(name)
    assert message.endswith(".")
    assert "\n" not in message
    return message


def test_nodes_place_meshes_and_number_their_vertices():
    # The root has no mesh of its own; its children come in their order, each before those below it.
    nodes = [
        {"children": [2, 1], "translation": [0, 0, 5]},
        {"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1]},
        {"mesh": 0, "scale": [2, 3, 4], "children": [3]},
        {"mesh": 0, "rotation": [0, 0, np.sqrt(0.5), np.sqrt(0.5)], "translation": [1, 0, 0]},
    ]
    surface = surface_in(made(nodes), "a.gltf")
    up, turned = [0, 0, 5], np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    scaled = np.array([2, 3, 4])
    expected = [SINGLE * scaled + up, (SINGLE @ turned.T + [1, 0, 0]) * scaled + up, SINGLE @ turned.T + [7, 8, 9] + up]
    np.testing.assert_allclose(surface.vertices, np.concatenate(expected), atol=1e-12)
    np.testing.assert_array_equal(surface.faces, np.concatenate([FACES, FACES + 5, FACES + 10]))
    assert surface.facts == ("3 primitives at 3 places joined into one surface, in the file's order",)


def test_a_mirror_image_keeps_its_outside():
    surface = surface_in(made([{"mesh": 0, "scale": [-1, 1, 1]}]), "a.gltf")
    np.testing.assert_array_equal(surface.vertices, SINGLE * [-1, 1, 1])
    np.testing.assert_array_equal(surface.faces, FACES[:, [0, 2, 1]])


def test_files_without_a_scene_or_nodes_show_everything():
    assert_same(surface_in(made(scenes=[], scene=0), "a.gltf"), SINGLE)
    inner = [{"mesh": 0, "translation": [1, 0, 0]}, {"children": [0], "translation": [0, 1, 0]}]
    assert_same(surface_in(made(inner, scenes=[]), "a.gltf"), np.add(SINGLE.astype(float), [1, 1, 0]))
    assert_same(surface_in(made([], scenes=[]), "a.gltf"), SINGLE)


def test_primitives_of_one_accessor_share_its_vertices():
    primitive = {"attributes": {"POSITION": 1}, "indices": 0}
    other = {"attributes": {"POSITION": 1}, "mode": 6}
    lines = {"attributes": {"POSITION": 1}, "mode": 1}
    surface = surface_in(made(primitives=[primitive, other, lines]), "a.gltf")
    # The fan about vertex 0 has a face that is there already.
    assert_same(surface, SINGLE, np.concatenate([FACES, [[0, 3, 4]]])[[0, 1, 2]])
    assert surface.repairs == ("1 primitive of points or lines ignored", "3 faces that repeated another dropped")


@pytest.mark.parametrize(
    ("mode", "expected"), [(5, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]), (6, [[0, 1, 2], [0, 2, 3], [0, 3, 4]])]
)
def test_strips_and_fans_without_indices(mode, expected):
    surface = surface_in(made(primitives=[{"attributes": {"POSITION": 1}, "mode": mode}]), "a.gltf")
    assert_same(surface, SINGLE, np.array(expected))


def test_what_is_left_out_is_said():
    data, buffer = gltf_parts()
    data["meshes"][0]["primitives"][0] |= {"material": 0, "targets": [{"POSITION": 1}]}
    surface = surface_in(gltf(data, buffer), "a.gltf")
    assert surface.facts == ("colours and materials left out", "skins and morph targets left out")
    data["nodes"] = [{"mesh": 0, "skin": 0, "translation": [1, 2, 3]}]
    assert_same(surface_in(gltf(data, buffer), "a.gltf"), SINGLE)


def test_positions_may_be_whole_numbers_and_interleaved():
    data, _ = gltf_parts()
    ids, points = FACES.astype("<u2").tobytes(), np.zeros((5, 4), "<i2")
    points[:, :3] = [[0, 0, 0], [32767, 0, 0], [32767, 32767, 0], [0, 32767, 0], [-32768, 0, 100]]
    buffer = ids + b"\0\0" + points.tobytes()
    data["accessors"][1] |= {"componentType": 5122, "normalized": True}
    data["bufferViews"][1] = {"buffer": 0, "byteOffset": 20, "byteLength": 40, "byteStride": 8}
    data["extensionsRequired"] = ["KHR_mesh_quantization"]
    expected = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [-1, 0, 100 / 32767]])
    assert_same(surface_in(gltf(data, buffer), "a.gltf"), expected)


# ---------------------------------------------------------------------- files beside it
def beside(folder, uri, name="mesh.bin"):
    """A .gltf file that names a buffer of that name beside it, and the buffer."""
    data, buffer = gltf_parts()
    data["buffers"][0]["uri"] = uri
    (folder / "a.gltf").write_text(json.dumps(data))
    (folder / name).write_bytes(buffer)
    return folder / "a.gltf", buffer


def test_a_buffer_beside_the_file_is_read_and_part_of_its_content(tmp_path):
    path, buffer = beside(tmp_path, "the%20mesh.bin", "the mesh.bin")
    assert_same(read_surface(path), SINGLE)
    before = mesh_content(path)
    (tmp_path / "the mesh.bin").write_bytes(buffer[:-4] + bytes(4))
    assert mesh_content(path) != before
    assert "buffer 0 is 'the%20mesh.bin', which is not followed from here" in refused(path.read_bytes())


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("../mesh.bin", "only a file in the folder of the .gltf is read"),
        ("%2e%2e%2fmesh.bin", "only a file in the folder of the .gltf is read"),
        ("/etc/passwd", "only a file in the folder of the .gltf is read"),
        ("https://example.org/mesh.bin", "only a file in the folder of the .gltf is read"),
        ("..", "only a file in the folder of the .gltf is read"),
        ("gone.bin", "'gone.bin' beside it, cannot be read: No such file or directory"),
        ("folder", "buffer 0, 'folder', is not a regular file"),
    ],
)
def test_other_paths_are_not_followed(tmp_path, uri, expected):
    (tmp_path / "folder").mkdir()
    path, _ = beside(tmp_path, uri, "../mesh.bin")
    with pytest.raises(MeshError, match=r"a\.gltf: buffer 0") as caught:
        read_surface(path)
    assert expected in str(caught.value)


def test_a_buffer_beside_that_is_too_large_is_not_read(tmp_path, monkeypatch):
    path, _ = beside(tmp_path, "mesh.bin")
    monkeypatch.setattr(reader, "MOST_BYTES", 50)
    with pytest.raises(MeshError, match=r"'mesh.bin', has more than"):
        read_surface(path)


# ---------------------------------------------------------------------- refusals
def with_change(change):
    data, buffer = gltf_parts()
    change(data)
    return gltf(data, buffer)


CHANGES = {
    "extension": (
        lambda d: d.update(extensionsRequired=["KHR_draco_mesh_compression"]),
        "'KHR_draco_mesh_comp",
    ),
    "version": (lambda d: d.update(asset={"version": "1.0"}), "is not a glTF 2 file"),
    "no asset": (lambda d: d.pop("asset"), "is not a glTF 2 file"),
    "no list": (lambda d: d.update(nodes={}), "'nodes' is not a list"),
    "no scene": (lambda d: d.update(scene=3), "scenes 3 does not exist"),
    "no object": (lambda d: d.update(meshes=[7]), "meshes 0 is not an object"),
    "loop": (lambda d: d.update(nodes=[{"mesh": 0, "children": [0]}]), "node 0 stands in two places"),
    "matrix": (lambda d: d.update(nodes=[{"mesh": 0, "matrix": [1]}]), "matrix of node 0 is [1], not 16 numbers"),
    "projection": (lambda d: d.update(nodes=[{"mesh": 0, "matrix": [1.0] * 16}]), "is not affine"),
    "scale": (lambda d: d.update(nodes=[{"mesh": 0, "scale": [1, 10**400, 1]}]), "scale of node 0 is"),
    "rotation": (lambda d: d.update(nodes=[{"mesh": 0, "rotation": [0, 0, 0, 0]}]), "is not a unit quaternion"),
    "attributes": (lambda d: d.update(meshes=[{"primitives": [{}]}]), "primitive 0 of mesh 0 has no attributes"),
    "index": (lambda d: d["accessors"][1].update(count=4), "index 7 of primitive 0 of mesh 0 names vertex 4"),
    "corners": (lambda d: d["accessors"][0].update(count=8), "has 8 corners"),
    "beyond": (lambda d: d["accessors"][1].update(count=6), "accessor 1 reads 6 entries and goes beyond the end of"),
    "stride": (lambda d: d["bufferViews"][1].update(byteStride=4), "goes beyond the end of bufferView 1"),
    "sparse": (lambda d: d["accessors"][1].update(sparse={}), "accessor 1 is sparse"),
    "type": (lambda d: d["accessors"][1].update(type="VEC4"), "accessor 1 holds VEC4 of 5126, not VEC3 of 5120 or"),
    "float indices": (lambda d: d["accessors"][0].update(componentType=5126), "not SCALAR of 5121 or 5123 or 5125"),
    "count": (lambda d: d["accessors"][1].update(count=-1), "count of accessor 1 is -1, not a count"),
    "no length": (lambda d: d["bufferViews"][1].pop("byteLength"), "byteLength of bufferView 1 is None, not a count"),
    "points only": (lambda d: d["meshes"][0]["primitives"][0].update(mode=0), "but no faces"),
}


@pytest.mark.parametrize("case", CHANGES)
def test_refusals_say_where_and_why(case):
    change, expected = CHANGES[case]
    assert expected in refused(with_change(change))


def test_damaged_files_are_refused():
    whole, (data, buffer) = glb(*gltf_parts()), gltf_parts()
    assert "is not a glTF file, or is cut off or damaged" in refused(made()[:-30])
    assert "nested more than 64 deep" in refused(b"[" * 100_000)
    assert "announces" in refused(whole[:-4], "a.glb")
    assert "its length is wrong" in refused(whole + b"1234", "a.glb")
    assert "of version 1" in refused(whole[:4] + b"\1" + whole[5:], "a.glb")
    assert "goes beyond the end" in refused(whole[:12] + b"\xff" * 4 + whole[16:], "a.glb")
    assert "begins with a chunk of JSON" in refused(whole[:16] + b"XXXX" + whole[20:], "a.glb")
    assert "buffer 0 has no data" in refused(json.dumps(data).encode())
    assert "buffer 0 announces 99,999 bytes" in refused(glb(data | {"buffers": [{"byteLength": 99999}]}, buffer))
    assert "buffer 0 is damaged base64 text" in refused(made().replace(b"base64,", b"base64,*"))


def test_a_small_file_cannot_fill_the_memory(monkeypatch):
    monkeypatch.setattr(reader, "MOST_BYTES", 10_000)
    content = made([{"children": [*range(1, 100)]}, *[{"mesh": 0}] * 99])
    assert "unfolds to more than" in refused(content)


def test_damaged_values_give_a_surface_or_one_sentence():
    rng = random.Random(0)
    values = [None, -1, 0, 1, 2, 5, 1e300, 2**70, "", "x", [], {}, [0], [[]], {"a": 1}, True, float("nan")]
    read = 0

    def spoil(found):
        """Some value somewhere replaced."""
        key = rng.choice([*found] if isinstance(found, dict) else range(len(found)))
        if isinstance(found[key], dict | list) and found[key] and rng.random() < 0.9:
            spoil(found[key])
        else:
            found[key] = rng.choice(values)

    for _ in range(1500):
        data, buffer = gltf_parts()
        data["nodes"] = [{"children": [1, 2]}, {"mesh": 0, "rotation": [0, 0, 0, 1]}, {"mesh": 0, "scale": [1, 2, 3]}]
        data["meshes"][0]["primitives"].append({"attributes": {"POSITION": 1}, "mode": 5})
        data["accessors"][1] |= {"byteOffset": 0, "normalized": False}
        spoil(data)
        message = message_of(surface_in, glb(data, buffer), "a.glb")
        assert not message or ("a.glb" in message and "\n" not in message)
        read += not message
    assert 100 < read < 1400
