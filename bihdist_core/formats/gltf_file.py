"""Contents of glTF files: their JSON, and the arrays that its accessors name.

Format: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.  Buffers stand in the file, or in files beside it.
"""

import base64
import binascii
import json
import math
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from ..arrays import AnyArray, FloatArray
from ..errors import MeshError
from ..file_content import bytes_beside, json_value
from .compression import MOST_BYTES

_MAGIC, _JSON, _BIN = b"glTF", b"JSON", b"BIN\0"
COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""Types of numbers, by glTF's codes."""


@dataclass
class GltfFile:
    """The JSON of a file, the binary chunk of a .glb, and buffers that have been read."""

    name: str
    data: dict[str, Any]
    inside: bytes | None
    read: dict[int, bytes] = field(default_factory=dict)
    taken: int = 0
    """Bytes that arrays have taken: a small file may name the same bytes again and again."""

    def entries(self, of: dict[str, Any], key: str) -> list[Any]:
        """Return a list, empty if there is none."""
        found = of.get(key, [])
        if not isinstance(found, list):
            raise MeshError(f"{self.name}: {key!r} is not a list.")
        return found

    def entry(self, kind: str, k: Any) -> dict[str, Any]:
        """Return object k of the list of this kind."""
        entries = self.entries(self.data, kind)
        if isinstance(k, bool) or not isinstance(k, int) or not 0 <= k < len(entries):
            raise MeshError(f"{self.name}: {kind} {str(k)[:40]} does not exist; there are {len(entries):,}.")
        if not isinstance(entries[k], dict):
            raise MeshError(f"{self.name}: {kind} {k} is not an object.")
        found: dict[str, Any] = entries[k]
        return found

    def count(self, of: dict[str, Any], key: str, where: str, default: int | None = 0) -> int:
        """Return a whole number that is not negative."""
        found = of.get(key, default)
        if isinstance(found, bool) or not isinstance(found, int) or not 0 <= found <= MOST_BYTES:
            raise MeshError(f"{self.name}: {key} of {where} is {str(found)[:40]}, not a count.")
        return found

    def floats(self, of: dict[str, Any], key: str, default: list[float], where: str) -> FloatArray:
        """Return as many finite numbers as the default has."""
        found = of.get(key, default)
        is_fine = isinstance(found, list) and len(found) == len(default)
        if is_fine:
            is_fine = all(isinstance(x, int | float) and abs(x) < 1e300 and math.isfinite(x) for x in found)
        if not is_fine:
            raise MeshError(f"{self.name}: {key} of {where} is {str(found)[:60]}, not {len(default)} numbers.")
        return np.array(found, np.float64)

    def take(self, size: int) -> None:
        """Count bytes in memory."""
        self.taken += size
        if self.taken > MOST_BYTES:
            raise MeshError(f"{self.name} unfolds to more than {MOST_BYTES / 2**30:g} GiB; it is not read.")

    def buffer(self, k: int) -> bytes:
        """Return the bytes of a buffer."""
        if k not in self.read:
            entry = self.entry("buffers", k)
            size, uri = self.count(entry, "byteLength", f"buffer {k}", None), entry.get("uri")
            if uri is None and k == 0 and self.inside is not None:
                content = self.inside
            elif isinstance(uri, str) and (head := re.match(r"data:[^,]{0,200};base64,", uri)):
                try:
                    content = base64.b64decode(uri[head.end() :], validate=True)
                except (binascii.Error, ValueError) as error:
                    raise MeshError(f"{self.name}: buffer {k} is damaged base64 text ({error}).") from None
            else:
                what = "has no data" if uri is None else f"is {str(uri)[:80]!r}, which is not followed from here"
                raise MeshError(f"{self.name}: buffer {k} {what}.")
            if len(content) < size:
                raise MeshError(f"{self.name}: buffer {k} announces {size:,} bytes and has {len(content):,}.")
            self.read[k] = content[:size]
        return self.read[k]

    def array(self, k: Any, kind: str, components: tuple[int, ...]) -> AnyArray:
        """Return (count, width) numbers of an accessor of this type, "SCALAR" or "VEC3", as the file has them."""
        entry, where = self.entry("accessors", k), f"accessor {k}"
        component, count = entry.get("componentType"), self.count(entry, "count", where, None)
        if entry.get("type") != kind or component not in components:
            found = f"{str(entry.get('type'))[:20]} of {str(component)[:20]}"
            raise MeshError(f"{self.name}: {where} holds {found}, not {kind} of {' or '.join(map(str, components))}.")
        if "sparse" in entry or "bufferView" not in entry:
            raise MeshError(f"{self.name}: {where} is sparse, which is not read.")
        view = self.entry("bufferViews", entry["bufferView"])
        where = f"bufferView {entry['bufferView']}"
        content = self.buffer(self.count(view, "buffer", where, None))
        dtype, width = np.dtype(COMPONENTS[component]), 3 if kind == "VEC3" else 1
        begin = self.count(view, "byteOffset", where)
        end = begin + self.count(view, "byteLength", where, None)
        begin += self.count(entry, "byteOffset", f"accessor {k}")
        size = width * dtype.itemsize
        stride = self.count(view, "byteStride", where) or size
        last = begin + stride * (count - 1) + size
        if stride < size or (count and last > min(end, len(content))):
            raise MeshError(f"{self.name}: accessor {k} reads {count:,} entries and goes beyond the end of {where}.")
        self.take(8 * width * count)
        return np.ndarray((count, width), dtype, content, begin if count else 0, (stride, dtype.itemsize))


def gltf_file(raw: bytes, name: str) -> GltfFile:
    """Read a .gltf or .glb file; MeshError where it is none, or is cut off or damaged."""
    text, inside = _chunks(raw, name) if raw[:4] == _MAGIC else (raw, None)
    return GltfFile(name, _parsed(text, name), inside)


def with_buffers(content: bytes, path: Path) -> bytes:
    """Return the content of a .gltf file with the files that it names inside it.

    These stand beside it, or are refused.
    """
    if content[:4] == _MAGIC or b'"uri"' not in content:
        return content
    data = _parsed(content, path.name)
    changed = False
    for k, buffer in enumerate(GltfFile(path.name, data, None).entries(data, "buffers")):
        uri = buffer.get("uri") if isinstance(buffer, dict) else None
        if isinstance(uri, str) and not uri.startswith("data:"):
            coded = base64.b64encode(bytes_beside(path, unquote(uri), f"{path.name}: buffer {k}", MOST_BYTES)).decode()
            buffer["uri"], changed = f"data:;base64,{coded}", True
    return json.dumps(data).encode() if changed else content


def _chunks(raw: bytes, name: str) -> tuple[bytes, bytes | None]:
    """Return the JSON and the binary chunk of a .glb file, None if it has none."""
    version, length = (int.from_bytes(raw[at : at + 4], "little") for at in (4, 8))
    if version != 2:
        raise MeshError(f"{name} is a GLB file of version {version}; only version 2 is read.")
    if length != len(raw):
        state = "it is cut off or damaged" if length > len(raw) else "its length is wrong"
        raise MeshError(f"{name} announces {length:,} bytes and has {len(raw):,}: {state}.")
    at, found = 12, []
    while at < length:
        size, kind, begin = int.from_bytes(raw[at : at + 4], "little"), raw[at + 4 : at + 8], at + 8
        if begin + size > length:
            raise MeshError(f"{name}: a chunk of {size:,} bytes goes beyond the end; the file is damaged.")
        found.append((kind, raw[begin : begin + size]))
        at = begin + size
    if not found or found[0][0] != _JSON:
        raise MeshError(f"{name} is damaged: a GLB file begins with a chunk of JSON.")
    return found[0][1], found[1][1] if len(found) > 1 and found[1][0] == _BIN else None


def _parsed(text: bytes, name: str) -> dict[str, Any]:
    try:
        data = json_value(text.decode("utf-8-sig"))
    except ValueError as error:  # ParameterError, too
        raise MeshError(f"{name} is not a glTF file, or is cut off or damaged ({str(error)[:100]}).") from None
    version = data.get("asset", {}) if isinstance(data, dict) else None
    version = version.get("version") if isinstance(version, dict) else None
    if not isinstance(version, str) or not version.startswith("2."):
        raise MeshError(f"{name} is not a glTF 2 file: it does not say so in its 'asset'.")
    found: dict[str, Any] = data
    return found
