"""What is remembered from one start to the next: recent files, which way meshes point up, and the state of a window
that did not end as it should.

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
from bihdist_core.whole_file import sweep_half_written, whole_file

from ..document.looks import UPS
from ..session.recipe_file import sweep_arrays

MOST_RECENT = 10
MOST_UPS = 1000

SESSION = ".session"
"""Of the file, beside what a window shows, that says which session that is."""


def folder() -> Path:
    """Of this program's data for the user."""
    location = QtCore.QStandardPaths.StandardLocation.GenericDataLocation
    return Path(QtCore.QStandardPaths.writableLocation(location)) / "bihdist"


# ---------------------------------------------------------------------- recent files
@dataclass(frozen=True)
class Recent:
    """A file that was opened; when, in local time, is unknown of those remembered without it."""

    path: str
    opened_at: datetime | None


def recent_files() -> list[Recent]:
    """Meshes and sessions opened last, the last first, as far as they are still there."""
    entries = _read("recent.json")
    files = [_file_of(entry) for entry in entries] if isinstance(entries, list) else []
    return [file for file in files if file is not None and os.path.exists(file.path)]


def recent() -> list[str]:
    """The paths of `recent_files`."""
    return [file.path for file in recent_files()]


def remember(path: str) -> None:
    """Put a file first among the recent ones."""
    path = os.path.abspath(path)
    files = [Recent(path, datetime.now(UTC)), *(file for file in recent_files() if file.path != path)]
    entries = [{"path": file.path, "opened": file.opened_at and file.opened_at.isoformat()} for file in files]
    _write("recent.json", entries[:MOST_RECENT])


def _file_of(entry: object) -> Recent | None:
    """An entry of the list: a path with its time, or, as it used to be, a path alone."""
    path, opened_at = (entry.get("path"), entry.get("opened")) if isinstance(entry, dict) else (entry, None)
    if not isinstance(path, str):
        return None
    try:
        return Recent(path, datetime.fromisoformat(str(opened_at)).astimezone())
    except (TypeError, ValueError, OverflowError, OSError):
        return Recent(path, None)


# ---------------------------------------------------------------------- which way is up
def up_of(sha256: str) -> str:
    """The axis that points up as it was chosen for a mesh, by its checksum; "" if none was."""
    up = _chosen_ups().get(sha256, "")
    return up if up in UPS and up != "auto" else ""


def remember_up(sha256: str, up: str) -> None:
    """It was chosen for a mesh; the choices made longest ago are forgotten."""
    ups = {known: other for known, other in _chosen_ups().items() if known != sha256} | {sha256: up}
    _write("up.json", dict(list(ups.items())[-MOST_UPS:]))


def _chosen_ups() -> dict[str, object]:
    found = _read("up.json")
    return found if isinstance(found, dict) else {}


# ---------------------------------------------------------------------- the state of windows that are open
def own_state() -> Path:
    """Where this process keeps what its window shows."""
    return folder() / f"open-{os.getpid()}.json"


def keep_state(write: Callable[[Path], None], session: str | None) -> bool:
    """Keep what the window shows, to be offered after a crash; whether that was possible.

    write: writes it as a recipe at a path.  session: the path of the session's file, None if it has none yet.
    """
    is_kept = False
    with suppress(OSError, BihdistError):
        folder().mkdir(parents=True, exist_ok=True)
        write(own_state())
        with whole_file(own_state().with_suffix(SESSION)) as temporary:
            temporary.write_text(os.path.abspath(session) if session else "", encoding="utf-8")
        is_kept = True
    if own_state() not in _held and own_state().exists():
        lock = _lock(own_state())
        lock.tryLock(0)
        _held[own_state()] = lock
    return is_kept


def forget_state() -> None:
    """The window ends as it should."""
    remove_state(own_state())
    lock = _held.pop(own_state(), None)
    if lock is not None:
        lock.unlock()


def session_of(path: Path) -> str | None:
    """The path of the session's file, of what a window showed; None if it had none."""
    with suppress(BihdistError):
        return file_text(path.with_suffix(SESSION), "session's name") or None
    return None


def remove_state(path: Path) -> None:
    """What a window showed, with its arrays."""
    for part in (path, path.with_suffix(SESSION)):
        with suppress(OSError):
            part.unlink()
    sweep_arrays(path)


def lost_states() -> list[Path]:
    """What windows showed whose processes are no longer there, the newest first."""
    found = []
    sweep_half_written(folder())
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
    """A file beside it that says which process it belongs to."""
    lock = QtCore.QLockFile(f"{path}.lock")
    lock.setStaleLockTime(0)
    return lock


def _read(name: str) -> object:
    """What a JSON file of the folder holds; None if there is none, or what is no JSON."""
    with suppress(BihdistError):
        return file_json(folder() / name, "list", "a list")
    return None


def _write(name: str, data: object) -> None:
    with suppress(OSError, BihdistError):
        folder().mkdir(parents=True, exist_ok=True)
        with whole_file(folder() / name) as temporary:
            temporary.write_text(json.dumps(data, indent=1), encoding="utf-8")
