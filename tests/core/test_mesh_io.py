"""Reading mesh files: every format gives the file's ids, coordinates and faces."""

import itertools
import re

import numpy as np
import pytest

from bihdist_core.formats.field_output import write_fields
from bihdist_core.formats.mesh_io import read_surface
from bihdist_core.formats.mesh_names import ARRAY_FILES, MNI, mesh_format
from bihdist_core.formats.vertex_count import announced_vertices
from bihdist_core.surface import Surface
from tests.core.mesh_samples import (
    FACES,
    QUAD_AND_TRIANGLE,
    SAMPLES,
    SINGLE,
    VERTICES,
    assert_same,
    grid_written_by_vtk,
    obj,
    off,
    off_binary,
    ply,
    stl_binary,
    stl_text,
    written_by_vtk,
)
from tests.shapes import MESHES, needs_meshes


# ---------------------------------------------------------------------- each format gives the same surface
@pytest.mark.parametrize("name", SAMPLES)
def test_ids_coordinates_and_faces_are_the_files(put, name):
    surface = read_surface(put(name, SAMPLES[name]))
    assert_same(surface)
    assert surface.name == name
    assert surface.repairs == ()


@pytest.mark.parametrize("name", [*SAMPLES, *SINGLE])
def test_the_vertices_that_a_file_announces_are_found_without_reading_it(put, name):
    path = put(name, {**SAMPLES, **SINGLE}[name])
    form = mesh_format(path)
    # Neither a header of triangles nor the accessors of a scene tell how many vertices there will be.
    is_told = form not in (".stl", ".gltf", ".glb", *ARRAY_FILES) and (form != ".obj" or path.suffix != ".gz")
    is_told &= form != MNI or path.read_bytes()[:1] != b"p"
    assert announced_vertices(path) == (len(read_surface(path).vertices) if is_told else None)


def test_of_a_file_that_cannot_be_read_no_vertices_are_announced(put, tmp_path):
    assert announced_vertices(tmp_path / "missing.off") is None
    assert announced_vertices(put("bad.ply.gz", b"ply")) is None
    assert announced_vertices(put("empty.off", b"")) is None


@pytest.mark.parametrize("name", SINGLE)
def test_ids_and_faces_are_the_files_where_coordinates_are_single(put, name):
    surface = read_surface(put(name, SINGLE[name]))
    assert_same(surface, VERTICES.astype(np.float32))
    assert (surface.name, surface.repairs, surface.facts) == (name, (), ())


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("with_colour", [False, True])
def test_ply_polygons_of_different_size_and_other_properties(put, form, with_colour):
    surface = read_surface(put("a.ply", ply(form, QUAD_AND_TRIANGLE, with_colour=with_colour)))
    assert_same(surface)
    assert (surface.repairs, surface.facts) == ((), ("1 quad divided into 2 triangles",))
    smaller_first = read_surface(put("b.ply", ply(form, QUAD_AND_TRIANGLE[::-1], with_colour=with_colour)))
    assert_same(smaller_first, faces=FACES[[2, 0, 1]])


@pytest.mark.parametrize("mode", ["ascii", "binary"])
@pytest.mark.parametrize("version", [42, 51])
@pytest.mark.parametrize("polygons", [FACES, QUAD_AND_TRIANGLE], ids=["triangles", "mixed"])
def test_legacy_files_written_by_vtk(tmp_path, mode, version, polygons):
    assert_same(read_surface(written_by_vtk(tmp_path / "a.vtk", polygons, mode, version)))


@pytest.mark.parametrize("mode", ["ascii", "binary", "appended", "appended base64", "big"])
@pytest.mark.parametrize("compressor", ["zlib", "lzma", "lz4", None])
def test_xml_files_written_by_vtk(tmp_path, mode, compressor):
    path = written_by_vtk(tmp_path / "a.vtp", QUAD_AND_TRIANGLE, mode, compressor=compressor)
    assert_same(read_surface(path))


@pytest.mark.parametrize("compressor", ["zlib", "lz4"])
def test_xml_with_many_compressed_blocks(tmp_path, compressor):
    rng = np.random.default_rng(0)
    vertices = rng.normal(size=(20000, 3))
    faces = np.stack([np.arange(19998), np.arange(1, 19999), np.arange(2, 20000)], axis=1)
    path = written_by_vtk(tmp_path / "a.vtp", faces, "binary", vertices=vertices, compressor=compressor)
    assert_same(read_surface(path), vertices, faces)


@pytest.mark.parametrize("content", [stl_text(), stl_binary()], ids=["text", "binary"])
def test_stl_merges_corners_at_one_place(put, content):
    surface = read_surface(put("a.stl", content))
    # Numbered as they first appear: here that is their order in VERTICES.  Binary STL holds single precision.
    assert_same(surface, VERTICES.astype(np.float32) if isinstance(content, bytes) else VERTICES)
    said = "9 triangle corners at 5 places merged into one vertex each, numbered in the order of the file"
    assert (surface.repairs, surface.facts) == ((), (said,))


def test_stl_takes_both_zeros_for_one_place(put):
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.0, 0, 0], [0, -1, 0]])
    assert len(read_surface(put("a.stl", stl_text(vertices, np.array([[0, 1, 2], [3, 4, 1]])))).vertices) == 4


@pytest.mark.parametrize("extension", [".ply", ".vtp"])
def test_written_surfaces_read_back(tmp_path, extension):
    surface = Surface(VERTICES, FACES)
    path = tmp_path / f"a{extension}"
    write_fields(path, surface, {"d": np.arange(5.0)})
    assert_same(read_surface(path))


def test_text_stl_in_capitals(put):
    assert_same(read_surface(put("a.stl", stl_text().upper())))
    assert_same(read_surface(put("b.stl", stl_text().replace("facet", "Facet"))))


def test_binary_stl_with_bytes_behind_it(put):
    surface = read_surface(put("a.stl", stl_binary() + b"written by x"))
    assert_same(surface, VERTICES.astype(np.float32))
    assert surface.facts[1:] == ("12 bytes after the last triangle ignored",)


@pytest.mark.parametrize("version", [42, 51])
def test_grids_of_triangles_and_volumes(tmp_path, version):
    for extension in (".vtk", ".vtu"):
        path = grid_written_by_vtk(tmp_path / f"a{extension}", [[0, 1, 2], [0, 1, 2, 4], [0, 2, 3], [3, 4, 0]], version)
        surface = read_surface(path)
        assert_same(surface)
        assert surface.repairs == ("1 cell other than polygons ignored",)


def test_upper_case_extension(put):
    assert_same(read_surface(put("A.OFF", off())))


# ---------------------------------------------------------------------- OFF
@pytest.mark.parametrize(("header", "extra"), [("COFF", 4), ("COFF", 3), ("NOFF", 3), ("STOFF", 2), ("STCNOFF", 9)])
def test_off_with_normals_colours_and_texture_coordinates(put, header, extra):
    wide = np.hstack([VERTICES, np.full((5, extra), 0.5)])
    assert_same(read_surface(put("a.off", off(wide, header=header))))


@pytest.mark.parametrize("first", ["OFF 5 3 0\n", "OFF5 3 0\n", "# c\n\nOFF # c\n# c\n\n5 3\n", "  OFF\n\t5 3 0 # c\n"])
def test_off_headers(put, first):
    assert_same(read_surface(put("a.off", first + off().split("\n", 2)[2])))


@pytest.mark.parametrize("extra", [3, 4])
@pytest.mark.parametrize("header", ["OFF", "NOFF", "STOFF"])
def test_off_with_colours_that_the_first_line_does_not_announce(put, header, extra):
    wide = np.hstack([VERTICES, np.full((5, {"OFF": 0, "NOFF": 3, "STOFF": 2}[header] + extra), 0.5)])
    surface = read_surface(put("a.off", off(wide, header=header)))
    assert_same(surface)
    said = f"{extra} numbers behind each vertex, a colour that the first line does not announce, ignored"
    assert surface.facts == (said,)


def test_off_on_few_lines(put):
    assert_same(read_surface(put("a.off", "OFF\n5 3 0\n" + " ".join(off().split()[4:]))))
    coloured = off(np.hstack([VERTICES, np.full((5, 3), 0.5)]), header="COFF")
    assert_same(read_surface(put("b.off", "COFF\n5 3 0\n" + "\n".join(coloured.split()[4:]))))


def test_binary_off_of_polygons(put):
    surface = read_surface(put("a.off", off_binary(polygons=QUAD_AND_TRIANGLE)))
    assert_same(surface, VERTICES.astype(np.float32))


def test_ply_of_lists_on_wrapped_lines(put):
    text = ply("ascii", QUAD_AND_TRIANGLE, with_colour=True)
    head, body = text.split(b"end_header\n")
    assert_same(read_surface(put("a.ply", head + b"end_header\n" + b"\n".join(body.split()))))


def test_off_colours_after_faces_comments_and_blank_lines(put):
    text = off().replace("3 0 1 2\n", "3 0 1 2 0.1 0.2 0.3 1\n\n# comment\n").replace("3 0 2 3\n", "3 0 2 3 17 # c\n")
    text = text.replace("1.0 0.0 0.0", "  1.0\t0.0  0 # \xe9")
    assert_same(read_surface(put("a.off", text.encode("latin-1"))))


# ---------------------------------------------------------------------- PLY
LINE_ENDS = ("\n", "\r\n", "\r", "\n\r")


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_headers_of_any_line_ends(put, form):
    """All alike, and mixed; and numbers that begin with the bytes of line ends."""
    lines = [*ply(form).split(b"end_header\n")[0].decode().splitlines(), "end_header"]
    for first in (0.0, 3.0, *np.frombuffer(b"\r\n\r\n\n\r\n\r" + b"\n@\n@\n@\n@" + b"@\n@\n@\n@\r", np.float64)):
        vertices = np.array(VERTICES)
        vertices[0, 0] = first
        body = ply(form, vertices=vertices).split(b"end_header\n", 1)[1]
        for ends in (*([end] * len(lines) for end in LINE_ENDS), *mixed_ends(len(lines))):
            header = "".join(line + end for line, end in zip(lines, ends, strict=True)).encode()
            assert_same(read_surface(put("a.ply", header + body)), vertices)


def mixed_ends(count):
    """Line ends that change at the first, in the middle and at the last line, and in turn."""
    for one, other in itertools.permutations(LINE_ENDS, 2):
        for where in (1, count // 2, count - 1):
            yield [one] * where + [other] * (count - where)
        yield [(one, other)[k % 2] for k in range(count)]


# ---------------------------------------------------------------------- OBJ
def test_obj_texture_and_normal_ids_do_not_split_vertices(put):
    text = obj(polygons=[]) + "vt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\nf 1/2 3/1 4/2\nf 4//1 5//1 1//1\n"
    assert_same(read_surface(put("a.obj", text)))


def test_obj_negative_ids_count_back_from_their_line(put):
    lines = obj(polygons=[]).splitlines(keepends=True)
    text = "".join(lines[:4]) + "f -4 -3 -2\nf -4/-1 -2/-1 -1/-1\n" + lines[4] + "f -2 -1 -5\n"
    assert_same(read_surface(put("a.obj", text)))


def test_obj_continued_lines_colours_weights_and_other_statements(put):
    lines = obj(polygons=[]).splitlines()
    text = f"mtllib x.mtl # c\no thing\n{lines[0]} 1.0\n{lines[1]} 0.1 0.2 0.3\n" + "\n".join(lines[2:])
    text += "\n\ng a b\ns off\nusemtl \xe9\nf 1 \\\n  2 \\\n 3\nf 1 3 4\nl 1 2\nf 4 5 1"
    surface = read_surface(put("a.obj", text.encode("latin-1")))
    assert_same(surface)
    assert surface.repairs == ("1 line or point statement ignored",)


NAMES = ("mtllib C:\\models\\", "usemtl a\\", "o C:\\", "g a b\\", "# C:\\models\\", "usemap \\", "x y\\")


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("names", [*NAMES, "\n".join(NAMES)])
def test_obj_paths_that_end_in_a_backslash(put, names, end):
    for text in (f"{names}\n{obj()}", obj(polygons=[]) + f"{names}\n" + obj(VERTICES[:0]), obj() + names):
        assert_same(read_surface(put("a.obj", text.replace("\n", end))))


def test_obj_counts_lines_it_does_not_know(put):
    surface = read_surface(put("a.obj", "// made by x\n" + obj() + "tag crease 2 1\nxyz\n"))
    assert_same(surface)
    assert surface.facts == ("3 lines of unknown statements ignored, the first: '// made by x'",)


@pytest.mark.parametrize("end", ["", " ", "\r", " # c"])
def test_obj_may_end_without_a_line_end(put, end):
    assert_same(read_surface(put("a.obj", obj()[:-1] + end)))
    slashes = obj(polygons=[]) + "f 1/1/1 2/2/1 3/1/1\nf 1/2 3/1 4/2\nf -2//1 -1//1 -5//1"
    assert_same(read_surface(put("b.obj", slashes + end)))


def test_obj_vertices_and_normals_in_turn(put):
    text = "".join(f"{line}\nvn 0 0 1\n" for line in obj(polygons=[]).splitlines()) + obj(VERTICES[:0])
    assert_same(read_surface(put("a.obj", text)))


# ---------------------------------------------------------------------- sample meshes
@needs_meshes
def test_sample_meshes_have_the_counts_of_their_table():
    listed = re.findall(r"^\| (\S+\.o\w\w) \| (\d+) \| (\d+) \|", (MESHES / "TABLE.md").read_text(), re.MULTILINE)
    assert len(listed) == 20
    for name, vertices, faces in listed:
        surface = read_surface(MESHES / name)
        # The table counts the face that repeats another.
        assert (len(surface.vertices), len(surface.faces)) == (int(vertices), int(faces) - (name == "suzanne.obj")), (
            name
        )
        if name == "suzanne.obj":
            assert surface.facts == ("468 quads divided into 936 triangles",)
            assert surface.repairs == ("1 face that repeated another dropped",)
        assert surface.unreferenced_count == (1113 if name == "bunny_raw.obj" else 0)
