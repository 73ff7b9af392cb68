"""Memory from one start to the next: recent files, which way meshes point up, and windows that ended by a crash.

It stands in the user's folder for application data; where that cannot be written nothing is remembered.
"""

import json
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from qtpy import QtCore

from bihdist_core import BihdistError
from bihdist_core.file_content import file_json, file_text
from bihdist_core.file_output import atomic_write, remove_stale

from ..document.looks import UPS
from ..session.recipe_file import sweep_arrays

MOST_RECENT = 10
MOST_UPS = 1000

SESSION = ".session"
"""Extension of the file that names the session of kept work."""


def folder() -> Path:
    """Return the folder of the program's data for the user."""
    location = QtCore.QStandardPaths.StandardLocation.GenericDataLocation
    return Path(QtCore.QStandardPaths.writableLocation(location)) / "bihdist"


# ---------------------------------------------------------------------- recent files
@dataclass(frozen=True)
class Recent:
    """A file that was opened, with the local time if that is known."""

    path: str
    opened_at: datetime | None


def recent_files() -> list[Recent]:
    """Return the meshes and sessions opened last that still exist, the last first."""
    entries = _read("recent.json")
    files = [_file_of(entry) for entry in entries] if isinstance(entries, list) else []
    return [file for file in files if file is not None and os.path.exists(file.path)]


def recent() -> list[str]:
    """Return the paths of `recent_files`."""
    return [file.path for file in recent_files()]


def remember(path: str) -> None:
    """Put a file first among the recent ones."""
    path = os.path.abspath(path)
    files = [Recent(path, datetime.now(UTC)), *(file for file in recent_files() if file.path != path)]
    entries = [{"path": file.path, "opened": file.opened_at and file.opened_at.isoformat()} for file in files]
    _write("recent.json", entries[:MOST_RECENT])


def _file_of(entry: object) -> Recent | None:
    """Return the file of an entry: a path with its time, or a path alone in old lists."""
    path, opened_at = (entry.get("path"), entry.get("opened")) if isinstance(entry, dict) else (entry, None)
    if not isinstance(path, str):
        return None
    try:
        return Recent(path, datetime.fromisoformat(str(opened_at)).astimezone())
    except (TypeError, ValueError, OverflowError, OSError):
        return Recent(path, None)


# ---------------------------------------------------------------------- which way is up
def up_of(sha256: str) -> str:
    """Return the up axis that was chosen for a mesh, by its checksum; "" if none was."""
    up = _chosen_ups().get(sha256, "")
    return up if up in UPS and up != "auto" else ""


def remember_up(sha256: str, up: str) -> None:
    """Remember the up axis chosen for a mesh, and forget the oldest choices."""
    ups = {known: other for known, other in _chosen_ups().items() if known != sha256} | {sha256: up}
    _write("up.json", dict(list(ups.items())[-MOST_UPS:]))


def _chosen_ups() -> dict[str, object]:
    found = _read("up.json")
    return found if isinstance(found, dict) else {}


# ---------------------------------------------------------------------- the state of windows that are open
def own_state() -> Path:
    """Return the folder in which this process keeps the unsaved work of its window."""
    return folder() / f"open-{os.getpid()}.json"


def keep_state(write: Callable[[Path], None], session: str | None) -> bool:
    """Keep unsaved work, to be offered after a crash, and return whether that was possible.

    `write` writes it as a recipe at a path; `session` is the path of the session's file, None if it has none yet.
    """
    is_kept, path = False, own_state()
    with suppress(OSError, BihdistError):
        folder().mkdir(parents=True, exist_ok=True)
        write(path)
        with atomic_write(path.with_suffix(SESSION)) as temporary:
            temporary.write_text(os.path.abspath(session) if session else "", encoding="utf-8")
        is_kept = True
    if path not in _held and path.exists():
        lock = _lock(path)
        lock.tryLock(0)
        _held[path] = lock
    return is_kept


def forget_state() -> None:
    """Remove what this process keeps, as nothing would be lost."""
    path = own_state()
    remove_state(path)
    lock = _held.pop(path, None)
    if lock is not None:
        lock.unlock()


def session_of(path: Path) -> str | None:
    """Return the path of the session's file of kept work; None if it had none."""
    with suppress(BihdistError):
        return file_text(path.with_suffix(SESSION), "session's name") or None
    return None


def remove_state(path: Path) -> None:
    """Remove kept work, with its arrays."""
    for part in (path, path.with_suffix(SESSION)):
        with suppress(OSError):
            part.unlink()
    sweep_arrays(path)


def lost_states() -> list[Path]:
    """Return the kept work of processes that are gone, the newest first."""
    found = []
    remove_stale(folder())
    with suppress(OSError):
        for path in folder().glob("open-*.json"):
            lock = _lock(path)
            # One whose process is gone is taken over.
            if path not in _held and lock.tryLock(0):
                lock.unlock()
                found.append(path)
        found.sort(key=lambda path: path.stat().st_mtime, reverse=True)
    return found


_held: dict[Path, QtCore.QLockFile] = {}


def _lock(path: Path) -> QtCore.QLockFile:
    """Return the lock of kept work, which tells whose it is."""
    lock = QtCore.QLockFile(f"{path}.lock")
    lock.setStaleLockTime(0)
    return lock


def _read(name: str) -> object:
    """Return the content of a JSON file of the folder; None if it is missing or not JSON."""
    with suppress(BihdistError):
        return file_json(folder() / name, "list", "a list")
    return None


def _write(name: str, data: object) -> None:
    with suppress(OSError, BihdistError):
        folder().mkdir(parents=True, exist_ok=True)
        with atomic_write(folder() / name) as temporary:
            temporary.write_text(json.dumps(data, indent=1), encoding="utf-8")
