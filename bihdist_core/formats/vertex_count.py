"""How many vertices a mesh file announces, found in its first bytes or by a scan, without reading the mesh."""

import gzip
import os
import re
import zlib

from .mesh_names import FREESURFER, GZIP, MNI, mesh_format

_HEAD = 1 << 16
"""So many bytes are searched for an announcement."""
_WHOLE = 1 << 30
"""So many bytes are searched where vertices are counted, or announced anywhere."""

_COMMENT = re.compile(rb"#[^\r\n]*")
_PIECE = re.compile(rb"""\bNumberOfPoints\s*=\s*["'](\d{1,18})["']""")
_IN_WORDS = {
    ".off": re.compile(rb"\A\s*\w*OFF\s+(\d{1,18})\s+\d+"),
    ".ply": re.compile(rb"[\r\n]element[ \t]+vertex[ \t]+(\d{1,18})"),
    ".pcd": re.compile(rb"[\r\n]POINTS[ \t]+(\d{1,18})"),
    ".vtk": re.compile(rb"[\r\n]POINTS[ \t]+(\d{1,18})", re.IGNORECASE),
    FREESURFER: re.compile(rb"\A#![^\n]*\n\s*(\d{1,18})[ \t]+\d+"),
    MNI: re.compile(rb"\A\s*P(?:\s+\S+){5}\s+(\d{1,18})"),
    ".vtp": _PIECE,
    ".vtu": _PIECE,
    ".gii": re.compile(rb"""<DataArray\b(?=[^>]*NIFTI_INTENT_POINTSET)[^>]*\bDim0\s*=\s*["'](\d{1,18})["']"""),
}
_IN_BYTES = {
    ".off": re.compile(rb"\s*\w*OFF[ \t]+BINARY[ \t\r]*\n(.{4})", re.DOTALL),
    FREESURFER: re.compile(rb"\xff\xff\xfe[^\n]*\n(?:(?![\0-\x09])[^\n]*\n)?(.{4})", re.DOTALL),
}
"""A big-endian number of four bytes."""


def announced_vertices(path: str | os.PathLike[str]) -> int | None:
    """Find how many vertices a mesh file announces, without reading the mesh.

    Parameters
    ----------
    path : path-like
        The file; its name tells the format, as for `read_surface`.

    Returns
    -------
    int or None
        A file in several pieces has at least as many, and one that is cut off fewer. None where finding it would take
        as long as reading the mesh, and for a file that cannot be read.

    Notes
    -----
    STL files announce triangles only, and what of a glTF file is shown depends on its scene: both give None.
    """
    form, is_packed = mesh_format(path), os.fspath(path).lower().endswith(GZIP)
    is_scanned = form in (".obj", ".gii") and not is_packed
    try:
        with gzip.open(path) if is_packed else open(path, "rb") as file:
            content = file.read(_WHOLE if is_scanned else _HEAD).removeprefix(b"\xef\xbb\xbf")
    except (OSError, EOFError, zlib.error):
        return None  # reading the mesh says why
    if form == ".obj":
        counts = [content.count(b"\n" + start) + content.startswith(start) for start in (b"v ", b"v\t")]
        return sum(counts) if is_scanned else None
    if form in _IN_BYTES and (found := _IN_BYTES[form].match(content)):
        return int.from_bytes(found[1], "big")
    if form == ".off":
        content = _COMMENT.sub(b"", content)
    found = _IN_WORDS[form].search(content) if form in _IN_WORDS else None
    return int(found[1]) if found else None
