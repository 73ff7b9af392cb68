"""Large meshes in parts, tasks that are done again, and results that share a name: nothing is lost or mistaken."""

import gc
import json
import weakref
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from app.batch import execution
from app.batch.execution import mesh_of, run_task
from app.batch.maps import found_maps
from app.batch.memory import needed
from app.batch.mesh_files import find_mesh_files
from app.batch.scheduler import tasks_for
from app.batch.storage import Folder
from app.batch.task import existing_report
from app.batch.work_order import WorkOrder
from app.document.sources import Sources
from bihdist_core import GeodesicDistance, read_surface, write_mesh
from tests.shapes import bumpy, torus

HEAT = "geodesic(method=heat)"


@pytest.fixture
def mesh(tmp_path):
    write_mesh(tmp_path / "ring.off", torus(16, 8))
    return tmp_path / "ring.off"


def task_for(mesh, out, *works, **options):
    (task,), failures = tasks_for(find_mesh_files([str(mesh)]).paths, WorkOrder(works, **options), str(out), "1")
    assert not failures
    return task


def in_parts(monkeypatch):
    monkeypatch.setattr(execution, "PART_BYTES", 8 * 128 * 30)


def finish(report):
    """Do the parts that a report leads to; the task that puts them together."""
    parts = [task for task in report.more if task.part]
    for part in parts:
        assert not run_task(part).failures
    return replace(parts[0], part=replace(parts[0].part, is_whole=True))


# ---------------------------------------------------------------------- parts
@pytest.mark.parametrize("words", ["biharmonic", HEAT])
def test_pairs_in_parts_are_those_at_first_failures(mesh, tmp_path, monkeypatch, words):
    options = {"sources": Sources("all"), "distances": (words,)}
    (row,) = run_task(task_for(mesh, tmp_path / "whole", "pairs", **options)).rows
    whole = np.load(tmp_path / "whole" / row.metadata["file"])
    in_parts(monkeypatch)
    join = finish(run_task(task_for(mesh, tmp_path / "out", "pairs", **options)))
    (row,) = run_task(join).rows
    found = np.load(tmp_path / "out" / row.metadata["file"])
    assert np.abs(found - whole).max() <= 1e-12 * whole.max()
    assert (np.diag(found) == 0).all()
    if words == HEAT:
        assert (found == found.T).all(), "the heat method is not the same both ways"
        assert not GeodesicDistance(read_surface(mesh), "heat").is_symmetric


def test_what_has_been_put_together_is_not_lost_when_it_is_asked_for_again(mesh, tmp_path, monkeypatch):
    in_parts(monkeypatch)
    task = task_for(mesh, tmp_path / "out", "fields", sources=Sources("all"))
    first = run_task(task)
    join = finish(first)
    (row,) = run_task(join).rows
    before = (tmp_path / "out" / row.metadata["file"]).read_bytes()
    assert row.metadata["seconds"] > 0
    for again in (join, first.more[0], join):
        report = run_task(again)
        assert not report.failures
    assert report.rows[0].metadata == row.metadata
    assert (tmp_path / "out" / row.metadata["file"]).read_bytes() == before
    assert existing_report(task) is not None
    assert not list((tmp_path / "out").glob(".parts/*"))


def test_what_is_put_together_has_the_seconds_of_all_its_parts(mesh, tmp_path, monkeypatch):
    in_parts(monkeypatch)
    task = task_for(mesh, tmp_path / "out", "fields", sources=Sources("all"))
    finish(run_task(task))
    kept = sorted((tmp_path / "out").glob(".parts/*/*.seconds"))
    assert len(kept) == len(list((tmp_path / "out").glob(".parts/*/*.npy"))) > 3
    for path in kept:
        assert float(path.read_text()) >= 0
        path.write_text("1000.25")
    # Parts of an earlier run are not done again, and count.
    (row,) = run_task(finish(run_task(task))).rows
    assert row.metadata["seconds"] == pytest.approx(1000.25 * len(kept), abs=60)
    assert existing_report(task).rows[0].metadata == row.metadata


def test_meshes_of_one_content_have_parts_of_their_own(mesh, tmp_path, monkeypatch):
    in_parts(monkeypatch)
    (tmp_path / "twin.off").write_bytes(mesh.read_bytes())
    joins = [
        finish(run_task(task_for(path, tmp_path / "out", "fields", sources=Sources("all"))))
        for path in (mesh, tmp_path / "twin.off")
    ]
    assert [len(run_task(join).failures) for join in joins] == [0, 0]


def test_threads_of_a_worker_have_each_their_own_mesh(tmp_path):
    for k in range(4):
        write_mesh(tmp_path / f"m{k}.off", bumpy(40 + k))
    asked = [task_for(tmp_path / f"m{k}.off", tmp_path / "out", "fields") for k in range(4)]
    with ThreadPoolExecutor(4) as pool:
        names = list(pool.map(lambda k: mesh_of(asked[k % 4]).name, range(200)))
    assert names == [f"m{k % 4}" for k in range(200)]


def test_the_memory_of_a_mesh_is_returned_before_the_next_one(mesh, tmp_path, monkeypatch):
    write_mesh(tmp_path / "next.off", bumpy(40))
    works = {"sources": Sources("farthest", count=4), "distances": ("biharmonic", HEAT)}
    assert not run_task(task_for(mesh, tmp_path / "out", "fields", "pairs", "fps", **works)).failures
    last = weakref.ref(execution._last[1].distances.laplacian)
    are_alive = []
    monkeypatch.setattr(execution, "release_freed", lambda: are_alive.append(last() is not None))
    gc.disable()
    try:
        assert not run_task(task_for(tmp_path / "next.off", tmp_path / "out", "fields")).failures
    finally:
        gc.enable()
    assert are_alive == [False]


# ---------------------------------------------------------------------- keys and names
def test_a_layout_has_the_distance_that_was_asked_for_last(mesh, tmp_path):
    out, options = tmp_path / "out", {"sources": Sources("all"), "layout": "dist"}
    ways = [task_for(mesh, out, "pairs", distances=(word,), **options) for word in ("geodesic", "biharmonic")]
    run_task(ways[0])
    run_task(ways[1])
    assert existing_report(ways[0]) is None, "its file holds the other"
    (row,) = run_task(ways[0]).rows
    assert (row.is_new, row.metadata["distance"]) == (True, "geodesic(method=auto)")
    from scipy.io import loadmat

    expected = GeodesicDistance(read_surface(mesh)).pairwise(np.arange(128))
    np.testing.assert_allclose(loadmat(out / "dist/ring.mat")["dist"], expected, atol=1e-9)


def test_a_file_counts_for_what_it_is(mesh, tmp_path):
    task = task_for(mesh, tmp_path / "out", "pairs", labels=str(mesh), mask="")
    other = task_for(mesh, tmp_path / "out", "pairs", mask=str(mesh), sources=Sources("all"))
    assert task.checksums == other.checksums
    assert task.read("pairs")[1].keys() == {"labels"}
    assert task.key("pairs", "biharmonic") != other.key("pairs", "biharmonic")


def test_maps_of_one_name_are_refused(mesh, tmp_path):
    maps = tmp_path / "maps"
    maps.mkdir()
    np.save(maps / "ring-twin.npy", np.arange(128))
    (maps / "ring-twin.txt").write_text("0\n")
    found, reasons = found_maps(str(maps), {"ring": str(mesh), "twin": str(mesh)}, "identity", "", 0)
    assert not found
    assert "ring-twin.npy and" in reasons["ring-twin"]
    assert "have the same name" in reasons["ring-twin"]


@pytest.mark.parametrize("formats", [("npy", "npz"), ("npz", "zarr"), ("zarr", "mat")])
def test_another_format_takes_the_place_of_the_one_before(mesh, tmp_path, formats):
    if "zarr" in formats:
        pytest.importorskip("zarr")
    out = tmp_path / "out"
    for format in formats:
        (row,) = run_task(task_for(mesh, out, "fields", arrays=format)).rows
    (json_file,) = out.glob("*.json")
    assert json.loads(json_file.read_text()) == row.metadata
    assert {path.name for path in out.iterdir()} == {json_file.name, row.metadata["file"]}


def test_zarr_is_whole_or_absent(tmp_path):
    folder = Folder(str(tmp_path))

    def fail():
        with folder.writing_folder("a.zarr") as begun:
            (tmp_path / begun).mkdir()
            raise ValueError("stopped")

    with pytest.raises(ValueError, match="stopped"):
        fail()
    assert not list(tmp_path.iterdir())
    # What a process has left that was killed.
    (tmp_path / ".a.half-0123abcd.zarr" / "whole").mkdir(parents=True)
    with folder.writing_folder("a.zarr") as begun:
        (tmp_path / begun).mkdir()
        folder.sweep()  # as another run does that has ended
        assert not (tmp_path / ".a.half-0123abcd.zarr").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["a.zarr"]


# ---------------------------------------------------------------------- memory
def test_sources_of_a_file_count():
    wanted = WorkOrder(("fields",), sources=Sources("file", file="x"), arrays="npz")
    farthest = WorkOrder(("fields",), sources=Sources("farthest", count=5000), arrays="npz")
    assert needed(20_000, wanted, 5000) == needed(20_000, farthest) > needed(20_000, wanted)


def test_a_task_with_many_sources_in_a_file_asks_for_their_memory(mesh, tmp_path, monkeypatch):
    marks = tmp_path / "marks.txt"
    marks.write_text("".join(f"{k}\n" for k in range(100)))
    asked = []
    monkeypatch.setattr(execution, "needed", lambda n, wanted, from_file: asked.append((n, from_file)) or 0)
    run_task(task_for(mesh, tmp_path / "out", "fields", sources=Sources("file", file=str(marks))))
    assert asked == [(128, 100)]
