"""All pairs of a mesh by a Dask cluster: the bytes of one computer, also where a run, a worker or the cluster ends."""

import pytest

from app.main import main
from bihdist_core import write_mesh
from tests.programs import ROOT, run_python
from tests.shapes import two_pieces

# In a process of its own, as a user's cluster is: its threads and warnings are not those of the tests.
CLUSTER = """
import os, signal, sys
from distributed import LocalCluster
from app.batch import engines
from app.main import main

def rows_and_an_end(*how):
    for number, block in enumerate(rows(*how)):
        yield block
        if number == 2:
            end()

rows, engines._rows = engines._rows, rows_and_an_end
if __name__ == "__main__":
    out, *words = sys.argv[1:]
    with LocalCluster(n_workers=2, threads_per_worker=1, memory_limit="4GiB", dashboard_address=None) as cluster:
        for name, end in (
            ("all", lambda: os.kill(os.getpid(), signal.SIGINT)),
            ("all", lambda: os.kill(list(cluster.workers.values())[0].pid, signal.SIGKILL)),
            ("lost", cluster.close),
        ):
            where = ["-o", f"{out}/{name}.npy", "--dask", cluster.scheduler_address]
            print("status", main([*words, *where]), flush=True)
"""


@pytest.mark.parametrize("distance", ["geodesic", "biharmonic"])
def test_rows_of_a_cluster_are_the_same_bytes(distance, tmp_path):
    pytest.importorskip("distributed")
    surface, script = two_pieces(), tmp_path / "cluster.py"
    write_mesh(tmp_path / "mesh.off", surface)
    script.write_text(CLUSTER)
    # Blocks of seven rows, and a rest.
    memory = 7 * len(surface.vertices) * 40 / 1e6
    words = ["pairs", str(tmp_path / "mesh.off"), "--sources", "all", "--distance", distance, "--dtype", "float32"]
    assert main([*words, "-o", str(tmp_path / "here.npy")]) == 0
    run = run_python(script, tmp_path, *words, "--memory", memory, PYTHONPATH=str(ROOT))
    assert run.returncode == 0, run.stderr
    ends = [line for line in run.stdout.splitlines() if line.startswith("status")]
    assert ends == ["status 130", "status 0", "status 2"]
    assert (tmp_path / "all.npy").read_bytes() == (tmp_path / "here.npy").read_bytes()
    assert run.stderr.count("21 of 65 rows") == 3
    assert "Resuming from" in run.stderr
    assert "The cluster has not computed the rows: " in run.stderr
