"""The guide's `bihdist.m`, by GNU Octave: files and arrays, one and several sources, and what is refused."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.samples import sample
from bihdist_core import BiharmonicDistance, GeodesicDistance, simplified, write_mesh

FUNCTION = Path(__file__).parents[2] / "assets/guide/how-to/bihdist.m"
OCTAVE = shutil.which("octave-cli")

pytestmark = pytest.mark.skipif(OCTAVE is None, reason="GNU Octave is not installed")


def run(folder, code):
    """What Octave says to code in which `bihdist` is known, and its exit status."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    (folder / "script.m").write_text(f"addpath('{FUNCTION.parent.as_posix()}');\n{code}\n")
    done = subprocess.run(
        [OCTAVE, "--no-init-file", "script.m"],
        cwd=folder,
        env=os.environ | {"PATH": path, "TMPDIR": str(folder)},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.returncode, done.stdout


def test_files_and_arrays(tmp_path):
    surface, _ = simplified(sample("hand"), 300)
    write_mesh(tmp_path / "hand.off", surface)
    np.savetxt(tmp_path / "V.txt", surface.vertices, fmt="%.17g")
    np.savetxt(tmp_path / "F.txt", surface.faces + 1, fmt="%d")
    status, said = run(
        tmp_path,
        "D = bihdist('hand.off', [12 40]);\ndlmwrite('a.txt', D, 'precision', '%.17g');\n"
        "G = bihdist({load('V.txt'), load('F.txt')}, 12, 'geodesic(method=exact)');\n"
        "dlmwrite('b.txt', G, 'precision', '%.17g');",
    )
    assert status == 0, said
    wanted = BiharmonicDistance(surface).from_sources([11, 39])
    np.testing.assert_allclose(np.loadtxt(tmp_path / "a.txt", delimiter=","), wanted, rtol=1e-12)
    geodesic = GeodesicDistance(surface, method="exact").from_source(11)
    np.testing.assert_allclose(np.loadtxt(tmp_path / "b.txt"), geodesic, rtol=1e-12)
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]  # its own folder is gone


def test_what_is_refused_is_an_error_with_the_sentence(tmp_path):
    status, said = run(tmp_path, "bihdist('nothing.off', 1);")
    assert status == 1
    assert "There is no file or folder nothing.off, nor a sample of that name." in said
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]
