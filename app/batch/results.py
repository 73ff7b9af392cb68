"""Results as files: arrays in the format that was asked for, and beside them a JSON that says what they are.

The JSON is written last: a result is there if its JSON names this very work and the file it names has the size, and
where that is looked at the checksum, that it says.
"""

import io
import json
import os
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core.arrays import AnyArray
from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.file_content import MOST_JSON_BYTES, json_value
from bihdist_core.formats.array_file import array_in, put_array
from bihdist_core.formats.gifti_output import write_gifti_values

from ..document.json_values import Reader, listed, number, or_none, text, whole
from .storage import Folder
from .work_order import ARRAYS, GIFTI

CHUNK = 1024
"""Rows and columns of a chunk of a Zarr array, which is read and written by chunks."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """An array that comes in blocks along an axis, each when it is asked for."""

    shape: tuple[int, ...]
    dtype: np.dtype
    axis: int
    each: Callable[[], Iterator[AnyArray]]

    def into(self, target: Any) -> None:
        """Fill what takes slices."""
        begin = 0
        for block in self.each():
            end = begin + block.shape[self.axis]
            target[(slice(None),) * self.axis + (slice(begin, end),)] = block
            begin = end

    def whole(self) -> AnyArray:
        """The array with all blocks in memory."""
        array = np.empty(self.shape, self.dtype)
        self.into(array)
        return array


Array = AnyArray | Blocks


def facts_of(folder: Folder, name: str, key: str, verify: bool = False) -> dict[str, Any] | None:
    """What is said of a result that is there, complete; None if it is not, or is of other work.

    verify: whether its bytes are read, to be those that were written.
    """
    facts = facts_in(folder, name)
    if facts is None or facts.get("key") != key or not is_complete(folder, facts):
        return None
    return facts if not verify or facts.get("sha256") == folder.sha256(facts["file"]) else None


def facts_in(folder: Folder, name: str) -> dict[str, Any] | None:
    """What a JSON says, be its file complete or not; None if there is none, or no JSON of ours."""
    if (folder.size(f"{name}.json") or 0) > MOST_JSON_BYTES:
        return None
    try:
        facts = json_value((folder.read(f"{name}.json") or b"null").decode())
    except ValueError:  # ParameterError, too
        return None
    return facts if isinstance(facts, dict) else None


def is_complete(folder: Folder, facts: Mapping[str, Any]) -> bool:
    """Whether the file of a result is there with all its bytes, and what is said of it is as it is written here."""
    file = facts.get("file")
    return isinstance(file, str) and folder.size(file) == facts.get("bytes", -1) and _are_of_their_kinds(facts)


_NUMBERS = ("accuracy", "mean", "median", "area_under_curve", "seconds")
_KINDS: dict[str, Reader] = {
    "shape": listed(whole),
    "repairs": listed(text),
    "maxima": listed(number),
    "scales": listed(number),
    **{name: or_none(number) for name in _NUMBERS},
}
"""Of facts that stand in tables, or that others are made of."""


def _are_of_their_kinds(facts: Mapping[str, Any]) -> bool:
    try:
        for name in facts.keys() & _KINDS.keys():
            _KINDS[name](facts[name], name)
    except ParameterError:
        return False
    return True


def write_result(
    folder: Folder,
    name: str,
    key: str,
    arrays: Mapping[str, Array],
    facts: Mapping[str, Any],
    begin: float,
    format: str = "npy",
    file: str = "",
) -> dict[str, Any]:
    """Arrays by name, the first of which is the result, and what is to be said of them; what was written.

    begin: as of `write_facts`.  file: where the arrays go, if not beside the JSON.

    Raises OutputError if it cannot be written; then no JSON says that it is there.
    """
    format = format if format != "npy" or len(arrays) == 1 else "npz"
    file = file or f"{name}.{format}"
    folder.check_free(f"{name}.json")
    folder.check_free(file, is_folder=format == "zarr")
    _forget(folder, name, file)
    if format == "zarr":
        write_zarr(folder, file, arrays, facts)
    else:
        with folder.writing(file) as path:
            _write(path, format, arrays)
    first = next(iter(arrays.values()))
    return write_facts(folder, name, key, file, {"shape": list(first.shape), "dtype": str(first.dtype), **facts}, begin)


def _forget(folder: Folder, name: str, file: str) -> None:
    """What was there of other work: its JSON, and its file if that has another name."""
    before = (facts_in(folder, name) or {}).get("file")
    folder.remove(f"{name}.json")
    if before != file and before in [f"{name}.{format}" for format in ARRAYS]:
        folder.remove(before)


def write_facts(
    folder: Folder, name: str, key: str, file: str, facts: Mapping[str, Any], begin: float
) -> dict[str, Any]:
    """The JSON beside a file that is complete.

    begin: the `time.monotonic()` from which its seconds count; of what was put together, earlier by those of its parts.
    """
    seconds = round(time.monotonic() - begin, 3)
    there = {"file": file, "bytes": folder.size(file), "sha256": folder.sha256(file)}
    facts_in_file = {**there, **facts, "seconds": seconds, "key": key}
    text = json.dumps(facts_in_file, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    folder.write(f"{name}.json", text.encode())
    return facts_in_file


def _write(path: Path, format: str, arrays: Mapping[str, Array]) -> None:
    if format == "npy":
        (array,) = arrays.values()
        if isinstance(array, Blocks):
            # Larger than memory, it may be.
            there = np.lib.format.open_memmap(path, "w+", array.dtype, array.shape)
            if hasattr(os, "posix_fallocate"):
                # On a full disk, an error now rather than the end of the process later.
                with path.open("r+b") as file:
                    os.posix_fallocate(file.fileno(), 0, path.stat().st_size)
            array.into(there)
            there.flush()
            return
        with path.open("wb") as file:
            put_array(file, array)
    elif format == GIFTI:
        (array,) = _whole(arrays).values()
        with path.open("wb") as file:
            write_gifti_values(file, path.name, {str(k): column for k, column in enumerate(array.T)})
    elif format == "npz":
        with path.open("wb") as file:
            np.savez(file, **_whole(arrays))  # type: ignore[arg-type]
    else:
        from scipy.io import savemat

        # Of a list MATLAB makes a column.
        savemat(path, _whole(arrays), oned_as="column")


def _whole(arrays: Mapping[str, Array]) -> dict[str, AnyArray]:
    """Blocks that have two names are put together once."""
    blocks = {id(array): array for array in arrays.values() if isinstance(array, Blocks)}
    wholes = {key: array.whole() for key, array in blocks.items()}
    return {name: wholes[id(array)] if isinstance(array, Blocks) else array for name, array in arrays.items()}


def read_arrays(folder: Folder, file: str) -> dict[str, AnyArray]:
    """The arrays of a file that `write_result` has written, by name; a single one of .npy has none, ""."""
    if file.endswith(".zarr"):
        import zarr

        group = zarr.open_group(zarr_store(folder, file), mode="r")
        return {name: np.asarray(group[name]) for name in group.array_keys()}
    content = folder.read(file)
    if content is None:
        raise OutputError(f"{folder}/{file} is gone.")
    try:
        return _arrays_in(content, file)
    except Exception:  # of whatever reads what is damaged
        raise OutputError(f"{folder}/{file} is damaged; the same command with --verify makes it again.") from None


def _arrays_in(content: bytes, file: str) -> dict[str, AnyArray]:
    if file.endswith(".mat"):
        from scipy.io import loadmat

        found = loadmat(io.BytesIO(content))
        return {name: np.squeeze(array) for name, array in found.items() if not name.startswith("__")}
    if file.endswith(".npy"):
        return {"": array_in(io.BytesIO(content), len(content))}
    return dict(np.load(io.BytesIO(content), allow_pickle=False).items())


def check_format(format: str) -> None:
    """ParameterError for a format that is none, or whose package is missing, which is named."""
    if format not in ARRAYS:
        raise ParameterError(f"There is no format {format!r}; arrays are written as {', '.join(ARRAYS)}.")
    if format == "zarr":
        try:
            import zarr  # noqa: F401
        except ImportError:
            raise ParameterError("Zarr arrays need the package zarr: pip install 'bihdist[zarr]'.") from None


def write_zarr(folder: Folder, file: str, arrays: Mapping[str, Array], facts: Mapping[str, Any]) -> None:
    """A Zarr group of arrays, what is said of them in its attributes."""
    import zarr

    with folder.writing_folder(file) as begun:
        group = zarr.open_group(zarr_store(folder, begun), mode="w", attributes=dict(facts))
        for each, array in arrays.items():
            chunks = tuple(min(CHUNK, max(length, 1)) for length in array.shape)
            there = group.create_array(each, shape=array.shape, dtype=array.dtype, chunks=chunks)
            if isinstance(array, Blocks):
                array.into(there)
            else:
                there[...] = array


def zarr_store(folder: Folder, file: str) -> Any:
    """Where Zarr keeps the arrays of a file."""
    if folder.local is not None:
        return str(folder.local / file)
    from zarr.storage import FsspecStore

    return FsspecStore.from_url(f"{folder.address}/{file}")
