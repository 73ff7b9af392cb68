"""Sources of every kind in documents, recipes, sessions, commands and Python."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import app
from app.document.document import Point, comparison
from app.document.edits import put_point
from app.document.file import read_recipe
from app.document.form import document_data, document_from
from app.main import main
from app.session.questions import pieces_at, source_at, vertex_at
from bihdist_core import (
    BiharmonicDistance,
    BoundaryLoop,
    Curve,
    ParameterError,
    SourceSet,
    SurfacePoint,
    VertexError,
    read_surface,
)
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid, two_pieces

BIHARMONIC = Spec.of("biharmonic")
PLACE = SurfacePoint.of(17, 0.2, 0.5)
CURVE = Curve((SurfacePoint.of(3, 0.2, 0.3), SurfacePoint.of(40, 0.3, 0.3)))
KINDS = [PLACE, SourceSet((3, 40, PLACE)), BoundaryLoop(0), CURVE, SourceSet((BoundaryLoop(0), CURVE))]

PLACES = st.builds(SurfacePoint.of, st.integers(0, 99), st.floats(0, 0.5), st.floats(0, 0.5))
MEMBERS = st.one_of(
    st.integers(0, 99),
    PLACES,
    st.builds(BoundaryLoop, st.integers(0, 9)),
    st.builds(Curve, st.lists(PLACES, min_size=2, max_size=4).map(tuple), st.booleans()),
)
SOURCES = st.one_of(MEMBERS, st.lists(MEMBERS, min_size=1, max_size=4).map(tuple).map(SourceSet))


@settings(max_examples=100, deadline=None, derandomize=True)
@given(SOURCES)
def test_a_document_is_read_as_it_was_written(source):
    document = put_point(comparison("a.off", (BIHARMONIC,), (0,)), "source", source)
    assert document_from(json.loads(json.dumps(document_data(document)))) == document
    assert pickle.loads(pickle.dumps(document)) == document
    assert hash(document) == hash(replace(document))


@pytest.mark.parametrize(
    ("at", "said"),
    [
        ({"set": 3}, "points[0].at.set must be a list"),
        ({"set": []}, "points[0].at: A set of sources has from 1"),
        ({"set": [1, {"set": [2]}]}, "no sets among its members"),
        ({"set": [1, -2]}, "points[0].at.set[1] must be a whole number"),
        ({"loop": -1}, "points[0].at.loop must be a whole number"),
        ({"loop": 0, "closed": True}, "unknown key 'closed'"),
        ({"curve": [[1, 0.5, 0.2], [2, 0.9, 0.2]]}, "points[0].at.curve[1]: The weights"),
        ({"curve": [[1, 0.5, 0.2]]}, "points[0].at: A curve has from 2"),
        ({"curve": [[1, 0.5, 0.2], 7]}, "points[0].at.curve[1] must be a face and two weights"),
        ({"curve": [[1, 0, 0], [2, 0, 0]], "closed": 3}, "closed must be true or false"),
        ({"face": 3, "weights": [0.5, 0.5, 0.5]}, "add up to 1"),
        ("loop:0", "must be a whole number"),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_place(at, said):
    data = document_data(comparison("a.off", (BIHARMONIC,), (0,)))
    data["points"][0]["at"] = at
    with pytest.raises(ParameterError) as error:
        document_from(data)
    assert said in str(error.value)


def test_points_take_words_too():
    assert Point("a", "12+40").at == SourceSet((12, 40))
    for wrong in (-1, 2.5, "lop:0", True):
        with pytest.raises(ParameterError):
            Point("a", wrong)


# ---------------------------------------------------------------------- on a surface
def test_a_vertex_stands_for_each_of_them():
    g = grid(8, 6)
    for source in KINDS:
        assert source_at(source, g) is source
        assert vertex_at(source, g) in pieces_at(source, g).corners
    assert vertex_at(SourceSet((31, 4)), g) == 31
    assert vertex_at(SurfacePoint.of(17, 0.1, 0.7), g) == g.faces[17, 1]
    for source, error in [(BoundaryLoop(1), ParameterError), (SourceSet((1, 99)), VertexError)]:
        with pytest.raises(error):
            source_at(source, g)


def test_a_session_answers_from_all_of_them(desk, mesh_file):
    path, d = mesh_file(grid(8, 6)), desk((BIHARMONIC,))
    session = d.loaded(path, 3)
    distance = BiharmonicDistance(read_surface(path))
    for source in KINDS:
        session.show(put_point(session.document, "source", source))
        d.complete()
        assert np.array_equal(d.answers[0].field, distance.from_source(source))


def test_a_source_that_is_not_there_leaves_what_is_shown(desk, mesh_file):
    d = desk((BIHARMONIC,))
    session = d.loaded(mesh_file(bumpy(100)), 3)
    session.show(put_point(session.document, "source", BoundaryLoop(0)))
    d.until_told("this mesh is closed")
    assert session.document.point().at == 3


# ---------------------------------------------------------------------- commands
@pytest.fixture
def flat(mesh_file):
    return mesh_file(grid(8, 6))


def test_fields_from_words(flat, tmp_path, capsys):
    (tmp_path / "way.json").write_text('{"points": [[3, 0.2, 0.3], [40, 0.3, 0.3]]}')
    words = ["3", "3+40", "f17:0.2,0.5", "loop:0", str(tmp_path / "way.json")]
    assert main(["field", flat, "--sources", ",".join(words), "-o", str(tmp_path / "d.csv")]) == 0
    sources = [3, SourceSet((3, 40)), PLACE, BoundaryLoop(0), CURVE]
    expected = BiharmonicDistance(read_surface(flat)).from_sources(sources)
    rows = (tmp_path / "d.csv").read_text().splitlines()
    names = rows[0].split(",")[-5:]
    assert names == [f"biharmonic_from_{n}" for n in ("3", "3_40", "f17_0.2_0.5", "loop_0", "a_curve_of_2_points")]
    found = np.array([row.split(",")[-5:] for row in rows[1:]], float)
    assert np.allclose(found, expected, rtol=1e-9)
    assert "biharmonic, exact, 63 vertices, 5 sources" in capsys.readouterr().out


def test_the_exact_geodesic_is_exact_from_a_line_too(flat, tmp_path, capsys):
    words = ["field", flat, "--distance", "geodesic(method=exact)", "-o", str(tmp_path / "d.npy"), "--sources"]
    assert main([*words, "loop:0"]) == 0
    assert "geodesic, exact, 63 vertices" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["field", "figure", "movie", "view"])
def test_words_that_are_no_source_are_refused_before_anything_is_read(command, capsys):
    output = [] if command == "view" else ["-o", "out.png"]
    with pytest.raises(SystemExit):
        main([command, "no mesh.off", *output, "--sources", "lop:0"])
    assert "did you mean loop:0?" in capsys.readouterr().err


def test_sources_that_the_mesh_does_not_have_are_refused(mesh_file, tmp_path, capsys):
    mesh = mesh_file(two_pieces())
    for word, said in [
        ("loop:0", "mesh.off has no boundary loop 0: this mesh is closed."),
        ("f999:0,0", "mesh.off has no face 999; faces run from 0 to "),
        ("3+99", "mesh.off has no vertex 99"),
        ("60", "belongs to no face"),
    ]:
        for command in (["field", mesh, "-o", tmp_path / "d.npy"], ["figure", mesh, "-o", tmp_path / "f.png"]):
            assert main([*map(str, command), "--sources", word]) == 2
            assert said in capsys.readouterr().err


def test_a_figure_with_rows_of_sources_and_its_recipe(flat, tmp_path, capsys):
    words = ["figure", flat, "--distance", "biharmonic", "--size", "300x500"]
    assert main([*words, "--sources", "3+40,loop:0", "-o", str(tmp_path / "a.png")]) == 0
    assert "source 3+40, loop:0" in capsys.readouterr().out
    recipe = read_recipe(tmp_path / "a.json")
    assert recipe.document.sources == (SourceSet((3, 40)), BoundaryLoop(0))
    assert main(["figure", "--recipe", str(tmp_path / "a.json"), "-o", str(tmp_path / "b.png")]) == 0
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    # Another source for the same recipe.
    more = ["--sources", "f17:0.2,0.5,4", "-o", str(tmp_path / "c.png")]
    assert main(["figure", "--recipe", str(tmp_path / "a.json"), *more]) == 0
    assert read_recipe(tmp_path / "c.json").document.sources == (PLACE, 4)


def test_python_draws_from_all_of_them(flat):
    distance = BiharmonicDistance(read_surface(flat))
    for source in (*KINDS, "3+40"):
        picture = app.figure(flat, ["biharmonic"], source, layout={"size": "150x150"})
        assert np.array_equal(picture.answers[0].field, distance.from_source(source))
    rows = app.figure(flat, ["biharmonic"], ["3+40", PLACE], layout={"size": "150x150"})
    assert [answer.field[3] == 0 for answer in rows.answers] == [True, False]
    assert rows.document.sources == (SourceSet((3, 40)), PLACE)


def test_a_movie_turns_about_a_set(flat, tmp_path):
    words = ["--sources", "3+40", "--distance", "biharmonic", "--size", "120x120", "--frames", "2"]
    assert main(["movie", flat, *words, "-o", str(tmp_path / "m.gif")]) == 0
    assert (tmp_path / "m.gif").stat().st_size > 0


# ---------------------------------------------------------------------- marks
def yellow(picture):
    """Pixels of the colour of sources."""
    red, green, blue = np.moveaxis(picture[..., :3].astype(int), -1, 0)
    return (red > 230) & (green > 190) & (blue < 80)


def test_a_figure_marks_each_member_and_draws_lines_as_lines(flat):
    from scipy.ndimage import binary_dilation, label

    def marks(source):
        picture = app.figure(flat, ["biharmonic"], source, layout={"size": "900x700"}, view={"cpos": "front"}).pixels
        return label(binary_dilation(yellow(picture), iterations=3))[1]  # a ring is one

    assert marks(31) == 1
    assert marks("31+33+49") == 3
    assert marks(PLACE) == 1
    assert marks(BoundaryLoop(0)) == 1
    picture = app.figure(
        flat, ["biharmonic"], BoundaryLoop(0), layout={"size": "900x700"}, view={"cpos": "front"}
    ).pixels
    rows, columns = np.nonzero(yellow(picture))
    # Along all four sides and nowhere else: nothing in the middle.
    assert not yellow(picture)[rows.min() + 20 : rows.max() - 20, columns.min() + 20 : columns.max() - 20].any()
    assert yellow(picture)[rows.min() : rows.max() + 1].any(axis=1).all()


def test_the_mark_of_a_place_is_where_it_is(flat):
    from scipy.ndimage import center_of_mass

    def centre(source):
        picture = app.figure(flat, ["biharmonic"], source, layout={"size": "900x700"}, view={"cpos": "front"}).pixels
        return np.array(center_of_mass(yellow(picture)))

    corners = np.array([centre(int(v)) for v in grid(8, 6).faces[17]])
    assert np.abs(centre(PLACE) - np.array(PLACE.weights) @ corners).max() < 1.5


def test_what_is_hidden_is_said_in_few_sentences(mesh_file, tmp_path, capsys):
    surface = bumpy(300)
    back = np.argsort(surface.vertices[:, 2])
    words = ["figure", mesh_file(surface), "--distance", "biharmonic", "--cpos", "front", "-o", str(tmp_path / "a.png")]
    face = int(np.argmin(surface.vertices[surface.faces, 2].max(axis=1)))

    def said(source):
        assert main([*words, "--sources", source]) == 0
        return [line for line in capsys.readouterr().err.splitlines() if "hidden" in line]

    assert said(f"{back[0]}+{back[-1]}") == [
        f"bihdist: Vertex {back[0]} is hidden in the view front: a dashed ring; try --cpos source or --cpos front,back."
    ]
    assert f"The place f{face}:0.3,0.3 is hidden" in said(f"f{face}:0.3,0.3")[0]
    (line,) = said("+".join(map(str, back[:5])))
    assert f"Vertex {back[0]} and 4 other marked places are hidden" in line
    way = tmp_path / "way.json"
    way.write_text(f'{{"points": [[{face}, 0.3, 0.3], [{face}, 0.1, 0.1]]}}')
    assert said(str(way)) == [
        "bihdist: The curve of 2 points is hidden in the view front; try --cpos source or --cpos front,back."
    ]
