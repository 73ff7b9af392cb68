"""`bihdist desktop`: the viewer in the menu of a Linux desktop, and as what opens mesh files."""

import argparse
import os
import re
import shutil
import subprocess
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.file_output import atomic_write
from bihdist_core.formats.mesh_names import ARRAY_FILES, GZIP, MESH_FORMATS

from ..samples import SAMPLES
from .terminal import Result, tell

WORDS = "add the viewer to the desktop's menu, and open mesh files with it (Linux)"
EXAMPLES = (
    "bihdist desktop --install",
    "bihdist desktop --remove",
)

TEMPLATES = SAMPLES / "application"
MIME_PACKAGES = Path("mime/packages")
MENU_ENTRIES = Path("applications")
DATABASES = {
    "update-mime-database": ("mime", "shared-mime-info"),
    "update-desktop-database": ("applications", "desktop-file-utils"),
}
"""The programs that update what desktops look up: the folder each reads, and the Debian package it is in."""

MADE_BY_UPDATE = (
    "XMLnamespaces", "aliases", "generic-icons", "globs", "globs2", "icons", "magic", "mime.cache", "subclasses",
    "treemagic", "types", "version",
)  # fmt: skip
"""The files that update-mime-database writes, besides one for each type."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `desktop` to its parser."""
    either = parser.add_mutually_exclusive_group(required=True)
    either.add_argument("--install", action="store_true", help="add a menu entry, its icon and the types of mesh files")
    either.add_argument("--remove", action="store_true", help="remove the menu entry, its icon and these types")


def run(options: argparse.Namespace) -> Result:
    """Install or remove the files, and print where they are."""
    files, notes = install() if options.install else remove()
    for note in notes:
        tell(note)
    if options.install:
        print(f"{len(files)} files written to {data_folder()}: the viewer is in the menu and opens mesh files")
    elif files:
        print(f"{len(files)} files removed from {data_folder()}")
    else:
        print(f"Nothing of bihdist is installed in {data_folder()}")
    paths: list[str] = [str(file) for file in files]
    return Result({"outputs": paths if options.install else [], "removed": [] if options.install else paths})


def install() -> tuple[list[Path], list[str]]:
    """Write all files and update the databases; return the files, and a sentence for each failed update.

    Raises OutputError where a file cannot be written, and ParameterError where there is no menu or nothing to start.
    """
    check_system()
    if find_spec("bihdist") is None:
        raise ParameterError(f"{sys.executable} cannot import bihdist; install it by `pip install .` first.")
    folder, written = data_folder(), []
    for name, content in installed_files().items():
        path = folder / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"The folder {path.parent} cannot be made: {error.strerror or error}.") from None
        with atomic_write(path) as file:
            file.write_bytes(content)
        written.append(path)
    return written, _update_databases(folder)


def remove() -> tuple[list[Path], list[str]]:
    """Remove all files and the folders they leave empty; return the files, and a sentence for each failed update.

    Raises OutputError where a file cannot be removed, and ParameterError where there is no menu.
    """
    check_system()
    folder, removed = data_folder(), []
    for name in installed_files():
        path = folder / name
        try:
            path.unlink()
        except FileNotFoundError:
            continue
        except OSError as error:
            raise OutputError(f"{path} cannot be removed: {error.strerror or error}.") from None
        removed.append(path)
    notes = _update_databases(folder) if removed else []
    # Files that the updates made of those that are gone.
    made = [Path("mime", f"{name}.xml") for name in mime_types()]
    if removed and not any((folder / MIME_PACKAGES).glob("*.xml")):
        for path in (*made, *(Path("mime", name) for name in MADE_BY_UPDATE)):
            _unlink(folder / path)
    if removed and not any((folder / MENU_ENTRIES).glob("*.desktop")):
        _unlink(folder / MENU_ENTRIES / "mimeinfo.cache")
    for path in (*installed_files(), *made):
        _remove_empty(folder / path, folder)
    return removed, notes


def data_folder() -> Path:
    """Return the user's data folder; a relative path in XDG_DATA_HOME is ignored, as its specification says."""
    named = os.environ.get("XDG_DATA_HOME", "")
    return Path(named) if os.path.isabs(named) else Path.home() / ".local/share"


def check_system() -> None:
    """Raise ParameterError where there is no such menu."""
    if not sys.platform.startswith("linux"):
        raise ParameterError(
            "`bihdist desktop` works on Linux only; on macOS and Windows the conda package, made of "
            ".ci/conda/recipe.yaml, adds the program to the menu."
        )


def installed_files() -> dict[Path, bytes]:
    """Return the content of every file that is installed, by its path in the data folder."""
    types = "".join(f"<mediatype>{name}</mediatype>" for name in mime_types())
    found = {
        MENU_ENTRIES / "bihdist.desktop": menu_entry(sys.executable).encode(),
        MIME_PACKAGES / "bihdist.xml": mime_package().encode(),
        Path("metainfo/bihdist.metainfo.xml"): _template("bihdist.metainfo.xml", TYPES=types).encode(),
        Path("icons/hicolor/scalable/apps/bihdist.svg"): (TEMPLATES / "bihdist.svg").read_bytes(),
    }
    for picture in sorted(TEMPLATES.glob("*.png")):
        side = picture.stem.rpartition("-")[2]
        found[Path(f"icons/hicolor/{side}x{side}/apps/bihdist.png")] = picture.read_bytes()
    return found


def mime_package() -> str:
    """Return the XML that describes the types of meshes, sessions and recipes, for shared-mime-info.

    Types that the system, F3D or MeshLab describe have their names. Files of arrays stay with other programs.
    """
    compressed = "".join(
        f'<glob pattern="*{extension}{GZIP}"/>' for extension in MESH_FORMATS if extension not in ARRAY_FILES
    )
    return _template("bihdist.xml", COMPRESSED=compressed)


def mime_types() -> list[str]:
    """Return the names of the types that the viewer opens."""
    return re.findall(r'<mime-type type="([^"]+)"', mime_package())


def menu_entry(python: str) -> str:
    """Return the desktop entry that starts the viewer by the interpreter at the absolute path `python`."""
    types = "".join(f"{name};" for name in mime_types())
    return _template("bihdist.desktop", COMMAND=_escaped(_quoted(python)), PYTHON=_escaped(python), TYPES=types)


def _template(name: str, **values: str) -> str:
    """Return the text of a file with `@NAME@` replaced by each of the values."""
    text = (TEMPLATES / name).read_bytes().decode()
    return re.sub(r"@([A-Z]+)@", lambda match: values[match[1]], text)


def _quoted(path: str) -> str:
    """Return a path as a word of a command in a desktop entry."""
    path = path.replace("%", "%%")
    if not re.search(r"[^\w@%+=:,./-]", path):
        return path
    return '"' + re.sub(r'(["`$\\])', r"\\\1", path) + '"'


def _escaped(value: str) -> str:
    """Return a value as desktop entries write it."""
    return value.replace("\\", "\\\\").replace("\n", "\\n").replace("\t", "\\t")


def _update_databases(folder: Path) -> list[str]:
    """Update the databases of a data folder; return a sentence for each that could not be."""
    with suppress(OSError):
        os.utime(folder / "icons/hicolor")  # the cache of a theme's icons is valid until its folder changes
    notes = []
    for program, (name, debian) in DATABASES.items():
        if not (folder / name).is_dir():
            continue
        if shutil.which(program) is None:
            notes.append(f"{program} is not installed (Debian: {debian}); the desktop may notice the change later.")
            continue
        ran = subprocess.run([program, str(folder / name)], capture_output=True, text=True)
        if ran.returncode:
            notes.append(f"{program} failed: {(ran.stderr.strip() or str(ran.returncode)).splitlines()[-1]}")
    return notes


def _unlink(path: Path) -> None:
    with suppress(OSError):
        path.unlink()


def _remove_empty(path: Path, top: Path) -> None:
    """Remove the empty folders above a path, up to `top`, which stays."""
    with suppress(OSError):
        for folder in path.parents:
            if folder == top:
                break
            folder.rmdir()
