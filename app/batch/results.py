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
from bihdist_core.formats.gifti import write_gifti_values

from ..document.json_values import Reader, listed, number, or_none, text, whole
from ..version import install_command
from .storage import Folder
from .work_order import ARRAYS, GIFTI

ZARR_CHUNK = 1024
"""Rows and columns of a chunk of a Zarr array, which is read and written by chunks."""


@dataclass(frozen=True, eq=False)
class ArrayBlocks:
    """An array that comes in blocks along an axis, each when it is asked for."""

    shape: tuple[int, ...]
    dtype: np.dtype
    axis: int
    each: Callable[[], Iterator[AnyArray]]

    def into(self, target: Any) -> None:
        """Fill a target that takes slices."""
        begin = 0
        for block in self.each():
            end = begin + block.shape[self.axis]
            target[(slice(None),) * self.axis + (slice(begin, end),)] = block
            begin = end

    def whole(self) -> AnyArray:
        """Return the array with all blocks in memory."""
        array = np.empty(self.shape, self.dtype)
        self.into(array)
        return array


Array = AnyArray | ArrayBlocks


def existing_metadata(folder: Folder, name: str, key: str, verify: bool = False) -> dict[str, Any] | None:
    """Return the metadata of a result that is complete, None if it is missing or of other work.

    With `verify`, its bytes must have their checksum.
    """
    metadata = metadata_in(folder, name)
    if metadata is None or metadata.get("key") != key or not is_complete(folder, metadata):
        return None
    return metadata if not verify or metadata.get("sha256") == folder.sha256(metadata["file"]) else None


def metadata_in(folder: Folder, name: str) -> dict[str, Any] | None:
    """Return the metadata in a JSON file, None if there are none of ours."""
    if (folder.size(f"{name}.json") or 0) > MOST_JSON_BYTES:
        return None
    try:
        metadata = json_value((folder.read(f"{name}.json") or b"null").decode())
    except ValueError:  # ParameterError, too
        return None
    return metadata if isinstance(metadata, dict) else None


def is_complete(folder: Folder, metadata: Mapping[str, Any]) -> bool:
    """Return whether the file of a result has all its bytes, and its metadata are valid."""
    file = metadata.get("file")
    return isinstance(file, str) and folder.size(file) == metadata.get("bytes", -1) and _are_of_their_kinds(metadata)


_NUMBERS = ("accuracy", "mean", "median", "area_under_curve", "seconds")
_KINDS: dict[str, Reader] = {
    "shape": listed(whole),
    "repairs": listed(text),
    "maxima": listed(number),
    "scales": listed(number),
    **{name: or_none(number) for name in _NUMBERS},
}
"""The values of metadata that stand in tables, or that others are made of."""


def _are_of_their_kinds(metadata: Mapping[str, Any]) -> bool:
    try:
        for name in metadata.keys() & _KINDS.keys():
            _KINDS[name](metadata[name], name)
    except ParameterError:
        return False
    return True


def write_result(
    folder: Folder,
    name: str,
    key: str,
    arrays: Mapping[str, Array],
    metadata: Mapping[str, Any],
    begin: float,
    format: str = "npy",
    file: str = "",
) -> dict[str, Any]:
    """Write arrays by name, the first of which is the result, and their metadata; return the metadata.

    `begin` is that of `write_metadata`; the arrays go to `file`, if not beside the JSON. Raises OutputError if they
    cannot be written; then no JSON says that they are there.
    """
    format = format if format != "npy" or len(arrays) == 1 else "npz"
    file = file or f"{name}.{format}"
    folder.check_free(f"{name}.json")
    folder.check_free(file, is_folder=format == "zarr")
    _forget(folder, name, file)
    if format == "zarr":
        write_zarr(folder, file, arrays, metadata)
    else:
        with folder.writing(file) as path:
            _write(path, format, arrays)
    first = next(iter(arrays.values()))
    return write_metadata(
        folder, name, key, file, {"shape": list(first.shape), "dtype": str(first.dtype), **metadata}, begin
    )


def _forget(folder: Folder, name: str, file: str) -> None:
    """Remove the metadata of other work, and its file if that has another name."""
    before = (metadata_in(folder, name) or {}).get("file")
    folder.remove(f"{name}.json")
    if before != file and before in [f"{name}.{format}" for format in ARRAYS]:
        folder.remove(before)


def write_metadata(
    folder: Folder, name: str, key: str, file: str, metadata: Mapping[str, Any], begin: float
) -> dict[str, Any]:
    """Write the metadata of a file that is complete, and return them.

    Seconds count from `begin` of `time.monotonic()`; a joined result begins earlier by those of its parts.
    """
    seconds = round(time.monotonic() - begin, 3)
    there = {"file": file, "bytes": folder.size(file), "sha256": folder.sha256(file)}
    written = {**there, **metadata, "seconds": seconds, "key": key}
    text = json.dumps(written, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    folder.write(f"{name}.json", text.encode())
    return written


def _write(path: Path, format: str, arrays: Mapping[str, Array]) -> None:
    if format == "npy":
        (array,) = arrays.values()
        if isinstance(array, ArrayBlocks):
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
    """Return the arrays in memory; blocks that have two names are put together once."""
    blocks = {id(array): array for array in arrays.values() if isinstance(array, ArrayBlocks)}
    wholes = {key: array.whole() for key, array in blocks.items()}
    return {name: wholes[id(array)] if isinstance(array, ArrayBlocks) else array for name, array in arrays.items()}


def read_arrays(folder: Folder, file: str) -> dict[str, AnyArray]:
    """Return the arrays of a file by `write_result`, by name; the only one of .npy has the name ""."""
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
        raise OutputError(
            f"{folder}/{file} is damaged; run the same command with --verify to compute it again."
        ) from None


def _arrays_in(content: bytes, file: str) -> dict[str, AnyArray]:
    if file.endswith(".mat"):
        from scipy.io import loadmat

        found = loadmat(io.BytesIO(content))
        return {name: np.squeeze(array) for name, array in found.items() if not name.startswith("__")}
    if file.endswith(".npy"):
        return {"": array_in(io.BytesIO(content), len(content))}
    return dict(np.load(io.BytesIO(content), allow_pickle=False).items())


def check_format(format: str) -> None:
    """Raise ParameterError for an unknown format, or for one whose package is missing."""
    if format not in ARRAYS:
        raise ParameterError(f"There is no format {format!r}; arrays are written as {', '.join(ARRAYS)}.")
    if format == "zarr":
        try:
            import zarr  # noqa: F401
        except ImportError:
            raise ParameterError(f"Zarr arrays need the package zarr: {install_command('zarr')}") from None


def write_zarr(folder: Folder, file: str, arrays: Mapping[str, Array], metadata: Mapping[str, Any]) -> None:
    """Write a Zarr group of arrays, with the metadata as its attributes."""
    import zarr

    with folder.writing_folder(file) as begun:
        group = zarr.open_group(zarr_store(folder, begun), mode="w", attributes=dict(metadata))
        for each, array in arrays.items():
            chunks = tuple(min(ZARR_CHUNK, max(length, 1)) for length in array.shape)
            there = group.create_array(each, shape=array.shape, dtype=array.dtype, chunks=chunks)
            if isinstance(array, ArrayBlocks):
                array.into(there)
            else:
                there[...] = array


def zarr_store(folder: Folder, file: str) -> Any:
    """Return the store of a file for Zarr."""
    if folder.local is not None:
        return str(folder.local / file)
    from zarr.storage import FsspecStore

    return FsspecStore.from_url(f"{folder.address}/{file}")


# ---------------------------------------------------------------------- MATLAB
# The layout "dist" is `dist`, as ULRSSM and its successors read it; their metrics do not normalise, and expect an area
# of 1. The layout "geodist" has the distances as `Gamma` (GeomFmaps, DUO-FM) and `geodist` (AttentiveFMaps), and the
# root of the area as `SQRarea` and, sparse as MATLAB has it, `sqrt_area`, by which they divide.
NORMALISED = "metrics that do not normalise, such as ULRSSM's, expect an area of 1: --normalise area"


def laid_out(layout: str, distances: Array, root: float) -> Mapping[str, Any]:
    """Return the arrays of a layout by name; `root` is that of the area."""
    if layout == "dist":
        return {"dist": distances}
    from scipy.sparse import csc_matrix

    one = np.array([[root]])
    # Each reader has a name of its own for the distances, and takes no other.
    return {"geodist": distances, "Gamma": distances, "sqrt_area": csc_matrix(one), "SQRarea": one}


IDS = ("sources", "vertices", "indices")
"""Arrays whose entries are vertex ids."""
COUNT_FROM = "ids_count_from"
"""The variable of a .mat file with the id that a mesh's first vertex has in it."""


def for_matlab(arrays: Mapping[str, Array], one_based: bool) -> tuple[dict[str, Array], dict[str, Any]]:
    """Return arrays with ids that count from 0 or 1, a variable that says so, and the metadata about it.

    An id of -1 for a missing vertex becomes 0 if ids count from 1.
    """
    first = int(one_based)
    ids = {name: array + first for name, array in arrays.items() if name in IDS and not isinstance(array, ArrayBlocks)}
    if not ids:
        return dict(arrays), {}
    metadata: dict[str, Any] = {f"mat_{COUNT_FROM}": first}
    if "indices" in ids:
        metadata["indices"] = f"{first - 1} where there is none"
    return {**arrays, **ids, COUNT_FROM: np.array(first)}, metadata
