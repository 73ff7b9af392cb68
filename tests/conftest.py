"""What tests of the program share."""

import os
import shutil
import subprocess

import pytest

SCREEN = "1600x1000x24"

THREADS = ("LP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")
"""Of drawing without a graphics card, and of linear algebra."""


def pytest_configure(config):
    """Each of several processes gets a screen of its own, and draws and multiplies with one thread.

    On a common screen they would take the pointer from another; with threads for all cores each, they would wait.
    """
    if "PYTEST_XDIST_WORKER" not in os.environ:
        return
    for name in THREADS:
        os.environ.setdefault(name, "1")
    if os.environ.get("DISPLAY") and shutil.which("Xvfb"):
        read, write = os.pipe()
        config.own_screen = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", SCREEN, "-nolisten", "tcp"],
            pass_fds=[write],
            stderr=subprocess.DEVNULL,
        )
        os.close(write)
        with os.fdopen(read) as told:
            os.environ["DISPLAY"] = f":{told.readline().strip()}"
        os.environ.pop("XAUTHORITY", None)


def pytest_unconfigure(config):
    if hasattr(config, "own_screen"):
        config.own_screen.terminate()
        config.own_screen.wait()


@pytest.fixture
def mesh_file(tmp_path):
    """Writes a surface as an OFF file and gives its path."""

    def write(surface, name="mesh.off"):
        rows = ["OFF", f"{len(surface.vertices)} {len(surface.faces)} 0"]
        rows += [" ".join(map(repr, map(float, v))) for v in surface.vertices]
        rows += [" ".join(map(str, [3, *f])) for f in surface.faces]
        path = tmp_path / name
        path.write_text("\n".join(rows) + "\n")
        return str(path)

    return write
