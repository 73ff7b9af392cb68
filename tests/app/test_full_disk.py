"""Where there is no room for it, what is written is one sentence, and what was there stays; no half file is left."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.shapes import bumpy

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a limit stands for a full disk there")

LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
from app.program import run
sys.argv[0] = "bihdist"
sys.exit(run())
"""

COMMANDS = {
    "field.npy": "field MESH --sources 5 -o OUT",
    "field.csv": "field MESH --sources 5 -o OUT",
    "field.ply": "field MESH --sources 5 -o OUT",
    "field.vtp": "field MESH --sources 5 -o OUT",
    "pairs.npy": "pairs MESH --sources all -o OUT",
    "near.json": "pairs MESH --nearest --k 5 -o OUT",
    "near.npz": "pairs MESH --nearest --k 5 -o OUT",
    "lines.vtp": "isolines MESH --sources 5 -o OUT",
    "ids.csv": "samples MESH --sources farthest:200 -o OUT",
    "figure.png": "figure MESH -o OUT",
    "figure.svg": "figure MESH -o OUT",
    "figure.pdf": "figure MESH -o OUT",
    "movie.gif": "movie MESH --frames 2 --size 200x200 -o OUT",
}


def limited(words, folder):
    command = [sys.executable, "-c", LIMITED, *words]
    # What others keep for the next time would be cut off, too, and be found by it.
    own = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "MPLCONFIGDIR": str(folder)}
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, timeout=300, check=False, env=own)


@pytest.mark.parametrize(("name", "words"), COMMANDS.items(), ids=COMMANDS)
def test_no_half_file_is_left(name, words, mesh_file, tmp_path):
    mesh, out = mesh_file(bumpy(300)), tmp_path / "out" / name
    out.parent.mkdir()
    out.write_text("old")
    done = limited([{"MESH": mesh, "OUT": str(out)}.get(word, word) for word in words.split()], tmp_path)
    assert done.returncode == 2, done.stderr
    assert done.stderr.splitlines()[-1] == f"bihdist: {out} could not be written: File too large."
    assert "Traceback" not in done.stderr
    assert out.read_text() == "old"
    assert [each.name for each in out.parent.iterdir() if not each.name.endswith(".part")] == [name]


def test_results_of_a_batch_are_failures(mesh_file, tmp_path):
    mesh_file(bumpy(300))
    out = tmp_path / "out"
    done = limited(["batch", str(tmp_path), "-o", str(out), "--do", "fields", "--workers", "1"], tmp_path)
    assert done.returncode == 1, done.stderr
    assert "could not be written: File too large." in (out / "failures.csv").read_text()
    assert sorted(each.name for each in out.iterdir()) == ["failures.csv", "summary.csv"]
