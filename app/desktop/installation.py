"""What the program has in a user's data folder (`XDG_DATA_HOME`): put there, and taken away without a trace."""

import os
import shutil
import subprocess
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.whole_file import whole_file

from ..samples import SAMPLES
from .menu_entry import ICON, entry, metainfo
from .mime_types import MIME_TYPES, package

PICTURES = SAMPLES / "application"
PACKAGES = Path("mime/packages")
ENTRIES = Path("applications")
DATABASES = {
    "update-mime-database": ("mime", "shared-mime-info"),
    "update-desktop-database": ("applications", "desktop-file-utils"),
}
"""Programs that make what desktops look things up in: the folder each is about, and the Debian package it is in."""

MIME_FILES = (
    "XMLnamespaces", "aliases", "generic-icons", "globs", "globs2", "icons", "magic", "mime.cache", "subclasses",
    "treemagic", "types", "version",
)  # fmt: skip
"""What update-mime-database makes, besides a file for each type."""


def data_folder() -> Path:
    """The user's own folder of data; a relative path in XDG_DATA_HOME counts for nothing, as its specification says."""
    named = os.environ.get("XDG_DATA_HOME", "")
    return Path(named) if os.path.isabs(named) else Path.home() / ".local/share"


def check_system() -> None:
    """ParameterError where there is no such menu."""
    if not sys.platform.startswith("linux"):
        raise ParameterError(
            "This is for Linux alone; on macOS and Windows the conda package, made of .ci/conda/recipe.yaml, puts the "
            "program into the menu when it is installed."
        )


def install() -> tuple[list[Path], list[str]]:
    """Write all files and bring the databases up to date: the files, and sentences on what could not be.

    Raises OutputError where a file cannot be written, and ParameterError where there is no menu or nothing to start.
    """
    check_system()
    if find_spec("bihdist") is None:
        raise ParameterError(f"{sys.executable} has no program to start; install it by `pip install .` first.")
    folder, written = data_folder(), []
    for name, content in _files().items():
        path = folder / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"The folder {path.parent} cannot be made: {error.strerror or error}.") from None
        with whole_file(path) as file:
            file.write_bytes(content)
        written.append(path)
    return written, _updated(folder)


def remove() -> tuple[list[Path], list[str]]:
    """Remove all files, and folders that are empty then: the files, and sentences on what could not be brought up to
    date.

    Raises OutputError where a file cannot be removed, and ParameterError where there is no menu.
    """
    check_system()
    folder, removed = data_folder(), []
    for name in _files():
        path = folder / name
        try:
            path.unlink()
        except FileNotFoundError:
            continue
        except OSError as error:
            raise OutputError(f"{path} cannot be removed: {error.strerror or error}.") from None
        removed.append(path)
    notes = _updated(folder) if removed else []
    # What was made of files that are gone.
    made = [Path("mime", f"{each.name}.xml") for each in MIME_TYPES]
    if removed and not any((folder / PACKAGES).glob("*.xml")):
        for path in (*made, *(Path("mime", name) for name in MIME_FILES)):
            _unlink(folder / path)
    if removed and not any((folder / ENTRIES).glob("*.desktop")):
        _unlink(folder / ENTRIES / "mimeinfo.cache")
    for path in (*_files(), *made):
        _remove_empty(folder / path, folder)
    return removed, notes


def _files() -> dict[Path, bytes]:
    """All that is installed, by its place in the data folder."""
    found = {
        ENTRIES / "bihdist.desktop": entry(sys.executable).encode(),
        PACKAGES / "bihdist.xml": package().encode(),
        Path("metainfo/bihdist.metainfo.xml"): metainfo().encode(),
        Path(f"icons/hicolor/scalable/apps/{ICON}.svg"): (PICTURES / f"{ICON}.svg").read_bytes(),
    }
    for picture in sorted(PICTURES.glob("*.png")):
        side = picture.stem.rpartition("-")[2]
        found[Path(f"icons/hicolor/{side}x{side}/apps/{ICON}.png")] = picture.read_bytes()
    return found


def _updated(folder: Path) -> list[str]:
    """Bring the databases up to date; sentences on those that could not be."""
    with suppress(OSError):
        os.utime(folder / "icons/hicolor")  # what is remembered of a theme's icons holds until its folder changes
    notes = []
    for program, (name, debian) in DATABASES.items():
        if not (folder / name).is_dir():
            continue
        if shutil.which(program) is None:
            notes.append(f"{program} is not here (Debian's {debian}); the desktop may know the change only later.")
            continue
        ran = subprocess.run([program, str(folder / name)], capture_output=True, text=True)
        if ran.returncode:
            notes.append(f"{program} failed: {(ran.stderr.strip() or str(ran.returncode)).splitlines()[-1]}")
    return notes


def _unlink(path: Path) -> None:
    with suppress(OSError):
        path.unlink()


def _remove_empty(path: Path, top: Path) -> None:
    """Remove the folders above a path that are empty, up to `top`, which stays."""
    with suppress(OSError):
        for folder in path.parents:
            if folder == top:
                break
            folder.rmdir()
