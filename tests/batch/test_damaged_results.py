"""Results and what stands beside them: changed on disk, damaged, or of others."""

import json
import os
import shutil

import numpy as np
import pytest

from app.batch.results import existing_metadata, read_arrays, write_result
from app.batch.storage import Folder
from app.batch.work_order import thumbnail_name
from bihdist_core import OutputError, write_mesh
from tests.batch.runs import batch, rows
from tests.shapes import bumpy


@pytest.fixture
def meshes(tmp_path):
    folder = tmp_path / "meshes"
    folder.mkdir()
    write_mesh(folder / "bumpy.off", bumpy(100))
    return folder


def changed(path, at=-1):
    """One byte of a file is another, its size and times are the same."""
    content, before = bytearray(path.read_bytes()), path.stat()
    content[at] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


@pytest.mark.parametrize("format", ["npy", "npz", "mat", "zarr"])
def test_what_has_changed_on_disk_is_made_again_where_it_is_looked_at(meshes, tmp_path, format):
    if format == "zarr":
        pytest.importorskip("zarr")
    out, name = tmp_path / "out", f"bumpy.fields.biharmonic.{format}"
    work = ("--do", "fields", "--sources", "5,7", "--format", format)
    assert batch(meshes, out, *work) == 0
    there = read_arrays(Folder(str(out)), name)
    files = [each for each in (out / name).rglob("*") if each.is_file() and each.name != "zarr.json"]
    changed(files[0] if files else out / name, -9)
    assert batch(meshes, out, *work) == 0
    with pytest.raises((AssertionError, OutputError)):
        assert all(np.array_equal(array, there[key]) for key, array in read_arrays(Folder(str(out)), name).items())
    assert batch(meshes, out, *work, "--verify") == 0
    again = read_arrays(Folder(str(out)), name)
    assert again.keys() == there.keys()
    assert all(np.array_equal(array, there[key]) for key, array in again.items())


def test_what_is_as_it_was_is_not_made_again(meshes, tmp_path, capsys):
    assert batch(meshes, tmp_path / "out", "--do", "fields,figure", "--sources", "5") == 0
    capsys.readouterr()
    assert batch(meshes, tmp_path / "out", "--do", "fields,figure", "--sources", "5", "--verify") == 0
    assert "2 of them there before" in capsys.readouterr().out


def test_checksums_stand_in_the_json_and_are_of_the_bytes(tmp_path):
    import hashlib

    folder = Folder(str(tmp_path))
    facts = write_result(folder, "a", "key", {"a": np.arange(9)}, {}, 0.0)
    assert facts["sha256"] == hashlib.sha256((tmp_path / "a.npy").read_bytes()).hexdigest()
    assert existing_metadata(folder, "a", "key", verify=True) == json.loads((tmp_path / "a.json").read_text())
    elsewhere = Folder("memory://checksums")
    elsewhere.make()
    there = write_result(elsewhere, "a", "key", {"a": np.arange(9)}, {}, 0.0)
    assert there["sha256"] == facts["sha256"]
    assert existing_metadata(elsewhere, "a", "key", verify=True)


def test_a_mesh_whose_name_is_too_long_for_results_is_a_failure_and_costs_no_other(meshes, tmp_path, capsys):
    write_mesh(meshes / f"{'x' * 245}.off", bumpy(80))
    assert batch(meshes, tmp_path / "out", "--do", "fields", "--sources", "5") == 1
    assert [row["mesh"] for row in rows(tmp_path / "out")] == ["bumpy"]
    (failure,) = rows(tmp_path / "out", "failures")
    assert "cannot be written (File name too long); rename the mesh." in failure["reason"]
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize("ending", ["json", "npy"])
def test_a_folder_in_the_place_of_a_result_stays_and_is_a_failure(meshes, tmp_path, ending):
    kept = tmp_path / "out" / f"bumpy.fields.biharmonic.{ending}" / "kept.txt"
    kept.parent.mkdir(parents=True)
    kept.write_text("mine")
    assert batch(meshes, tmp_path / "out", "--do", "fields", "--sources", "5") == 1
    (failure,) = rows(tmp_path / "out", "failures")
    assert failure["reason"].endswith("is a folder, and a result would have this name; move it.")
    assert kept.read_text() == "mine"


@pytest.mark.parametrize("text", ["[" * 1000 + "]" * 1000, "[" * 100_000, "{", "7", "\x00", '{"key": "' + "x" * 5000])
def test_a_json_that_is_none_of_ours_is_no_result(meshes, tmp_path, text):
    out = tmp_path / "out"
    out.mkdir()
    (out / "bumpy.fields.biharmonic.json").write_text(text)
    assert batch(meshes, out, "--do", "fields", "--sources", "5") == 0
    assert json.loads((out / "bumpy.fields.biharmonic.json").read_text())["shape"] == [100, 1]


def test_a_json_of_a_stranger_removes_no_file_elsewhere(tmp_path):
    out, mine = tmp_path / "out", tmp_path / "mine.npy"
    out.mkdir()
    mine.write_text("mine")
    (out / "a.json").write_text(json.dumps({"file": "a./../../mine.npy"}))
    (out / "a.").mkdir()
    write_result(Folder(str(out)), "a", "key", {"a": np.arange(3)}, {}, 0.0)
    assert mine.read_text() == "mine"


def test_a_damaged_file_is_named_where_it_is_read(tmp_path):
    (tmp_path / "a.npy").write_bytes(b"nothing")
    (tmp_path / "a.npz").write_bytes(b"nothing")
    for name in ("a.npy", "a.npz"):
        with pytest.raises(OutputError, match=rf"{name} is damaged; run the same command with --verify"):
            read_arrays(Folder(str(tmp_path)), name)


def test_a_damaged_part_is_made_again(meshes, tmp_path, monkeypatch):
    from app.batch import execution
    from app.batch.execution import run_task
    from app.batch.scheduler import run_tasks, tasks_for
    from app.batch.work_order import Sources, WorkOrder

    monkeypatch.setattr(execution, "PART_BYTES", 8 * 100 * 40)
    wanted = WorkOrder(works=("fields",), sources=Sources("all"))
    out = tmp_path / "out"
    out.mkdir()
    mesh = {"bumpy": str(meshes / "bumpy.off")}

    class Here:
        """An engine that damages the first part once."""

        def __init__(self, damages):
            self.waiting, self.damages = [], damages

        def submit(self, task):
            self.waiting.append(task)

        def reports(self):
            while self.waiting:
                task = self.waiting.pop(0)
                if self.damages and task.part is not None and task.part.is_whole:
                    (first, *_) = sorted((out / ".parts").rglob("*.npy"))
                    first.write_bytes(b"\x93NUMPY\x01\x00\x05\x00'''  ")
                yield run_task(task)

    tasks, _ = tasks_for(mesh, wanted, str(out), "1")
    outcome = run_tasks(tasks, Here(True), lambda *_: None)
    assert "is missing or damaged" in outcome.failures[0].reason
    outcome = run_tasks(tasks, Here(False), lambda *_: None)
    assert not outcome.failures
    assert np.load(out / "bumpy.fields.biharmonic.npy").shape == (100, 100)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes in folders")
def test_a_pipe_in_the_place_of_a_result_is_not_waited_for(meshes, tmp_path):
    (tmp_path / "out").mkdir()
    os.mkfifo(tmp_path / "out" / "bumpy.fields.biharmonic.json")
    assert batch(meshes, tmp_path / "out", "--do", "fields", "--sources", "5") == 1
    (failure,) = rows(tmp_path / "out", "failures")
    assert "is not a regular file" in failure["reason"]


# ---------------------------------------------------------------------- damaged facts
@pytest.mark.parametrize(
    "damage",
    [
        {"accuracy": {}},
        {"accuracy": 10**400},
        {"seconds": "long"},
        {"mean": [1]},
        {"shape": 100},
        {"shape": ["100", "2"]},
        {"repairs": [None]},
        {"repairs": "none"},
    ],
    ids=str,
)
def test_facts_of_other_kinds_are_of_no_result(tmp_path, damage, capsys):
    write_mesh(tmp_path / "bumpy.off", bumpy(60))
    work = (tmp_path / "bumpy.off", tmp_path / "out", "--do", "fields", "--sources", "5,7")
    assert batch(*work) == 0
    facts = next((tmp_path / "out").glob("*.json"))
    sound, table = json.loads(facts.read_text()), rows(tmp_path / "out")
    facts.write_text(json.dumps({**sound, **damage}))
    capsys.readouterr()
    assert batch(*work) == 0
    assert "there before" not in capsys.readouterr().out
    assert {**json.loads(facts.read_text()), "seconds": 0} == {**sound, "seconds": 0}
    assert [{**row, "seconds": ""} for row in rows(tmp_path / "out")] == [{**row, "seconds": ""} for row in table]
    assert np.load(tmp_path / "out" / sound["file"]).shape == (60, 2)


# ---------------------------------------------------------------------- damaged figures
FACTS = "bumpy.figure.json"


@pytest.fixture(scope="module")
def there(tmp_path_factory):
    """A mesh, and its figure in a folder."""
    place = tmp_path_factory.mktemp("drawn")
    write_mesh(place / "bumpy.off", bumpy(60))
    assert batch(place / "bumpy.off", place / "out", "--do", "figure") == 0
    return place


@pytest.fixture
def drawn(there, tmp_path):
    shutil.copytree(there, tmp_path, dirs_exist_ok=True)
    return tmp_path


def again(drawn, *options):
    return batch(drawn / "bumpy.off", drawn / "out", "--do", "figure", *options)


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda facts: facts.pop("panels"), "figure has no 'panels'"),
        (lambda facts: facts.update(panels={}), "figure.panels must be a list, not {}"),
        (lambda facts: facts["panels"].append(5), "figure.panels[1] must be an object in braces, not 5"),
        (lambda facts: facts["panels"][0].pop("unit"), "figure.panels[0] has no 'unit'"),
        (
            lambda facts: facts["panels"][0].update(maximum="long"),
            'figure.panels[0].maximum must be a number, not "long"',
        ),
        (lambda facts: facts["panels"][0].update(of_set=[1]), "figure.panels[0].of_set must be a text, not [1]"),
        (lambda facts: facts.update(range=None), "figure.range must be a text, not null"),
        (lambda facts: facts.pop("n_vertices"), "figure has no 'n_vertices'"),
        (
            lambda facts: facts.update(file="other.png"),
            'figure.file must be bumpy.figure.png, not "other.png"',
        ),
    ],
)
def test_facts_that_are_damaged_are_named(drawn, capsys, damage, reason):
    out = drawn / "out"
    facts = json.loads((out / FACTS).read_text())
    damage(facts)
    (out / FACTS).write_text(json.dumps(facts))
    shutil.copy(out / "bumpy.figure.png", out / "other.png")
    capsys.readouterr()
    assert again(drawn) == 2
    said = capsys.readouterr().err.splitlines()[-1]
    remedy = "delete it and run the same command to draw the figure again."
    assert said == f"bihdist: {out}/{FACTS}: {reason}; {remedy}"
    assert [row["file"] for row in rows(out)] == [facts["file"]]
    (out / FACTS).unlink()
    assert again(drawn) == 0


def test_pictures_that_are_damaged_are_made_anew_or_named(drawn, capsys):
    out, small = drawn / "out", drawn / "out" / thumbnail_name("bumpy")
    before = small.read_bytes()
    small.write_bytes(b"no picture")
    assert again(drawn) == 0
    assert small.read_bytes() == before
    small.unlink()
    figure = out / "bumpy.figure.png"
    figure.write_bytes(b"x" * figure.stat().st_size)
    capsys.readouterr()
    assert again(drawn) == 2
    remedy = "run the same command with --verify to draw it again."
    assert capsys.readouterr().err.splitlines()[-1] == f"bihdist: {figure} is not a picture; {remedy}"
    assert again(drawn, "--verify") == 0


@pytest.mark.parametrize("name", ["maxima", "scales"])
def test_maxima_of_other_kinds_are_found_again(drawn, name):
    out = drawn / "out"
    (facts,) = (path for path in out.rglob("*.json") if "maxima" in json.loads(path.read_text()))
    facts.write_text(json.dumps({**json.loads(facts.read_text()), name: ["long"]}))
    assert again(drawn) == 0
    assert Folder(str(out)).size("index.html")
