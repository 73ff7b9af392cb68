"""GIFTI files: as nibabel writes them, and what is refused."""

import base64
import tracemalloc
import zlib

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, Surface, read_vertex_values
from bihdist_core.errors import MeshError
from bihdist_core.formats.mesh_io import mesh_content, read_surface, surface_in
from tests.core.mesh_samples import (
    FACES,
    VERTICES,
    assert_same,
    freesurfer,
    gifti,
    gifti_array,
    gifti_surface,
    off,
    ply,
    written_by_vtk,
)


def refused(content):
    with pytest.raises(MeshError) as caught:
        surface_in(content if isinstance(content, bytes) else content.encode(), "a.surf.gii")
    message = str(caught.value)
    assert message.startswith("a.surf.gii")
    assert message.endswith(".")
    assert "\n" not in message
    return message


@pytest.mark.parametrize("encoding", ["ASCII", "Base64Binary", "GZipBase64Binary"])
@pytest.mark.parametrize("order", "<>")
def test_surfaces_in_all_encodings(encoding, order):
    assert_same(surface_in(gifti_surface(encoding=encoding, order=order), "a.surf.gii"))


@pytest.mark.parametrize("encoding", ["GIFTI_ENCODING_ASCII", "GIFTI_ENCODING_B64BIN", "GIFTI_ENCODING_B64GZ"])
def test_surfaces_written_by_nibabel(encoding):
    nibabel = pytest.importorskip("nibabel")
    points = nibabel.gifti.GiftiDataArray(VERTICES.astype("f4"), intent="NIFTI_INTENT_POINTSET", encoding=encoding)
    # What stands beside the coordinates moves them to a scanner, and is not applied.
    points.coordsys.xform = np.diag([2.0, 2, 2, 1])
    triangles = nibabel.gifti.GiftiDataArray(FACES.astype("i4"), intent="NIFTI_INTENT_TRIANGLE", encoding=encoding)
    content = nibabel.gifti.GiftiImage(darrays=[points, triangles]).to_bytes()
    surface = surface_in(content, "a.surf.gii")
    np.testing.assert_allclose(surface.vertices, VERTICES, rtol=1e-6)
    np.testing.assert_array_equal(surface.faces, FACES)


def test_arrays_by_columns():
    by_columns = gifti_array("POINTSET", VERTICES.T.copy()).replace("RowMajor", "ColumnMajor")
    by_columns = by_columns.replace('Dim0="3" Dim1="5"', 'Dim0="5" Dim1="3"')
    assert_same(surface_in(gifti(by_columns, gifti_array("TRIANGLE", FACES.astype("i4"))), "a.gii"))


def test_compressed_by_gzip():
    stream = zlib.compressobj(wbits=31)
    packed = base64.b64encode(stream.compress(VERTICES.tobytes()) + stream.flush()).decode()
    plain = base64.b64encode(zlib.compress(VERTICES.tobytes())).decode()
    assert_same(surface_in(gifti_surface().replace(plain.encode(), packed.encode()), "a.gii"))


POINTS, TRIANGLES = gifti_array("POINTSET", VERTICES), gifti_array("TRIANGLE", FACES.astype("i4"))
WHOLE = gifti(POINTS, TRIANGLES).decode()
REFUSED = {
    "cut off": (WHOLE[:-30], "is not a GIFTI file, or is cut off or damaged"),
    "other XML": ("<html/>", "its root element is 'html', not 'GIFTI'"),
    "entity": ("<!DOCTYPE GIFTI [<!ENTITY a 'b'>]><GIFTI/>", "declares XML entities"),
    "count": (WHOLE.replace('Arrays="2"', 'Arrays="3"'), "announces 3 arrays and holds 2"),
    "no surface": (gifti(gifti_array("SHAPE", VERTICES[:, 0])), "0 arrays of points"),
    "two surfaces": (gifti(POINTS, POINTS, TRIANGLES), "has 2 arrays of points; a surface needs one"),
    "shape": (gifti(gifti_array("POINTSET", VERTICES[:, :2]), TRIANGLES), "have the shape (5, 2), not three numbers"),
    "index": (gifti(POINTS, gifti_array("TRIANGLE", np.array([[0, 1, 5]], "i4"))), "triangle 0 names vertex 5"),
    "type": (WHOLE.replace("FLOAT64", "COMPLEX64"), "array 0 is of the type 'NIFTI_TYPE_COMPLEX64'"),
    "encoding": (WHOLE.replace("GZipBase64Binary", "Base32"), "array 0 is encoded as 'Base32'"),
    "external": (
        WHOLE.replace("GZipBase64Binary", "ExternalFileBinary"),
        "keeps its numbers in another file, which is read only where this one is not compressed",
    ),
    "endian": (WHOLE.replace("LittleEndian", "Middle"), "byte order 'Middle'"),
    "dimensions": (WHOLE.replace('Dimensionality="2"', 'Dimensionality="0"'), "has '0' dimensions"),
    "dimension": (WHOLE.replace('Dim0="5"', 'Dim0="-5"'), "Dim0 is '-5', not a count"),
    "huge": (WHOLE.replace('Dim0="5"', 'Dim0="999999999999"'), "announces 2,999,999,999,997 numbers, more than"),
    "more": (WHOLE.replace('Dim0="5"', 'Dim0="6"'), "announces 18 numbers and holds 15"),
    "fewer": (WHOLE.replace('Dim0="5"', 'Dim0="4"'), "holds more than the 96 bytes that it announces"),
    "half a number": (
        gifti_surface(encoding="Base64Binary").replace(b"AAAAAAAA</Data>", b"AAAAAA==</Data>"),
        "not a whole number",
    ),
    "damaged": (WHOLE.replace("<Data>eJ", "<Data>AA"), "array 0 is damaged"),
    "no base64": (WHOLE.replace("<Data>", "<Data>*"), "array 0 is damaged"),
    "word": (gifti_surface(encoding="ASCII").replace(b"0.25", b"half"), "array 0: 'half' stands among the numbers"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals_say_where_and_why(case):
    content, expected = REFUSED[case]
    assert expected in refused(content)


def test_compressed_data_that_do_not_end():
    packed = base64.b64encode(zlib.compress(VERTICES.tobytes())).decode()
    cut = base64.b64encode(zlib.compress(VERTICES.tobytes())[:-6]).decode()
    assert "array 0 is cut off: its compressed data do not end" in refused(WHOLE.replace(packed, cut))


def test_a_small_array_cannot_fill_the_memory():
    packed = base64.b64encode(zlib.compress(VERTICES.tobytes())).decode()
    bomb = base64.b64encode(zlib.compress(bytes(100_000_000))).decode()
    tracemalloc.start()
    message = refused(WHOLE.replace(packed, bomb))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert "holds more than the 120 bytes" in message
    assert peak < 10_000_000


# ---------------------------------------------------------------------- numbers in a file beside it
def external(folder, order="<", name="a.dat", begin=(0, 120), intents=("POINTSET", "TRIANGLE")):
    """A GIFTI file whose arrays are in a file beside it, from some bytes on; the path."""
    arrays, content = [], bytearray()
    for intent, array, at in zip(intents, (VERTICES, FACES.astype("i4")), begin, strict=True):
        arrays.append(
            gifti_array(intent, array, "ExternalFileBinary", order)
            .replace(
                'ExternalFileName="" ExternalFileOffset=""', f'ExternalFileName="{name}" ExternalFileOffset="{at}"'
            )
            .replace("<Data>", "<Data/><!--")
            .replace("</Data>", "-->")
        )
        content[len(content) : at] = bytes(max(0, at - len(content)))
        content[at:at] = array.astype(array.dtype.newbyteorder(order)).tobytes()
    (folder / "a.surf.gii").write_bytes(gifti(*arrays))
    (folder / "a.dat").write_bytes(content)
    return folder / "a.surf.gii"


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("begin", [(0, 120), (7, 333)])
def test_numbers_beside_the_file_are_read_and_part_of_its_content(tmp_path, order, begin):
    path = external(tmp_path, order, begin=begin)
    assert_same(read_surface(path))
    before = mesh_content(path)
    nibabel = pytest.importorskip("nibabel")
    np.testing.assert_array_equal(nibabel.load(path).darrays[0].data, VERTICES)
    content = bytearray((tmp_path / "a.dat").read_bytes())
    content[begin[0]] ^= 1
    (tmp_path / "a.dat").write_bytes(content)
    assert mesh_content(path) != before


def test_values_beside_the_file_are_read(tmp_path):
    path = external(tmp_path, intents=("SHAPE", "POINTSET"))
    (tmp_path / "a.shape.gii").write_bytes(path.read_bytes().replace(b'Dim0="5" Dim1="3"', b'Dim0="15" Dim1="1"'))
    np.testing.assert_array_equal(read_vertex_values(tmp_path / "a.shape.gii"), VERTICES.ravel())


@pytest.mark.parametrize(
    ("name", "begin", "expected"),
    [
        ("../a.dat", (0, 120), "array 0: its file is '../a.dat'; only a file in the folder of the .gii is read"),
        ("/etc/passwd", (0, 120), "only a file in the folder of the .gii is read"),
        ("", (0, 120), "array 0: its file is ''; only a file in the folder of the .gii is read"),
        ("gone.dat", (0, 120), "array 0: its file, 'gone.dat' beside it, cannot be read: No such file or directory"),
        ("folder", (0, 120), "array 0: its file, 'folder', is not a regular file"),
        ("a.dat", (0, 124), "array 1 announces 9 numbers and holds 8"),
        ("a.dat", (0, 10**9), "array 1 announces 9 numbers and holds 0"),
        ("a.dat", (-1, 120), "array 0 begins at '-1' of its file, which is not a number of bytes"),
        ("a.dat", ("x", 120), "array 0 begins at 'x' of its file"),
    ],
)
def test_other_places_are_not_read(tmp_path, name, begin, expected):
    (tmp_path / "folder").mkdir()
    path = external(tmp_path)
    text = path.read_text().replace('Name="a.dat"', f'Name="{name}"')
    for old, new in zip((0, 120), begin, strict=True):
        text = text.replace(f'Offset="{old}"', f'Offset="{new}"')
    path.write_text(text)
    (tmp_path / "a.dat").write_bytes((tmp_path / "a.dat").read_bytes()[:156])
    with pytest.raises(MeshError, match=r"a\.surf\.gii: array [01]") as caught:
        read_surface(path)
    assert expected in str(caught.value)


def test_no_more_is_read_of_a_file_beside_it_than_is_announced(tmp_path, monkeypatch):
    path = external(tmp_path)
    with (tmp_path / "a.dat").open("ab") as file:
        file.truncate(1 << 30)
    tracemalloc.start()
    assert_same(read_surface(path))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10_000_000
    monkeypatch.setattr("bihdist_core.formats.gifti.MOST_BYTES", 1000)
    with pytest.raises(MeshError, match=r"its file, 'a\.dat', has more than"):
        read_surface(path)


# ---------------------------------------------------------------------- vertices without coordinates
def test_vertices_of_no_face_may_be_without_coordinates(tmp_path, put):
    vertices = np.vstack([[np.nan] * 3, VERTICES, [[np.nan, 0, 0], [np.nan] * 3]])
    faces = FACES + 1
    files = {
        "a.surf.gii": gifti_surface(vertices, faces),
        "a.off": off(vertices, faces),
        "a.ply": ply("binary_big_endian", faces, vertices),
        "lh.white": freesurfer(vertices, faces),
        "a.vtp": written_by_vtk(tmp_path / "b.vtp", faces, vertices=vertices).read_bytes(),
    }
    said = "3 vertices of no face and without coordinates (NaN) put in the place of vertex 1"
    for surface in (Surface(vertices, faces), *(read_surface(put(name, content)) for name, content in files.items())):
        np.testing.assert_array_equal(
            surface.vertices[1:6], VERTICES.astype("f4" if surface.name == "lh.white" else "f8")
        )
        np.testing.assert_array_equal(surface.vertices[[0, 6, 7]], [VERTICES[0]] * 3)
        assert surface.facts == (said,)
        field = BiharmonicDistance(surface).from_source(2)
        assert np.isnan(field).tolist() == [True, *[False] * 5, True, True]
    for wrong in ([np.nan] * 3, [np.inf, 0, 0]):
        vertices[3 if np.isnan(wrong[0]) else 0] = wrong
        with pytest.raises(MeshError, match=f"vertex {3 if np.isnan(wrong[0]) else 0} has the coordinates"):
            Surface(vertices, faces)
        vertices[3] = VERTICES[2]
