"""GIFTI files: as nibabel writes them, and what is refused."""

import base64
import tracemalloc
import zlib

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats.mesh_io import surface_in
from tests.core.mesh_samples import FACES, VERTICES, assert_same, gifti, gifti_array, gifti_surface


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
    "external": (WHOLE.replace("GZipBase64Binary", "ExternalFileBinary"), "keeps its numbers in another file"),
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
