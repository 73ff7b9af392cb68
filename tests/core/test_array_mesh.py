"""Meshes in files of arrays: the structs and variables of shape matching, .npz, and what is refused."""

import gzip
import io
import random
import struct
import zlib

import numpy as np
import pytest
from scipy.io import loadmat, savemat

from bihdist_core.errors import MeshError
from bihdist_core.formats.mat_file import mat_variables
from bihdist_core.formats.mesh_io import read_surface, surface_in
from tests.core.damage import damaged
from tests.core.mesh_samples import FACES, VERTICES, assert_same, mat, message_of, npz

NAMES = [("X", "Y", "Z", "TRIV"), ("VERT", "TRIV"), ("vertices", "faces")]


def saved(**variables):
    file = io.BytesIO()
    savemat(file, variables)
    return file.getvalue()


def refused(content, name):
    with pytest.raises(MeshError) as caught:
        surface_in(content, name)
    message = str(caught.value)
    assert message.startswith(name)
    assert message.endswith(".")
    assert "\n" not in message
    return message


@pytest.mark.parametrize("names", NAMES, ids="-".join)
@pytest.mark.parametrize("struct", ["surface", "M", ""])
@pytest.mark.parametrize("packed", [True, False])
def test_structs_and_variables_of_matlab(put, names, struct, packed):
    content = mat(names=names, struct=struct, packed=packed)
    assert_same(read_surface(put("cat0.mat", content)))
    assert_same(read_surface(put("CAT0.MAT.GZ", gzip.compress(content))))


def test_other_variables_rows_and_types_do_not_matter(put):
    x, y, z = VERTICES.T
    surface = {"X": x[None], "Y": y[:, None], "Z": z.astype("f4"), "TRIV": (FACES + 1).astype("u2"), "I": [[1, 2]]}
    whole = {"shape": {"surface": surface, "name": "cat"}, "words": "text", "list": np.array([1, "a"], object)}
    assert_same(read_surface(put("a.mat", saved(**whole, X=[1, 2]))))
    quads = saved(VERT=VERTICES[:4], TRIV=[[1, 2, 3, 4]])
    assert read_surface(put("b.mat", quads)).facts == ("1 quad divided into 2 triangles",)


def element(order, kind, content):
    """Small ones as they are."""
    if len(content) <= 4:
        tag = len(content) << 16 | kind
        return struct.pack(f"{order}I", tag) + content.ljust(4, b"\0")
    return struct.pack(f"{order}2I", kind, len(content)) + content.ljust(-(-len(content) // 8) * 8, b"\0")


def matrix(order, name, kind, shape, *parts):
    head = element(order, 6, struct.pack(f"{order}2I", kind, 0)) + element(order, 5, struct.pack(f"{order}2i", *shape))
    return element(order, 14, head + element(order, 1, name.encode()) + b"".join(parts))


def by_hand(order="<", code="i2"):
    """TOSCA's struct, with columns of doubles that are stored as they are, and triangles as smaller numbers."""
    fields = [
        matrix(order, "", 6, (5, 1), element(order, 9, column.astype(f"{order}f8").tobytes())) for column in VERTICES.T
    ]
    triangles = element(
        order, {"i2": 3, "u1": 2, "f4": 7, "i4": 5}[code], (FACES + 1).T.astype(f"{order}{code}").tobytes()
    )
    fields.append(matrix(order, "", 6, (3, 3), triangles))
    names = b"".join(name.ljust(8, b"\0") for name in (b"X", b"Y", b"Z", b"TRIV"))
    size = element(order, 5, struct.pack(f"{order}i", 8))
    body = matrix(order, "surface", 2, (1, 1), size, element(order, 1, names), *fields)
    mark = struct.pack(f"{order}H", 0x0100) + (b"IM" if order == "<" else b"MI")
    return b"MATLAB 5.0 MAT-file".ljust(124) + mark + body


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("code", ["i2", "u1", "f4", "i4"])
def test_both_orders_of_bytes_and_smaller_numbers(put, order, code):
    content = by_hand(order, code)
    assert_same(read_surface(put("a.mat", content)))
    found = loadmat(io.BytesIO(content))["surface"][0, 0]
    np.testing.assert_array_equal(found["TRIV"], FACES + 1)


def test_variables_are_those_of_scipy():
    rng = np.random.default_rng(0)
    kinds = ("f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8")
    variables = {
        f"v_{kind}_{k}": rng.integers(0, 99, rng.integers(0, 5, k)).astype(kind) for kind in kinds for k in (2, 3)
    }
    variables |= {"one": 7.5, "text": "abc", "z": np.array([1j]), "truth": np.array([[True, False]])}
    for packed in (True, False):
        file = io.BytesIO()
        savemat(file, variables | {"s": {"a": variables, "b": 1}}, do_compression=packed)
        found, expected = mat_variables(file.getvalue(), "a.mat"), loadmat(file)
        assert list(found) == [*variables, "s"]
        for each in (found, found["s"]["a"]):
            assert each["text"] is each["z"] is None
            for name in variables.keys() - {"text", "z"}:
                np.testing.assert_array_equal(each[name], expected[name])
                assert each[name].dtype == (expected[name].dtype if name != "truth" else np.uint8)


def test_damaged_files_give_variables_or_one_sentence():
    rng = random.Random(0)
    for content in (mat(), mat(packed=False), by_hand(), by_hand(">")):
        for _ in range(1500):
            damaged_content = damaged(content, rng)
            message = message_of(mat_variables, damaged_content, "a.mat")
            assert not message or (message.startswith("a.mat") and "\n" not in message)


@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
def test_archives_of_numpy(put, save):
    assert_same(read_surface(put("a.npz", npz(save=save, thickness=VERTICES[:, 0], words=np.array(["a"])))))
    single = npz(VERTICES.astype("f4"), FACES.astype("u1"), save)
    assert_same(read_surface(put("b.npz.gz", gzip.compress(single))), VERTICES.astype("f4"))


def huge():
    """A variable that announces to unfold to 4 GiB."""
    packed = zlib.compress(struct.pack("<2I", 14, 2**32 - 1) + bytes(99))
    return mat()[:128] + struct.pack("<2I", 15, len(packed)) + packed


HDF = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512) + b"\x89HDF\r\n\x1a\n" + bytes(100)
REFUSED = {
    "7.3": ("a.mat", HDF, "is a MAT file of version 7.3 (HDF5), which is not read; save it with -v7"),
    "HDF5": ("a.mat", bytes(512) + HDF[512:], "is a MAT file of version 7.3"),
    "no MAT file": ("a.mat", b"TRIV" * 99, "is not a MAT file of version 5"),
    "no mesh": ("a.mat", saved(f=[1], g=[2]), "no mesh, which is X, Y, Z and TRIV, VERT and TRIV, or vertices and"),
    "its variables": ("a.mat", saved(f=[1], g=[2]), "(its variables are f and g)"),
    "version 4": ("a.mat", bytes(200), "is not a MAT file of version 5"),
    "cut off": ("a.mat", mat(packed=False)[:-20], "is cut off or damaged: a variable ends after its file"),
    "packed, cut off": ("a.mat", mat()[:-20], "is cut off or damaged"),
    "huge": ("a.mat", huge(), "is cut off or damaged: a variable ends after its file"),
    "count": (
        "a.mat",
        by_hand().replace(b"\5\0\0\0\1\0\0\0", b"\6\0\0\0\1\0\0\0"),
        "announces 6 numbers of 'a field' and",
    ),
    "several": (
        "a.mat",
        saved(a={"VERT": VERTICES, "TRIV": FACES + 1}, b={"VERT": VERTICES, "TRIV": FACES + 1}),
        "has several meshes, in a and b",
    ),
    "ids from 0": ("a.mat", saved(VERT=VERTICES, TRIV=FACES), "face 1 names vertex 0, but ids run from 1 to 5"),
    "ids beyond": ("a.mat", saved(VERT=VERTICES, TRIV=FACES + 2), "face 3 names vertex 6, but ids run from 1 to 5"),
    "fraction": ("a.mat", saved(VERT=VERTICES, TRIV=FACES + 1.5), "face 1 names vertex 1.5"),
    "lengths": ("a.mat", saved(X=[1, 2], Y=[1], Z=[1, 2], TRIV=FACES), "has 2, 1 and 2 numbers of X, Y and Z"),
    "shape": ("a.mat", saved(VERT=VERTICES.T, TRIV=FACES + 1), "its vertices have the shape (3, 5), not three numbers"),
    "faces": ("a.mat", saved(VERT=VERTICES, TRIV=FACES[:, :2]), "its faces have the shape (3, 2)"),
    "text": ("a.mat", saved(VERT=VERTICES, TRIV="abc"), "the arrays of its mesh are not real numbers"),
    "complex": ("a.mat", saved(VERT=VERTICES * 1j, TRIV=FACES + 1), "the arrays of its mesh are not real numbers"),
    "no archive": ("a.npz", b"vertices, faces", "is not an archive of arrays"),
    "archive without": ("a.npz", npz().replace(b"faces.npy", b"facet.npy"), "no mesh, which is vertices and faces"),
    "archive cut off": ("a.npz", npz()[:-9], "is not an archive of arrays"),
    "archive ids": ("a.npz", npz(faces=FACES + 1), "face 2 names vertex 5, but ids run from 0 to 4"),
    "archive shape": ("a.npz", npz(faces=np.arange(3)), "its faces have the shape (3,)"),
    "archive objects": ("a.npz", npz(faces=np.array([None])), "'faces' cannot be read: it does not hold plain numbers"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals_say_where_and_why(case):
    name, content, expected = REFUSED[case]
    assert expected in refused(content, name)
