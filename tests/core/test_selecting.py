"""What a brush touches, what is cut out, and the files that hold it."""

import numpy as np
import pytest

from bihdist_core import (
    Brush,
    OutputError,
    ParameterError,
    Surface,
    VertexError,
    cut_out,
    read_surface,
    write_selection,
)
from bihdist_core.analysis.selecting import is_ids_file, read_ids, write_ids
from tests.shapes import bumpy


def sheets(apart):
    """Two flat sheets of 11 x 11 vertices, one above the other."""
    i, j = np.divmod(np.arange(121), 11)
    flat = np.stack([i / 10, j / 10, np.zeros(121)], 1)
    corner = (np.arange(10)[:, None] * 11 + np.arange(10)).ravel()
    faces = np.concatenate([corner[:, None] + [0, 11, 12], corner[:, None] + [0, 12, 1]])
    return Surface(np.concatenate([flat, flat + np.array([0, 0, apart])]), np.concatenate([faces, faces + 121]))


def test_a_brush_has_what_is_near_on_its_own_sheet():
    surface = sheets(0.05)
    brush = Brush(surface)
    face = 44
    place = surface.vertices[surface.faces[face]].mean(axis=0)
    near = brush.near(face, place, 0.3)
    apart = np.linalg.norm(surface.vertices - place, axis=1)
    assert near.tolist() == np.flatnonzero((apart <= 0.3) & (np.arange(242) < 121)).tolist()
    assert (apart[121:] <= 0.3).any()


def test_a_brush_smaller_than_a_face_has_the_nearest_corner():
    surface = sheets(1.0)
    corners = surface.faces[7]
    place = surface.vertices[corners].T @ [0.2, 0.7, 0.1]
    assert Brush(surface).near(7, place, 1e-6).tolist() == [corners[1]]
    for radius, at in ((0, place), (np.nan, place), (1, place[:2]), (1, place * np.nan)):
        with pytest.raises(ParameterError, match="radius above 0"):
            Brush(surface).near(7, at, radius)


def test_cut_out_are_the_faces_with_all_corners_chosen():
    surface = bumpy(400)
    chosen = np.flatnonzero(surface.vertices[:, 2] > 0)
    part, of = cut_out(surface, chosen)
    inside = np.isin(surface.faces, chosen).all(axis=1)
    assert np.array_equal(of[part.faces], surface.faces[inside])
    assert np.array_equal(part.vertices, surface.vertices[of])
    with pytest.raises(ParameterError, match="No face"):
        cut_out(surface, [3])


def test_selections_are_written_in_each_way(tmp_path):
    surface = bumpy(400)
    chosen = np.flatnonzero(surface.vertices[:, 0] > 0)
    for name in ("a.txt", "a.npy", "a.csv"):
        write_selection(tmp_path / name, surface, chosen)
    assert np.loadtxt(tmp_path / "a.txt", dtype=int).tolist() == chosen.tolist()
    assert np.load(tmp_path / "a.npy").tolist() == chosen.tolist()
    assert np.loadtxt(tmp_path / "a.csv", dtype=int, skiprows=1).tolist() == chosen.tolist()
    write_selection(tmp_path / "b.npy", surface, chosen, "field")
    assert np.flatnonzero(np.load(tmp_path / "b.npy")).tolist() == chosen.tolist()
    write_selection(tmp_path / "c.ply", surface, chosen, "mesh")
    read, (part, _) = read_surface(tmp_path / "c.ply"), cut_out(surface, chosen)
    assert np.array_equal(read.vertices, part.vertices)
    assert np.array_equal(read.faces, part.faces)


def test_what_cannot_be_written_leaves_no_file(tmp_path):
    surface = bumpy(400)
    with pytest.raises(OutputError, match=r"\.txt"):
        write_selection(tmp_path / "a.docx", surface, [1])
    with pytest.raises(ParameterError, match="written as"):
        write_selection(tmp_path / "a.txt", surface, [1], "picture")
    with pytest.raises(VertexError):
        write_selection(tmp_path / "a.txt", surface, [4000])
    with pytest.raises(ParameterError, match="No face"):
        write_selection(tmp_path / "a.ply", surface, [1], "mesh")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("extension", [".txt", ".npy", ".csv"])
def test_ids_are_read_as_they_were_written(extension, tmp_path):
    path = tmp_path / f"ids{extension}"
    write_ids(path, [7, 3, 11])
    assert is_ids_file(str(path))
    assert read_ids(path).tolist() == [7, 3, 11]


def test_what_holds_no_ids_is_refused(tmp_path):
    (tmp_path / "words.txt").write_text("3\near\n")
    (tmp_path / "none.csv").write_text("vertex\n")
    (tmp_path / "less.txt").write_text("3\n-1\n")
    np.save(tmp_path / "shares.npy", np.array([0.5, 1.5]))
    for name in ("words.txt", "none.csv", "less.txt", "shares.npy", "not-there.txt"):
        with pytest.raises(ParameterError, match=name):
            read_ids(tmp_path / name)
    assert not is_ids_file("12,40-77")
