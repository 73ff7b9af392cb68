"""A folder of this process among the temporary ones, which goes with it; the next one sweeps those of killed ones."""

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
"""A folder that is younger may not have its lock yet."""

_kept: list[tuple[Path, QtCore.QLockFile]] = []


def own_folder() -> Path:
    """The folder, made where it is not there; OSError if it cannot be."""
    if not _kept or not _kept[0][0].is_dir():
        _sweep()
        folder = Path(tempfile.mkdtemp(prefix=PREFIX))
        lock = _lock(folder)
        lock.tryLock(0)
        _kept[:] = [(folder, lock)]
        atexit.register(remove_own_folder)
    return _kept[0][0]


def remove_own_folder() -> None:
    """To be called where the process ends without what Python does at its end."""
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
