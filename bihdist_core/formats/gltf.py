"""glTF 2.0 files, .gltf with its buffers inside or beside it and .glb: a strict reader of their triangles.

Format: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.  Of the scene that the file shows, each mesh is put
where its nodes place it.  Vertex ids are the order of the nodes, a node before those below it; at each node, the
primitives of its mesh in order, with all vertices that their POSITION accessor has.  Primitives of a mesh that name
one accessor share its vertices.  Materials, colours, textures, skins and shapes to be morphed into are left out.
"""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..arrays import FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .gltf_file import COMPONENTS, GltfFile, gltf_file
from .polygons import Polygons, checked_corners, strip_triangles

_INDICES = (5121, 5123, 5125)
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
UNDEFINED = -1e30
"""Stands for NaN in values at vertices, as glTF allows none."""
_HARMLESS = re.compile("KHR_(materials|texture|lights|xmp|mesh_quantization|animation)|EXT_(texture|lights)")
"""Extensions that triangles do not depend on, or that need nothing more."""


def read_gltf(raw: bytes, name: str) -> Polygons:
    """Read the triangles of a glTF file.

    MeshError where it is none, is cut off or damaged, or needs what is not read.
    """
    return _joined(raw, name).polygons()


def gltf_values(raw: bytes, name: str) -> dict[str, FloatArray]:
    """Read the values (n,) at vertices in a glTF file by name, attributes such as `_THICKNESS`; MeshError as of
    `read_gltf`.

    NaN where a primitive has not the attribute, and for values below -1e29, which stand for it.
    """
    joined = _joined(raw, name)
    joined.polygons()
    words = dict.fromkeys(key for attributes, _ in joined.attributes for key in attributes if key.startswith("_"))
    return {word.lstrip("_").lower(): np.concatenate(list(joined.values(word))) for word in words}


def _joined(raw: bytes, name: str) -> "_Joined":
    file = gltf_file(raw, name)
    for extension in file.entries(file.data, "extensionsRequired"):
        if not isinstance(extension, str) or not _HARMLESS.match(extension):
            raise MeshError(f"{name} needs the extension {str(extension)[:60]!r}, which is not read; save it without.")
    return _Joined(file)


class _Joined:
    """The triangles of a file's scene, joined to one surface."""

    def __init__(self, file: GltfFile) -> None:
        self.file = file
        self.points: list[FloatArray] = []
        self.attributes: list[tuple[dict[str, Any], int]] = []  # of the same primitives, with their vertices' number
        self.corners: list[IntArray] = []
        self.before = 0
        self.primitives = self.nodes = self.ignored = 0
        self.has_colours = self.is_posed = False

    def polygons(self) -> Polygons:
        """Return vertices and triangles, with what was left out."""
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

    def values(self, word: str) -> Iterator[FloatArray]:
        """Yield the values of an attribute, NaN for those of primitives without it."""
        for attributes, count in self.attributes:
            values = np.full(count, np.nan)
            if word in attributes:
                found = self.file.array(attributes[word], "SCALAR", tuple(COMPONENTS)).ravel()
                if len(found) != count:
                    raise MeshError(f"{self.file.name}: {word[:40]} has {len(found):,} values at {count:,} vertices.")
                values[:] = np.where(found < UNDEFINED / 10, np.nan, found)
            yield values

    def _facts(self) -> Iterator[str]:
        if self.primitives > 1:
            places = counted(self.nodes, "place")
            yield f"{counted(self.primitives, 'primitive')} at {places} joined into one surface, in the file's order"
        if self.has_colours:
            yield "colours and materials left out"
        if self.is_posed:
            yield "skins and morph targets left out"

    def _placed(self) -> Iterator[tuple[dict[str, Any], FloatArray]]:
        """Yield the nodes of the scene, a node before those below it, with their (4, 4) transforms."""
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
        """Return a node's transform (4, 4): its matrix, stored by columns, or scale, rotation and translation."""
        if "matrix" in node:
            matrix = self.file.floats(node, "matrix", [0.0] * 16, where).reshape(4, 4).T
            if (matrix[3] != (0, 0, 0, 1)).any():
                raise MeshError(f"{self.file.name}: the matrix of {where} is not affine.")
            return matrix
        x, y, z, w = self.file.floats(node, "rotation", [0.0, 0.0, 0.0, 1.0], where)
        length = float(np.sqrt(x * x + y * y + z * z + w * w))
        if not 0.5 < length < 2:
            raise MeshError(f"{self.file.name}: the rotation of {where} is not a unit quaternion.")
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
        """Add the triangles of a mesh at a place."""
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
                self.attributes.append((attributes, len(points)))
                self.before += len(points)
            first, n = first_of[accessor]
            ids = np.arange(n)
            if "indices" in primitive:
                ids = file.array(primitive["indices"], "SCALAR", _INDICES).ravel().astype(np.int64)
                ids = self._checked(ids, n, where)
            triangles = _triangles(ids, mode)
            if triangles is None:
                raise MeshError(f"{file.name}: {where} has {len(ids):,} corners, which is not a multiple of 3.")
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
        values = self.file.array(accessor, "VEC3", tuple(COMPONENTS))
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
    """Return (m, 3) of the corners in a row; None where they are not a whole number of triangles."""
    if mode == _TRIANGLES:
        return None if len(ids) % 3 else ids.reshape(-1, 3)
    if mode == _STRIP:
        return strip_triangles(np.array([len(ids)]), ids)
    return np.stack([np.broadcast_to(ids[:1], max(len(ids) - 2, 0)), ids[1:-1], ids[2:]], axis=1)
