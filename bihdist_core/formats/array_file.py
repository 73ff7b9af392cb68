"""Arrays in .npy files and .npz archives, which anybody may have written: plain numbers or texts, as many as the header
says."""

import ast
import math
import os
import re
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, BinaryIO

import numpy as np

from ..arrays import AnyArray
from ..errors import ParameterError
from ..file_content import open_regular
from .compression import MOST_BYTES

_MAGIC = b"\x93NUMPY"
_COUNTS = {(1, 0): 2, (2, 0): 4}
"""By version, the bytes of the header's length; version 3 is of tables, whose columns have names."""
_LONGEST = 10_000
"""Bytes of a header, as NumPy has it."""
_PLAIN = re.compile(r"[<>|=][biufcSU][1-9][0-9]{0,8}")
_ENCRYPTED = 1
"""A bit of the flags of an archive's entries."""


def read_array(path: str | os.PathLike[str], what: str) -> AnyArray:
    """Read the array in a .npy file.

    Raises ParameterError, with the file and the reason, for anything else; the message calls the file `what`, "map in".
    """
    with open_regular(path, what) as file:
        try:
            return array_in(file, os.fstat(file.fileno()).st_size)
        except ParameterError as error:
            raise ParameterError(f"The {what} {path} cannot be read: {error}") from None
        except OSError as error:
            raise ParameterError(f"The {what} {path} cannot be read: {error.strerror or error}.") from None
        except MemoryError:
            raise ParameterError(f"The {what} {path} is too large for the memory of this computer.") from None


def put_array(file: BinaryIO, array: AnyArray) -> None:
    """Write an array, by rows or by columns as it lies there, into an open .npy file; OSError where there is no room.

    The bytes are those of `np.save`, which does not notice that a disk is full.
    """
    facts = np.lib.format.header_data_from_array_1_0(array)
    np.lib.format.write_array_header_1_0(file, facts)
    file.write(np.ascontiguousarray(array.T if facts["fortran_order"] else array).data)


def array_in(file: BinaryIO, size: int) -> AnyArray:
    """Read the array in an open .npy file of so many bytes; ParameterError, the end of a sentence, if there is none."""
    dtype, shape, is_fortran = _header(file)
    wanted, there = math.prod(shape) * dtype.itemsize, size - file.tell()
    if wanted != there:
        raise ParameterError(f"its header announces {wanted:,} bytes of numbers, and {there:,} follow.")
    content = file.read(wanted)
    if len(content) != wanted:
        raise ParameterError(f"it ends after {len(content):,} of {wanted:,} bytes of numbers.")
    array: AnyArray = np.frombuffer(content, dtype).reshape(shape, order="F" if is_fortran else "C")
    return array


def _header(file: BinaryIO) -> tuple[np.dtype, tuple[int, ...], bool]:
    start = file.read(8)
    if start[:6] != _MAGIC:
        raise ParameterError("it is not a .npy file.")
    digits = _COUNTS.get((start[6], start[7]) if len(start) == 8 else (0, 0))
    length = int.from_bytes(file.read(digits or 0), "little")
    if digits is None or length > _LONGEST:
        raise ParameterError("its header is damaged.")
    try:
        # Python 2 wrote an L after some numbers.
        facts = ast.literal_eval(re.sub(r"(?<=\d)L\b", "", file.read(length).decode("latin1").strip()))
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        raise ParameterError("its header is damaged.") from None
    descr, is_fortran, shape = _facts(facts)
    if not isinstance(descr, str) or not _PLAIN.fullmatch(descr):
        raise ParameterError("it does not hold plain numbers.")
    try:
        return np.dtype(descr), shape, is_fortran
    except (TypeError, ValueError):
        raise ParameterError("its header is damaged.") from None


def _facts(facts: Any) -> tuple[Any, bool, tuple[int, ...]]:
    if isinstance(facts, dict) and facts.keys() == {"descr", "fortran_order", "shape"}:
        shape, is_fortran = facts["shape"], facts["fortran_order"]
        is_shape = isinstance(shape, tuple) and len(shape) <= 32
        # bool is an int, too.
        is_shape = is_shape and all(type(length) is int and 0 <= length < 2**48 for length in shape)
        if is_shape and isinstance(is_fortran, bool):
            return facts["descr"], is_fortran, shape
    raise ParameterError("its header is damaged.")


# ---------------------------------------------------------------------- archives
@contextmanager
def opened_archive(file: BinaryIO, path: str | os.PathLike[str]) -> Iterator[zipfile.ZipFile]:
    """Open the .npz archive in an open file; ParameterError, with its path, if it is none."""
    with ExitStack() as files:
        try:
            archive = files.enter_context(zipfile.ZipFile(file))
        except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile):
            raise ParameterError(f"{path} is not an archive of arrays.") from None
        yield archive


def archived_array(archive: zipfile.ZipFile, name: str, path: str | os.PathLike[str]) -> AnyArray:
    """Read the array of a name in an archive; ParameterError, with the path, if it cannot be."""
    try:
        entry = archive.getinfo(f"{name}.npy")
    except KeyError:
        raise ParameterError(f"{path} has no {name!r}.") from None
    # Packed, a small file may hold more than there is memory for.
    if entry.file_size > MOST_BYTES or entry.flag_bits & _ENCRYPTED:
        raise ParameterError(f"{path}: {name!r} is encrypted, or has more than {MOST_BYTES / 2**30:g} GiB.")
    try:
        with archive.open(entry) as file:
            return array_in(file, entry.file_size)  # type: ignore[arg-type]
    except ParameterError as error:
        raise ParameterError(f"{path}: {name!r} cannot be read: {error}") from None
    except MemoryError:
        raise ParameterError(f"{path}: {name!r} is too large for the memory of this computer.") from None
    except (OSError, ValueError, EOFError, NotImplementedError, zipfile.BadZipFile, zlib.error):
        raise ParameterError(f"{path}: {name!r} cannot be read; the file is damaged.") from None
