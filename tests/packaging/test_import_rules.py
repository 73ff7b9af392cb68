"""Who may import whom: the contracts in pyproject.toml, and what really is loaded in a fresh interpreter."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

QT = {"qtpy", "PyQt5", "PyQt6", "PySide2", "PySide6", "pyvistaqt"}
DRAWING = {"pyvista", "vtk", "vtkmodules", "matplotlib", "PIL"}


def run(code: str) -> str:
    """What the code prints in a fresh interpreter, in the checkout; the test fails with it if the code does."""
    command = [sys.executable, "-c", code]
    said = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert said.returncode == 0, said.stdout
    return said.stdout


def loaded(*modules: str) -> set[str]:
    """Names of all modules in a fresh interpreter that has imported these."""
    return set(run(f"import sys, {', '.join(modules)}; print(*sys.modules)").split())


def test_contracts_are_kept():
    said = run("from importlinter.cli import lint_imports; raise SystemExit(lint_imports(no_cache=True))")
    assert "0 broken" in said


@pytest.mark.parametrize(
    ("module", "line", "contract"),
    [
        ("app/document/edits.py", "from ..session import lane", "The layers of the application"),
        ("app/session/latest_request_worker.py", "import vtkmodules.vtkCommonCore", "Only these folders draw"),
        ("app/figures/draw.py", "from qtpy import QtCore", "Only the window knows Qt"),
        ("app/paper/page.py", "from ..qt import look", "The layers of the application"),
        ("app/new/thing.py", "", "The layers of the application"),
        ("bihdist_core/solver/factor.py", "from .. import surface", "The layers of the core"),
        ("bihdist_core/surface.py", "import app", "The core draws nothing and knows no application"),
    ],
)
def test_contracts_fail_when_they_are_broken(tmp_path, module, line, contract):
    for folder in ("app", "bihdist_core"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    path = tmp_path / module
    if not path.exists():
        path.parent.mkdir()
        (path.parent / "__init__.py").touch()
    with path.open("a") as file:
        file.write(f"\n{line}\n")
    code = "from importlinter.cli import lint_imports; lint_imports(no_cache=True)"
    said = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True).stdout
    assert f"{contract} BROKEN" in said


@pytest.fixture(scope="module")
def core() -> set[str]:
    """Names of all modules once every name of the core has been asked for."""
    return set(run("import sys; from bihdist_core import *; print(*sys.modules)").split())


def test_the_core_loads_nothing_that_draws(core):
    assert "bihdist_core.distances.biharmonic" in core
    assert not core & (DRAWING | QT | {"app"})


def test_the_core_loads_no_part_of_scipy_it_rarely_needs(core):
    heavy = {f"scipy.{part}" for part in ("stats", "signal", "optimize", "interpolate", "integrate", "ndimage")}
    assert not core & (heavy | {"pygeodesic", "multiprocessing"})


def test_the_core_loads_nothing_before_a_name_is_asked_for():
    assert "numpy" not in loaded("bihdist_core")
    assert "bihdist_core.formats.mesh_io" not in run(
        "import sys; from bihdist_core import BiharmonicDistance; print(*sys.modules)"
    )
    said = run("import bihdist_core; print(all(hasattr(bihdist_core, name) for name in dir(bihdist_core)))")
    assert said.strip() == "True"


def modules(*folders: str) -> list[str]:
    """All modules of folders of the application."""
    found = [path for folder in folders for path in (ROOT / "app" / folder).glob("*.py")]
    return [".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__") for path in found]


WITHOUT_QT = {"profile", "curves", "figure", "command", "samples_command", "evaluate_command"}
WITHOUT_QT |= {
    "part",
    "paths",
    "division",
    "map_errors",
    "candidate_errors",
    "quality_worker",
    "locations",
    "options",
    "marks",
}
WITHOUT_QT |= {"pins", "scatter", "statistics", "quality", "regions", "interpolation", "correspondence", "robustness"}
"""Modules of tools, and tools themselves, that are no part of the window."""


def test_document_and_session_load_nothing_that_draws():
    assert not loaded(*modules("document", "document/shared_parts", "session")) & (DRAWING | QT)


def test_only_the_window_and_what_tools_have_in_it_load_qt():
    folders = {path.parent.name for path in (ROOT / "app").glob("*/__init__.py")}
    assert {"document", "session", "scene", "figures", "paper", "qt", "commands", "tools"} <= folders
    tools = [f"tools/{path.parent.name}" for path in (ROOT / "app" / "tools").glob("*/__init__.py")]
    models = [name for name in modules(*tools) if name.rpartition(".")[2] in WITHOUT_QT]
    assert {f"app.tools.{name}" for name in ("pins", "profile.command", "profile.figure")} <= {*models}
    assert not loaded(*modules(*folders - {"qt"}), *models) & QT


def test_the_window_opens_before_what_draws_is_loaded():
    assert not loaded("app.qt.main_window") & DRAWING


def test_the_library_has_one_name():
    said = run("import app, sys; print('numpy' in sys.modules, app.Surface.__module__)")
    assert said.split() == ["False", "bihdist_core.surface"]


@pytest.mark.parametrize("module", ["app.main", "app.samples"])
def test_the_command_line_answers_before_numpy_is_loaded(module):
    assert not loaded(module) & (DRAWING | QT | {"numpy", "scipy"})
