"""What ends a command, its processes or its cluster: the tables say what is there and what is not."""

import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

from app.batch.engines import Processes
from app.batch.execution import PARTS
from app.batch.mesh_files import find_mesh_files
from app.batch.scheduler import run_tasks, tasks_for
from app.batch.task import Report, TaskPart, refused_report
from app.batch.work_order import WorkOrder
from app.commands import batch as command
from bihdist_core import write_mesh
from tests.batch.runs import batch, rows
from tests.programs import ROOT, run_python
from tests.shapes import bumpy
from tests.waiting import PATIENCE

GOES_ON = "Run the same command to resume."


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Three meshes; nobody writes here."""
    place = tmp_path_factory.mktemp("meshes")
    for k in range(3):
        write_mesh(place / f"bumpy{k}.off", bumpy(150, k))
    return place


def test_a_cluster_without_its_scheduler_is_a_failure_of_what_is_left(folder, tmp_path):
    pytest.importorskip("distributed")
    script = tmp_path / "cluster.py"
    script.write_text(WITHOUT_SCHEDULER)
    words = [script, folder, tmp_path / "out", tmp_path / "scheduler.json"]
    done = run_python(*words, PYTHONPATH=str(ROOT))
    assert done.returncode == 1, done.stderr
    assert "Traceback" not in done.stderr
    failures = rows(tmp_path / "out", "failures")
    assert [row["mesh"] for row in failures] == ["bumpy0", "bumpy1", "bumpy2"]
    assert {row["reason"].partition(":")[0] for row in failures} == {"The connection to the cluster was lost"}
    assert rows(tmp_path / "out") == []


WITHOUT_SCHEDULER = """
import subprocess, sys
from app.batch.engines import Cluster
from app.main import main

if __name__ == "__main__":
    folder, out, file = sys.argv[1:]
    words = ["--scheduler-file", file, "--no-dashboard", "--host", "127.0.0.1", "--port", "0"]
    scheduler = subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", *words], stderr=-3)
    reports = Cluster.reports

    def without_scheduler(self):
        scheduler.kill()
        scheduler.wait()
        yield from reports(self)

    Cluster.reports = without_scheduler
    try:
        sys.exit(main(["batch", folder, "-o", out, "--do", "fields", "--dask", file]))
    finally:
        scheduler.kill()
"""


@pytest.mark.parametrize(
    ("number", "send", "status", "words_of_it"),
    [
        (signal.SIGINT, os.killpg, 130, "interrupted"),
        # As clusters do, to all processes of a job; as one does by hand.
        (signal.SIGTERM, os.killpg, 143, "ended by SIGTERM"),
        (signal.SIGTERM, os.kill, 143, "ended by SIGTERM"),
    ],
    ids=["terminal", "cluster", "by hand"],
)
def test_what_ends_a_command_ends_all_its_processes_in_silence(tmp_path, number, send, status, words_of_it):
    meshes, out = tmp_path / "meshes", tmp_path / "out"
    meshes.mkdir()
    write_mesh(meshes / "large.off", bumpy(20_000))
    write_mesh(meshes / "small.off", bumpy(150))
    words = [sys.executable, "-m", "app", "batch", str(meshes), "-o", str(out), "--workers", "2"]
    words += ["--do", "eigen", "--k", "1000"]
    run = subprocess.Popen(words, cwd=ROOT, stderr=subprocess.PIPE, text=True, start_new_session=True)
    begin = time.monotonic()
    # One process has nothing to do then, the other has much.
    while not (out / "small.eigen.json").exists() and time.monotonic() - begin < PATIENCE:
        time.sleep(0.02)
    time.sleep(0.3)
    send(run.pid, number)
    # Until all that hold the other end of the pipe have ended.
    _, said = run.communicate(timeout=PATIENCE)
    assert run.returncode == status
    # No word of semaphores that somebody has left.
    lines = [line for line in said.splitlines() if not line.endswith("others under way")]
    assert lines == ["bihdist: 1 of 2: small", f"bihdist: {words_of_it}; 1 result in {out}. {GOES_ON}"]
    assert [row["mesh"] for row in rows(out)] == ["small"]


def test_processes_leave_an_interruption_to_the_one_that_began_them(folder, tmp_path, capfd):
    engine, pools = Processes(1), []

    def interrupt(report, done, of):
        pools.append(engine._pool)
        for process in engine._pool._processes:
            os.kill(process, signal.SIGINT)
        time.sleep(0.1)

    tasks, _ = tasks_for(find_mesh_files([str(folder)]).paths, WorkOrder(("fields",)), str(tmp_path), "1")
    try:
        outcome = run_tasks(tasks, engine, interrupt)
    finally:
        engine.close()
    assert len(outcome.rows) == 3
    assert len(set(map(id, pools))) == 1
    assert "Traceback" not in capfd.readouterr().err


@pytest.mark.parametrize("where", ["reports", "pages"])
def test_tables_are_written_whatever_fails(folder, tmp_path, monkeypatch, where):
    def reports_and_fails(self):
        for k, report in enumerate(reports(self)):
            yield report
            if k == 1:
                raise OSError("no space left")

    def fails(*_):
        raise OSError("no space left")

    reports = Processes.reports
    if where == "reports":
        monkeypatch.setattr(Processes, "reports", reports_and_fails)
    else:
        monkeypatch.setattr(command, "_pages", fails)
    with pytest.raises(OSError, match="no space"):
        batch(folder, tmp_path, "--do", "fields")
    assert len(rows(tmp_path)) == {"reports": 2, "pages": 3}[where]


def test_an_interrupted_set_of_figures_says_which_are_missing(folder, tmp_path, monkeypatch):
    """Their maxima come first, and are no work that anybody has asked for."""

    def interrupted(self):
        yield from reports(self)
        raise KeyboardInterrupt

    meshes, out, reports = tmp_path / "meshes", tmp_path / "out", Processes.reports
    shutil.copytree(folder, meshes)
    (meshes / "torn.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    with monkeypatch.context() as patch:
        patch.setattr(Processes, "reports", interrupted)
        assert batch(meshes, out, "--do", "figure") == 130
    assert [(row["mesh"], row["work"]) for row in rows(out, "failures")] == [("torn", "figure")]
    assert rows(out) == []
    assert batch(meshes, out, "--do", "fields") == 1
    assert [row["work"] for row in rows(out, "failures")] == ["fields", "figure"]
    write_mesh(meshes / "torn.off", bumpy(60))
    assert batch(meshes, out, "--do", "figure,fields") == 0
    assert not (out / "failures.csv").exists()


def test_what_has_no_room_is_said_of_its_part_alone(folder, tmp_path):
    (task, *_), _ = tasks_for(find_mesh_files([str(folder)]).paths, WorkOrder(("fields", "eigen")), str(tmp_path), "1")
    part = replace(task, part=TaskPart("fields", "biharmonic", 0, 10, 150))
    found = {each: refused_report(Report(each, needs=3 * 10**9), 10**9).failures for each in (task, part)}
    assert [(each.work, each.distance) for each in found[task]] == [("fields", "biharmonic"), ("eigen", "")]
    (failure,) = found[part]
    assert (failure.name, failure.work, failure.distance) == (task.name, "fields", "biharmonic")
    assert "It needs about 3.0 GB of memory" in failure.reason


def test_unfinished_work_of_another_command_stays_and_is_told_of(folder, tmp_path, capsys):
    out = tmp_path / "out"
    begun = out / PARTS / "another" / "0-64.npy"
    begun.parent.mkdir(parents=True)
    begun.write_bytes(bytes(2_000_000))
    assert batch(folder, out, "--do", "eigen", "--k", "5") == 0
    assert begun.exists()
    assert "has 2.0 MB of unfinished work" in capsys.readouterr().err
    begun.unlink()
    assert batch(folder, out, "--do", "eigen", "--k", "5") == 0
    assert not (out / PARTS).exists()


# ---------------------------------------------------------------------- interrupted cluster
INTERRUPTED = """
import os, signal, sys
from distributed import LocalCluster
from app.batch.engines import Cluster
from app.main import main

def interrupted(self):
    for report in reports(self):
        yield report
        os.kill(os.getpid(), signal.SIGINT)  # a terminal's Ctrl-C, while others are under way

reports = Cluster.reports
if __name__ == "__main__":
    folder, out = sys.argv[1:]
    one = dict(n_workers=1, threads_per_worker=1, memory_limit="4GiB", dashboard_address=None)
    with LocalCluster(**one) as cluster:
        words = ["batch", folder, "-o", out, "--do", "fields,eigen", "--k", "20", "--dask", cluster.scheduler_address]
        Cluster.reports = interrupted
        print("status", main(words), flush=True)
        with open(f"{out}/summary.csv") as file:
            print("lines", len(file.readlines()))
        Cluster.reports = reports
        print("status", main(words), flush=True)
"""


def test_what_is_done_on_a_cluster_is_kept_when_it_is_interrupted_and_the_next_run_goes_on(tmp_path):
    pytest.importorskip("distributed")
    meshes, out, script = tmp_path / "meshes", tmp_path / "out", tmp_path / "cluster.py"
    meshes.mkdir()
    for k in range(4):
        write_mesh(meshes / f"bumpy{k}.off", bumpy(150 + k, k))
    script.write_text(INTERRUPTED)
    run = run_python(script, meshes, out, PYTHONPATH=str(ROOT))
    assert run.returncode == 0, run.stderr
    assert "Traceback" not in run.stderr
    said = run.stdout.splitlines()
    assert said[:2] == ["status 130", "lines 3"]  # the head, and both results of the first mesh
    assert f"interrupted; 2 results in {out}. Run the same command to resume." in run.stderr
    assert said[2].startswith(f"{out}: 8 results of 4 meshes, ")
    assert said[2].endswith(" of them there before")
    assert said[3] == "status 0"
    assert len(rows(out)) == 8
    assert not [path.name for path in out.iterdir() if path.name.startswith(".")]
    for path in out.glob("*.npy"):
        assert np.isfinite(np.load(path)).all()


# ---------------------------------------------------------------------- unguarded script
SCRIPT = """
import sys
from app.main import main

print("begun as", __name__, flush=True)
words = ["batch", *sys.argv[1:], "--do", "fields", "--workers", "2"]
print("ended with", main(words), sys.modules["__main__"].__file__ == __file__, flush=True)
"""


def test_a_script_needs_no_guard_for_its_workers(tmp_path):
    script, meshes, out = tmp_path / "script.py", tmp_path / "meshes", tmp_path / "out"
    script.write_text(SCRIPT)
    meshes.mkdir()
    for k in range(3):
        write_mesh(meshes / f"{k}.off", bumpy(60, k))
    words = [sys.executable, str(script), str(meshes), "-o", str(out)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=PATIENCE, cwd=tmp_path)
    said = [line for line in run.stdout.splitlines() if line.startswith(("begun", "ended"))]
    assert said == ["begun as __main__", "ended with 0 True"], run.stderr
    assert "Traceback" not in run.stderr
    assert len(list(out.glob("*.fields.biharmonic.npy"))) == 3
