"""`bihdist.show` in processes of its own: scripts, IPython and notebooks."""

import doctest
import gc
import importlib.util
import json
import locale
import os
import sys
import textwrap

import pytest

import app
from tests.programs import ROOT, run_python
from tests.shapes import bumpy
from tests.waiting import PATIENCE


def script(tmp_path, text):
    """Run a program of its own, with the package under its name."""
    path = tmp_path / "script.py"
    path.write_text(f"import app as bihdist\n{textwrap.dedent(text)}")
    return run_python(path, cwd=tmp_path, PYTHONPATH=str(ROOT))


# ---------------------------------------------------------------------- scripts
def test_the_process_stays_as_it_was(application, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))

    def state():
        return sys.excepthook, gc.get_freeze_count(), locale.setlocale(locale.LC_ALL), os.environ.get("QT_QPA_PLATFORM")

    before = state()
    viewer = app.show(bumpy(300), ["biharmonic"], block=False)
    viewer.panels  # noqa: B018
    viewer.close()
    assert state() == before
    assert not (tmp_path / "data").exists()


def test_without_a_display_it_says_so(tmp_path, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    done = script(tmp_path, "bihdist.show('hand')")
    if sys.platform.startswith("linux"):
        assert "BihdistError: The viewer needs a display" in done.stderr


def test_a_script_waits_until_the_window_is_closed(application, tmp_path):
    done = script(
        tmp_path,
        """
        import os, sys
        from qtpy import QtCore, QtWidgets
        application = QtWidgets.QApplication([])
        def look():
            for window in QtWidgets.QApplication.topLevelWidgets():
                if getattr(window, "session", None) is not None and window.session.is_complete:
                    QtCore.QTimer.singleShot(500, window.close)
        timer = QtCore.QTimer(interval=200)
        timer.timeout.connect(look)
        timer.start()
        viewer = bihdist.show("hand", ["biharmonic"])
        print(viewer, "QT_QPA_PLATFORM" in os.environ, sys.excepthook is sys.__excepthook__)
        """,
    )
    assert (done.returncode, done.stdout.strip()) == (0, "Viewer(closed) False True"), done.stderr


def test_a_script_may_go_on_and_end_with_the_window_open(application, tmp_path):
    done = script(
        tmp_path,
        """
        viewer = bihdist.show("hand", ["biharmonic"], block=False)
        viewer.screenshot("w.png")
        print(viewer.panels[0].field.max() > 0)
        """,
    )
    assert (done.returncode, done.stdout.strip()) == (0, "True"), done.stderr
    assert (tmp_path / "w.png").exists()


@pytest.mark.skipif(not hasattr(os, "kill") or sys.platform == "win32", reason="needs POSIX signals")
def test_an_interrupt_closes_the_window_and_is_raised(application, tmp_path):
    done = script(
        tmp_path,
        """
        import os, signal, threading
        threading.Timer(3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            bihdist.show("hand", ["biharmonic"])
        except KeyboardInterrupt:
            print("interrupted", signal.getsignal(signal.SIGINT) is signal.default_int_handler)
        """,
    )
    assert (done.returncode, done.stdout.strip()) == (0, "interrupted True"), done.stderr


# ---------------------------------------------------------------------- IPython and notebooks
def test_the_example_in_the_docstring_runs(application, monkeypatch):
    from app.qt import show

    # In a checkout the package has another name.
    monkeypatch.setitem(sys.modules, "bihdist", app)
    (test,) = doctest.DocTestFinder(recurse=False).find(show.show, "show")
    assert doctest.DocTestRunner().run(test) == (0, len(test.examples))


def test_ipython_gets_its_prompt_back_while_the_window_lives(application, tmp_path):
    pexpect = pytest.importorskip("pexpect")
    pytest.importorskip("IPython")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "IPYTHONDIR": str(tmp_path), "TERM": "xterm"}
    options = ["-m", "IPython", "--no-banner", "--colors=NoColor", "--no-confirm-exit"]
    shell = pexpect.spawn(
        sys.executable, options, cwd=str(tmp_path), env=environment, timeout=PATIENCE, encoding="utf-8"
    )
    try:
        for line in (
            "import app as bihdist, pathlib; from qtpy.QtCore import QTimer",
            "viewer = bihdist.show('hand', ['biharmonic'])",
            # Heard only if Qt works while the prompt waits.
            "QTimer.singleShot(500, lambda: pathlib.Path('alive').touch()); print('still', 'here')",
        ):
            shell.expect(r"In \[\d+\]:")
            shell.sendline(line)
        shell.expect("still here")
        for _ in range(100):
            if not (tmp_path / "alive").exists():
                shell.expect(["no such words", pexpect.TIMEOUT], timeout=0.1)
        assert (tmp_path / "alive").exists()
        shell.sendline("viewer.close(); print(repr(viewer), viewer.is_open)")
        shell.expect(r"Viewer\(closed\) False")
        shell.sendline("exit()")
        shell.expect(pexpect.EOF)
    finally:
        shell.close(force=True)


@pytest.mark.skipif(importlib.util.find_spec("nbconvert") is None, reason="nbconvert is not installed")
def test_a_notebook_shows_windows_and_draws_figures(application, tmp_path):
    pytest.importorskip("ipykernel")
    cells = [
        "import app as bihdist, numpy as np",
        "viewer = bihdist.show('hand', ['biharmonic', 'geodesic'], source=12)\nviewer",
        "viewer.source = 900\nassert viewer.panels[0].field[900] == 0\nviewer.screenshot('w.png').name",
        "bihdist.figure('hand', ['biharmonic'], source=12, layout={'size': '300x200'})",
        "viewer.close()\nviewer.is_open",
        # The kernel goes on listening, also while nothing of ours is open.
        *["import asyncio\nawait asyncio.sleep(0.3)", "1 + 1"] * 3,
    ]
    notebook = {
        "cells": [
            {"cell_type": "code", "id": f"c{k}", "metadata": {}, "source": text, "outputs": [], "execution_count": None}
            for k, text in enumerate(cells)
        ],
        "metadata": {},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    (tmp_path / "n.ipynb").write_text(json.dumps(notebook))
    settings = {"PYTHONPATH": str(ROOT), "IPYTHONDIR": str(tmp_path), "JUPYTER_DATA_DIR": str(tmp_path)}
    words = ["-m", "nbconvert", "--to", "notebook", "--execute", "--inplace", "n.ipynb"]
    done = run_python(*words, cwd=tmp_path, **settings)
    assert done.returncode == 0, done.stderr
    outputs = [cell["outputs"] for cell in json.loads((tmp_path / "n.ipynb").read_text())["cells"]]
    said = [[output["data"] for output in each if "data" in output] for each in outputs]
    assert said[1][0]["text/plain"] == ["Viewer(biharmonic, geodesic, of hand.ply)"]
    assert said[2][0]["text/plain"] == ["'w.png'"]
    assert len(said[3][0]["image/png"]) > 5000
    assert said[4][0]["text/plain"] == ["False"]
    assert said[-1][0]["text/plain"] == ["2"]
    assert (tmp_path / "w.png").exists()


def test_what_is_shown_goes_on_in_pyvista(application, tmp_path):
    """In a process of its own: pyvista changes what Qt does for OpenGL."""
    done = script(
        tmp_path,
        """
        import os
        import numpy as np
        viewer = bihdist.show("hand", ["biharmonic", "geodesic"], source=12, block=False)
        plotter = viewer.plotter()
        shown = {panel.quantity: panel.field for panel in viewer.panels}
        same = [np.array_equal(plotter.mesh[name], field) for name, field in shown.items()]
        print(same, plotter.mesh.n_points, plotter.mesh.n_cells, flush=True)
        plotter.close()
        os._exit(0)
        """,
    )
    assert done.stdout.split("\n")[0] == "[True, True] 7569 15082", done.stderr
