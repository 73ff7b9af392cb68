"""`--json` of every command: one object, whose keys are those that the guide has."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from app.commands.terminal import as_json
from app.main import COMMANDS, main
from app.version import version
from bihdist_core import BiharmonicDistance, farthest_points, field_statistics, read_surface, write_mesh
from tests.commands import ran, refused
from tests.shapes import bumpy, two_pieces

GUIDE = Path(__file__).parents[2] / "assets/guide/reference/command-line.md"

COMMON = {"command", "version", "exit_status", "notes"}
DISTANCE = {"distance", "label", "unit", "accuracy", "accuracy_text", "accuracy_sources"}
FIELD = DISTANCE | {"maximum", "failure"}
LINES = {
    "info": "info a.off --accuracy --solver",
    "field": "field a.off --sources 3,7 -o f.npy",
    "pairs": "pairs a.off --sources 3,7,9 -o p.csv --distance biharmonic,commute-time",
    "isolines": "isolines a.off --sources 3 -o lines.csv --region 20%:40% --region-ids ids.txt",
    "graph": "graph roads.csv --pairs A:B,B:C -o edges.csv",
    "samples": "samples a.off --sources farthest:5:3 -o samples.txt",
    "regions": "regions a.off --sources 3,7 -o labels.csv --boundaries lines.json",
    "profile": "profile a.off --sources 3 --through source,40 -o along.csv --distance biharmonic",
    "statistics": "statistics a.off --sources 3 --distance biharmonic,geodesic --truncation --k 5 "
    "--scatter scatter.csv",
    "interpolate": "interpolate a.off --anchors @anchors.csv -o i.npy",
    "correspond": "correspond a.off b.off --pairs @pairs.csv -o map.txt --truth identity",
    "evaluate": "evaluate a.off b.off identity.txt --truth identity",
    "perturb": "perturb a.off --noise 0.1 -o noisy.off --distance biharmonic --sources 3",
    "figure": "figure a.off --sources 3 --distance biharmonic --size 300px --tex -o figure.png",
    "movie": "movie a.off --sources 3 --distance biharmonic --size 200px --frames 2 --workers 1 -o movie.gif",
    "page": "page a.off --sources 3 --distance biharmonic -o page.html",
    "batch": "batch meshes -o results --do fields --workers 1",
    "desktop": "desktop --install",
    "guide": "guide --where",
    "paper": "paper -o paper --only fig3 --quick --mesh a.off",
}
"""A command line of each command but `view`, which opens a window (`tests/qt/test_mouse.py`)."""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where all of them find what they read."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    write_mesh("a.off", bumpy(120))
    write_mesh("b.off", bumpy(120, 1))
    Path("meshes").mkdir()
    Path("index.html").write_text("the guide")
    monkeypatch.setattr("app.guide_pages.GUIDE", Path("index.html").resolve())
    write_mesh("meshes/a.off", bumpy(120))
    Path("anchors.csv").write_text("vertex,value\n3,0\n40,1\n")
    Path("roads.csv").write_text("A,B,1\nB,C,2\n")
    Path("pairs.csv").write_text("3,3\n40,40\n90,90\n")
    np.savetxt("identity.txt", np.arange(120), "%d")
    return tmp_path


def documented(command):
    """The keys in a command's row of the guide's table, at any depth."""
    (row,) = re.findall(rf"^\| `{command}` \| (.*) \|$", GUIDE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    keys = {word for word in re.findall(r"`([^`]+)`", row) if not word.startswith("--")}
    keys |= DISTANCE if "*D*" in row else FIELD if "*F*" in row else set()
    return COMMON | keys


def keys_in(value):
    if isinstance(value, dict):
        return set(value).union(*map(keys_in, value.values()))
    return set().union(*map(keys_in, value)) if isinstance(value, list) else set()


def said_by(capsys, words):
    """The object that a command prints, and its exit status."""
    capsys.readouterr()
    status = main([*words.split(), "--json"])
    return json.loads(capsys.readouterr().out), status


def test_every_command_but_view_is_tried():
    assert {*LINES, "view"} == set(COMMANDS)


@pytest.mark.parametrize("command", LINES)
def test_the_result_is_one_object_with_the_keys_of_the_guide(folder, capsys, command):
    said, status = said_by(capsys, LINES[command])
    assert status == said["exit_status"] == 0
    assert (said["command"], said["version"]) == (command, version())
    # What fails has a reason, and nothing does.
    assert keys_in(said) - {"reason"} == documented(command) - {"reason"}
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", key) for key in keys_in(said))
    outputs = said.get("outputs", [path for each in said.get("meshes", []) for path in each.get("outputs", [])])
    assert all(Path(path).exists() for path in outputs)
    assert bool(outputs) is (command not in ("info", "evaluate", "guide"))


def test_values_are_those_of_the_library(folder, capsys):
    surface = read_surface("a.off")
    distance = BiharmonicDistance(surface)
    field = distance.from_source(3)
    (info,) = said_by(capsys, "info a.off --accuracy")[0]["meshes"]
    assert [info[name] for name in ("n_vertices", "n_faces", "area")] == [120, surface.n_faces, surface.area]
    assert info["bounds"] == surface.bounds.tolist()
    assert info["distances"][0]["accuracy"] == pytest.approx(distance.accuracy, rel=1e-6)
    assert said_by(capsys, LINES["samples"])[0]["vertices"] == farthest_points(distance, 3, 5).tolist()
    (fields,) = said_by(capsys, "statistics a.off --sources 3")[0]["fields"]
    assert fields["greatest_at"] == int(field.argmax())
    assert fields["quantiles"] == field_statistics(surface, field).quantiles.tolist()
    (row,) = said_by(capsys, LINES["batch"])[0]["results"]
    assert (row["is_new"], row["seconds"] > 0) == (True, True)
    assert said_by(capsys, LINES["batch"])[0]["results"] == [{**row, "is_new": False}]


def test_samples_by_no_distance_name_none(folder, capsys):
    said, _ = said_by(capsys, "samples a.off --sources random:5 -o samples.txt")
    assert len(said["vertices"]) == 5
    assert not DISTANCE & set(said)


def test_all_files_of_a_command_are_outputs(folder, capsys):
    said, _ = said_by(capsys, "profile a.off --through 3,40 -o along.csv --chart along.svg --distance biharmonic")
    assert said["outputs"] == ["along.csv", "along.svg"]
    said, _ = said_by(capsys, "regions a.off --sources 3,7 --region-mesh cut.ply --boundaries lines.json")
    assert said["outputs"] == ["cut.ply", "lines.json"]


def test_meshes_that_a_list_misses_are_counted_and_failures(folder, capsys):
    Path("list.txt").write_text("none.off\n")
    said, status = said_by(capsys, f"{LINES['batch']} --list list.txt")
    assert (status, said["n_meshes"], len(said["results"])) == (1, 2, 1)
    assert [(each["mesh"], each["work"]) for each in said["failures"]] == [("none", "fields")]


def test_a_map_that_is_not_known_somewhere_has_null(folder, capsys):
    Path("nowhere.txt").write_text("-1\n" + "0\n" * 119)
    (row,) = said_by(capsys, "evaluate a.off b.off nowhere.txt --truth identity")[0]["maps"]
    assert (row["mean"], row["n_vertices"]) == (None, 120)


def test_notes_are_in_it_said_or_not(folder, capsys):
    write_mesh("pieces.off", two_pieces())
    for options, is_said in (("", True), (" --quiet", False)):
        main(["field", "pieces.off", "--sources", "3", "-o", "f.npy", "--json", *options.split()])
        out, err = capsys.readouterr()
        (note,) = [note for note in json.loads(out)["notes"] if "2 components" in note]
        assert (note in err) is is_said
        assert bool(err) is is_said


def test_what_fails_is_said_in_it_and_on_standard_error(folder, capsys):
    out, err = ran(capsys, "field", "a.off", "--sources", "999", "-o", "f.npy", "--json", "--quiet", status=2)
    said = json.loads(out)
    assert err == f"bihdist: {said['error']}\n"
    assert "no vertex 999" in said["error"]
    assert set(said) == {"command", "version", "exit_status", "error"}
    assert said["exit_status"] == 2
    said, status = said_by(capsys, "field a.off none.off --sources 3 -o {name}.npy --quiet")
    assert status == said["exit_status"] == 2
    assert [each["mesh"] for each in said["meshes"]] == ["a.off"]
    assert [(each["mesh"], "no file none.off" in each["reason"]) for each in said["failures"]] == [("none.off", True)]


def test_results_with_gaps_say_what_is_missing(folder, capsys, no_exact_geodesics):
    by = "--distance biharmonic,geodesic --method exact"
    said, status = said_by(capsys, f"figure a.off --sources 3 {by} --size 300px -o figure.svg")
    assert status == said["exit_status"] == 1
    assert [bool(panel["failure"]) for panel in said["panels"]] == [False, True]
    assert "no room for windows" in said["panels"][1]["failure"]
    Path("meshes/torn.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    said, status = said_by(capsys, LINES["batch"])
    assert status == said["exit_status"] == 1
    (failure,) = said["failures"]
    assert (failure["mesh"], failure["work"], failure["distance"]) == ("torn", "fields", "biharmonic")
    assert [each["mesh"] for each in said["results"]] == ["a"]
    assert all(Path(path).exists() for path in said["outputs"])
    assert len(said["outputs"]) == 2


def test_standard_output_has_one_of_both(folder, capsys):
    assert "either the file or the JSON" in refused(capsys, "field", "a.off", "--sources", "3", "-o", "-", "--json")


def test_numbers_that_json_does_not_know_are_null():
    facts = {"array": np.array([1.0, np.nan]), "infinite": -np.inf, "number": np.int64(3), "pair": (1, {"root": "√"})}
    said = as_json("info", 0, facts)
    assert said.isascii()
    assert {name: json.loads(said)[name] for name in facts} == {
        "array": [1.0, None], "infinite": None, "number": 3, "pair": [1, {"root": "√"}]
    }  # fmt: skip
