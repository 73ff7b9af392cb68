"""What tests of the program share."""

import os
import shutil
import signal
import subprocess
import sys

import pytest

from bihdist_core import SolverError

SCREEN = "1600x1000x24"

SERVE = """
Xvfb -displayfd "$2" -screen 0 "$3" -nolisten tcp &
while kill -0 "$1"; do sleep 1; done
kill $!
"""
"""A screen that outlives a process, as long as that is there: without its screen it could not end in peace."""

THREADS = ("LP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")
"""Of drawing without a graphics card, and of linear algebra."""


if "PYTEST_XDIST_WORKER" in os.environ:
    # One of several processes: with threads for all cores each, they would wait for each other.
    if "numpy" in sys.modules:
        # It would not listen any more, and everything would take three times as long.
        raise pytest.UsageError(
            "NumPy is loaded before its threads are limited, by a plugin; leave that out (-p no:NAME)."
        )
    for _name in THREADS:
        os.environ.setdefault(_name, "1")

# The many programs that tests begin would each compile all of the project's modules, where the environment says so.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False


if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # Shells have what they run in the background ignore interruptions, and so would the programs that tests begin.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_configure(config):
    """Each of several processes gets a screen of its own: on a common one they would take the pointer from another."""
    if "PYTEST_XDIST_WORKER" not in os.environ:
        return
    if os.environ.get("DISPLAY") and shutil.which("Xvfb"):
        read, write = os.pipe()
        command = ["sh", "-c", SERVE, "screen", str(os.getpid()), str(write), SCREEN]
        config.own_screen = subprocess.Popen(
            command, pass_fds=[write], stderr=subprocess.DEVNULL, start_new_session=True
        )
        os.close(write)
        with os.fdopen(read) as told:
            os.environ["DISPLAY"] = f":{told.readline().strip()}"
        os.environ.pop("XAUTHORITY", None)


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


@pytest.fixture
def built_guide(tmp_path, monkeypatch):
    """A guide that has been built."""
    page = tmp_path / "index.html"
    page.write_text("<title>The guide</title>")
    monkeypatch.setattr("app.guide_pages.GUIDE", page)
    return page


@pytest.fixture
def no_exact_geodesics(monkeypatch):
    """Exact geodesic distances that cannot be made."""

    def fails(self, surface):
        raise SolverError(
            "There is no room for windows: exact geodesic distances on this surface need more memory than there is."
        )

    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.ExactGeodesic.__init__", fails)


@pytest.fixture
def unmeasured_fonts(monkeypatch):
    """EPS files without the box around all glyphs of their fonts, which takes matplotlib two seconds for each font.

    `test_eps_has_letters_and_no_transparency` writes them as they are.
    """
    monkeypatch.setattr("matplotlib.backends.backend_ps._bounds", lambda font: (0, 0, 0, 0), raising=False)
