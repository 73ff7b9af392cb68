"""What the name of a mesh file says: its format, and what the mesh is called."""

import gzip
import os
import re
import zlib
from pathlib import Path

MESH_FORMATS = (".off", ".obj", ".ply", ".stl", ".vtk", ".vtp", ".vtu", ".gltf", ".glb", ".gii")
"""The extensions of mesh files, each with its dot, in lower case; .gz may follow."""
GZIP = ".gz"
FREESURFER = "FreeSurfer"
"""The format of files whose names begin with the hemisphere, such as lh.pial."""

_HEMISPHERE = re.compile(r"(^|[._-])[lr]h\.[a-z]", re.IGNORECASE)
_OTHER_GIFTI = re.compile(r"\.(func|shape|label|time|rgba|vector|tensor|coord|topo)\.gii(\.gz)?$", re.IGNORECASE)
_SEARCHED = 1 << 26
"""So many bytes of a GIFTI file are searched for points."""


def mesh_format(path: str | os.PathLike[str]) -> str:
    """The extension that names the format of a mesh file, without .gz; FREESURFER, or "" for a file of another name."""
    name = os.path.basename(path).lower().removesuffix(GZIP)
    extension = os.path.splitext(name)[1]
    if extension in MESH_FORMATS:
        return extension
    return FREESURFER if has_hemisphere(name) else ""


def has_hemisphere(name: str) -> bool:
    """Whether a file is named as FreeSurfer names those of a hemisphere: lh.pial, sub-01_rh.thickness."""
    return bool(_HEMISPHERE.search(name))


def mesh_name(path: str | os.PathLike[str]) -> str:
    """What a mesh is called: its file's name without what tells the format, `lh.pial` of lh.pial.surf.gii.gz."""
    name = os.path.basename(path)
    if name.lower().endswith(GZIP):
        name = name[: -len(GZIP)]
    stem, extension = os.path.splitext(name)
    if extension.lower() == ".gii":
        return re.sub(r"\.surf$", "", stem, flags=re.IGNORECASE)
    return name if mesh_format(name) == FREESURFER else stem


def is_mesh_file(path: Path) -> bool:
    """Whether a file of a folder is a mesh, by its name; a GIFTI or FreeSurfer file also by what it holds.

    One that cannot be read counts as a mesh, so that reading it says why.
    """
    form = mesh_format(path)
    if form not in (".gii", FREESURFER) or not path.is_file():
        return bool(form)
    if _OTHER_GIFTI.search(path.name):
        return False
    try:
        with gzip.open(path) if path.suffix.lower() == GZIP else path.open("rb") as file:
            head = file.read(3 if form == FREESURFER else _SEARCHED)
    except (OSError, EOFError, zlib.error):
        return form == ".gii"
    return head == b"\xff\xff\xfe" if form == FREESURFER else b"NIFTI_INTENT_POINTSET" in head
