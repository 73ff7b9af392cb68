"""The wheel: what is in it, and that it works under its installed name, away from the checkout."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from wheels import building
from wheels.contents import package_files

from bihdist_core.kernel import build, library
from bihdist_core.version import VERSION

ROOT = Path(__file__).resolve().parents[2]

PACKAGES = {"bihdist_core": "bihdist_core", "bihdist": "app"}
"""Installed name: folder of the checkout."""


def run(*command: str | Path, **options) -> str:
    """What the command prints; the test fails with it if the command does."""
    said = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    assert said.returncode == 0, said.stdout
    return said.stdout


def pip(*arguments: str | Path) -> None:
    run(sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input", *arguments)


@pytest.fixture(scope="module")
def source(tmp_path_factory) -> Path:
    """A copy of the checkout to build in: setuptools leaves folders behind."""
    copy = tmp_path_factory.mktemp("source") / "tree"
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*building.LEFT_OUT))
    return copy


@pytest.fixture(scope="module")
def wheel(source, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip("wheel", "--no-deps", "--no-build-isolation", "--no-index", "--wheel-dir", folder, source)
    (path,) = folder.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def names(wheel) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory) -> Path:
    target = tmp_path_factory.mktemp("installed")
    pip("install", "--no-deps", "--no-index", "--no-compile", "--target", target, wheel)
    return target


@pytest.fixture
def environment(installed) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(installed), "PYTHONDONTWRITEBYTECODE": "1"}


def test_holds_its_packages_and_nothing_else(names):
    tops = {name.split("/")[0] for name in names}
    (information,) = {top for top in tops if top.endswith(".dist-info")}
    assert tops - {information} == {*PACKAGES, "bihdist_assets"}
    assert {f"{information}/licenses/{name}" for name in ("LICENSE", "assets/LICENSE")} <= names


def test_holds_the_compiled_kernel_and_is_for_such_machines(wheel, names, environment, tmp_path):
    try:
        build.compiler()
    except build.NotCompiled as reason:
        pytest.skip(str(reason))
    assert f"bihdist_core/kernel/libbihdist{library.SUFFIX}" in names
    assert re.fullmatch(r"bihdist-[^-]+-py3-none-(?!any)\w+\.whl", wheel.name)
    said = run(sys.executable, "-m", "bihdist", "info", "--solver", cwd=tmp_path, env=environment)
    assert said.split()[1].startswith("compiled")


def test_is_for_every_machine_where_there_is_no_compiler(source, tmp_path, monkeypatch):
    monkeypatch.setenv("CC", "false")
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "-v", "--no-deps", "--no-index"]
    said = run(*command, "--no-build-isolation", "--wheel-dir", tmp_path, source)
    (sentence,) = [line for line in said.splitlines() if "kernel is not compiled" in line]
    assert sentence.endswith("the solver runs in NumPy: false: it fails without a message")
    assert "Traceback" not in said
    (path,) = tmp_path.glob("*-py3-none-any.whl")
    with zipfile.ZipFile(path) as archive:
        assert not [name for name in archive.namelist() if "libbihdist" in name]


@pytest.mark.parametrize("package", PACKAGES)
def test_holds_every_file_of_a_package(names, package):
    wanted = {f"{package}/{name}" for name in package_files(ROOT / PACKAGES[package])}
    held = {name for name in names if name.startswith(f"{package}/") and "libbihdist" not in name}
    assert held == wanted, "a folder of modules needs an `__init__.py`"


def test_holds_the_sample_meshes_and_not_how_they_were_made(names):
    meshes = {f"bihdist_assets/{path.name}" for path in (ROOT / "assets").glob("*.ply")}
    assert meshes
    icons = {f"bihdist_assets/icons/{path.name}" for path in (ROOT / "assets" / "icons").glob("*.svg")}
    assert icons
    icons |= {f"bihdist_assets/application/bihdist{end}" for end in (".svg", "-16.png", "-256.png")}
    samples = {name for name in names if name.startswith("bihdist_assets/")}
    assert meshes | icons <= samples
    assert {Path(name).suffix for name in samples} <= {".ply", ".png", ".svg", ".md", ".m", ".desktop", ".xml"}
    # The text of the guide, or the guide built from it, and not both.
    assert ("bihdist_assets/guide/index.md" in names) != ("bihdist/guide/index.html" in names)


def test_is_imported_from_where_it_was_installed(installed, environment, tmp_path):
    code = "import bihdist, bihdist_core; print(bihdist.__file__, bihdist_core.__file__, sep='\\n')"
    said = run(sys.executable, "-c", code, cwd=tmp_path, env=environment)
    assert [Path(line).parent for line in said.splitlines()] == [installed / package for package in PACKAGES][::-1]


def test_runs_under_its_installed_name(wheel, environment, tmp_path):
    said = run(sys.executable, "-m", "bihdist", "--version", cwd=tmp_path, env=environment)
    assert said == f"bihdist {wheel.name.split('-')[1]}\n"
    assert wheel.name.split("-")[1] == VERSION


def test_the_library_has_the_name_of_the_package(environment, tmp_path):
    code = (
        "import sys, bihdist; print('numpy' in sys.modules); import bihdist_core; "
        "print(all(getattr(bihdist, name) is getattr(bihdist_core, name) for name in bihdist_core.__all__)); "
        "from bihdist import BiharmonicDistance, Surface, figure"
    )
    assert run(sys.executable, "-c", code, cwd=tmp_path, env=environment).split() == ["False", "True"]


def test_installs_the_command(installed, environment, tmp_path):
    command = shutil.which("bihdist", path=installed / ("Scripts" if os.name == "nt" else "bin"))
    assert command, "there is no command"
    assert "field" in run(command, "--help", cwd=tmp_path, env=environment)


def test_opens_a_sample_by_its_name(environment, tmp_path):
    said = run(sys.executable, "-m", "bihdist", "info", "figure", cwd=tmp_path, env=environment)
    rows = dict(line.rsplit(maxsplit=1) for line in said.splitlines())
    assert rows["components"] == "1"
    assert rows["vertices"] == "10,369"


def test_writes_a_field(environment, tmp_path):
    command = [sys.executable, "-m", "bihdist", "field", "figure", "--sources", "0", "-o", "field.csv"]
    run(*command, cwd=tmp_path, env=environment)
    assert (tmp_path / "field.csv").stat().st_size > 10_000


def test_a_source_distribution_builds_the_same_wheel(source, names, tmp_path):
    run(sys.executable, "-c", building.HOOK, "bihdist_core/kernel", tmp_path, cwd=source)
    (archive,) = tmp_path.glob("bihdist-*.tar.gz")
    shutil.unpack_archive(archive, tmp_path)
    unpacked = tmp_path / archive.name.removesuffix(".tar.gz")
    pip("wheel", "--no-deps", "--no-build-isolation", "--no-index", "--wheel-dir", tmp_path, unpacked)
    (again,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(again) as contents:
        assert set(contents.namelist()) == names


@pytest.fixture
def with_other_library(environment, tmp_path) -> dict[str, str]:
    """The environment where the light library of another version was installed, too."""
    information = tmp_path / "other" / "bihdist_core-0.0.9.dist-info"
    information.mkdir(parents=True)
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: bihdist-core\nVersion: 0.0.9\n")
    return {**environment, "PYTHONPATH": os.pathsep.join((str(information.parent), environment["PYTHONPATH"]))}


APART = (
    f"bihdist {VERSION} and bihdist-core 0.0.9, whose library says it is {VERSION}, do not fit together: install one "
    f"version, by `pip install --force-reinstall --no-deps bihdist=={VERSION} bihdist-core=={VERSION}`."
)


def test_distributions_of_different_versions_say_so(environment, with_other_library, tmp_path):
    solver = [sys.executable, "-m", "bihdist", "info", "--solver"]
    said = run(*solver, cwd=tmp_path, env=with_other_library)
    assert said.splitlines()[0] == f"bihdist: warning: {APART}"
    assert "fit together" not in run(*solver, cwd=tmp_path, env=environment)
    library = [sys.executable, "-c", "import bihdist; bihdist.Surface; bihdist.Surface"]
    said = run(*library, cwd=tmp_path, env=with_other_library)
    assert said.count(APART) == 1
    assert run(*library, cwd=tmp_path, env=environment) == ""
