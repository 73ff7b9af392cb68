"""`bihdist desktop`: what it puts into a user's data folder, what desktops make of that, and that it goes again."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from app.commands import desktop
from app.document.document import COMPARISON, comparison
from app.document.file import recipe_text
from app.document.page import Recipe
from app.main import main
from bihdist_core.formats.mesh_names import ARRAY_FILES, MESH_FORMATS
from tests.commands import ran, refused
from tests.core.mesh_samples import samples_of_all_formats

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="menus of this kind are Linux's")


def needs(*programs):
    """Skips where one of them is not installed."""
    missing = [name for name in programs if shutil.which(name) is None]
    return pytest.mark.skipif(bool(missing), reason=f"not installed: {', '.join(missing)}")


@pytest.fixture
def data(tmp_path, monkeypatch):
    """The user's data folder, which is empty."""
    folder = tmp_path / "user's data"
    folder.mkdir()
    monkeypatch.setenv("XDG_DATA_HOME", str(folder))
    monkeypatch.setenv("HOME", str(tmp_path))
    return folder


def everything(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def run(*command):
    """What the command prints; the test fails with it if the command does."""
    ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert ran.returncode == 0, ran.stdout
    return ran.stdout


# ---------------------------------------------------------------------- putting there and taking away
def test_removing_leaves_nothing(data, capsys):
    written = json.loads(ran(capsys, "desktop", "--install", "--json").out)["outputs"]
    assert all(Path(path).is_file() and data in Path(path).parents for path in written)
    assert {"bihdist.desktop", "bihdist.xml", "bihdist.metainfo.xml", "bihdist.svg"} <= {Path(p).name for p in written}
    assert json.loads(ran(capsys, "desktop", "--remove", "--json").out)["removed"] == written
    assert everything(data) == []
    assert ran(capsys, "desktop", "--remove").out == f"Nothing of bihdist is installed in {data}\n"


@needs("update-mime-database", "update-desktop-database")
def test_removing_leaves_what_is_others(data, capsys):
    (data / "mime/packages").mkdir(parents=True)
    (data / "applications").mkdir()
    (data / "mime/packages/own.xml").write_text(
        '<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">'
        '<mime-type type="text/x-own"><comment>Own</comment><glob pattern="*.own"/></mime-type></mime-info>'
    )
    (data / "applications/own.desktop").write_text(
        "[Desktop Entry]\nType=Application\nName=Own\nExec=true %f\nMimeType=text/x-own;\n"
    )
    run("update-mime-database", str(data / "mime"))
    run("update-desktop-database", str(data / "applications"))
    before = everything(data)
    known = (data / "mime/globs").read_text(), (data / "applications/mimeinfo.cache").read_text()
    assert main(["desktop", "--install"]) == 0
    assert "*.off" in (data / "mime/globs").read_text()
    assert "bihdist.desktop" in (data / "applications/mimeinfo.cache").read_text()
    assert main(["desktop", "--remove"]) == 0
    assert everything(data) == before
    assert known == ((data / "mime/globs").read_text(), (data / "applications/mimeinfo.cache").read_text())


def test_a_relative_data_folder_counts_for_nothing(data, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", "somewhere")
    assert desktop.data_folder() == data.parent / ".local/share"


def test_programs_that_are_missing_are_named(data, monkeypatch, capsys):
    monkeypatch.setenv("PATH", str(data))
    said = ran(capsys, "desktop", "--install").err
    assert "update-mime-database is not installed (Debian: shared-mime-info)" in said
    assert "update-desktop-database is not installed (Debian: desktop-file-utils)" in said
    assert main(["desktop", "--remove"]) == 0
    assert everything(data) == []


def test_a_program_that_fails_is_told(data, monkeypatch, tmp_path, capsys):
    failing = tmp_path / "programs/update-mime-database"
    failing.parent.mkdir()
    failing.write_text("#!/bin/sh\necho one thing >&2; echo another thing >&2; exit 3\n")
    failing.chmod(0o755)
    monkeypatch.setenv("PATH", str(failing.parent), prepend=os.pathsep)
    assert "update-mime-database failed: another thing\n" in ran(capsys, "desktop", "--install").err


# ---------------------------------------------------------------------- refusals
def test_a_folder_that_cannot_be_made(data, capsys):
    (data / "applications").write_text("a file where the folder would be")
    said = refused(capsys, "desktop", "--install")
    assert said == f"bihdist: The folder {data / 'applications'} cannot be made: File exists."


@pytest.mark.skipif(hasattr(os, "geteuid") and os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written(data, capsys):
    data.chmod(0o500)
    assert "cannot be made: Permission denied." in refused(capsys, "desktop", "--install")
    data.chmod(0o700)


def test_a_file_that_cannot_be_removed(data, capsys):
    (data / "applications/bihdist.desktop").mkdir(parents=True)
    said = refused(capsys, "desktop", "--remove")
    assert said == f"bihdist: {data / 'applications/bihdist.desktop'} cannot be removed: Is a directory."


@pytest.mark.parametrize("system", ["darwin", "win32"])
@pytest.mark.parametrize("option", ["--install", "--remove"])
def test_other_systems_have_another_way(data, monkeypatch, capsys, system, option):
    monkeypatch.setattr(desktop.sys, "platform", system)
    said = refused(capsys, "desktop", option)
    assert "on macOS and Windows the conda package" in said
    assert (Path(__file__).parents[2] / ".ci/conda/recipe.yaml").is_file()


def test_what_is_not_installed_cannot_be_started(data, monkeypatch, capsys):
    monkeypatch.setattr(desktop, "find_spec", lambda name: None)
    said = refused(capsys, "desktop", "--install")
    assert said.startswith(f"bihdist: {sys.executable} cannot import bihdist")
    assert everything(data) == []


@pytest.mark.parametrize("words", [[], ["--install", "--remove"]])
def test_it_is_one_or_the_other(words, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["desktop", *words])
    assert stop.value.code == 2
    assert "--install" in capsys.readouterr().err


# ---------------------------------------------------------------------- what desktops make of it
@needs("desktop-file-validate")
def test_the_entry_is_valid(data):
    assert main(["desktop", "--install", "--quiet"]) == 0
    assert run("desktop-file-validate", str(data / "applications/bihdist.desktop")) == ""


@needs("appstreamcli")
def test_the_metainfo_is_valid(data):
    assert main(["desktop", "--install", "--quiet"]) == 0
    said = run("appstreamcli", "validate", "--no-net", "--no-color", str(data / "metainfo/bihdist.metainfo.xml"))
    assert "Validation was successful" in said


@needs("gio")
def test_any_path_of_the_interpreter_is_started(tmp_path):
    """`gio launch` reads the entry as GNOME does, which takes no % in paths, however it is written."""
    assert "Exec=/a%%b/python -m" in desktop.menu_entry("/a%b/python")
    python = tmp_path / r"""a folder; of "mine", with `\$HOME's`/python"""
    python.parent.mkdir()
    python.write_text(
        '#!/bin/sh\nprintf "%s\\n" "$@" > "$(dirname "$0")/words.part"\nmv "$0"* /dev/null 2>&1\n'
        'mv "$(dirname "$0")/words.part" "$(dirname "$0")/words"\n'
    )
    python.chmod(0o755)
    file = tmp_path / "own.desktop"
    file.write_text(desktop.menu_entry(str(python)))
    mesh = tmp_path / "my mesh.off"
    mesh.touch()
    run("gio", "launch", str(file), str(mesh))
    words = python.parent / "words"
    for _ in range(200):
        if words.exists():
            break
        subprocess.run(["sleep", "0.05"], check=True)
    assert words.read_text().splitlines() == ["-m", "bihdist", "view", str(mesh)]


def test_every_mesh_format_has_its_type():
    patterns = set(re.findall(r'<glob pattern="([^"]+)"', desktop.mime_package()))
    assert patterns == {f"*{form}{end}" for form in MESH_FORMATS if form not in ARRAY_FILES for end in ("", ".gz")}


@needs("gio", "update-mime-database")
def test_files_have_their_types(data, tmp_path):
    """By name, and by content where a name says nothing; other JSON and what is no mesh keeps its type."""
    assert main(["desktop", "--install", "--quiet"]) == 0
    folder = tmp_path / "files"
    folder.mkdir()
    samples = samples_of_all_formats(tmp_path)
    session = recipe_text(Recipe(comparison("hand", COMPARISON)), "0.2.0").encode()
    texts = {"other.json": b'{"format": 2, "program": "another"}', "lh.thickness": b"\xff\xff\xff\x00\x00"}
    texts |= {"hand.json": session}
    texts |= {
        f"no extension {k}": samples[name] for k, name in enumerate(("a.off", "ascii.ply", "new.vtk", "zlib.vtp"))
    }
    for name, content in {**samples, **texts}.items():
        (folder / name).write_bytes(content)
    words = {
        ".off": "application/vnd.off", ".obj": "model/obj", ".ply": "application/vnd.ply", ".stl": "model/stl",
        ".vtk": "application/vnd.vtk", ".vtp": "application/vnd.vtp", ".vtu": "application/vnd.vtu",
        ".gltf": "model/gltf+json", ".glb": "model/gltf-binary", ".gii": "application/gifti+xml",
    }  # fmt: skip
    expected = {path.name: words[path.suffix] for path in folder.iterdir() if path.suffix in words}
    expected |= dict.fromkeys(("packed.off.gz", "big.gii.gz"), "application/x-compressed-mesh")
    expected |= {f"no extension {k}": words[form] for k, form in enumerate((".off", ".ply", ".vtk", ".vtp"))}
    expected |= {"lh.pial": "application/x-freesurfer-surface", "hand.json": "application/x-bihdist+json"}
    expected |= {"other.json": "application/json", "lh.thickness": "application/octet-stream"}
    said = run("gio", "info", "-a", "standard::name,standard::content-type", *(str(folder / name) for name in expected))
    names = [line.split(": ")[1] for line in said.splitlines() if "standard::name" in line]
    kinds = [line.split(": ")[1] for line in said.splitlines() if "standard::content-type" in line]
    assert dict(zip(names, kinds, strict=True)) == expected
