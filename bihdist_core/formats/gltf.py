"""glTF 2.0 files, .gltf with its buffers inside or beside it and .glb: a strict reader of their triangles.

Format: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.  Of the scene that the file shows, each mesh is put
where its nodes place it.  Vertex ids are the order of the nodes, a node before those below it; at each node, the
primitives of its mesh in order, with all vertices that their POSITION accessor has.  Primitives of a mesh that name
one accessor share its vertices.  Materials, colours, textures, skins and shapes to be morphed into are left out.
"""

import base64
import binascii
import json
import math
import re
import stat
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .gzip_files import MOST_BYTES
from .polygons import Polygons, checked_corners, strip_triangles

_MAGIC, _JSON, _BIN = b"glTF", b"JSON", b"BIN\0"
_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_INDICES = (5121, 5123, 5125)
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_HARMLESS = re.compile("KHR_(materials|texture|lights|xmp|mesh_quantization|animation)|EXT_(texture|lights)")
"""Extensions that triangles do not depend on, or that need nothing more."""


def read_gltf(raw: bytes, name: str) -> Polygons:
    """The triangles of a glTF file; MeshError where it is none, is cut off or damaged, or needs what is not read."""
    text, inside = _chunks(raw, name) if raw[:4] == _MAGIC else (raw, None)
    data = _parsed(text, name)
    file = _File(name, data, inside)
    for extension in file.entries(data, "extensionsRequired"):
        if not isinstance(extension, str) or not _HARMLESS.match(extension):
            raise MeshError(f"{name} needs the extension {str(extension)[:60]!r}, which is not read; save it without.")
    return _Joined(file).polygons()


def with_buffers(content: bytes, path: Path) -> bytes:
    """The content of a .gltf file with the files that it names inside it; these stand beside it, or are refused."""
    if content[:4] == _MAGIC or b'"uri"' not in content:
        return content
    data = _parsed(content, path.name)
    changed = False
    for k, buffer in enumerate(_File(path.name, data, None).entries(data, "buffers")):
        uri = buffer.get("uri") if isinstance(buffer, dict) else None
        if isinstance(uri, str) and not uri.startswith("data:"):
            coded = base64.b64encode(_beside(path, unquote(uri), k)).decode()
            buffer["uri"], changed = f"data:;base64,{coded}", True
    return json.dumps(data).encode() if changed else content


def _beside(path: Path, uri: str, k: int) -> bytes:
    """The bytes of the file beside a .gltf that its buffer k names."""
    if not uri or uri in (".", "..") or re.search(r"[/\\:\0]", uri):
        raise MeshError(f"{path.name}: buffer {k} is {uri[:80]!r}; only a file in the folder of the .gltf is read.")
    other = path.parent / uri
    try:
        status = other.stat()
        if not stat.S_ISREG(status.st_mode):
            raise MeshError(f"{path.name}: buffer {k}, {uri[:80]!r}, is not a regular file.")
        if status.st_size > MOST_BYTES:
            raise MeshError(f"{path.name}: buffer {k}, {uri[:80]!r}, has more than {MOST_BYTES / 2**30:g} GiB.")
        return other.read_bytes()
    except OSError as error:
        raise MeshError(
            f"{path.name}: buffer {k}, {uri[:80]!r} beside it, cannot be read: {error.strerror or error}."
        ) from None


def _chunks(raw: bytes, name: str) -> tuple[bytes, bytes | None]:
    """The JSON and the binary chunk of a .glb file, None if it has none."""
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
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deep" if isinstance(error, RecursionError) else str(error)[:100]
        raise MeshError(f"{name} is not a glTF file, or is cut off or damaged ({reason}).") from None
    version = data.get("asset", {}) if isinstance(data, dict) else None
    version = version.get("version") if isinstance(version, dict) else None
    if not isinstance(version, str) or not version.startswith("2."):
        raise MeshError(f"{name} is not a glTF 2 file: it does not say so in its 'asset'.")
    found: dict[str, Any] = data
    return found


@dataclass
class _File:
    """The JSON of a file, the binary chunk of a .glb, and buffers that have been read."""

    name: str
    data: dict[str, Any]
    inside: bytes | None
    read: dict[int, bytes] = field(default_factory=dict)
    taken: int = 0
    """Bytes that arrays have taken: a small file may name the same bytes again and again."""

    def entries(self, of: dict[str, Any], key: str) -> list[Any]:
        """A list, empty if there is none."""
        found = of.get(key, [])
        if not isinstance(found, list):
            raise MeshError(f"{self.name}: {key!r} is not a list.")
        return found

    def entry(self, kind: str, k: Any) -> dict[str, Any]:
        """Object k of the list of this kind."""
        entries = self.entries(self.data, kind)
        if isinstance(k, bool) or not isinstance(k, int) or not 0 <= k < len(entries):
            raise MeshError(f"{self.name}: {kind} {str(k)[:40]} is named, and there are {len(entries):,}.")
        if not isinstance(entries[k], dict):
            raise MeshError(f"{self.name}: {kind} {k} is not an object.")
        found: dict[str, Any] = entries[k]
        return found

    def count(self, of: dict[str, Any], key: str, where: str, default: int | None = 0) -> int:
        """A whole number that is not negative."""
        found = of.get(key, default)
        if isinstance(found, bool) or not isinstance(found, int) or not 0 <= found <= MOST_BYTES:
            raise MeshError(f"{self.name}: {key} of {where} is {str(found)[:40]}, not a count.")
        return found

    def floats(self, of: dict[str, Any], key: str, default: list[float], where: str) -> FloatArray:
        """As many finite numbers as the default has."""
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
        """The bytes of a buffer."""
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
        """(count, width) numbers of an accessor of this type, "SCALAR" or "VEC3", as the file has them."""
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
        dtype, width = np.dtype(_COMPONENTS[component]), 3 if kind == "VEC3" else 1
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


class _Joined:
    """All triangles of a file's scene in one surface."""

    def __init__(self, file: _File) -> None:
        self.file = file
        self.points: list[FloatArray] = []
        self.corners: list[IntArray] = []
        self.before = 0
        self.primitives = self.nodes = self.ignored = 0
        self.has_colours = self.is_posed = False

    def polygons(self) -> Polygons:
        """Vertices and triangles, with what was left out."""
        file = self.file
        if file.entries(file.data, "nodes"):
            for node, place in self._placed():
                if "mesh" in node:
                    # A skin moves its vertices from where they are in the file, wherever the node is.
                    self._add(node["mesh"], np.eye(4) if "skin" in node else place)
                    self.is_posed |= "skin" in node
        else:
            for k in range(len(file.entries(file.data, "meshes"))):
                self._add(k, np.eye(4))
        vertices = np.concatenate([np.empty((0, 3)), *self.points])
        corners = np.concatenate([np.empty(0, np.int64), *self.corners])
        repairs = (f"{counted(self.ignored, 'primitive')} of points or lines ignored",) if self.ignored else ()
        return Polygons(vertices, np.full(len(corners) // 3, 3), corners, repairs, tuple(self._facts()))

    def _facts(self) -> Iterator[str]:
        if self.primitives > 1:
            places = counted(self.nodes, "place")
            yield f"{counted(self.primitives, 'primitive')} at {places} joined into one surface, in the file's order"
        if self.has_colours:
            yield "colours and materials left out"
        if self.is_posed:
            yield "skins and shapes to morph into left out"

    def _placed(self) -> Iterator[tuple[dict[str, Any], FloatArray]]:
        """The nodes of the scene, a node before those below it, with their (4, 4) transforms."""
        file, scenes = self.file, self.file.entries(self.file.data, "scenes")
        if scenes:
            roots = file.entries(file.entry("scenes", file.data.get("scene", 0)), "nodes")
        else:
            below = {k for node in file.data["nodes"] if isinstance(node, dict) for k in _ids(node.get("children"))}
            roots = [k for k in range(len(file.data["nodes"])) if k not in below]
        waiting, seen = [(k, np.eye(4)) for k in reversed(roots)], set()
        while waiting:
            k, above = waiting.pop()
            node = file.entry("nodes", k)
            if k in seen:
                raise MeshError(f"{file.name}: node {k} stands in two places, or below itself.")
            seen.add(k)
            place = above @ self._transform(node, f"node {k}")
            yield node, place
            waiting += [(below, place) for below in reversed(file.entries(node, "children"))]

    def _transform(self, node: dict[str, Any], where: str) -> FloatArray:
        """(4, 4) of a node: its matrix, which a file has by columns, or scale, then rotation, then translation."""
        if "matrix" in node:
            matrix = self.file.floats(node, "matrix", [0.0] * 16, where).reshape(4, 4).T
            if (matrix[3] != (0, 0, 0, 1)).any():
                raise MeshError(f"{self.file.name}: the matrix of {where} is not one of an affine map.")
            return matrix
        x, y, z, w = self.file.floats(node, "rotation", [0.0, 0.0, 0.0, 1.0], where)
        length = float(np.sqrt(x * x + y * y + z * z + w * w))
        if not 0.5 < length < 2:
            raise MeshError(f"{self.file.name}: the rotation of {where} is no unit quaternion.")
        x, y, z, w = (c / length for c in (x, y, z, w))
        matrix = np.eye(4)
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        matrix[:3, :3] *= self.file.floats(node, "scale", [1.0, 1.0, 1.0], where)
        matrix[:3, 3] = self.file.floats(node, "translation", [0.0, 0.0, 0.0], where)
        return matrix

    def _add(self, mesh: Any, place: FloatArray) -> None:
        """The triangles of a mesh at a place."""
        file, first_of = self.file, dict[Any, tuple[int, int]]()
        entry = file.entry("meshes", mesh)
        before = self.primitives
        for k, primitive in enumerate(file.entries(entry, "primitives")):
            where = f"primitive {k} of mesh {mesh}"
            attributes = primitive.get("attributes") if isinstance(primitive, dict) else None
            if not isinstance(attributes, dict):
                raise MeshError(f"{file.name}: {where} has no attributes.")
            mode = file.count(primitive, "mode", where, _TRIANGLES)
            if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
                self.ignored += 1
                continue
            accessor = attributes["POSITION"]
            if not isinstance(accessor, int) or accessor not in first_of:
                points = self._points(accessor, place)
                first_of[accessor] = self.before, len(points)
                self.points.append(points)
                self.before += len(points)
            first, n = first_of[accessor]
            ids = np.arange(n)
            if "indices" in primitive:
                ids = file.array(primitive["indices"], "SCALAR", _INDICES).ravel().astype(np.int64)
                ids = self._checked(ids, n, where)
            triangles = _triangles(ids, mode)
            if triangles is None:
                raise MeshError(f"{file.name}: {where} has {len(ids):,} corners, no whole number of triangles.")
            file.take(triangles.nbytes)
            # A mirror image keeps its outside outside.
            ordered = triangles[:, [0, 2, 1]] if np.linalg.det(place[:3, :3]) < 0 else triangles
            self.corners.append(first + ordered.ravel())
            self.primitives += 1
            self.has_colours |= "material" in primitive or any(key.startswith("COLOR_") for key in attributes)
            self.is_posed |= bool(primitive.get("targets"))
        self.nodes += self.primitives > before

    def _checked(self, ids: IntArray, n: int, where: str) -> IntArray:
        return checked_corners(ids, np.full(len(ids), 1), n, lambda k: f"{self.file.name}: index {k} of {where}")

    def _points(self, accessor: Any, place: FloatArray) -> FloatArray:
        values = self.file.array(accessor, "VEC3", tuple(_COMPONENTS))
        points = values.astype(np.float64)
        if self.file.entry("accessors", accessor).get("normalized") is True and values.dtype.kind in "iu":
            points = np.maximum(points / np.iinfo(values.dtype).max, -1.0)
        if (place == np.eye(4)).all():
            return points
        moved: FloatArray = points @ place[:3, :3].T + place[:3, 3]
        return moved


def _ids(found: Any) -> list[int]:
    return [k for k in found if isinstance(k, int)] if isinstance(found, list) else []


def _triangles(ids: IntArray, mode: int) -> IntArray | None:
    """(m, 3) of the corners in a row; None where they are not a whole number of triangles."""
    if mode == _TRIANGLES:
        return None if len(ids) % 3 else ids.reshape(-1, 3)
    if mode == _STRIP:
        return strip_triangles(np.array([len(ids)]), ids)
    return np.stack([np.broadcast_to(ids[:1], max(len(ids) - 2, 0)), ids[1:-1], ids[2:]], axis=1)
