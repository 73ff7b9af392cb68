"""What tests of the program share."""

import os
import shutil
import signal
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

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


NIGHTLY = {
    "app/test_paper.py": "runs experiments of the paper",
    "app/test_paper_any_mesh.py": "runs experiments of the paper",
    "app/test_paper_live.py": "runs experiments of the paper",
    "app/test_paper_pictures.py": "runs experiments of the paper",
    "bench": "times the solver and the window",
    "browser": "drives web browsers",
    "core/test_experiments.py": "runs experiments of the paper",
    "guide/test_build.py": "builds the guide",
    "guide/test_explanation.py::test_what_is_computed": "computes the numbers of pages",
    "guide/test_gallery.py": "runs the examples of the gallery",
    "guide/test_pages.py": "runs the examples of all pages",
    "guide/test_search.py": "drives web browsers",
    "guide/test_window_in_the_guide.py::test_a_picture_is_made_again": "draws a picture of the guide",
    "packaging/test_kernel.py::test_each_compiler": "compiles the kernel with every compiler",
    "packaging/test_kernel.py::test_sanitizers": "compiles the kernel with sanitizers",
    "packaging/test_kernel.py::test_the_kernel_of_pages": "compiles the kernel to WebAssembly",
    "packaging/test_release.py": "builds the files of a release",
    "packaging/test_wheel.py": "builds and installs wheels",
    "qt/test_random_actions.py::test_random_actions": "attacks the window at random",
    "stress": "attacks the program at random",
    "web/test_notebook.py": "starts a notebook kernel",
}
"""Folders, modules and beginnings of tests that `make test` leaves to `make nightly`, with the reason."""


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


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark the tests of `NIGHTLY`."""
    beginnings = tuple(each if "::" in each else f"{each}{'::' if each.endswith('.py') else '/'}" for each in NIGHTLY)
    for item in items:
        path = item.path.relative_to(Path(__file__).parent).as_posix()
        if f"{path}::{item.name}".startswith(beginnings):
            item.add_marker("nightly")


@pytest.fixture(autouse=True)
def no_progress_by_time(monkeypatch):
    """Commands say no progress because the machine is slow: neither a line every ten seconds, nor one because what a
    test before has measured lets work seem long."""
    monkeypatch.setattr("bihdist_core.expected_time._slowness", 1.0)
    if find_spec("app") is not None:  # not where the core is tested alone
        monkeypatch.setattr("app.commands.terminal.PROGRESS_INTERVAL_S", 1e6)


def write_off(surface, path):
    """Write a surface as an OFF file, and return its path as text."""
    rows = ["OFF", f"{len(surface.vertices)} {len(surface.faces)} 0"]
    rows += [" ".join(map(repr, map(float, v))) for v in surface.vertices]
    rows += [" ".join(map(str, [3, *f])) for f in surface.faces]
    path.write_text("\n".join(rows) + "\n")
    return str(path)


@pytest.fixture
def mesh_file(tmp_path):
    """Writes a surface as an OFF file and gives its path."""
    return lambda surface, name="mesh.off": write_off(surface, tmp_path / name)


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
