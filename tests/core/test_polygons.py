"""Polygons of a file become triangles that cover each of them once."""

import numpy as np
import pytest

from bihdist_core.formats.mesh_io import read_surface
from tests.core.mesh_samples import FACES, VERTICES, assert_same, off, ply, rows


def area(surface):
    x = surface.vertices[surface.faces]
    return np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])[:, 2] / 2


COMB = [(0, 0), (6, 0), (6, 3), (5, 1), (4, 3), (3, 1), (2, 3), (1, 1), (0, 3)]


@pytest.mark.parametrize(
    ("outline", "expected"),
    [
        ([(0, 0), (2, 0), (2, 2), (0, 2)], 4.0),
        ([(2, 0), (0, 1), (1, 0), (0, -1)], 1.0),
        ([(0, 1), (1, 0), (0, -1), (2, 0)], 1.0),
        ([(0, -1), (1, 0), (0, 1), (2, 0)], -1.0),
        ([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)], 4.0),
        (COMB, 12.0),
        (COMB[::-1], -12.0),
        (COMB[4:] + COMB[:4], 12.0),
    ],
    ids=[
        "square",
        "dart",
        "dart from a tip",
        "dart turned",
        "corner in line",
        "comb",
        "comb turned",
        "comb from a tooth",
    ],
)
def test_a_simple_polygon_is_covered_once(put, outline, expected):
    flat = np.column_stack([np.array(outline, float), np.zeros(len(outline))])
    surface = read_surface(put("a.off", off(flat, [range(len(outline))])))
    assert len(surface.faces) == len(outline) - 2
    assert area(surface).sum() == pytest.approx(expected, rel=1e-12)
    assert (area(surface) * np.sign(expected) > 0).all()
    # Tilted in space, the same division.
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    tilted = read_surface(put("b.off", off(flat @ turn.T, [range(len(outline))])))
    lengths = np.linalg.norm(np.cross(*np.moveaxis(np.diff(tilted.vertices[tilted.faces], axis=1), 1, 0)), axis=1) / 2
    assert lengths.sum() == pytest.approx(abs(expected), rel=1e-12)


def test_a_polygon_that_cannot_be_divided_stays_a_fan(put):
    star = [(np.cos(4 * np.pi * k / 7), np.sin(4 * np.pi * k / 7), 0.0) for k in range(7)]
    assert len(read_surface(put("a.off", off(np.array(star), [range(7)]))).faces) == 5
    in_line = np.column_stack([np.arange(7.0), np.zeros(7), np.zeros(7)])
    assert len(read_surface(put("b.off", off(in_line, [range(7)]))).faces) == 5


def test_an_enormous_concave_polygon_does_not_hang(put):
    angle = np.linspace(0, 2 * np.pi, 3000, endpoint=False)
    radius = 1 + 0.5 * (np.arange(3000) % 2)
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle])
    assert len(read_surface(put("a.off", off(ring, [range(3000)]))).faces) == 2998


def test_polygons_keep_their_order(put):
    surface = read_surface(put("a.off", off(polygons=[[3, 4, 0], [0, 1, 2, 3], [4, 1, 0]])))
    np.testing.assert_array_equal(surface.faces, [[3, 4, 0], [0, 1, 2], [0, 2, 3], [4, 1, 0]])


def test_faces_with_too_few_corners_are_ignored_in_words(put):
    surface = read_surface(put("a.off", off(polygons=[[0, 1], *FACES, [2], []])))
    assert_same(surface)
    assert surface.repairs == ("3 faces with fewer than 3 corners ignored",)


def test_vtk_strips_lines_and_grids(put):
    head = f"# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n{rows(VERTICES)}"
    surface = read_surface(put("a.vtk", head + "LINES 1 3\n2 0 1\nTRIANGLE_STRIPS 1 6\n5 1 2 0 3 4\n"))
    np.testing.assert_array_equal(surface.faces, [[1, 2, 0], [2, 3, 0], [0, 3, 4]])
    assert surface.facts == ("1 triangle strip divided into 3 triangles",)
    assert surface.repairs == ("1 cell other than polygons ignored",)
    grid = (
        head.replace("POLYDATA", "UNSTRUCTURED_GRID") + "CELLS 3 12\n4 0 1 3 2\n3 3 4 0\n2 0 1\nCELL_TYPES 3\n8 5 3\n"
    )
    assert_same(read_surface(put("b.vtk", grid)))


def test_ply_strips(put):
    text = ply("ascii", polygons=[]).decode().replace("element face 0", "element tristrips 1")
    surface = read_surface(put("a.ply", text + "8 1 2 0 3 -1 3 4 0\n"))
    np.testing.assert_array_equal(surface.faces, [[1, 2, 0], [2, 3, 0], [3, 4, 0]])
