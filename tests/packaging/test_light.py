"""Batches where nothing that draws is installed: on a cluster, and on its workers."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.main import NOT_FOR_BATCHES
from tests.batch.runs import rows
from tests.shapes import sphere

ROOT = Path(__file__).resolve().parents[2]

MISSING = NOT_FOR_BATCHES | {"vtk", "PyQt5", "PyQt6", "PySide6"}

BLOCK = f"""
from importlib.machinery import PathFinder

found = PathFinder.find_spec
PathFinder.find_spec = lambda name, *where: None if name.partition(".")[0] in {MISSING} else found(name, *where)
"""
"""Python runs it at the beginning of every process, those of workers included."""


@pytest.fixture
def environment(tmp_path):
    """That of a program which finds nothing that draws."""
    (tmp_path / "light").mkdir()
    (tmp_path / "light" / "sitecustomize.py").write_text(BLOCK)
    return {**os.environ, "PYTHONPATH": os.pathsep.join((str(tmp_path / "light"), str(ROOT)))}


def run(environment, *words: str, program=("-m", "app")) -> tuple[int, str]:
    """The exit status and what is said."""
    command = [sys.executable, *program, *map(str, words)]
    said = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return said.returncode, said.stdout


WORK = ("--do", "fields,pairs,nearest,fps", "--sources", "farthest:4", "--k", "5")


def check_results(out) -> None:
    """Of all works, in numbers."""
    assert {row["work"] for row in rows(out)} == set(WORK[1].split(","))
    found = np.load(next(out.glob("*fields*.npy")))
    assert found.min() == 0 < found.max() < np.inf


def test_what_draws_is_not_there(environment):
    code = "import importlib, sys\ntry: importlib.import_module(sys.argv[1])\nexcept ImportError: print('missing')"
    assert {run(environment, name, program=("-c", code))[1] for name in ("vtkmodules.all", "PyQt5", "PIL")} == {
        "missing\n"
    }


@pytest.mark.parametrize("workers", [1, 2])
def test_a_batch_needs_nothing_that_draws(environment, mesh_file, tmp_path, workers):
    mesh = mesh_file(sphere(200))
    status, said = run(environment, "batch", mesh, "-o", tmp_path / "out", "--workers", workers, *WORK)
    assert status == 0, said
    check_results(tmp_path / "out")


CLUSTER = """
import subprocess, sys
from distributed import LocalCluster

if __name__ == "__main__":
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        where = ["--dask", cluster.scheduler_address]
        sys.exit(subprocess.run([sys.executable, "-m", "app", "batch", *sys.argv[1:], *where]).returncode)
"""


def test_a_worker_of_dask_needs_nothing_that_draws(environment, mesh_file, tmp_path):
    pytest.importorskip("distributed")
    script = tmp_path / "cluster.py"
    script.write_text(CLUSTER)
    words = (mesh_file(sphere(200)), "-o", tmp_path / "out", *WORK)
    status, said = run(environment, *words, program=(str(script),))
    assert status == 0, said
    check_results(tmp_path / "out")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("figure hand -o a.png", "this needs {}, which"),
        ("movie hand -o a.gif", "this needs {}, which"),
        ("batch hand --do figure -o out", "--do figure needs vtkmodules, which"),
        ("batch hand --do fields,evaluate --maps . --truth identity -o out", "--do evaluate needs matplotlib, which"),
    ],
)
def test_what_draws_says_what_is_missing(environment, words, sentence, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, said = run(environment, *words.split())
    assert status == 2
    names = ("matplotlib", "PIL", "pyvista", "vtkmodules")
    brings = "is not installed: `pip install bihdist` brings it.\n"
    assert said in {f"bihdist: {sentence.format(name)} {brings}" for name in names}
    assert not (tmp_path / "out").exists()
