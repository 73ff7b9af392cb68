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
    """The extension of an output path, in lower case; to be called before long work whose result goes there.

    `formats` are extensions with their dot, such as .npy or .func.gii.  Raises OutputError for another extension, a
    folder that is missing or cannot be written, and a path that is a folder.
    """
    path = Path(path)
    name = path.name.lower()
    extension = next((each for each in formats if name.endswith(each) and name != each), "")
    if not extension:
        ending = f"the extension {path.suffix!r}" if path.suffix else "no extension"
        raise OutputError(f"{path} has {ending}; this can be written as {', '.join(formats)}.")
    _check_place(path)
    return extension


def check_outputs(*outputs: tuple[str | os.PathLike[str] | None, Sequence[str]]) -> bool:
    """`check_output` of each path that there is, with its formats; whether there is any."""
    named = [(path, formats) for path, formats in outputs if path]
    for path, formats in named:
        check_output(path, formats)
    return bool(named)


HALF_WRITTEN = re.compile(r"\.(.+)\.half-[0-9a-f]{8}(\..*)?")
"""The names that files have while they are written: the beginning of their own, and its ending."""
FIRST = 50
"""Letters of a name that the one of a half-written file begins with: it has at most 255 bytes, a letter up to four."""
OLD_S = 86400.0
"""Where there are no locks, what nobody has touched for so long is not being written any more."""


def half_written(target: Path) -> Path:
    """A new name for what is to be at `target` once it is whole."""
    return target.with_name(f".{target.stem[:FIRST]}.half-{secrets.token_hex(4)}{target.suffix}")


@contextmanager
def held(path: Path) -> Iterator[bool]:
    """While the block runs `is_left` says of this file or folder, to every process, that somebody writes it; whether
    it is still there, and has not been swept before."""
    with ExitStack() as files:
        if fcntl is not None:
            with suppress(OSError):  # a file system without locks, or it is gone
                handle = _handle(path)
                files.callback(os.close, handle)
                fcntl.flock(handle, fcntl.LOCK_EX)
        yield path.exists()


def is_left(path: Path) -> bool:
    """Whether whoever was writing a file or folder is gone.  The system lets go of the locks of those that end."""
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
            return time.time() - path.stat().st_mtime > OLD_S
        finally:
            os.close(handle)
    except OSError:
        return False  # somebody else's, or it is gone


def _handle(path: Path) -> int:
    """OSError also for what is neither a file nor a folder: a pipe would be waited for."""
    kind = path.lstat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)):
        raise OSError(errno.EINVAL, "it is not a regular file")
    return os.open(path, os.O_RDWR if stat.S_ISREG(kind) else os.O_RDONLY)


def sweep_half_written(folder: Path, name: str = ".*") -> None:
    """Remove the files that killed processes have left half written in a folder.

    name: an expression for the names, of which the first letters and the extension count, that they were to have.
    """
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            half = HALF_WRITTEN.fullmatch(entry.name)
            if half is None or not entry.is_file(follow_symlinks=False):
                continue
            if re.fullmatch(name, "".join(half.groups(""))) and is_left(Path(entry.path)):
                with suppress(OSError):
                    os.unlink(entry.path)


@contextmanager
def whole_file(path: str | os.PathLike[str], sweeps: bool = True) -> Iterator[Path]:
    """A temporary path in the same folder, with the same extension, that replaces `path` when the block ends well.

    If the block raises (also KeyboardInterrupt), the temporary file is removed and an old file at `path` stays as it
    was.  What a process has left that was killed in such a block is removed by the next for the same path, unless
    sweeps is False, for folders of many files.  A link is followed, not replaced; an old file's permissions are kept.
    OSError inside the block, a full disk for example, becomes OutputError.
    """
    path = Path(path)
    _check_place(path)
    target = Path(os.path.realpath(path))
    if sweeps:
        sweep_half_written(target.parent, re.escape(target.stem[:FIRST] + target.suffix))
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
    """A new file for a target that nobody sweeps, to be moved or else removed when the block ends."""
    with ExitStack() as files:
        while True:
            temporary = half_written(target)
            files.callback(_remove, temporary)
            temporary.open("xb").close()
            # Between the two somebody may have taken it for left.
            if files.enter_context(held(temporary)):
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
