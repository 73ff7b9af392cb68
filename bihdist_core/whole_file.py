"""Files written whole or not at all."""

import os
import re
import secrets
import stat
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from .errors import OutputError


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


HALF_WRITTEN = re.compile(r"\.(.+)-[0-9a-f]{8}(\.\w+)")
"""The names that files have while they are written: the beginning of their own, and its ending."""
OLD_S = 3600.0
"""Nothing of ours is written for so long."""


def sweep_half_written(folder: Path) -> None:
    """Remove what killed processes have left half written in a folder of the program's own."""
    with suppress(OSError):
        for path in folder.glob(".*"):
            is_half = HALF_WRITTEN.fullmatch(path.name) and path.is_file()
            if is_half and time.time() - path.stat().st_mtime > OLD_S:
                path.unlink(missing_ok=True)


@contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary path in the same folder, with the same extension, that replaces `path` when the block ends well.

    If the block raises (also KeyboardInterrupt), the temporary file is removed and an old file at `path` stays as it
    was.  A link is followed, not replaced; an old file's permissions are kept.
    OSError inside the block, a full disk for example, becomes OutputError.
    """
    path = Path(path)
    _check_place(path)
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.stem[:60]}-{secrets.token_hex(4)}{target.suffix}")
    try:
        with temporary.open("xb"):
            pass
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode) | stat.S_IWUSR)
        yield temporary
        os.replace(temporary, target)
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{path} could not be written: {error.strerror or error}.") from error
    finally:
        with suppress(OSError):
            temporary.unlink()


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
