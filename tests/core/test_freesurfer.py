"""FreeSurfer's surfaces, values and annotations: as nibabel writes them, and what is refused."""

import gzip
import random
import struct

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats.freesurfer import read_annotation, read_values
from bihdist_core.formats.mesh_io import read_surface, surface_in
from bihdist_core.formats.vertex_count import announced_vertices
from tests.core.mesh_samples import FACES, VERTICES, assert_same, freesurfer, freesurfer_text, message_of

VALUES = np.array([0.5, -1, 2, 0, 3], np.float32)
NAMES = ("unknown", "bankssts", "cuneus")


def values(values=VALUES, each=1):
    return b"\xff\xff\xff" + struct.pack(">3i", len(values), 3, each) + values.astype(">f4").tobytes()


def annotation(labels=(1, 2, 0, 2, -1), numbered=True, ids=range(5)):
    colours = [10 + 256 * k + 65536 * (k + 1) for k in range(3)]
    rows = [(i, 0 if label < 0 else colours[label]) for i, label in zip(ids, labels, strict=True)]
    content = struct.pack(">i", len(rows)) + b"".join(struct.pack(">2i", *row) for row in rows) + struct.pack(">i", 1)
    content += struct.pack(">2i", -2, 3) if numbered else struct.pack(">i", 3)
    content += text("table") + (struct.pack(">i", 3) if numbered else b"")
    for k, name in enumerate(NAMES):
        content += (struct.pack(">i", k) if numbered else b"") + text(name) + struct.pack(">4i", 10, k, k + 1, 0)
    return content


def text(words):
    return struct.pack(">i", len(words) + 1) + words.encode() + b"\0"


def refused(call, *arguments):
    with pytest.raises(MeshError) as caught:
        call(*arguments, "lh.a")
    message = str(caught.value)
    assert message.startswith("lh.a")
    assert message.endswith(".")
    assert "\n" not in message
    return message


def test_surfaces_written_by_nibabel(tmp_path):
    nibabel = pytest.importorskip("nibabel.freesurfer")
    # Where the volume stands in a scanner is said behind the triangles, and not applied.
    volume = {"head": np.array([2, 0, 20]), "valid": "1", "filename": "x", "volume": [256] * 3, "voxelsize": [1.0] * 3}
    volume |= {"xras": [-1.0, 0, 0], "yras": [0.0, 0, -1], "zras": [0.0, 1, 0], "cras": [5.0, 6, 7]}
    nibabel.write_geometry(str(tmp_path / "lh.pial"), VERTICES, FACES, volume_info=volume)
    surface = surface_in((tmp_path / "lh.pial").read_bytes(), "lh.pial")
    assert_same(surface, VERTICES.astype(np.float32))


@pytest.mark.parametrize("name", ["lh.pial", "lh.seghead", "inner_skull.surf", "pial", "brain.T1.dat"])
@pytest.mark.parametrize("stamp", [b"by hand\n\n", b"by hand\n", b"by hand\na second line\n", b"\n\n", b"\n"])
def test_surfaces_of_any_name_and_stamp(tmp_path, name, stamp):
    for n in (5, 9, 10, 11, 32, 255, 256, 2560, 2570, 65_546, 167_774):  # counts of all kinds of bytes
        vertices = np.zeros((n, 3))
        vertices[:5] = VERTICES
        content = freesurfer(vertices, stamp=stamp)
        (tmp_path / name).write_bytes(content)
        assert_same(read_surface(tmp_path / name), vertices.astype(np.float32))
        assert announced_vertices(tmp_path / name) == n
    (tmp_path / f"{name}.gz").write_bytes(gzip.compress(content))
    assert len(read_surface(tmp_path / f"{name}.gz").vertices) == n


@pytest.mark.parametrize("name", ["lh.pial.asc", "pial.asc", "lh.pial", "suma"])
def test_surfaces_of_text(tmp_path, name):
    (tmp_path / name).write_text(freesurfer_text())
    surface = read_surface(tmp_path / name)
    assert_same(surface)
    assert surface.repairs == ()
    (tmp_path / name).write_bytes(freesurfer_text(marks=[0, 1, 0]).replace("\n", "\r\n").encode()[:-2])
    surface = read_surface(tmp_path / name)
    assert_same(surface, faces=FACES[[0, 2]])
    assert surface.repairs == ("1 triangle marked as cut out ignored",)


TEXT = freesurfer_text()
REFUSED_TEXTS = {
    "label": ("#!ascii label  , from subject\n1\n0 0 0 0 0\n", "is a FreeSurfer label, not a surface"),
    "patch": (TEXT.replace("of lh", "of patch lh"), "is a FreeSurfer patch, not a surface"),
    "no counts": ("#!ascii version\n", "is cut off: its second line is not the numbers of vertices and triangles"),
    "one count": (TEXT.replace("5 3\n", "5\n"), "line 2: '5' is not the numbers of vertices and triangles"),
    "negative": (TEXT.replace("5 3\n", "5 -3\n"), "line 2: '5 -3' is not the numbers"),
    "fraction": (TEXT.replace("5 3\n", "5 3.5\n"), "line 2: '5 3.5' is not the numbers"),
    "cut off": (TEXT[:-8], "announces 5 vertices and 3 triangles, and 7 lines follow; it is cut off or damaged"),
    "longer": (TEXT + "0 1 2 0\n", "and 9 lines follow; its counts are wrong"),
    "column": (TEXT.replace("1.5  0", "1.5"), "line 7: '-0.5 0.001 1.5' is not three numbers and a mark"),
    "index": (TEXT.replace("0 1 2 0", "0 1 5 0"), "line 8: triangle 0 names vertex 5, but ids run from 0 to 4"),
    "word": (TEXT.replace("1.5", "1,5"), "line 7: '1,5' is not a number"),
}


@pytest.mark.parametrize("case", REFUSED_TEXTS)
def test_surfaces_of_text_that_are_refused(case):
    content, expected = REFUSED_TEXTS[case]
    assert expected in refused(surface_in, content.encode())


def test_values_are_those_that_nibabel_writes(tmp_path):
    nibabel = pytest.importorskip("nibabel.freesurfer")
    nibabel.write_morph_data(str(tmp_path / "lh.thickness"), VALUES)
    assert (tmp_path / "lh.thickness").read_bytes()[15:] == values()[15:]
    np.testing.assert_array_equal(read_values((tmp_path / "lh.thickness").read_bytes(), "lh.thickness"), VALUES)


def test_annotations_are_read_as_by_nibabel(tmp_path):
    nibabel = pytest.importorskip("nibabel.freesurfer")
    rng = np.random.default_rng(0)
    table = np.column_stack([rng.permutation(256)[:40], *rng.integers(0, 256, (2, 40)), np.zeros(40, int)])
    labels = rng.integers(-1, 40, 500)
    names = [f"parcel {k}" for k in range(40)]
    nibabel.write_annot(str(tmp_path / "lh.annot"), labels, table, names, fill_ctab=True)
    found = read_annotation((tmp_path / "lh.annot").read_bytes(), "lh.annot")
    np.testing.assert_array_equal(found.labels, labels)
    assert found.names == tuple(names)
    for content in (annotation(), annotation(numbered=False)):
        (tmp_path / "rh.annot").write_bytes(content)
        np.testing.assert_array_equal(nibabel.read_annot(str(tmp_path / "rh.annot"))[0], [1, 2, 0, 2, -1])


@pytest.mark.parametrize("numbered", [True, False], ids=["new", "old"])
def test_annotations_label_vertices_by_their_ids(numbered):
    found = read_annotation(annotation(numbered=numbered, ids=[4, 3, 2, 1, 0]), "lh.annot")
    assert (found.labels.tolist(), found.names) == ([-1, 2, 0, 2, 1], NAMES)


def test_surfaces_that_are_refused():
    whole = freesurfer()

    def message(content):
        return refused(surface_in, content)

    assert "holds values, not a surface: its first bytes are ffffff" in message(values())
    assert "is a FreeSurfer surface of quads" in message(b"\xff\xff\xfd" + whole[3:])
    assert "is not a FreeSurfer surface: its first bytes are 236173" in message(b"#asc\n1 2\n")
    assert "announces 15 coordinates and holds 0" in message(whole[:28])
    assert "the text at its beginning does not end" in message(whole[:18])
    assert "announces 9 corners and holds 8" in message(whole[:-1])
    assert "announces 15 coordinates and holds" in message(whole[:50])
    assert "the number of vertices is -1" in message(whole[:20] + b"\xff" * 4 + whole[24:])
    assert "triangle 0 names vertex 5" in message(freesurfer(faces=[[0, 1, 5]]))


def test_values_that_are_refused():
    assert "is a surface, and holds no values" in refused(read_values, freesurfer())
    assert "is not a FreeSurfer file of values: its first bytes are 000005" in refused(
        read_values, b"\0\0\5" + bytes(20)
    )
    assert "announces 5 values and holds 4" in refused(read_values, values()[:-1])
    assert "continues after its last value" in refused(read_values, values() + b"1")
    assert "has 2 values at each vertex" in refused(read_values, values(each=2))


def test_annotations_that_are_refused():
    whole = annotation()
    assert "has no table of labels" in refused(read_annotation, whole[:44])
    assert "has no table of labels" in refused(read_annotation, whole[:44] + bytes(40))
    assert "cut off or damaged" in refused(read_annotation, whole[:-1])
    assert "does not label each of its 5 vertices once" in refused(read_annotation, annotation(ids=[0, 1, 2, 3, 3]))
    other = whole[:8] + struct.pack(">i", 77) + whole[12:]
    assert "vertex 0 has the colour 77, which is not in the table of labels" in refused(read_annotation, other)
    at = whole.index(text("table")) + len(text("table")) + 4
    assert "stands at 9 of a table of 3" in refused(
        read_annotation, whole[:at] + struct.pack(">i", 9) + whole[at + 4 :]
    )


def test_damaged_files_give_arrays_or_one_sentence():
    rng = random.Random(0)
    samples = ((surface_in, freesurfer()), (read_values, values()), (read_annotation, annotation()))
    samples += ((read_annotation, annotation(numbered=False)),)
    refusals = 0
    for call, content in samples:
        for _ in range(800):
            damaged = bytearray(content)
            for _ in range(rng.randint(1, 3)):
                damaged[rng.randrange(len(damaged))] = rng.choice([0, 1, 127, 128, 255, rng.randrange(256)])
            cut = rng.choice([len(damaged), rng.randrange(len(damaged))])
            message = message_of(call, bytes(damaged[:cut]), "lh.a")
            assert not message or ("lh.a" in message and "\n" not in message)
            refusals += bool(message)
    assert refusals > 1000
