"""A temporary folder of this process; those of killed processes are removed by the next one."""

import atexit
import os
import shutil
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from qtpy import QtCore

PREFIX = "bihdist-look-"
YOUNG_S = 60.0
"""Age from which on a folder without a lock is stale."""

_kept: list[tuple[Path, QtCore.QLockFile]] = []


def own_folder() -> Path:
    """Return the folder, made if needed; OSError if it cannot be made."""
    if not _kept or not _kept[0][0].is_dir():
        _sweep()
        folder = Path(tempfile.mkdtemp(prefix=PREFIX))
        lock = _lock(folder)
        lock.tryLock(0)
        _kept[:] = [(folder, lock)]
        atexit.register(remove_own_folder)
    return _kept[0][0]


def remove_own_folder() -> None:
    """Remove the folder where the process ends without Python's own cleanup."""
    while _kept:
        folder, lock = _kept.pop()
        lock.unlock()
        shutil.rmtree(folder, ignore_errors=True)


def _sweep() -> None:
    """Remove folders whose processes are gone."""
    with suppress(OSError):
        for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
            lock = _lock(folder)
            # The lock of a process that is gone is taken over.
            if time.time() - os.lstat(folder).st_mtime > YOUNG_S and lock.tryLock(0):
                lock.unlock()
                shutil.rmtree(folder, ignore_errors=True)


def _lock(folder: Path) -> QtCore.QLockFile:
    lock = QtCore.QLockFile(str(folder / "lock"))
    lock.setStaleLockTime(0)
    return lock
