"""Where tasks run: processes and a Dask cluster give the same bytes, and survive what ends a worker."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from app.batch import engines, memory
from app.batch.engines import Processes
from app.batch.execution import run_task
from app.batch.mesh_files import find_mesh_files
from app.batch.scheduler import run_tasks, tasks_for
from app.batch.storage import Folder
from app.batch.task import existing_report
from app.batch.work_order import WorkOrder
from app.document.sources import Sources
from app.main import main
from bihdist_core import BiharmonicDistance, read_surface, write_mesh
from bihdist_core.file_output import lock
from tests.commands import refused
from tests.programs import ROOT, run_python
from tests.shapes import bumpy, torus
from tests.waiting import PATIENCE


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("meshes")
    write_mesh(place / "ring.off", torus(16, 8))
    for k in range(4):
        write_mesh(place / f"bumpy{k}.off", bumpy(300 + 10 * k, k))
    return place


def files(out):
    """All results but the table and the lines with times."""
    return {
        str(path.relative_to(out)): re.sub(rb'"seconds": [\d.]+', b"", path.read_bytes())
        for path in Path(out).rglob("*")
        if path.is_file() and path.name != "summary.csv"
    }


WORK = ("--do", "fields,pairs,eigen,figure", "--sources", "farthest:8", "--k", "5", "--clim", "own")


@pytest.fixture(scope="module")
def done(folder, tmp_path_factory):
    out = tmp_path_factory.mktemp("out")
    assert main(["batch", str(folder), "-o", str(out), "--workers", "2", *WORK]) == 0
    return out


# ---------------------------------------------------------------------- Dask
def test_a_cluster_that_loses_a_worker_makes_the_same_bytes(folder, done, tmp_path):
    distributed = pytest.importorskip("distributed")
    # In a process of its own, as a user's cluster is: its threads and warnings are not those of the tests.
    script = tmp_path / "cluster.py"
    script.write_text(CLUSTER)
    done_there = run_python(script, folder, tmp_path / "out", *WORK, PYTHONPATH=str(ROOT))
    assert done_there.returncode == 0, done_there.stderr
    assert "killed" in done_there.stdout
    assert files(tmp_path / "out") == files(done)
    assert distributed.__version__


CLUSTER = """
import os, signal, subprocess, sys, time
from pathlib import Path
from distributed import LocalCluster

if __name__ == "__main__":
    folder, out, *options = sys.argv[1:]
    with LocalCluster(n_workers=2, threads_per_worker=1, memory_limit="4GiB", dashboard_address=None) as cluster:
        where = ["--dask", cluster.scheduler_address]
        run = subprocess.Popen([sys.executable, "-m", "app", "batch", folder, "-o", out, *options, *where])
        while not list(Path(out).glob("*.json")) and run.poll() is None:
            time.sleep(0.01)
        (worker, *_) = cluster.workers.values()
        os.kill(worker.pid, signal.SIGKILL)
        print("killed", worker.pid)
        sys.exit(run.wait())
"""


SMALL_AND_LARGE = """
import subprocess, sys
from distributed import LocalCluster

if __name__ == "__main__":
    folder, out = sys.argv[1:]
    one = dict(n_workers=1, threads_per_worker=1, dashboard_address=None)
    with LocalCluster(memory_limit="450MB", **one) as cluster:
        address = cluster.scheduler_address
        words = [sys.executable, "-m", "app", "batch", folder, "-o", out, "--do", "figure", "--clim", "own"]
        alone = subprocess.run([*words, "--dask", address], capture_output=True, text=True)
        print(alone.returncode, alone.stderr)
        more = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--memory-limit", "4GB"]
        with subprocess.Popen([*more, "--nthreads", "1", "--no-dashboard"], stderr=subprocess.DEVNULL) as worker:
            with cluster.get_client() as client:
                client.wait_for_workers(2)
            both = subprocess.run([*words, "--dask", address], capture_output=True, text=True)
            worker.terminate()
        print(both.returncode, both.stderr)
"""


def test_what_is_too_big_for_a_worker_goes_to_a_larger_one_or_is_refused(folder, tmp_path):
    pytest.importorskip("distributed")
    script = tmp_path / "cluster.py"
    script.write_text(SMALL_AND_LARGE)
    ended = run_python(script, folder, tmp_path / "out", PYTHONPATH=str(ROOT))
    assert ended.returncode == 0, ended.stderr
    alone, both = ended.stdout.split("\n0 ")
    assert alone.startswith("1 ")
    assert "It needs about 0.6 GB of memory, and there are 0.5 GB" in alone
    assert "5 of 5" in both
    assert len(list((tmp_path / "out").glob("*.figure.png"))) == 5


def test_a_cluster_that_has_not_this_version_is_refused(folder, tmp_path):
    pytest.importorskip("distributed")
    script = tmp_path / "cluster.py"
    script.write_text(WITHOUT_IT)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    words = [sys.executable, "-P", str(script), str(folder), str(tmp_path / "out")]
    run = subprocess.run(words, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=PATIENCE)
    assert run.stdout.startswith("2 ")
    assert "the same version of bihdist" in run.stdout


def test_a_scheduler_that_never_writes_its_file_is_not_waited_for(folder, tmp_path, monkeypatch, capsys):
    pytest.importorskip("distributed")
    monkeypatch.setattr(engines, "SCHEDULER_WAIT_S", 0.3)
    assert main(["batch", str(folder), "-o", str(tmp_path), "--do", "fields", "--dask", "none.json"]) == 2
    assert "No scheduler has written none.json" in capsys.readouterr().err


WITHOUT_IT = """
import subprocess, sys
from distributed import LocalCluster

if __name__ == "__main__":
    for name in ("app", "bihdist"):
        sys.modules[name] = None
    folder, out = sys.argv[1:]
    with LocalCluster(n_workers=0, dashboard_address=None) as cluster:
        words = [sys.executable, "-m", "app", "batch", folder, "-o", out, "--do", "fields"]
        run = subprocess.run([*words, "--dask", cluster.scheduler_address], capture_output=True, text=True)
        print(run.returncode, run.stderr)
"""


# ---------------------------------------------------------------------- processes
def tasks_of(folder, out, wanted):
    tasks, failures = tasks_for(find_mesh_files([str(folder)]).paths, wanted, str(out), "1")
    assert not failures
    return tasks


def driven(tasks, engine):
    try:
        return run_tasks(tasks, engine, lambda *_: None)
    finally:
        engine.close()


def test_a_process_that_is_killed_costs_nothing(folder, done, tmp_path):
    wanted = WorkOrder(("fields", "eigen"), sources=Sources("farthest", count=30), eigenpairs=60)
    engine = Processes(2)
    tasks = tasks_of(folder, tmp_path, wanted)

    def kill() -> None:
        while not list(tmp_path.glob("*.json")):
            time.sleep(0.005)
        os.kill(next(iter(engine._pool._processes)), signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    outcome = driven(tasks, engine)
    killer.join()
    assert not outcome.failures
    assert len(outcome.rows) == 10


@pytest.mark.parametrize("workers", [1, 2])
def test_a_process_that_ends_between_two_tasks_costs_nothing(folder, tmp_path, workers):
    engine = Processes(workers)
    tasks = tasks_of(folder, tmp_path, WorkOrder(("fields",)))

    def kill(report, done, of) -> None:
        if done == 1:
            pool = engine._pool
            os.kill(next(iter(pool._processes)), signal.SIGKILL)
            while not pool._broken:
                time.sleep(0.005)

    try:
        outcome = run_tasks(tasks, engine, kill)
    finally:
        engine.close()
    assert not outcome.failures
    assert len(outcome.rows) == 5


def test_what_ends_its_process_again_and_again_is_named(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(engines, "run_task", _do_or_die)
    outcome = driven(tasks_of(folder, tmp_path, WorkOrder(("fields",))), Processes(2))
    (failure,) = outcome.failures
    assert failure.name == "bumpy3"
    assert "ended twice" in failure.reason
    assert len(outcome.rows) == 4


def _do_or_die(task):
    if task.name == "bumpy3":
        os.kill(os.getpid(), signal.SIGKILL)
    return run_task(task)


def test_what_needs_more_memory_than_there_is_is_refused_in_words(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "available", lambda: 10**8)
    (task, *_) = tasks_of(folder, tmp_path, WorkOrder(("fields",)))
    report = run_task(task)
    assert report.needs > 10**8
    (failure,) = engines.refused_report(report, 10**8).failures
    assert "It needs about 0.3 GB of memory, and there are 0.1 GB" in failure.reason


def test_tasks_begin_when_there_is_room_for_them(folder, tmp_path, monkeypatch):
    """Each needs 0.26 GB: three times 0.2 GB are their shares, two of them have room at once."""
    engine, most, start = Processes(3, 6 * 10**8), [], Processes._start

    def counted(self, task):
        start(self, task)
        most.append(sum(map(self._bytes, self._under_way.values())))

    monkeypatch.setattr(Processes, "_start", counted)
    outcome = driven(tasks_of(folder, tmp_path, WorkOrder(("fields",))), engine)
    assert not outcome.failures
    assert len(outcome.rows) == 5
    assert len(most) == 10  # each begins twice: only a look at the mesh says what it needs
    assert max(most) <= 6 * 10**8


def test_what_has_no_room_even_alone_is_refused(folder, tmp_path):
    outcome = driven(tasks_of(folder, tmp_path, WorkOrder(("fields",))), Processes(2, 10**8))
    assert not outcome.rows
    assert {each.reason[:48] for each in outcome.failures} == {"It needs about 0.3 GB of memory, and there are 0"}


def test_all_pairs_and_what_is_joined_in_memory_count():
    asked = {
        (work, arrays): memory.needed(5_500, WorkOrder((work,), sources=Sources("all"), arrays=arrays))
        for work in ("fields", "pairs")
        for arrays in ("npy", "mat")
    }
    assert asked["pairs", "npy"] > 1.57e9  # measured, in a process of its own
    assert asked["fields", "npy"] > 0.35e9
    large = WorkOrder(("pairs",), sources=Sources("all"), arrays="mat")
    assert memory.needed(20_000, large) > 20_000**2 * 8
    assert memory.needed(20_000, large) > 1.5 * memory.needed(20_000, WorkOrder(("pairs",), sources=Sources("all")))


def test_more_memory_is_asked_for_than_is_used(tmp_path):
    """Peaks of processes of their own, at sizes beside those it was measured at."""
    script = (
        "import sys; import numpy as np; from bihdist_core import BiharmonicDistance; from tests.shapes import bumpy; "
        "from tests.bench.child import peak_memory; "
        "BiharmonicDistance(bumpy(int(sys.argv[1]))).from_sources(np.arange(100)); print(peak_memory())"
    )
    for n in (3_000, 40_000):
        peak = int(run_python("-c", script, n).stdout)
        asked = memory.needed(n, WorkOrder(("fields",), sources=Sources("farthest", count=100)))
        assert peak < asked < 4 * peak


# ---------------------------------------------------------------------- parts
@pytest.mark.parametrize("arrays", ["npy", "npz", "zarr"])
def test_parts_of_a_large_mesh_are_put_together(folder, tmp_path, monkeypatch, arrays):
    if arrays == "zarr":
        zarr = pytest.importorskip("zarr")
    monkeypatch.setattr("app.batch.execution.PART_BYTES", 8 * 128 * 30)
    wanted = WorkOrder(("fields", "pairs"), sources=Sources("all"), arrays=arrays)
    (task,) = [t for t in tasks_of(folder, tmp_path, wanted) if t.name == "ring"]
    outcome = driven([task], InTurn())
    assert {row.work for row in outcome.rows} == {"fields", "pairs"}
    assert not outcome.failures
    distance = BiharmonicDistance(read_surface(folder / "ring.off"))
    rows = distance.from_sources(np.arange(128))
    for name, first in (("fields", "fields"), ("pairs", "dist")):
        path = tmp_path / f"ring.{name}.biharmonic.{arrays}"
        found = zarr.open_group(path, mode="r") if arrays == "zarr" else np.load(path)
        found = found if arrays == "npy" else found[first][...]
        np.testing.assert_allclose(found, rows if name == "fields" else rows.T, atol=1e-12)
    assert not list((tmp_path / ".parts").glob("*"))
    assert existing_report(task) is not None


def test_parcels_of_a_large_mesh_are_added_up(folder, tmp_path, monkeypatch):
    monkeypatch.setattr("app.batch.execution.PART_COLUMNS", 50)
    labels = tmp_path / "labels.npy"
    np.save(labels, np.arange(128) % 3)
    wanted = WorkOrder(("pairs",), labels=str(labels))
    (task,) = [t for t in tasks_of(folder, tmp_path, wanted) if t.name == "ring"]
    counted = InTurn()
    assert not driven([task], counted).failures
    assert counted.count == 5  # the mesh, three parts, all together
    rows = BiharmonicDistance(read_surface(folder / "ring.off")).from_sources(np.arange(128))
    of = [np.arange(128) % 3 == k for k in range(3)]
    expected = [[rows[np.ix_(a, b)].mean() for b in of] for a in of]
    np.testing.assert_allclose(np.load(tmp_path / "ring.pairs.biharmonic.npy"), expected, rtol=1e-9)


class InTurn:
    """An engine that does one task after the other, here."""

    def __init__(self):
        self.waiting, self.count = [], 0

    def submit(self, task):
        self.waiting.append(task)

    def reports(self):
        while self.waiting:
            self.count += 1
            yield run_task(self.waiting.pop(0))

    def close(self):
        pass


def test_what_killed_processes_left_half_written_is_swept_away(tmp_path):
    half = [".cat.half-0123abcd.npy", ".cat.half-01234567.json", ".dog.half-0123abcd.npy"]
    for name in ("cat.npy", "cat.json", *half, ".cat.npy", ".cat-0123abcd.npy"):
        (tmp_path / name).write_text("x")
    with lock(tmp_path / half[2]):  # as another run does that writes there
        Folder(str(tmp_path)).sweep()
    left = {"cat.npy", "cat.json", half[2], ".cat.npy", ".cat-0123abcd.npy"}
    assert {path.name for path in tmp_path.iterdir()} == left


# ---------------------------------------------------------------------- elsewhere
def test_results_go_wherever_fsspec_reaches(folder):
    wanted = WorkOrder(("fields", "eigen"), eigenpairs=5)
    tasks = tasks_of(folder, "memory://results", wanted)
    outcome = driven(tasks, InTurn())
    assert not outcome.failures
    assert len(outcome.rows) == 10
    place = Folder("memory://results")
    content = place.read("ring.fields.biharmonic.npy")
    assert content is not None
    assert len(content) == place.size("ring.fields.biharmonic.npy")
    assert not [row for row in driven(tasks, InTurn()).rows if row.is_new]
    assert place.read("nothing") is None


def test_an_address_that_nothing_reaches_is_said(folder, capsys):
    assert "nowhere://x cannot be reached" in refused(capsys, "batch", folder, "-o", "nowhere://x", "--do", "fields")
