"""Contents of files that anybody may have written: regular files of bounded size, as bytes, text or JSON.

`what` begins the sentence of an error, "The WHAT PATH cannot be read": "recipe", "map in".
"""

import json
import os
import re
import stat
from pathlib import Path
from typing import Any, BinaryIO

from .errors import MeshError, ParameterError, unreadable

MOST_BYTES = 1 << 30
"""Of a text: ten million numbers, each on a line, take a tenth of that."""
MOST_JSON_BYTES = 1 << 27
MOST_NESTED = 64
"""Lists and records within each other; ours have less than ten."""


def open_regular(path: str | os.PathLike[str], what: str) -> BinaryIO:
    """Return a file that is open for reading; ParameterError if it cannot be, and for folders, pipes and devices."""
    try:
        # Before it is opened: a pipe would be waited for.
        kind = os.stat(path).st_mode
        if not stat.S_ISREG(kind):
            reason = "it is a folder" if stat.S_ISDIR(kind) else "it is not a regular file"
            raise ParameterError(f"The {what} {path} cannot be read: {reason}.")
        return open(path, "rb")
    except (OSError, ValueError) as error:
        if isinstance(error, ParameterError):
            raise
        raise unreadable(f"The {what} {path}", error) from None  # ValueError: a path with a zero in it


def file_text(path: str | os.PathLike[str], what: str, most: int = MOST_BYTES) -> str:
    """Return the text of a file in UTF-8, with or without a mark of that; ParameterError if it has none, or too
    much."""
    with open_regular(path, what) as file:
        try:
            size = os.fstat(file.fileno()).st_size
            if size > most:
                reason = f"it has {size / 1e6:,.0f} MB, and such a file has at most {most / 1e6:,.0f}"
                raise ParameterError(f"The {what} {path} cannot be read: {reason}.")
            return file.read(most).decode("utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise unreadable(f"The {what} {path}", error) from None


def bytes_beside(path: Path, name: str, where: str, most: int, begin: int = 0, count: int = -1) -> bytes:
    """Return the bytes, or `count` of them, of a file that another, which it stands beside, names.

    Raises MeshError, which begins with `where`, for a name of any other place, and a file of more than `most` bytes.
    """
    if not name or name in (".", "..") or re.search(r"[/\\:\0]", name):
        raise MeshError(f"{where} is {name[:80]!r}; only a file in the folder of the {path.suffix} is read.")
    try:
        status = (path.parent / name).stat()
        if not stat.S_ISREG(status.st_mode):
            raise MeshError(f"{where}, {name[:80]!r}, is not a regular file.")
        if status.st_size > most:
            raise MeshError(f"{where}, {name[:80]!r}, has more than {most / 2**30:g} GiB.")
        with open(path.parent / name, "rb") as file:
            file.seek(begin)
            return file.read(count)
    except OSError as error:
        raise MeshError(f"{where}, {name[:80]!r} beside it, cannot be read: {error.strerror or error}.") from None


def file_json(path: str | os.PathLike[str], what: str, kind: str) -> Any:
    """Return the value in a JSON file; an error says that the path "is not" of this `kind`, such as "a recipe"."""
    text = file_text(path, what, MOST_JSON_BYTES)
    try:
        return json_value(text)
    except ParameterError as error:
        raise ParameterError(f"{Path(path)} is not {kind}: {error}") from None


def json_value(text: str) -> Any:
    """Return the value of a text in JSON; ParameterError, "it is not JSON" or "it is nested too deep", where there is
    none."""
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        raise ParameterError(f"it is not JSON (line {error.lineno}: {error.msg}).") from None
    except ValueError:  # a whole number of thousands of digits
        raise ParameterError("it is not JSON that can be read: it has a number of thousands of digits.") from None
    except RecursionError:
        raise ParameterError(TOO_DEEP) from None
    inside = [value]
    for _ in range(MOST_NESTED):
        children = (
            each.values() if isinstance(each, dict) else each for each in inside if isinstance(each, dict | list)
        )
        inside = [child for some in children for child in some if isinstance(child, dict | list)]
        if not inside:
            return value
    raise ParameterError(TOO_DEEP)


TOO_DEEP = f"its lists and objects are nested more than {MOST_NESTED} deep."
