"""A wheel in a clean environment: installed by uv from a folder of wheels, and the core's tests run on it."""

import os
import re
import shutil
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from .building import Failed, run

TESTS = ("pytest", "pytest-xdist", "hypothesis")

QUICK = tuple(
    f"tests/core/test_{name}.py"
    for name in (
        "distances", "elimination_tree", "exact_geodesic", "factor", "heat_geodesic", "isolines",
        "kernels", "laplacian", "mesh_io", "operators", "sources", "spectrum", "surface", "worker_threads",
    )
)  # fmt: skip
"""The tests of the core that say most in the least time."""

WHERE = "import bihdist_core.kernel.library as found; print(found.__file__); print(found.description())"
NEEDS_PROGRAM = re.compile(r"^(from|import) (app|bihdist|bihdist_core\.experiments)\b", re.MULTILINE)
"""Found in tests that need more than the light library."""


@dataclass(frozen=True)
class Trial:
    """The outcome of a wheel in an environment; `versions` are those of Python, NumPy and SciPy."""

    python: str
    requirement: str
    resolution: str
    kernel: str
    versions: str
    seconds: float
    tests: str
    passed: bool

    def row(self) -> str:
        """Return the line of a table."""
        cells = (self.versions, self.resolution, self.requirement, self.kernel, f"{self.seconds:.1f} s", self.tests)
        return f"| {' | '.join(cells)} |"


HEAD = """\
| Python, NumPy, SciPy | dependencies | installed | solver | installed in | core's tests |
| --- | --- | --- | --- | --- | --- |"""


def tried(wheel: Path, python: str, resolution: str, source: Path, folder: Path, tests: Iterable[str] = QUICK) -> Trial:
    """Install a wheel with its dependencies, lowest or highest, and run tests of its source distribution.

    Failed if it cannot be installed, if what is imported is not what was installed, or if its kernel is not used.
    """
    environment = folder / "environment"
    shutil.rmtree(environment, ignore_errors=True)
    run(["uv", "venv", "--quiet", "--no-project", "--python", python, str(environment)])
    inside = environment / ("Scripts" if os.name == "nt" else "bin") / "python"
    install = ["uv", "pip", "install", "--quiet", "--python", str(inside), "--only-binary", ":all:"]
    began = time.monotonic()
    run([*install, "--resolution", resolution, str(wheel)])
    seconds = time.monotonic() - began
    run([*install, *TESTS])

    away = laid_out(source, folder / "tests")
    place, kernel = run([str(inside), "-c", WHERE], cwd=away).splitlines()[-2:]
    if not Path(place).is_relative_to(environment):
        raise Failed(f"{place} is not what was installed into {environment}.")
    is_plain = "NumPy" in kernel
    if is_plain != wheel.stem.endswith("-any"):
        raise Failed(f"{wheel.name} gives this solver: {kernel}.")
    chosen = list(of_the_library(away, tests))
    # It is meant: no warning.
    plain = {"BIHDIST_PLAIN": "1"} if is_plain else {}
    said, passed = _pytest([str(inside), "-m", "pytest", "-n", "2", "-p", "no:cacheprovider", *chosen], away, plain)
    code = "import numpy, platform, scipy; print(platform.python_version(), numpy.__version__, scipy.__version__)"
    versions = ", ".join(run([str(inside), "-c", code]).split()[-3:])
    return Trial(python, wheel.name, resolution, kernel.partition(":")[0], versions, seconds, said, passed)


def laid_out(source: Path, away: Path) -> Path:
    """Return a folder with the tests of a source distribution and what they read, and without its packages."""
    shutil.rmtree(away, ignore_errors=True)
    away.mkdir()
    for name in ("tests", "assets"):
        shutil.copytree(source / name, away / name)
    shutil.copy(source / "pyproject.toml", away)
    return away


def of_the_library(folder: Path, tests: Iterable[str]) -> Iterable[str]:
    """Yield the names of test files that need the light library alone."""
    for name in tests:
        path = folder / name
        for file in sorted(path.rglob("test_*.py")) if path.is_dir() else [path]:
            if not NEEDS_PROGRAM.search(file.read_text(encoding="utf-8")):
                yield file.relative_to(folder).as_posix()


def _pytest(command: list[str], folder: Path, more: dict[str, str]) -> tuple[str, bool]:
    """Return how tests ended in their own words, and whether all passed."""
    try:
        return run(command, cwd=folder, env={**os.environ, **more}).splitlines()[-1].strip("= "), True
    except Failed as error:
        return str(error).splitlines()[-1].strip("= "), False
