"""What is to be known of a surface: facts, repairs and warnings, counted apart."""

import numpy as np

from bihdist_core import Surface, read_surface
from bihdist_core.analysis.surface_notes import SurfaceNotes, surface_notes
from tests.shapes import bumpy

CORNERS = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
QUADS = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def off(vertices, faces) -> str:
    lines = [" ".join(map(str, row)) for row in vertices] + [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *lines]) + "\n"


def test_a_closed_mesh_of_triangles_has_none():
    assert surface_notes(bumpy(200)) == SurfaceNotes()


def test_a_cube_of_quads_needs_no_repair(tmp_path):
    path = tmp_path / "cube.off"
    path.write_text(off(CORNERS, QUADS))
    assert surface_notes(read_surface(path)) == SurfaceNotes(facts=("6 quads divided into 12 triangles",))


def test_what_was_dropped_is_a_repair_and_what_is_odd_a_warning(tmp_path):
    # Two pieces: three faces at one edge, a face twice, a face without area, and vertices of no face.
    walls = [[0, 1, 2], [0, 2, 3], [0, 1, 5], [0, 5, 4], [0, 1, 6]]
    away = [[a + 8, b + 8, c + 8] for a, b, c in [[0, 1, 2], [0, 2, 3]]]
    flat = [[8, 16, 9]]
    vertices = np.concatenate([CORNERS, CORNERS + 5, [[5.5, 5, 5], [9, 9, 9]]])
    path = tmp_path / "odd.off"
    path.write_text(off(vertices, [*walls, *away, *flat, [2, 1, 0]]))
    notes = surface_notes(read_surface(path))
    assert notes.repairs == ("1 face that repeated another dropped",)
    assert [sentence.split(" ")[0] for sentence in notes.facts] == ["2", "6"]
    edges, flats, parts = notes.warnings
    assert edges == "1 edge with more than two faces"
    assert flats.startswith("1 face of (nearly) no area")
    assert parts.startswith("2 components, with no distance")


def test_a_vertex_between_two_fans_is_a_warning():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    notes = surface_notes(Surface(vertices, [[0, 1, 2], [0, 3, 4]]))
    assert notes.warnings == ("1 vertex where faces touch in a point",)
