"""Isolines: exact positions, whole curves, and what happens where the field is exactly their value."""

import csv
import json
import re
import time
from collections import defaultdict
from itertools import combinations, pairwise

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, OutputError, ParameterError, Surface, isolines, write_isolines
from bihdist_core.analysis.chains import chains
from tests.shapes import bumpy, fin, grid, sphere, torus


def on_their_edges(surface, lines):
    for line in lines:
        a, b = surface.vertices[line.edges[:, 0]], surface.vertices[line.edges[:, 1]]
        t = line.parameters[:, None]
        np.testing.assert_array_equal(line.points, (1 - t) * a + t * b)
        assert ((t >= 0) & (t <= 1)).all()
        pairs = {tuple(sorted(e)) for e in surface.edges.tolist()}
        assert all(tuple(sorted(e)) in pairs for e in line.edges.tolist())


def test_a_linear_field_on_a_flat_domain_gives_straight_lines():
    s = grid(7, 4)
    lines = isolines(s, s.vertices[:, 0], [0.5, 2.25, 6.9])
    assert [line.value for line in lines] == [0.5, 2.25, 6.9]
    for line in lines:
        assert not line.closed
        assert line.points[:, 0] == pytest.approx(line.value, abs=1e-15)
        steps = np.diff(line.points[:, 1])
        assert (steps > 0).all() or (steps < 0).all()
        assert line.length == pytest.approx(4)
        assert line.along(s.vertices[:, 1]) == pytest.approx(line.points[:, 1])
    on_their_edges(s, lines)


def test_circles_of_latitude_on_a_sphere():
    s = sphere(2000)
    values = [-0.5, 0.0, 0.7]
    lines = isolines(s, s.vertices[:, 2], values)
    assert [line.value for line in lines] == values
    for line in lines:
        assert line.closed
        # Chords of a polyhedron are shorter than the circle, by about the square of an edge length (0.04).
        assert line.length == pytest.approx(2 * np.pi * np.sqrt(1 - line.value**2), rel=0.005)
    on_their_edges(s, lines)


def test_every_face_that_is_crossed_gives_one_segment():
    s = torus(40, 20)
    field = BiharmonicDistance(s).from_source(5)
    levels = np.linspace(0, field.max(), 12)[1:-1]
    lines = isolines(s, field, levels)
    for level in levels:
        mine = [line for line in lines if line.value == level]
        corner = field[s.faces]
        crossed = ((corner < level).any(axis=1) & (corner >= level).any(axis=1)).sum()
        assert sum(len(line.points) for line in mine) == crossed
        assert all(line.closed for line in mine)
        for line in mine:
            assert line.along(field) == pytest.approx(level)


def test_consecutive_points_share_a_face_and_no_edge_is_used_twice():
    s = bumpy(400)
    field = BiharmonicDistance(s).from_source(5)
    faces = {frozenset(f) for f in s.faces.tolist()}
    for line in isolines(s, field, np.linspace(0, field.max(), 9)[1:-1]):
        assert len({frozenset(e) for e in line.edges.tolist()}) == len(line.edges)
        edges = [*line.edges.tolist(), line.edges[0].tolist()] if line.closed else line.edges.tolist()
        for one, two in pairwise(edges):
            assert frozenset(one + two) in faces


def test_values_met_exactly_at_vertices():
    s = grid(6, 6)
    # Through whole rows of vertices: one straight line, each vertex once.
    (line,) = isolines(s, s.vertices[:, 0], [3])
    assert line.points[:, 0].tolist() == [3] * 7
    assert sorted(line.points[:, 1].tolist()) == list(range(7))
    # Only the top of a cone: a single point has no curve.
    cone = np.maximum(0, 2 - np.abs(s.vertices[:, :2] - 3).max(axis=1))
    assert isolines(s, cone, [2]) == []
    assert isolines(s, s.vertices[:, 0] + s.vertices[:, 1], [12]) == []  # the same in a corner of the boundary


def test_along_edges_at_the_value_there_is_each_piece_once():
    s = grid(6, 6)
    for field in (np.abs(s.vertices[:, 0] - 3), -np.abs(s.vertices[:, 0] - 3), s.vertices[:, 0] - 3):  # valley, ridge
        (line,) = isolines(s, field, [0])
        assert (line.points[:, 0] == 3).all()
        assert line.length == 6
        on_their_edges(s, [line])
    for level in (0, 6):  # along the boundary, from above and from below
        (line,) = isolines(s, s.vertices[:, 0], [level])
        assert line.length == 6
    # Three pages of a fin meet in a valley.
    (line,) = isolines(fin(), np.abs(fin().vertices[:, :2]).max(axis=1), [0])
    assert line.length == 1


def test_each_row_of_vertices_is_one_line_and_a_constant_patch_one_closed_outline():
    """The values x of a grid of 11 by 11 vertices, all at once."""
    s = grid(10, 10)
    lines = isolines(s, s.vertices[:, 0], range(11))
    assert [(line.value, line.closed, line.length, len(line.points)) for line in lines] == [
        (x, False, 10, 11) for x in range(11)
    ]
    patch = np.clip(np.abs(s.vertices[:, :2] - 5).max(axis=1), 2, 4)
    inner, outer = isolines(s, patch, [2, 3.5])
    assert inner.closed
    assert outer.closed
    assert inner.length == 16
    # That of the outer plateau is the border of the grid, and inside a square of which two corners are cut off.
    plateau = isolines(s, patch, [4])
    assert all(line.closed for line in plateau)
    assert [line.length for line in plateau] == pytest.approx([40, 28 + 2 * np.sqrt(2)])


def test_what_is_flat_at_the_value_has_its_outline_once():
    s = grid(6, 6)
    cone = np.maximum(0, 2 - np.abs(s.vertices[:, :2] - 3).max(axis=1))
    for sign in (1, -1):  # a plateau and a hollow
        (line,) = isolines(s, sign * np.minimum(cone, 1), [sign])
        assert line.closed
        assert line.length == 8
    lines = isolines(s, cone, [0])  # its foot, a ring out to the boundary, with two corners cut off inside
    assert all(line.closed for line in lines)
    assert sorted(line.length for line in lines) == pytest.approx([12 + 2 * np.sqrt(2), 24])
    assert [line.length for line in isolines(s, np.ones(49), [1])] == [24]
    assert isolines(bumpy(100), np.ones(100), [1]) == []  # no outline
    # A saddle at a vertex, two of whose faces are 0 all over.
    x, y = s.vertices[:, 0] - 3, s.vertices[:, 1] - 3
    assert sum(line.length for line in isolines(s, x * y, [0])) == pytest.approx(12 + 2 * np.sqrt(2))


@pytest.mark.parametrize("surface", [grid(9, 7), bumpy(300), torus(), fin()], ids=lambda s: s.name)
@pytest.mark.parametrize("seed", range(4))
def test_pieces_are_those_found_face_by_face(surface, seed):
    """Of whole numbers, so that many vertices and whole faces have the value."""
    field = np.random.default_rng(seed).integers(-1, 2, len(surface.vertices))
    pieces, flat = {}, defaultdict(list)
    for face in surface.faces.tolist():
        ends = {(a,): surface.vertices[a] for a in face if field[a] == 0}
        for a, b in combinations(sorted(face), 2):
            if field[a] * field[b] < 0:
                ends[a, b] = (surface.vertices[a] + surface.vertices[b]) / 2
            if field[a] == field[b] == 0:
                flat[a, b].append(len(ends) == 3 and not field[face].any())
        if len(ends) == 2:
            pieces[frozenset(ends)] = tuple(ends.values())
    for (a, b), inside in flat.items():
        pieces.pop(key := frozenset([(a,), (b,)]), None)
        if len(inside) == 1 or not all(inside):
            pieces[key] = surface.vertices[a], surface.vertices[b]
    lines = isolines(surface, field, [0])
    on_their_edges(surface, lines)
    found = [
        frozenset([tuple(p), tuple(q)])
        for line in lines
        for p, q in pairwise(np.concatenate([line.points, line.points[: line.closed]]).tolist())
    ]
    assert len(found) == len(set(found)) == len(pieces) > 1
    assert set(found) == {frozenset([tuple(p.tolist()), tuple(q.tolist())]) for p, q in pieces.values()}


def test_faces_without_a_value_are_left_out():
    s = grid(6, 6)
    field = s.vertices[:, 0].copy()
    field[24] = np.nan  # the middle vertex, (3, 3)
    lines = isolines(s, field, [2.5])
    assert len(lines) == 2
    # Of its six faces, three lie at x = 2.5, each with half a unit of the line.
    assert sum(line.length for line in lines) == pytest.approx(6 - 1.5)
    assert isolines(s, np.full(49, np.nan), [1]) == []
    field[24] = np.inf
    assert len(isolines(s, field, [2.5])) == 2


def test_curves_end_at_edges_of_more_than_two_faces():
    s = fin()
    lines = isolines(s, s.vertices[:, 2], [0.25])
    # The edge 0-1 has three faces: three curves meet there.
    assert len(lines) == 3
    ends = [tuple(p) for line in lines for p in (line.points[0].tolist(), line.points[-1].tolist())]
    assert ends.count((0, 0, 0.25)) == 3


def test_extreme_values_do_not_overflow():
    s = grid(2, 2)
    field = np.where(s.vertices[:, 0] > 1, 1.5e308, -1.5e308)
    (line,) = isolines(s, field, [0.0])
    assert line.points[:, 0] == pytest.approx(1.5)


def test_100_000_vertices_and_20_values_are_quick():
    s = grid(315, 315)
    field = np.hypot(s.vertices[:, 0] - 100, s.vertices[:, 1] - 120)
    start = time.process_time()
    lines = isolines(s, field, np.linspace(0, field.max(), 22)[1:-1])
    assert time.process_time() - start < 1.5
    assert len({line.value for line in lines}) == 20


@pytest.mark.parametrize(
    ("field", "values", "words"),
    [
        (np.zeros(3), [1], r"each of 49 vertices, not an array of shape \(3,\)"),
        (np.zeros(49), [np.nan], "finite"),
        (np.zeros(49), [[1]], "finite"),
    ],
)
def test_refused(field, values, words):
    with pytest.raises(ParameterError, match=words):
        isolines(grid(6, 6), field, values)


@pytest.fixture
def lines():
    s = grid(6, 6)
    cone = np.hypot(s.vertices[:, 0] - 3, s.vertices[:, 1] - 3)
    found = isolines(s, cone, [1.7, 3.3])
    assert {line.closed for line in found} == {True, False}
    return found


def test_csv_reads_back_exactly(lines, tmp_path):
    write_isolines(tmp_path / "a.csv", lines)
    with (tmp_path / "a.csv").open() as file:
        rows = list(csv.DictReader(file))
    for k, line in enumerate(lines):
        mine = [row for row in rows if int(row["line"]) == k]
        assert [[float(row[c]) for c in "xyz"] for row in mine] == line.points.tolist()
        assert {float(row["value"]) for row in mine} == {line.value}
        assert {row["closed"] for row in mine} == {str(int(line.closed))}


def test_obj_has_a_line_element_for_each_curve(lines, tmp_path):
    write_isolines(tmp_path / "a.obj", lines)
    text = (tmp_path / "a.obj").read_text()
    points = [list(map(float, row.split())) for row in re.findall("^v (.*)$", text, re.M)]
    elements = [list(map(int, row.split())) for row in re.findall("^l (.*)$", text, re.M)]
    assert len(elements) == len(lines)
    for line, element in zip(lines, elements, strict=True):
        assert (element[0] == element[-1]) == line.closed
        ids = element[:-1] if line.closed else element
        assert [points[i - 1] for i in ids] == line.points.tolist()


def test_vtp_is_read_by_vtk(lines, tmp_path):
    io = pytest.importorskip("vtkmodules.vtkIOXML", reason="VTK is not installed")
    write_isolines(tmp_path / "a.vtp", lines)
    reader = io.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    data = reader.GetOutput()
    assert data.GetNumberOfLines() == len(lines)
    values = data.GetCellData().GetArray("value")
    for k, line in enumerate(lines):
        assert values.GetValue(k) == line.value
        cell = data.GetCell(k)
        assert cell.GetNumberOfPoints() == len(line.points) + line.closed
        assert list(cell.GetPoints().GetPoint(1)) == line.points[1].tolist()


def test_json_has_the_edges_too(lines, tmp_path):
    write_isolines(tmp_path / "a.json", lines)
    curves = json.loads((tmp_path / "a.json").read_text())["isolines"]
    assert len(curves) == len(lines)
    for line, curve in zip(lines, curves, strict=True):
        assert (curve["value"], curve["closed"]) == (line.value, line.closed)
        assert curve["points"] == line.points.tolist()
        assert curve["edges"] == line.edges.tolist()
        assert curve["parameters"] == line.parameters.tolist()


def test_no_curves_are_a_file_too(tmp_path):
    for name in ("a.csv", "a.obj", "a.vtp", "a.json"):
        write_isolines(tmp_path / name, [])
        assert (tmp_path / name).exists()


def test_other_extensions_are_refused(lines, tmp_path):
    with pytest.raises(OutputError, match=r"can be written as \.csv, \.obj, \.vtp"):
        write_isolines(tmp_path / "a.svg", lines)


def test_unreferenced_vertices_play_no_part():
    s = grid(3, 3)
    other = Surface(np.concatenate([s.vertices, [[9, 9, 9]]]), s.faces)
    (line,) = isolines(other, np.append(s.vertices[:, 0], -5.0), [1.5])
    assert line.length == pytest.approx(3)


def test_chains_use_each_edge_once():
    edges = np.array([[0, 1], [2, 1], [2, 3], [5, 6], [6, 7], [7, 5], [8, 1]])
    found = chains(edges)
    pairs = []
    for chain, closed in found:
        ring = [*chain.tolist(), *([int(chain[0])] if closed else [])]
        pairs += [tuple(sorted(pair)) for pair in pairwise(ring)]
    assert sorted(pairs) == sorted(tuple(sorted(edge)) for edge in edges.tolist())
    assert sorted(closed for _, closed in found) == [False, False, False, True]


def test_two_segments_between_the_same_ends_are_no_loop():
    ((chain, closed),) = chains(np.array([[4, 9], [9, 4]]))
    assert (chain.tolist(), closed) == ([4, 9], False)
