"""GIFTI files (.gii), surfaces of brains and values on them: a strict reader, and a writer of values.

Format: https://www.nitrc.org/projects/gifti/, version 1.0.  Coordinates are those of the array: the transforms to other
coordinate systems that may stand beside it are not applied.
"""

import base64
import binascii
import math
import re
import zlib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO
from xml.etree import ElementTree
from xml.sax.saxutils import escape

import numpy as np

from ..arrays import AnyArray
from ..errors import MeshError
from ..file_content import bytes_beside
from .compression import MOST_BYTES
from .mesh_names import hemisphere_of
from .polygons import Polygons, checked_corners
from .text_lines import parsed_numbers, xml_root

POINTS, TRIANGLES = "NIFTI_INTENT_POINTSET", "NIFTI_INTENT_TRIANGLE"
LABEL_INTENT = "NIFTI_INTENT_LABEL"
_TYPES = {
    f"NIFTI_TYPE_{sign}INT{8 * size}": f"{sign.lower() or 'i'}{size}" for sign in ("", "U") for size in (1, 2, 4, 8)
}
_TYPES |= {"NIFTI_TYPE_FLOAT32": "f4", "NIFTI_TYPE_FLOAT64": "f8"}
_PARTS = ("Red", "Green", "Blue", "Alpha")
_EXTERNAL = "ExternalFileBinary"
_ORDERS = {"LittleEndian": "<", "BigEndian": ">"}


@dataclass(frozen=True)
class GiftiArray:
    """An array of a file with its intent, such as NIFTI_INTENT_POINTSET, and its name, "" for none."""

    intent: str
    values: AnyArray
    name: str = ""


def read_gifti(raw: bytes, name: str) -> Polygons:
    """Read the surface in a GIFTI file; MeshError where it holds none, or several, or is cut off or damaged."""
    arrays = gifti_arrays(raw, name)
    found = {}
    for intent, what in ((POINTS, "points"), (TRIANGLES, "triangles")):
        fitting = [array.values for array in arrays if array.intent == intent]
        if len(fitting) != 1:
            held = ", ".join(dict.fromkeys(array.intent for array in arrays)) or "none"
            raise MeshError(f"{name} has {len(fitting)} arrays of {what}; a surface needs one (its arrays are {held}).")
        if fitting[0].ndim != 2 or fitting[0].shape[1] != 3:
            raise MeshError(f"{name}: the {what} have the shape {fitting[0].shape}, not three numbers each.")
        found[intent] = fitting[0]
    points, triangles = found[POINTS], found[TRIANGLES]
    sizes = np.full(len(triangles), 3)
    corners = checked_corners(triangles.ravel(), sizes, len(points), lambda k: f"{name}: triangle {k}")
    return Polygons(points.astype(np.float64), sizes, corners)


def gifti_arrays(raw: bytes, name: str) -> list[GiftiArray]:
    """Read all arrays of a GIFTI file; MeshError where it is none, or is cut off or damaged."""
    root = _root(raw, name)
    elements = root.findall("DataArray")
    announced = root.get("NumberOfDataArrays", str(len(elements)))
    if announced.strip() != str(len(elements)):
        raise MeshError(f"{name} announces {announced[:20]} arrays and holds {len(elements)}.")
    return [_array(element, f"{name}: array {k}") for k, element in enumerate(elements)]


def label_table(raw: bytes, name: str) -> dict[int, str]:
    """Read the names of labels in a GIFTI file by their keys.

    MeshError as of `gifti_arrays`, and for a key that is none.
    """
    return {key: (element.text or "").strip() for key, element in _labels(raw, name)}


def label_colours(raw: bytes, name: str) -> dict[int, tuple[float, ...]]:
    """Read the red, green, blue and alpha of labels, from 0 to 1, by the keys of those that have a colour."""
    found = {}
    for key, element in _labels(raw, name):
        with suppress(TypeError, ValueError):  # no colour, or none that can be shown
            parts = [float(element.get(part, 1 if part == "Alpha" else None)) for part in _PARTS]  # type: ignore[arg-type]
            found[key] = tuple(min(max(part, 0.0), 1.0) for part in parts)
    return found


def _labels(raw: bytes, name: str) -> Iterator[tuple[int, ElementTree.Element]]:
    """Yield the keys and elements of the labels."""
    for k, element in enumerate(_root(raw, name).iterfind("LabelTable/Label")):
        # Version 1.0 of the format calls it Key, files of older programs Index.
        key = element.get("Key", element.get("Index", ""))
        if not re.fullmatch("-?[0-9]{1,10}", key):
            raise MeshError(f"{name}: label {k} of its table has the key {key[:20]!r}, not a whole number.")
        yield int(key), element


def _root(raw: bytes, name: str) -> ElementTree.Element:
    if b"<!ENTITY" in raw:
        raise MeshError(f"{name} declares XML entities, which no GIFTI file needs; it is not read.")
    return xml_root(raw, name, "a GIFTI file", "GIFTI")


def with_external_data(content: bytes, path: Path) -> bytes:
    """Return the content of a GIFTI file with the numbers inside it that it keeps in files beside it.

    MeshError as of `gifti_arrays`, and for a file that is not beside it.
    """
    if _EXTERNAL.encode() not in content:
        return content
    root = _root(content, path.name)
    for k, element in enumerate(root.findall("DataArray")):
        if element.get("Encoding") == _EXTERNAL:
            where = f"{path.name}: array {k}"
            kind, shape = _announced(element, where)
            name, begin = element.get("ExternalFileName", ""), element.get("ExternalFileOffset", "").strip() or "0"
            if not re.fullmatch("[0-9]{1,15}", begin):
                raise MeshError(f"{where} begins at {begin[:20]!r} of its file, which is not a number of bytes.")
            count = math.prod(shape) * np.dtype(kind).itemsize
            found = bytes_beside(path, name, f"{where}: its file", MOST_BYTES, int(begin), count)
            for old in element.findall("Data"):
                element.remove(old)
            ElementTree.SubElement(element, "Data").text = base64.b64encode(found).decode("ascii")
            element.set("Encoding", "Base64Binary")
    return ElementTree.tostring(root)


def _announced(element: ElementTree.Element, where: str) -> tuple[str, tuple[int, ...]]:
    """Return the type of an array's numbers, without the order of their bytes, and its shape."""
    kind = element.get("DataType", "")[:40]
    if kind not in _TYPES:
        raise MeshError(f"{where} is of the type {kind!r}, which is not read.")
    shape = _shape(element, where)
    if math.prod(shape) * np.dtype(_TYPES[kind]).itemsize > MOST_BYTES:
        raise MeshError(f"{where} announces {math.prod(shape):,} numbers, more than are read.")
    return _TYPES[kind], shape


def _array(element: ElementTree.Element, where: str) -> GiftiArray:
    intent, encoding = (element.get(key, "")[:40] for key in ("Intent", "Encoding"))
    kind, shape = _announced(element, where)
    count, size = math.prod(shape), np.dtype(kind).itemsize
    text = (element.findtext("Data") or "").encode()
    if encoding == "ASCII":
        values: AnyArray = parsed_numbers(text, where, "numbers")
    elif encoding in ("Base64Binary", "GZipBase64Binary"):
        order = _ORDERS.get(element.get("Endian", ""))
        if order is None:
            raise MeshError(f"{where} has the unknown byte order {element.get('Endian', '')[:40]!r}.")
        content = _decoded(text, count * size if encoding.startswith("G") else None, where)
        if len(content) % size:
            raise MeshError(f"{where} has {len(content)} bytes, which is not a whole number of {kind} values.")
        values = np.frombuffer(content, order + kind)
    elif encoding == _EXTERNAL:
        raise MeshError(
            f"{where} keeps its numbers in another file, which is read only where this one is not compressed."
        )
    else:
        raise MeshError(f"{where} is encoded as {encoding!r}, which is not read.")
    if len(values) != count:
        raise MeshError(f"{where} announces {count:,} numbers and holds {len(values):,}; the file is damaged.")
    by_columns = element.get("ArrayIndexingOrder") == "ColumnMajorOrder"
    about = {md.findtext("Name", ""): md.findtext("Value", "") for md in element.iterfind("MetaData/MD")}
    return GiftiArray(intent, values.reshape(shape, order="F" if by_columns else "C"), about.get("Name", "").strip())


def _shape(element: ElementTree.Element, where: str) -> tuple[int, ...]:
    axes = element.get("Dimensionality", "")
    if axes not in tuple("123456"):
        raise MeshError(f"{where} has {axes[:20]!r} dimensions, not 1 to 6.")
    sizes = [element.get(f"Dim{k}", "") for k in range(int(axes))]
    for k, words in enumerate(sizes):
        if not re.fullmatch("[0-9]{1,12}", words):
            raise MeshError(f"{where}: Dim{k} is {words[:20]!r}, not a count.")
    return tuple(map(int, sizes))


def _decoded(text: bytes, packed_size: int | None, where: str) -> bytes:
    """Return the bytes of base64 text.

    Unpacked, if they have a size then, so far that a damaged file fills no memory.
    """
    try:
        content = base64.b64decode(b"".join(text.split()), validate=True)
        if packed_size is None:
            return content
        stream = zlib.decompressobj(47)  # with the head of zlib, or of gzip
        found = stream.decompress(content, packed_size + 1)
    except (binascii.Error, ValueError, zlib.error) as error:
        raise MeshError(f"{where} is damaged ({error}).") from None
    if len(found) > packed_size:
        raise MeshError(f"{where} holds more than the {packed_size:,} bytes that it announces; the file is damaged.")
    if not stream.eof:
        raise MeshError(f"{where} is cut off: its compressed data do not end.")
    return found


# ---------------------------------------------------------------------- output
def write_gifti_values(file: BinaryIO, surface_name: str, columns: Mapping[str, AnyArray]) -> None:
    """Write an array (n,) for each name; the structure is that of the hemisphere that the surface's name says."""
    side = hemisphere_of(surface_name)
    about = _meta_data({"AnatomicalStructurePrimary": f"Cortex{side.capitalize()}"} if side else {})
    arrays = "".join(_data_array(name, values) for name, values in columns.items())
    file.write(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<!DOCTYPE GIFTI SYSTEM "http://www.nitrc.org/frs/download.php/115/gifti.dtd">\n'
        f'<GIFTI Version="1.0" NumberOfDataArrays="{len(columns)}">\n{about}<LabelTable/>\n{arrays}</GIFTI>\n'.encode()
    )


def _data_array(name: str, values: AnyArray) -> str:
    text = base64.b64encode(zlib.compress(values.astype("<f4").tobytes())).decode("ascii")
    return (
        '<DataArray Intent="NIFTI_INTENT_NONE" DataType="NIFTI_TYPE_FLOAT32" ArrayIndexingOrder="RowMajorOrder" '
        f'Dimensionality="1" Dim0="{len(values)}" Encoding="GZipBase64Binary" Endian="LittleEndian" '
        f'ExternalFileName="" ExternalFileOffset="">\n{_meta_data({"Name": name})}<Data>{text}</Data>\n</DataArray>\n'
    )


def _meta_data(texts: Mapping[str, str]) -> str:
    entries = "".join(f"<MD><Name>{escape(k)}</Name><Value>{escape(v)}</Value></MD>" for k, v in texts.items())
    return f"<MetaData>{entries}</MetaData>\n"
