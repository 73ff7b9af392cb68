"""A batch on a Dask cluster that is interrupted keeps what is done, says so, and goes on when it is asked again."""

import os
import subprocess
import sys

import numpy as np
import pytest

from bihdist_core import write_mesh
from tests.batch.runs import ROOT, rows
from tests.shapes import bumpy

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
    run = subprocess.run(
        [sys.executable, str(script), str(meshes), str(out)],
        cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=240, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "Traceback" not in run.stderr
    said = run.stdout.splitlines()
    assert said[:2] == ["status 130", "lines 3"]  # the head, and both results of the first mesh
    assert f"interrupted; 2 results in {out}. The same command goes on from there." in run.stderr
    assert said[2].startswith(f"{out}: 8 results of 4 meshes, ")
    assert said[2].endswith(" of them there before")
    assert said[3] == "status 0"
    assert len(rows(out)) == 8
    assert not [path.name for path in out.iterdir() if path.name.startswith(".")]
    for path in out.glob("*.npy"):
        assert np.isfinite(np.load(path)).all()
