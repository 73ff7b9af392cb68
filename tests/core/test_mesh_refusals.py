"""Every failure to read a mesh is one sentence that names the file, the place and the value."""

import gzip
import os
import random
import re
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats import compression
from bihdist_core.formats.field_output import write_fields
from bihdist_core.formats.mesh_io import read_surface
from bihdist_core.formats.mesh_names import MESH_FORMATS
from bihdist_core.surface import Surface
from tests.core.damage import damaged
from tests.core.mesh_samples import (
    FACES,
    QUAD_AND_TRIANGLE,
    VERTICES,
    assert_same,
    obj,
    off,
    off_binary,
    ply,
    samples_of_all_formats,
    stl_binary,
    stl_text,
    vtk_old,
    written_by_vtk,
)


def refused(path):
    """The message with which a file is refused; it is one sentence naming the file."""
    with pytest.raises(MeshError) as caught:
        read_surface(path)
    message = str(caught.value)
    assert Path(path).name in message
    assert message.endswith(".")
    assert "\n" not in message
    return message


def outcome(path):
    """None if the file is read, else the message."""
    try:
        read_surface(path)
    except MeshError as error:
        return str(error)
    return None


def test_a_missing_file_a_folder_and_an_empty_file(tmp_path, put):
    assert refused(tmp_path / "no.off") == f"There is no file {tmp_path / 'no.off'}."
    (tmp_path / "x.off").mkdir()
    assert refused(tmp_path / "x.off") == f"{tmp_path / 'x.off'} is a folder, not a mesh file."
    for extension in MESH_FORMATS:
        assert "is empty" in refused(put(f"a{extension}", ""))


def test_an_unknown_extension_lists_the_known_ones(put):
    assert "'.step'" in (message := refused(put("a.step", "x")))
    assert all(extension in message for extension in MESH_FORMATS)
    assert refused(put("mesh", "x")).startswith("mesh has no extension; ")
    assert refused(put("part.3MF", "PK")).startswith("part.3MF is a 3MF file, which is not read; save it as PLY first")
    assert refused(put("a.laz", "LASF")) == (
        "a.laz is a LAZ file, which is not read; save it as PLY first, in CloudCompare or another."
    )


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.off")
    assert "not a regular file" in refused(tmp_path / "pipe.off")


def test_an_unreadable_file(put, monkeypatch):
    path = put("a.off", off())

    def denied(_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", denied)
    assert "permission denied" in refused(path)


@pytest.mark.parametrize("extension", MESH_FORMATS)
@pytest.mark.parametrize(
    "content",
    [
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x01\0" + bytes(range(256)),
        random.Random(0).randbytes(5000),
        b"hello world\nthis is no mesh\n",
        b"\xff\xfeO\0F\0F\0\n\0",
        b"\n\n\n",
    ],
    ids=["PNG", "noise", "prose", "UTF-16", "blank"],
)
def test_files_of_another_kind(put, extension, content):
    refused(put(f"a{extension}", content))


def vtk_new(offsets, word):
    """A triangle with offsets as files of version 5 have them."""
    return (
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
        f"POLYGONS 2 3\nOFFSETS vtktypeint64\n{offsets}\n{word} vtktypeint64\n0 1 2\n"
    )


def xml(corners, form="ascii", points=3):
    """A VTP file with a triangle, with its corners as text."""
    places = "<Points><DataArray type='Int8'>0 0 0 1 0 0 0 1 0</DataArray></Points>" if points == 3 else ""
    return (
        f"<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='{points}' NumberOfPolys='1'>{places}<Polys>"
        f"<DataArray Name='connectivity' type='Int32' format='{form}'>{corners}</DataArray>"
        "<DataArray Name='offsets' type='Int8'>3</DataArray></Polys></Piece></PolyData></VTKFile>"
    )


TETRAHEDRON = (
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
    "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
)
REFUSED = {
    "first line": ("a.off", "PLY\n1 1 0\n", "its first line is 'PLY' where OFF belongs"),
    "binary OFF": ("a.off", b"OFF BINARY\n\0\0", "the counts after its first line are []"),
    "binary OFF counts": ("a.off", off_binary()[:11] + b"\xff" * 4 + off_binary()[15:], "are [-1, 3, 0]"),
    "binary OFF cut off": ("a.off", off_binary()[:-4], "face 2 does not fit into the file"),
    "binary OFF cut off early": ("a.off", off_binary()[:40], "announces 5 vertices and 3 faces but has room for"),
    "binary OFF longer": ("a.off", off_binary() + b"1234", "goes on for 4 bytes after its last face"),
    "binary OFF index": ("a.off", off_binary(polygons=[[0, 1, 5]]), "face 0 names vertex 5"),
    "binary OFF of four": ("a.off", off_binary(header="4OFF"), "other than three coordinates"),
    "OFF row cut off": ("a.off", off().replace(" ", "\n").replace("5\n3\n0", "5 3 0")[:-2], "its counts are wrong"),
    "OFF row word": ("a.off", off().replace("1.0 1.0", "1.0\nx"), "one a line, but 9 lines follow"),
    "OFF row index": ("a.off", off().replace("3 3 4 0", "3 3\n5 0"), "one a line, but 9 lines follow"),
    "four coordinates": ("a.off", off(header="4OFF"), "other than three coordinates"),
    "header only": ("a.off", "OFF\n", "ends after its first line"),
    "no counts": ("a.off", "OFF\nfive 3 0\n", "line 2: 'five 3 0' is not the numbers of vertices"),
    "OFF cut off": ("a.off", off()[:-12], "announces 5 vertices and 3 faces, one a line, but 7 lines follow"),
    "OFF count low": ("a.off", off().replace("5 3 0", "5 2 0"), "but 8 lines follow: its counts are wrong"),
    "OFF count huge": ("a.off", off().replace("5 3 0", "5000000000000 3 0"), "announces 5,000,000,000,000 vertices"),
    "OFF word": ("a.off", off().replace("0.25", "0,25"), "line 5: '0,25' is not a number"),
    "OFF coordinates": ("a.off", off().replace(" 0.25", ""), "line 5: vertex 2 has 2 numbers where 3 belong"),
    "OFF index": (
        "a.off",
        off().replace("3 3 4 0", "3 3 5 0"),
        "line 10: face 2 names vertex 5, but ids run from 0 to 4",
    ),
    "OFF fraction": ("a.off", off().replace("3 3 4 0", "3 3 1.5 0"), "names vertex 1.5"),
    "OFF size": (
        "a.off",
        off().replace("3 3 4 0", "4 3 4 0"),
        "line 10: face 2 announces 4 corners and 3 numbers follow",
    ),
    "OFF nan": ("a.off", off().replace("0.25", "nan"), "vertex 2 has the coordinates (1, 1, nan)"),
    "OBJ inf": ("a.obj", obj().replace("0.25", "-inf"), "vertex 2 has the coordinates (1, 1, -inf)"),
    "OBJ overflow": ("a.obj", obj().replace("0.25", "1e999"), "vertex 2 has the coordinates (1, 1, inf)"),
    "OBJ word": ("a.obj", obj().replace("0.25", "1-2"), "line 3: '1-2' is not a number"),
    "OBJ corner": ("a.obj", obj().replace("f 1 2 3", "f 1/1 /2 3"), "line 6: '/2' is not a corner"),
    "OBJ corner 2": ("a.obj", obj().replace("f 1 2 3", "f 1/x 2 3"), "line 6: '1/x' is not a corner"),
    "OBJ index": (
        "a.obj",
        obj().replace("f 1 2 3", "f 1 2 6"),
        "line 6: the face names vertex 6, but vertices are numbered 1 to 5",
    ),
    "OBJ zero": ("a.obj", obj().replace("f 1 2 3", "f 0 1 2"), "line 6: the face names vertex 0"),
    "OBJ back": ("a.obj", obj().replace("f 1 2 3", "f -6 1 2"), "line 6: the face names vertex -6"),
    "OBJ statement": (
        "a.obj",
        obj().replace("v 1.0 1.0", "w 1.0 1.0"),
        "line 3: 'w 1.0 1.0 0.25' is not an OBJ statement",
    ),
    "OBJ coordinates": ("a.obj", obj().replace(" 0.25", ""), "line 3: vertex 3 has 2 numbers"),
    "OBJ no vertices": ("a.obj", "g a\n", "has no vertices"),
    "OBJ statement of corners": ("a.obj", obj() + "x 1/1 2/2 3/3\n", "line 9: 'x 1/1 2/2 3/3' is not an OBJ"),
    "OBJ statement without a blank": ("a.obj", obj() + "v1.0\n", "line 9: 'v1.0' is not an OBJ statement"),
    "OBJ cut off": ("a.obj", obj()[:-3], "is cut off: its last line, which does not end, is the face 'f 4 5'"),
    "OBJ cut off at once": ("a.obj", obj() + "f", "does not end, is the face 'f'"),
    "OBJ cut off in a corner": ("a.obj", obj() + "f 1/1 2/2 3/", "does not end, is the face 'f 1/1 2/2 3/'"),
    "OBJ cut off in a normal": ("a.obj", obj() + "f 1//1 2//2 3", "does not end, is the face 'f 1//1 2//2 3'"),
    "OBJ no faces": (
        "a.obj",
        obj(polygons=[]),
        "has 5 vertices but no faces; points without faces are read from .ply, .xyz",
    ),
    "OBJ degenerate": ("a.obj", obj(polygons=[[0, 1]]), "has no faces"),
    "zero byte": ("a.obj", obj() + "\0", "is not a text file"),
    "PLY no header end": ("a.ply", ply("ascii").replace(b"end_header", b"end"), "its header has no line 'end_header'"),
    "PLY header line": ("a.ply", ply("ascii").replace(b"double y", b"number y"), "line 6: 'property number y'"),
    "PLY no format": ("a.ply", ply("ascii").replace(b"format", b"comment"), "does not say in its header"),
    "PLY twice": ("a.ply", ply("ascii").replace(b"element face", b"element vertex"), "vertex is announced twice"),
    "PLY no z": ("a.ply", ply("ascii").replace(b"double z", b"double w"), "has no vertex property z"),
    "PLY no faces": ("a.ply", ply("ascii").replace(b"vertex_indices", b"other"), "no list vertex_indices"),
    "PLY text cut off": (
        "a.ply",
        ply("ascii")[:-9],
        "announces 5 of vertex and 3 of face, one a line, but 7 lines follow",
    ),
    "PLY text line": ("a.ply", ply("ascii").replace(b"3 3 4 0", b"3 3 4"), "the line of face 2 does not hold"),
    "PLY wrapped, no vertices": (
        "a.ply",
        ply("ascii").replace(b"vertex 5", b"vertex 0").replace(b"1.0 1.0", b"1.0\n1.0"),
        "announces 0 of vertex",
    ),
    "PLY text longer": ("a.ply", ply("ascii").replace(b"3 3 4 0", b"3 3 4 0 1"), "the line of face 2 does not hold"),
    "PLY list": ("a.ply", ply("ascii").replace(b"3 3 4 0", b"-3 3 4 0"), "face 2 announces a list of -3 entries"),
    "PLY index": ("a.ply", ply("binary_big_endian", [[0, 1, 5]]), "face 0 names vertex 5, but ids run from 0 to 4"),
    "PLY cut off": ("a.ply", ply("binary_little_endian")[:-1], "announces 3 of face but holds at most 2"),
    "PLY mixed cut off": (
        "a.ply",
        ply("binary_little_endian", QUAD_AND_TRIANGLE)[:-1],
        "announces 2 of face but holds at most 1",
    ),
    "PLY vertices": ("a.ply", ply("binary_little_endian", [])[:-1], "announces 5 of vertex but holds at most 4"),
    "PLY longer": ("a.ply", ply("binary_little_endian") + b"abc", "goes on for 3 bytes"),
    "PLY huge": ("a.ply", ply("binary_little_endian").replace(b"face 3", b"face 99999999999999"), "holds at most"),
    "STL cut off": ("a.stl", stl_binary()[:-3], "announces 3 triangles but has room for 2.94"),
    "STL count": ("a.stl", stl_binary(announced=2**32 - 1), "announces 4,294,967,295 triangles"),
    "STL short": ("a.stl", b"ab", "fewer than an STL header"),
    "STL text cut off": ("a.stl", stl_text()[:-16], "is cut off: its last line is 'endfacet'"),
    "STL order": (
        "a.stl",
        stl_text().replace("endloop", "vertex 1 1 1", 1),
        "line 7: 'vertex 1 1 1' stands where 'endloop'",
    ),
    "STL coordinates": ("a.stl", stl_text().replace(" 0.25", "", 1), "line 6: the vertex has 2 coordinates, not 3"),
    "STL nan": ("a.stl", stl_text().replace("0.25", "nan"), "triangle 0 has a corner at (1, 1, nan)"),
    "STL signal": (
        "a.stl",
        stl_binary()[:96] + b"\1\0\x80\x7f" + stl_binary()[100:],
        "triangle 0 has a corner at (nan",
    ),
    "STL no faces": ("a.stl", stl_binary(faces=FACES[:0]), "holds 0 triangles"),
    "STL no faces in a text": ("a.stl", "solid\nendsolid\n", "holds 0 triangles"),
    "STL triangles behind": ("a.stl", stl_binary(announced=2), "announces 2 triangles but has room for 3"),
    "STL bytes behind nothing": ("a.stl", stl_binary(faces=FACES[:0]) + b"x", "announces 0 triangles but has room for"),
    "one place": ("a.off", off(np.ones((5, 3))), "all corners of its faces are at (1, 1, 1)"),
    "STL in one place": ("a.stl", stl_text(np.ones((5, 3))), "every face names a vertex twice"),
    "too large": ("a.off", off().replace("1.5", "-1e160"), "vertex 4 has the coordinate -1e+160; beyond 1e+50"),
    "too small": ("a.off", off(VERTICES * 1e-80), "measures 1.5e-80; below 1e-50 areas have no numbers"),
    "gzip cut off": ("a.off.gz", gzip.compress(off().encode())[:-9], "is cut off: its gzip data do not end"),
    "gzip damaged": ("a.off.gz", gzip.compress(off().encode())[:-8] + bytes(8), "is damaged (CRC check failed"),
    "no gzip": ("a.off.gz", off(), "is not a gzip file, or is damaged"),
    "gzip of nothing": ("a.off.gz", gzip.compress(b""), "is empty"),
    "VTK volumes": (
        "a.vtk",
        TETRAHEDRON.replace("TYPES 1\n10", "TYPES 1\n14"),
        "holds only volume cells (1), no tetrahedra; extract the surface first",
    ),
    "VTK dataset": ("a.vtk", vtk_old().replace(b"POLYDATA", b"STRUCTURED_POINTS"), "so extract the surface first"),
    "VTK types": ("a.vtk", TETRAHEDRON.replace("TYPES 1\n10", "TYPES 2\n10 10"), "1 cells and 2 types of cells"),
    "VTK points": (
        "a.vtk",
        vtk_old(binary=True).replace(b"POINTS 5", b"POINTS 99999999999"),
        "299,999,999,997 numbers of POINTS",
    ),
    "VTK cut off": ("a.vtk", vtk_old(binary=True)[:-30], "numbers of POLYGONS"),
    "VTK no points": ("a.vtk", vtk_old().split(b"POINTS")[0], "has no POINTS"),
    "VTK count": ("a.vtk", vtk_old().replace(b"POLYGONS 3", b"POLYGONS 2"), "2 POLYGONS do not fill the 12 numbers"),
    "VTK cell": ("a.vtk", vtk_old().replace(b"3 0 1 2 ", b"9 0 1 2 ", 1), "cell 1 of POLYGONS"),
    "VTK type": ("a.vtk", vtk_old().replace(b"double", b"string"), "type 'string'"),
    "VTK section": ("a.vtk", vtk_old().replace(b"POLYGONS", b"POLYGON"), "'POLYGON 3 12' is not a section"),
    "VTK lacks count": ("a.vtk", vtk_old().replace(b"POLYGONS 3", b"POLYGONS -3"), "lacks a count"),
    "VTK no types": ("a.vtk", TETRAHEDRON.split("CELL_TYPES")[0], "it has CELLS but no CELL_TYPES"),
    "VTK offsets": ("a.vtk", vtk_new("0 2", "CONNECTIVITY"), "the offsets of the cells do not fit their 3 corners"),
    "VTK no corners": ("a.vtk", vtk_new("0 3", "OTHER"), "POLYGONS have OFFSETS but no CONNECTIVITY"),
    "VTK index": ("a.vtk", vtk_old(polygons=[[0, 1, 7]]), "polygon 0 names vertex 7"),
    "VTK word": ("a.vtk", vtk_old().replace(b"0.25", b"half"), "'half' stands among the POINTS"),
    "XML": ("a.vtp", "<VTKFile type='PolyData'>", "cut off or damaged"),
    "XML root": ("a.vtp", "<html></html>", "its root element is 'html'"),
    "XML empty": ("a.vtp", "<VTKFile type='PolyData'/>", "holds no piece of PolyData"),
    "XML no points": ("a.vtp", xml("", points=5), "announces 5 points but holds none"),
    "XML index": ("a.vtp", xml("0 1 5"), "a cell of Polys names point 5, but ids run from 0 to 2"),
    "XML half a number": (
        "a.vtp",
        xml("AwAAAAAAAA==", "binary"),
        "have 3 bytes, not a multiple of 4",
    ),
    "XML short": ("a.vtp", xml("AwA=", "binary"), "are shorter than announced"),
    "XML no types": (
        "a.vtu",
        "<VTKFile><UnstructuredGrid><Piece NumberOfPoints='0' NumberOfCells='1'><Cells>"
        "<DataArray Name='offsets' type='Int8'>0</DataArray><DataArray Name='connectivity' type='Int8'/>"
        "</Cells></Piece></UnstructuredGrid></VTKFile>",
        "announces 1 cells but lacks their types",
    ),
    "XML entity": ("a.vtp", "<!DOCTYPE x [<!ENTITY a 'b'>]><VTKFile/>", "declares XML entities"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals_say_where_and_why(put, case):
    name, content, expected = REFUSED[case]
    assert expected in refused(put(name, content))


def test_a_small_gzip_file_cannot_fill_the_memory(put, monkeypatch):
    monkeypatch.setattr(compression, "MOST_BYTES", 1 << 25)
    path = put("a.off.gz", gzip.compress(bytes(100_000_000)))
    tracemalloc.start()
    assert "unpacks to more than 0.03125 GiB; it is not read" in refused(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 80_000_000


def test_obj_continued_lines_keep_line_numbers(put):
    assert "line 9:" in refused(put("a.obj", obj(polygons=[]) + "f 1 \\\n 2 \\\n 3\nf 1 2 six\n"))


XML_REFUSED = [
    (b'NumberOfPoints="5"', b'NumberOfPoints="6"', "announces 18 numbers of points but holds 15"),
    (b'NumberOfPolys="3"', b'NumberOfPolys="2"', "announces 2 numbers of Polys offsets but holds 3"),
    (b'NumberOfPolys="3"', b'NumberOfPolys="many"', "NumberOfPolys is 'many', not a count"),
    (b'"connectivity"', b'"other"', "lacks their connectivity or offsets"),
    (b"</AppendedData>", b"", "its appended data do not end"),
    (b'type="Float64"', b'type="String"', "the type 'String'"),
    (b'format="appended"', b'format="other"', "the format 'other'"),
    (b'offset="0"', b'offset="99999"', "shorter than announced"),
    (b'header_type="UInt64"', b'header_type="UInt64" compressor="vtkOtherCompressor"', "save it with zlib"),
]


@pytest.mark.parametrize(("old", "new", "expected"), XML_REFUSED)
def test_xml_refusals(tmp_path, put, old, new, expected):
    path = tmp_path / "a.vtp"
    write_fields(path, Surface(VERTICES, FACES), {"d": np.zeros(5)})
    content = re.sub(b"<PointData>.*</PointData>", b"", path.read_bytes(), flags=re.DOTALL)
    content = content.replace(b'offset="48"', b'offset="0"')
    shift = content.index(b"\n_") + 2
    content = content[:shift] + content[shift + 48 :]
    for k, place in enumerate((176, 256)):
        content = content.replace(b'offset="%d"' % place, b'offset="%d"' % (128, 208)[k])
    assert_same(read_surface(put("good.vtp", content)))
    assert old in content
    assert expected in refused(put("a.vtp", content.replace(old, new)))


def test_damaged_compressed_xml(tmp_path, put):
    content = written_by_vtk(tmp_path / "a.vtp", mode="appended").read_bytes()
    start = content.index(b"_", content.index(b"AppendedData"))
    for k in range(start + 33, start + 60, 5):
        damaged = content[:k] + bytes([content[k] ^ 255]) + content[k + 1 :]
        assert outcome(put("b.vtp", damaged)) is None or "b.vtp" in outcome(tmp_path / "b.vtp")


# ---------------------------------------------------------------------- damage
def test_damaged_files_give_a_surface_or_one_sentence(tmp_path, put, capfd):
    rng = random.Random(20)
    refusals = 0
    for name, content in samples_of_all_formats(tmp_path).items():
        for _ in range(60):
            message = outcome(put(name, damaged(content, rng)))
            assert message is None or name in message
            refusals += message is not None
    assert refusals > 100
    assert capfd.readouterr() == ("", "")
