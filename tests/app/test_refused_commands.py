"""What the command line says when it cannot do what it is told: a sentence, and no file."""

import os
import re
import sys
from pathlib import Path

import pytest

from app.main import main
from tests.commands import refused
from tests.shapes import bumpy, two_pieces

ROOT = Path(__file__).parents[2]


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(200))


def test_bad_input_gets_a_sentence_and_leaves_no_file(mesh, mesh_file, tmp_path, capsys):
    out = tmp_path / "d.npy"
    pieces = mesh_file(two_pieces(), "pieces.off")
    bad_pairs = tmp_path / "bad.csv"
    bad_pairs.write_text("1,2\n3,x\n")
    empty = tmp_path / "empty.off"
    empty.write_text("")
    for arguments, words in [
        (["field", tmp_path / "none.off", "--sources", 0, "-o", out], "none.off"),
        (["field", tmp_path, "--sources", 0, "-o", out], "folder"),
        (["field", empty, "--sources", 0, "-o", out], "empty.off"),
        (["field", mesh, "--sources", 200, "-o", out], "no vertex 200; ids run from 0 to 199"),
        (["field", pieces, "--sources", 60, "-o", out], "vertex 60 belongs to no face"),
        (["field", mesh, "--sources", 0, "-o", tmp_path / "d.xyz"], ".xyz"),
        (["field", mesh, "--sources", 0, "-o", tmp_path / "no" / "d.npy"], "no folder"),
        (["field", mesh, "--sources", 0, "--distance", "power", "--alpha", 0.5, "-o", out], "alpha"),
        (
            ["field", mesh, "--sources", 0, "--distance", "euclidean", "-o", out],
            "no distance 'euclidean'; choose one of",
        ),
        (
            ["field", mesh, "--sources", 0, "--distance", "heat", "-o", out],
            "no distance 'heat'; did you mean geodesic(method=heat)? Otherwise choose one of",
        ),
        (["field", mesh, "--sources", 0, "--distance", "diffusion(k=3)", "-o", out], "has no parameter 'k'; it has t"),
        (["figure", mesh, "--distance", "diffusion(t", "-o", tmp_path / "f.png"], "has no closing bracket"),
        (["field", mesh, "--sources", 0, "--t", "-1", "-o", out], "t must be a number above 0, not -1"),
        (["view", mesh, "--k", "many"], "k must be a whole number above 0, not 'many'"),
        (["view", mesh, "--cmap", "jet"], "There is no colour map 'jet', and no such file"),
        (["pairs", mesh, "--sources", "1,900", "-o", out], "no vertex 900"),
        (["pairs", mesh, "-o", out], "Which pairs?"),
        (["pairs", mesh, "--sources", "7", "-o", out], "name another beside 7"),
        (["pairs", mesh, "--pairs", "1:2", "--sources", "1,2", "-o", out], "--pairs and --sources are two ways"),
        (["pairs", mesh, "--pairs", "1:2", "--nearest", "-o", out], "--pairs and --nearest are two ways"),
        (["pairs", mesh, "--pairs", "1:2", "--dtype", "float32", "-o", out], "--dtype goes with a matrix"),
        (["pairs", mesh, "--sources", "1,loop:0", "-o", out], "has no boundary loop 0"),
        (["pairs", mesh, "--sources", "1,3+4", "-o", out], "Pairs need vertices, and 3+4 is not one"),
        (["pairs", mesh, "--nearest", "--k", "9", "--distance", "truncated", "-o", out], "such as truncated(k=200)"),
        (
            ["isolines", mesh, "--sources", "3,4", "-o", tmp_path / "l.csv"],
            "one source, and --sources names 2",
        ),
        (["pairs", mesh, "--pairs", f"@{bad_pairs}", "-o", out], "line 2: '3,x'"),
        (["pairs", mesh, "--pairs", f"@{tmp_path}/none.csv", "-o", out], "none.csv"),
        (["figure", mesh, "-o", tmp_path / "f.jpg"], ".jpg"),
        (["info", empty], "empty.off"),
        (["view", tmp_path / "none.off"], "There is no file"),
        (["view", tmp_path / "none.json"], "none.json."),
        (["frobnicate"], "There is no command or file frobnicate. The samples are animal, "),
        (["figre", "hand", "-o", tmp_path / "f.png"], "no command or file figre; did you mean figure?"),
        (["fieeld", "hand", "-o", out], "no command or file fieeld; did you mean field? See `bihdist --help`."),
        (["export", "hand", "-o", out], "no command or file export; did you mean figure?"),
        (["distance", "hand", "-o", out], "no command or file distance; did you mean field?"),
        (["help", "export"], "no command or file export; did you mean figure?"),
        (["field", "sphere", "-o", out], "no file sphere. The samples are"),
        (["field", "hand", "12", "-o", out], "no file 12; did you mean --sources 12?"),
        (["field", "hand", "12,40", "-o", out], "no file 12,40; did you mean --sources 12,40?"),
        (["figure", "hand", "f3:0.2,0.5", "-o", tmp_path / "f.png"], "did you mean --sources f3:0.2,0.5?"),
        (["info", "f3"], "no file f3. The samples are"),
        (["field", "hand", "hnad", "-o", out], "no file hnad; did you mean hand?"),
        (["view", "figre"], "no file figre; did you mean figure? The samples are"),
        (["info", "hnad"], "no file hnad; did you mean hand?"),
        (["field", "hnad", "--sources", 0, "-o", out], "did you mean hand?"),
        (["pairs", "hnad", "--pairs", "1:2", "-o", out], "did you mean hand?"),
        (["figure", "hnad", "-o", tmp_path / "f.png"], "did you mean hand?"),
        (["movie", "hnad", "-o", tmp_path / "f.gif"], "did you mean hand?"),
        (["paper", "--mesh", "hnad", "-o", tmp_path / "paper"], "did you mean hand?"),
        (["info", "view.off"], "There is no file view.off. The samples are"),
        (["info", 500 * "m"], f"There is no file {132 * 'm'}...{65 * 'm'}. The samples"),
        (["pairs", mesh, "--pairs", "1:2", "--fresh", "-o", out], "--fresh goes with --sources all"),
        (["pairs", mesh, "--nearest", "--k", "2", "--memory", "10", "-o", out], "--memory goes with --sources all"),
        (["pairs", mesh, "--pairs", "1:2", "--radius", "1", "-o", out], "--radius goes with --sources all"),
        (["pairs", mesh, "--sources", "1,2", "--dask", "tcp://a:1", "-o", out], "--dask goes with --sources all"),
    ]:
        assert words in refused(capsys, *arguments)
        assert not out.exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ["field", "figure", "--sources", "a", "-o", "x.npy"],
        ["pairs", "figure", "--pairs", "1", "-o", "x.npy"],
        ["pairs", "figure", "--pairs", "1,2", "-o", "x.npy"],
        ["--nonsense"],
    ],
)
def test_words_that_make_no_sense_exit_with_2(arguments, capsys):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert stop.value.code == 2
    told = capsys.readouterr().err
    assert told.startswith("bihdist: ")
    assert " --help`.\n" in told
    assert told.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("field a.off b.off --sources 3", "a-field.npy b-field.npy"),
        ("pairs a.off --sources 3,9", "a-pairs.npy"),
        ("samples a.off --sources farthest:4", "a-samples.txt"),
        ("interpolate a.off --anchors 3=1,9=2", "a-interpolated.npy"),
        ("perturb a.off --noise 0.1", "a-perturbed.ply"),
        ("correspond a.off b.off --pairs 3:3,9:9", "a-map.txt"),
        ("movie a.off --frames 2 --size 80x80 --distance biharmonic", "a.gif"),
    ],
)
def test_an_output_is_named_after_its_mesh_and_replaces_nothing(words, names, mesh_file, capsys, monkeypatch):
    folder = Path(mesh_file(bumpy(80), "a.off")).parent
    mesh_file(bumpy(80), "b.off")
    monkeypatch.chdir(folder)
    there = set(os.listdir(folder))
    assert main([*words.split(), "--quiet"]) == 0
    assert set(os.listdir(folder)) - there == set(names.split())
    assert capsys.readouterr().out == ""
    first = names.split()[0]
    before = Path(first).read_bytes()
    assert f"There is a file {first} already; name another with -o" in refused(capsys, *words.split())
    assert Path(first).read_bytes() == before
    assert main([*words.split(), "-o", "{name}.npy" if "field" in words else f"other{Path(first).suffix}"]) == 0


def test_an_old_file_survives_a_failure(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "d.npy"
    out.write_text("old")
    refused(capsys, "field", mesh, "--sources", 999, "-o", out)

    def disk_full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("bihdist_core.formats.field_output.put_array", disk_full)
    assert "No space left" in refused(capsys, "field", mesh, "--sources", 3, "-o", out)
    assert out.read_text() == "old"
    assert set(os.listdir(tmp_path)) == {"d.npy", Path(mesh).name}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a display")
def test_no_display_is_a_sentence(monkeypatch, capsys):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    said = refused(capsys, "view")
    assert "needs a display" in said
    assert "`bihdist figure` draws without one, and in notebooks `bihdist.widget` shows it." in said


@pytest.mark.parametrize("line", ["1,--5", "1,²", "1,5.0", "1," + 30 * "9", "one,two"])
def test_a_line_that_is_no_pair_is_named(mesh, tmp_path, capsys, line):
    file = tmp_path / "pairs.csv"
    file.write_text(f"1,2\n{line}\n", encoding="utf-8")
    assert "line 2: " in refused(capsys, "pairs", mesh, "--pairs", f"@{file}", "-o", tmp_path / "p.npy")


@pytest.mark.parametrize(("command", "ending"), [("figure", "png"), ("movie", "gif"), ("page", "html")])
def test_a_session_in_the_place_of_a_mesh_is_a_recipe(command, ending, tmp_path, capsys):
    (tmp_path / "hand.json").write_text("{}")
    said = refused(capsys, command, tmp_path / "hand.json", "-o", tmp_path / f"out.{ending}")
    assert f"A recipe or a session is named with --recipe {tmp_path / 'hand.json'}." in said


def test_a_list_is_refused_where_one_distance_is_computed(mesh, capsys):
    with pytest.raises(SystemExit):
        main(["field", str(mesh), "--sources", "3", "--distance", "biharmonic,diffusion(t=1)"])
    said = capsys.readouterr().err
    assert "one distance at a time, not 'biharmonic,diffusion(t=1)'; `bihdist batch` computes several" in said


@pytest.mark.parametrize("words", [["truncated(k=200)"], ["truncated"]])
@pytest.mark.parametrize("command", [["field", "-o", "f.npy"], ["figure", "-o", "f.png"], ["statistics"]])
def test_more_eigenpairs_than_the_mesh_has_are_refused(mesh, tmp_path, capsys, monkeypatch, command, words):
    monkeypatch.chdir(tmp_path)
    word, *rest = command
    told = refused(capsys, word, mesh, "--sources", "0", "--distance", *words, *rest)
    assert re.search("has 199 eigenpairs besides the constant, and k is 200; choose k from 1 to 199", told)
    assert not list(tmp_path.glob("f.*"))
