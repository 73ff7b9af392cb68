"""MNI objects, as CIVET writes surfaces: text and binary, of all kinds of colours, and what is refused."""

import random
import struct

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats.mesh_io import read_surface, surface_in
from bihdist_core.formats.mesh_names import MNI, mesh_format
from bihdist_core.formats.vertex_count import announced_vertices
from tests.core.mesh_samples import QUAD_AND_TRIANGLE, VERTICES, assert_same, message_of, mni


def refused(content):
    with pytest.raises(MeshError) as caught:
        surface_in(content if isinstance(content, bytes) else content.encode(), "a.obj")
    message = str(caught.value)
    assert message.startswith("a.obj")
    assert message.endswith(".")
    assert "\n" not in message
    return message


@pytest.mark.parametrize("colours", [0, 1, 2])
def test_polygons_of_text(put, colours):
    text = mni(polygons=QUAD_AND_TRIANGLE, colours=colours)
    for content in (text, text[:-1], "\n" + text, text.replace("\n", "\r\n"), " ".join(text.split())):
        path = put("a.obj", content)
        surface = read_surface(path)
        assert_same(surface)
        assert surface.facts == ("1 quad divided into 2 triangles",)
        assert (mesh_format(path), announced_vertices(path)) == (MNI, 5)


@pytest.mark.parametrize("colours", [0, 1, 2])
@pytest.mark.parametrize("colour_size", [4, 8, 12, 16])
@pytest.mark.parametrize("order", "<>")
def test_polygons_of_binary_files(put, order, colours, colour_size):
    path = put("a.obj", mni(colours=colours, order=order, colour_size=colour_size))
    assert_same(read_surface(path), VERTICES.astype(np.float32))
    assert (mesh_format(path), announced_vertices(path)) == (MNI, None)


def test_wavefront_files_of_points_and_lines_are_none(put):
    for start in ("p 1 2\n", "l 1 2\n", "# P 1\n", "f 1 2 3\n"):
        assert mesh_format(put("a.obj", start)) == ".obj"


TEXT, BINARY = mni(), mni(order=">")
REFUSED = {
    "lines": ("L 0.1 5\n", "is an MNI object of lines, not of polygons"),
    "binary lines": (b"l\0\0\0\0", "is an MNI object of lines, not of polygons"),
    "quads": (TEXT.replace("P", "Q"), "is an MNI object of a grid of quads"),
    "P alone": ("P ", "announces 1 numbers and holds 0"),
    "cut off": (TEXT[:-3], "announces 9 corners and holds 8; it is cut off"),
    "points": (TEXT.replace("10 1 5", "10 1 9999"), "announces 29,997 coordinates and holds"),
    "fraction": (TEXT.replace("10 1 5", "10 1 5.5"), "the number of points is 5.5"),
    "colours": (TEXT.replace(" 0 1 1", " 7 1 1"), "colours are of kind 7"),
    "ends": (TEXT.replace("3 6 9", "3 2 9"), "polygon 1 ends before it begins"),
    "longer": (TEXT + "P 1", "'P' stands among the numbers of polygons"),
    "numbers behind": (TEXT + "1 2", "has 2 numbers after its polygons"),
    "index": (TEXT.replace("3 4 0\n", "3 5 0\n"), "polygon 2 names vertex 5, but ids run from 0 to 4"),
    "word": (TEXT.replace("0.25", "1/4"), "'1/4' stands among"),
    "binary cut off": (BINARY[:-4], "is a binary MNI object of polygons, and is cut off or damaged"),
    "half a number": (BINARY[:-1], "is a binary MNI object of polygons, and is cut off or damaged"),
    "binary index": (BINARY[:-4] + struct.pack(">i", 5), "is cut off or damaged"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals_say_where_and_why(case):
    content, expected = REFUSED[case]
    assert expected in refused(content)


def test_damaged_binary_files_give_a_surface_or_one_sentence():
    rng = random.Random(0)
    for _ in range(2000):
        damaged = bytearray(mni(order=rng.choice("<>"), colours=rng.randrange(3)))
        for _ in range(rng.randint(1, 3)):
            damaged[rng.randrange(1, len(damaged))] = rng.choice([0, 1, 127, 128, 255, rng.randrange(256)])
        message = message_of(
            surface_in, bytes(damaged[: rng.choice([len(damaged), rng.randrange(len(damaged))])]), "a.obj"
        )
        assert not message or ("a.obj" in message and "\n" not in message)
