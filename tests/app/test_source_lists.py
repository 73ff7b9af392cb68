"""Sources, pairs and points in words and files, on one mesh and on two."""

import io
import json

import numpy as np
import pytest

import app
from app.document.document import starting_points
from app.document.file import read_recipe
from app.document.lists import pair_from_words, pairs_from_words, pairs_text, split_list
from app.document.sources import Sources, sources_from_words
from app.main import main
from app.session.chosen_sources import chosen_sources
from bihdist_core import (
    BiharmonicDistance,
    BihdistError,
    BoundaryLoop,
    ParameterError,
    SourceSet,
    SurfacePoint,
    read_surface,
)
from bihdist_core.analysis.sampling import farthest_points
from tests.commands import ran, refused
from tests.shapes import bumpy, two_pieces

PLACE = SurfacePoint.of(17, 0.2, 0.5)


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(200))


def typed(monkeypatch, text):
    monkeypatch.setattr("sys.stdin", io.StringIO(text))


# ---------------------------------------------------------------------- words
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("12", ["12"]),
        ("12, 40 ,7", ["12", "40", "7"]),
        ("f17:0.2,0.5", ["f17:0.2,0.5"]),
        ("3,f17:0.2,0.5,4", ["3", "f17:0.2,0.5", "4"]),
        ("3+f17:0.2,0.5+f3:0.1,0.1+9,4", ["3+f17:0.2,0.5+f3:0.1,0.1+9", "4"]),
        ("diffusion(t=1/4),mine(a=1,b=2),x", ["diffusion(t=1/4)", "mine(a=1,b=2)", "x"]),
    ],
)
def test_commas_are_between_what_is_listed(text, words):
    assert split_list(text) == words


def test_a_file_may_have_commas_in_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a,b.json").write_text('{"points": [[3, 0.2, 0.3], [40, 0.3, 0.3]]}')
    assert split_list("3,a,b.json,4") == ["3", "a,b.json", "4"]


@pytest.mark.parametrize("text", ["", "3,", ",3", "3,,4"])
def test_a_comma_has_something_beside_it(text):
    with pytest.raises(ParameterError, match="has nothing beside it"):
        split_list(text)


@pytest.mark.parametrize(
    ("text", "sources"),
    [
        ("12", Sources(members=(12,))),
        ("12,3+40,f17:0.2,0.5,loop:0", Sources(members=(12, SourceSet((3, 40)), PLACE, BoundaryLoop(0)))),
        ("all", Sources("all")),
        ("farthest:400", Sources("farthest", count=400)),
        ("farthest:4:12+40", Sources("farthest", count=4, start=SourceSet((12, 40)))),
        ("random:100", Sources("random", count=100)),
        ("random:100:7", Sources("random", count=100, seed=7)),
        ("@ids.txt", Sources("file", file="ids.txt")),
        ("xyz:.1,-5,1e-3", Sources("file", file="xyz:.1,-5,1e-3", text="x,y,z\n.1,-5,1e-3")),
    ],
)
def test_sources_from_words(text, sources):
    assert sources_from_words(text) == sources


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("some", "'some' is not a source"),
        ("lop:0", "did you mean loop:0"),
        ("farthest", "write 12,40"),
        ("farthest:", "needs a number of sources"),
        ("farthest:0", "needs a number of sources"),
        ("farthest:5:x", "'x' is not a source"),
        ("random:many", "needs a number of sources"),
        ("random:5:x", "needs a seed"),
        ("@", "'@' is not a list of sources"),
        ("12,40,", "has nothing beside it"),
        ("12 40 7", "has no commas; write 12,40,7"),
        ("12; 40", "has no commas; write 12,40"),
        ("0.1,0.5,0.1", "for the vertex nearest to a position write xyz:0.1,0.5,0.1"),
        ("-1,2,3", "write xyz:-1,2,3"),
        ("xyz:0.1,0.5", "'xyz:0.1,0.5' is not a position; write xyz:0.1,0.5,0.1"),
        ("xyz:", "is not a position"),
        ("xyz:1,2,3,4", "is not a position"),
        ("xyz:1,2,3,xyz:a,b,c", "'xyz:a,b,c' is not a position"),
    ],
)
def test_what_is_no_sources_is_refused(text, said):
    with pytest.raises(ParameterError, match=said):
        sources_from_words(text)


def test_pairs_from_words(monkeypatch):
    assert pairs_from_words("1:2, 3 : 4") == [(1, 2), (3, 4)]
    assert pairs_from_words("@pairs.csv") == "pairs.csv"
    for pairs in ([(1, 2), (3, 4)], "pairs.csv"):
        assert pairs_from_words(pairs_text(pairs)) == pairs
    for dash in ("-", "@-"):
        typed(monkeypatch, "i,j\n1,2\n3,4\n")
        assert pairs_from_words(dash) == [(1, 2), (3, 4)]
    typed(monkeypatch, "1,x\n")
    with pytest.raises(ParameterError, match="standard input, line 1: '1,x' is not a pair"):
        pairs_from_words("-")
    typed(monkeypatch, " \n")
    with pytest.raises(ParameterError, match="Standard input holds no pairs"):
        pairs_from_words("-")
    for text in ("1,2", "1:2:3", "1:x", "-1:2"):
        with pytest.raises(ParameterError, match="not a pair of vertex ids such as 1:2"):
            pairs_from_words(text)
    with pytest.raises(ParameterError):
        pair_from_words("1:2,3:4")


# ---------------------------------------------------------------------- on a surface
def found(text, surface, **how):
    return chosen_sources(sources_from_words(text), surface, lambda: BiharmonicDistance(surface), **how)


def test_positions_are_the_vertices_nearest_to_them():
    surface = two_pieces()
    near = [",".join(map(repr, (surface.vertices[vertex] + 1e-9).tolist())) for vertex in (7, 61)]
    chosen = found(",".join(f"xyz:{each}" for each in near), surface)
    assert chosen.sources == [7, 61]
    assert chosen.pins.moved.max() < 1e-8


def test_rules_choose_on_a_surface():
    surface = two_pieces()
    used = np.flatnonzero(surface.component_of_vertex >= 0)
    distance = BiharmonicDistance(surface)
    assert found("all", surface).sources == used.tolist()
    assert found("farthest:4:3", surface).sources == farthest_points(distance, 3, 4).tolist()
    highest = chosen_sources(Sources(), surface, lambda: distance).one()
    assert found("farthest:4", surface).sources == farthest_points(distance, highest, 4).tolist()
    one, again, other = (found(f"random:20{seed}", surface).sources for seed in ("", ":0", ":1"))
    assert one == again == sorted(set(one))
    assert set(one) <= {*used.tolist()}
    assert one != other
    with pytest.raises(ParameterError, match="64 vertices, fewer than the 65 of random:65"):
        found("random:65", surface)


@pytest.mark.parametrize(
    ("name", "text", "sources"),
    [
        ("a.txt", "3\n1\n2\n", [3, 1, 2]),
        ("a.txt", "# two\n3, 1 2,0.0e+00\n", [3, 1, 2, 0]),
        ("a.txt", "3+40\nf17:0.2,0.5\n7\n", [SourceSet((3, 40)), PLACE, 7]),
        ("a.csv", "vertex\n5\n9\n", [5, 9]),
        ("a.csv", "id,vertex,name\n4,17,left\n9,40,\n", [17, 40]),
        ("a.json", '{"pins": [{"vertex": 17}, {"vertex": 40}]}', [17, 40]),
    ],
)
def test_files_of_sources(tmp_path, monkeypatch, name, text, sources):
    (tmp_path / name).write_text(text)
    surface = bumpy(60)
    assert found(f"@{tmp_path / name}", surface).sources == sources
    assert found(f"@{tmp_path}/{{name}}{name[1:]}", surface, name="a").sources == sources
    # Standard input is known by how it begins.
    for dash in ("-", "@-"):
        typed(monkeypatch, text)
        assert found(dash, surface).sources == sources


def test_ids_of_an_array_and_points_beside_the_mesh(tmp_path):
    surface = bumpy(60)
    np.save(tmp_path / "a.npy", [3, 1])
    assert found(f"@{tmp_path}/a.npy", surface).sources == [3, 1]
    x, y, z = surface.vertices[17]
    (tmp_path / "a.pp").write_text(
        f'<PickedPoints><point x="{x}" y="{y}" z="{z}" name="nose"/></PickedPoints>', encoding="ascii"
    )
    chosen = found(f"@{tmp_path}/a.pp", surface)
    assert (chosen.sources, chosen.pins.names) == ([17], ("nose",))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("3\none\n", "line 2: 'one' is not a source"),
        ("# none\n", "names no source"),
        ("3\n99\n", "has no vertex 99"),
    ],
)
def test_a_file_that_is_wrong_is_named(tmp_path, text, said):
    (tmp_path / "a.txt").write_text(text)
    with pytest.raises(BihdistError, match=said):
        found(f"@{tmp_path}/a.txt", bumpy(60))


# ---------------------------------------------------------------------- commands
def test_commands_read_standard_input(mesh, tmp_path, monkeypatch):
    distance = BiharmonicDistance(read_surface(mesh))
    out = tmp_path / "d.npy"
    typed(monkeypatch, "3 7\n")
    assert main(["field", mesh, "--sources", "-", "-o", str(out)]) == 0
    assert np.allclose(np.load(out), distance.from_sources([3, 7]), rtol=1e-12)
    typed(monkeypatch, "1,2\n3,4\n")
    assert main(["pairs", mesh, "--pairs", "-", "-o", str(out)]) == 0
    assert np.load(out)[:, 2] == pytest.approx(distance.of_pairs([[1, 2], [3, 4]]))
    typed(monkeypatch, "vertex,value\n3,0\n40,1\n")
    assert main(["interpolate", mesh, "--anchors", "@-", "-o", str(out)]) == 0
    given = np.load(out).ravel()
    assert main(["interpolate", mesh, "--anchors", "3=0,40=1", "-o", str(out)]) == 0
    assert np.array_equal(np.load(out).ravel(), given)
    typed(monkeypatch, "id,vertex\n1,3\n2,40\n")
    assert main(["profile", mesh, "--pins", "-", "--distance", "biharmonic", "-o", str(out)]) == 0
    assert np.load(out)[[0, -1], 1:4] == pytest.approx(read_surface(mesh).vertices[[3, 40]])


def test_every_command_starts_where_a_rule_says(mesh, tmp_path, capsys):
    distance = BiharmonicDistance(read_surface(mesh))
    points = farthest_points(distance, 3, 3).tolist()
    out = tmp_path / "d.npy"
    assert main(["field", mesh, "--sources", "farthest:3:3", "-o", str(out)]) == 0
    assert np.allclose(np.load(out), distance.from_sources(points), rtol=1e-12)
    assert main(["pairs", mesh, "--sources", "farthest:3:3", "-o", str(out)]) == 0
    assert np.allclose(np.load(out), distance.pairwise(points), rtol=1e-12)
    assert main(["samples", mesh, "--sources", "random:5:2", "-o", str(out)]) == 0
    ids = np.load(out)
    assert len(ids) == 5
    assert main(["regions", mesh, "--sources", f"@{out}", "-o", str(tmp_path / "labels.npy")]) == 0
    assert f"pin 5, vertex {ids[4]}" in capsys.readouterr().out
    assert (
        main(
            [
                "perturb",
                mesh,
                "--noise",
                "1",
                "--distance",
                "biharmonic",
                "--sources",
                "3,7",
                "-o",
                str(tmp_path / "n.off"),
            ]
        )
        == 0
    )
    assert [line.split(":")[0] for line in capsys.readouterr().out.splitlines()[1:]] == [
        "biharmonic from 3",
        "biharmonic from 7",
    ]


def test_figures_take_rules_and_files(mesh, tmp_path):
    from app.document.file import read_recipe
    from app.document.shared_parts.pins import Pins

    points = farthest_points(BiharmonicDistance(read_surface(mesh)), 3, 2).tolist()
    (tmp_path / "pins.csv").write_text("id,vertex\n1,9\n2,40\n")
    words = ["--distance", "biharmonic", "--sources", "farthest:2:3", "--pins", f"@{tmp_path}/pins.csv"]
    assert main(["figure", mesh, *words, "--size", "200x200", "-o", str(tmp_path / "a.png")]) == 0
    document = read_recipe(tmp_path / "a.json").document
    assert document.sources == tuple(points)
    assert [document.point(pin.point).at for pin in document[Pins].pins] == [9, 40]


def test_pins_are_points_and_numbers_are_of_their_kind(mesh, capsys):
    assert "and 3+4 is neither" in refused(capsys, "figure", mesh, "--pins", "3+4", "-o", "x.png")
    for words in (["--isoline-through", "x"], ["--insets", "3:x"], ["--anchors", "3=nan"], ["--isolines", "x"]):
        with pytest.raises(SystemExit):
            main(["figure", mesh, *words, "-o", "x.png"])
        assert f"{words[0]}: " in capsys.readouterr().err


# ---------------------------------------------------------------------- sources of two meshes
SMALL = ["--distance", "biharmonic", "--size", "200x100"]


@pytest.fixture
def meshes(mesh_file):
    return [mesh_file(bumpy(60), "a.off"), mesh_file(bumpy(80), "b.off")]


def starts(path):
    return [(point.at, point.surface) for point in starting_points(read_recipe(path).document)]


def test_the_second_source_is_of_the_second_mesh(meshes, tmp_path, capsys):
    assert main(["figure", *meshes, "--sources", "7,70", *SMALL, "-o", str(tmp_path / "x.png")]) == 0
    assert starts(tmp_path / "x.json") == [(7, "A"), (70, "B")]
    assert "--sources" not in capsys.readouterr().err
    picture = app.figure(meshes[0], ["biharmonic"], ["7", 70], second_mesh=meshes[1], layout={"size": "200x100"})
    assert [(point.at, point.surface) for point in starting_points(picture.document)] == [(7, "A"), (70, "B")]


def test_one_source_is_of_the_first_mesh_which_is_said(meshes, tmp_path, capsys):
    printed = ran(capsys, "figure", *meshes, "--sources", "7", *SMALL, "-o", tmp_path / "x.png", "--json")
    assert "starts from its highest vertex; one of each is named as 7,40" in printed.err
    assert json.loads(printed.out)["sources"][0] == 7
    assert starts(tmp_path / "x.json")[1][0] != 7
    picture = app.figure(meshes[0], ["biharmonic"], [7], second_mesh=meshes[1], layout={"size": "200x100"})
    assert starting_points(picture.document)[1].at == starts(tmp_path / "x.json")[1][0]


@pytest.mark.parametrize("command", ["figure", "view"])
@pytest.mark.parametrize("words", ["1,2,3", "farthest:2", "random:3"])
def test_more_than_one_of_each_mesh_is_refused(meshes, tmp_path, capsys, words, command):
    output = ["-o", str(tmp_path / "x.png")] if command == "figure" else ["--screenshot", str(tmp_path / "x.png")]
    assert main([command, *meshes, "--sources", words, "--distance", "biharmonic", *output]) == 2
    assert "Two meshes have a source each" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.png"))


def test_more_than_one_of_each_mesh_is_refused_in_python(meshes):
    with pytest.raises(ParameterError, match="Two meshes have a source each, not 3"):
        app.figure(meshes[0], ["biharmonic"], [1, 2, 3], second_mesh=meshes[1])


def test_a_vertex_that_the_second_mesh_lacks_is_named_with_it(meshes, tmp_path, capsys):
    assert main(["figure", *meshes, "--sources", "7,80", *SMALL, "-o", str(tmp_path / "x.png")]) == 2
    assert "b.off has no vertex 80" in capsys.readouterr().err


def test_a_recipe_of_two_meshes_takes_a_source_for_each(meshes, tmp_path, capsys):
    first, second = tmp_path / "x.json", tmp_path / "y.json"
    assert main(["figure", *meshes, "--sources", "7,7", *SMALL, "-o", str(tmp_path / "x.png")]) == 0
    again = ["figure", "--recipe", str(first), "-o", str(tmp_path / "y.png")]
    assert main([*again, "--sources", "3,50"]) == 0
    assert starts(second) == [(3, "A"), (50, "B")]
    assert "start from 2 sources, and --sources names 1; name as many" in refused(capsys, *again, "--sources", "3")
    assert main([*again, "--distance", "geodesic"]) == 2
    assert "--distance makes the panels of one mesh; this recipe has 2" in capsys.readouterr().err
