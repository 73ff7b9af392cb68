"""Files written whole or not at all."""

import errno
import os
import re
import secrets
import stat
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from .errors import OutputError

fcntl: Any = None
with suppress(ImportError):  # on Windows
    import fcntl


def check_output(path: str | os.PathLike[str], formats: Sequence[str]) -> str:
    """Return the one of `formats` that an output path ends in; to be called before long work whose result goes there.

    `formats` are extensions with their dot, such as .npy or .func.gii.  Raises OutputError for another extension, a
    folder that is missing or cannot be written, and a path that is a folder.
    """
    path = Path(path)
    name = path.name.lower()
    extension = next((each for each in formats if name.endswith(each.lower()) and name != each.lower()), "")
    if not extension:
        ending = f"the extension {path.suffix!r}" if path.suffix else "no extension"
        raise OutputError(f"{path} has {ending}; this can be written as {', '.join(formats)}.")
    _check_place(path)
    return extension


def check_outputs(*outputs: tuple[str | os.PathLike[str] | None, Sequence[str]]) -> bool:
    """Call `check_output` for each path that is given, with its formats; return whether any is."""
    named = [(path, formats) for path, formats in outputs if path]
    for path, formats in named:
        check_output(path, formats)
    return bool(named)


TEMPORARY_NAME = re.compile(r"\.(.+)\.half-[0-9a-f]{8}(\..*)?")
"""The names of files while they are written: the first characters of their own, and its ending."""
KEPT_CHARACTERS = 50
"""Characters that a temporary name keeps: it has at most 255 bytes, of which a character takes up to four."""
STALE_S = 86400.0
"""Seconds without a change after which, where there are no locks, a file is taken for abandoned."""


def temporary_name(target: Path) -> Path:
    """Return a new temporary name in the folder of a target."""
    return target.with_name(f".{target.stem[:KEPT_CHARACTERS]}.half-{secrets.token_hex(4)}{target.suffix}")


@contextmanager
def lock(path: Path) -> Iterator[bool]:
    """Lock a file or folder that is being written while the block runs, so that no process takes it for stale.

    Yields whether it is still there, and was not removed before.
    """
    with ExitStack() as files:
        if fcntl is not None:
            with suppress(OSError):  # a file system without locks, or it is gone
                handle = _handle(path)
                files.callback(os.close, handle)
                fcntl.flock(handle, fcntl.LOCK_EX)
        yield path.exists()


def is_stale(path: Path) -> bool:
    """Return whether the process that wrote a file or folder has ended, which releases its lock."""
    try:
        handle = _handle(path)
        try:
            if fcntl is None:
                raise OSError(errno.ENOTSUP, "no locks")
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            return False
        except OSError:
            return time.time() - path.stat().st_mtime > STALE_S
        finally:
            os.close(handle)
    except OSError:
        return False  # another user's, or it is gone


def _handle(path: Path) -> int:
    """Open a file or folder; OSError for anything else, as a pipe would be waited for."""
    kind = path.lstat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)):
        raise OSError(errno.EINVAL, "it is not a regular file")
    return os.open(path, os.O_RDWR if stat.S_ISREG(kind) else os.O_RDONLY)


def remove_stale(folder: Path, name: str = ".*") -> None:
    """Remove the temporary files that killed processes have left in a folder.

    `name` is a regular expression for the names they were to have; their first characters and the extension count.
    """
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            half = TEMPORARY_NAME.fullmatch(entry.name)
            if half is None or not entry.is_file(follow_symlinks=False):
                continue
            if re.fullmatch(name, "".join(half.groups(""))) and is_stale(Path(entry.path)):
                with suppress(OSError):
                    os.unlink(entry.path)


@contextmanager
def atomic_write(path: str | os.PathLike[str], removes_stale: bool = True) -> Iterator[Path]:
    """Yield a temporary path beside `path`, with the same extension, that replaces it when the block ends well.

    If the block raises (also KeyboardInterrupt), the temporary file is removed and an old file at `path` stays as it
    was.  Stale temporary files of the same path are removed first, unless `removes_stale` is False, for folders of many
    files.  A link is followed, not replaced; an old file's permissions are kept.  OSError inside the block, for example
    from a full disk, becomes OutputError.
    """
    path = Path(path)
    _check_place(path)
    target = Path(os.path.realpath(path))
    if removes_stale:
        remove_stale(target.parent, re.escape(target.stem[:KEPT_CHARACTERS] + target.suffix))
    try:
        with _temporary(target) as temporary:
            if target.exists():
                temporary.chmod(stat.S_IMODE(target.stat().st_mode) | stat.S_IWUSR)
            yield temporary
            os.replace(temporary, target)
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{path} could not be written: {error.strerror or error}.") from error


@contextmanager
def _temporary(target: Path) -> Iterator[Path]:
    """Yield a new file for a target, locked, to be moved or else removed when the block ends."""
    with ExitStack() as files:
        while True:
            temporary = temporary_name(target)
            files.callback(_remove, temporary)
            temporary.open("xb").close()
            # Between the two another process may have taken it for stale.
            if files.enter_context(lock(temporary)):
                break
        yield temporary


def _remove(path: Path) -> None:
    with suppress(OSError):
        path.unlink()


def _check_place(path: Path) -> None:
    folder = path.parent
    if "\0" in str(path):
        raise OutputError(f"{str(path)!r} cannot be written: a file name holds no zero bytes.")
    try:
        if path.is_dir():
            raise OutputError(f"{path} is a folder; give the name of a file in it.")
        if not folder.exists():
            raise OutputError(f"{path} cannot be written: there is no folder {folder}.")
        if not folder.is_dir():
            raise OutputError(f"{path} cannot be written: {folder} is not a folder.")
        if path.exists() and not path.is_file():
            raise OutputError(f"{path} is not a regular file and will not be replaced.")
        if not os.access(folder, os.W_OK | os.X_OK) or (path.exists() and not os.access(path, os.W_OK)):
            raise OutputError(f"{path} cannot be written: permission denied.")
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from None
