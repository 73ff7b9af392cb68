"""A script that runs a batch is run once, and not again by each worker."""

import os
import subprocess
import sys
from pathlib import Path

from bihdist_core import write_mesh
from tests.shapes import bumpy

ROOT = Path(__file__).parents[2]

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
    run = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=120, cwd=tmp_path)
    said = [line for line in run.stdout.splitlines() if line.startswith(("begun", "ended"))]
    assert said == ["begun as __main__", "ended with 0 True"], run.stderr
    assert "Traceback" not in run.stderr
    assert len(list(out.glob("*.fields.biharmonic.npy"))) == 3
