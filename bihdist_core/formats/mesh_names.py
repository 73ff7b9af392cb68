"""The formats of mesh files, and what a file's name says: its format, and what the mesh is called.

This module is imported for help texts and file dialogs; it needs no NumPy.
"""

import gzip
import os
import re
import zlib
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

GZIP = ".gz"
JOIN = "+"
"""Between the files of one mesh."""
FREESURFER = "FreeSurfer"
"""The format of files whose names begin with the hemisphere, such as lh.pial, or that begin as a surface."""
MNI = "MNI"
"""The format of .obj files that begin as an object of CIVET."""


@dataclass(frozen=True)
class MeshFormat:
    """A format of mesh files.

    Parameters
    ----------
    name : str
        The extension in lower case, with its dot, FREESURFER or MNI.
    reader : str
        A module of this package; ``"off"`` has the function ``read_off(content, name)``, which returns `Polygons`.
    has_points : bool
        Whether a file may hold points without faces.
    y_bonus : float
        How much better than y the direction z has to be before it is taken as up (see `upright`): programs that write
        OBJ have y up, and glTF has it by definition, while z is up in files of brains.
    """

    name: str
    reader: str
    has_points: bool = False
    y_bonus: float = 0.5


FORMATS = {
    each.name: each
    for each in (
        MeshFormat(".off", "off", y_bonus=1.0),
        MeshFormat(".obj", "obj", y_bonus=2.5),
        MeshFormat(".ply", "ply", has_points=True),
        MeshFormat(".stl", "stl", y_bonus=-0.5),
        MeshFormat(".vtk", "vtk"),
        MeshFormat(".vtp", "vtp"),
        MeshFormat(".vtu", "vtp"),
        MeshFormat(".mesh", "tetrahedra"),
        MeshFormat(".msh", "tetrahedra"),
        MeshFormat(".gltf", "gltf", y_bonus=4.0),
        MeshFormat(".glb", "gltf", y_bonus=4.0),
        MeshFormat(".gii", "gifti", y_bonus=-4.0),
        MeshFormat(".mat", "array_mesh"),
        MeshFormat(".npz", "array_mesh"),
        MeshFormat(".xyz", "points", has_points=True),
        MeshFormat(".pcd", "points", has_points=True),
        MeshFormat(".npy", "points", has_points=True),
        MeshFormat(FREESURFER, "freesurfer", y_bonus=-4.0),
        MeshFormat(MNI, "mni", y_bonus=-4.0),
    )
}
"""All formats by their names, in the order in which they are listed."""

MESH_FORMATS = tuple(name for name in FORMATS if name.startswith("."))
"""The extensions of mesh files; .gz may follow."""

ARRAY_FILES = (".mat", ".npz", ".npy")
"""Those that hold arrays of any kind."""
SOLIDS = (".mesh", ".msh", ".vtu")
"""Those of tetrahedra, mostly."""
SHARED = (".gii", FREESURFER, *ARRAY_FILES)
"""The formats of files that may hold something else than a mesh."""

_HEMISPHERE = re.compile(r"(^|[._-])[lr]h\.[a-z]", re.IGNORECASE)
_LEFT, _RIGHT = (
    re.compile(rf"(^|[._-])({words})(?=[._-]|$)", re.IGNORECASE) for words in ("lh|l|left|hemi-l", "rh|r|right|hemi-r")
)
_OTHER_GIFTI = re.compile(r"\.(func|shape|label|time|rgba|vector|tensor|coord|topo)\.gii(\.gz)?$", re.IGNORECASE)
_SURFACE = re.compile(rb"\xff\xff\xfe|#!ascii(?! *label)")
_MNI = re.compile(rb"\s*[FLMPQTX]\s|[flmpqtx](?!\s)[^\0]{0,40}\0")
"""A letter for the kind of object, and its numbers as words, or as bytes, of which some are zero."""
_PLY_FACES = re.compile(rb"element[ \t]+(face|tristrips)[ \t]+0*[1-9]")
_SEARCHED = 1 << 26
"""So many bytes of a GIFTI file are searched for points."""


def mesh_format(path: str | os.PathLike[str], content: bytes | None = None) -> str:
    """Return the extension that names the format of a mesh file, without .gz, FREESURFER or MNI; "" for another file.

    Where the name leaves it open, the first bytes tell: of `content`, or of the file if it is there.
    """
    name = os.path.basename(path).lower().removesuffix(GZIP)
    extension = os.path.splitext(name)[1]
    if extension in MESH_FORMATS and extension != ".obj":
        return extension
    if has_hemisphere(name) and extension != ".obj":
        return FREESURFER
    begin = beginning(path) if content is None else content
    if extension == ".obj":
        return MNI if _MNI.match(begin) else extension
    return FREESURFER if _SURFACE.match(begin) else ""


def beginning(path: str | os.PathLike[str], count: int = 200) -> bytes:
    """Return the first bytes of a file, unpacked; none if they cannot be read."""
    # A pipe would wait for ever.
    if os.path.isfile(path):
        with (
            suppress(OSError, EOFError, zlib.error),
            gzip.open(path) if os.fspath(path).lower().endswith(GZIP) else open(path, "rb") as file,
        ):
            return file.read(count)
    return b""


def holds_points(path: str | os.PathLike[str]) -> bool:
    """Return whether a mesh file has points without faces, by its name and its first bytes."""
    form = mesh_format(path)
    if form != ".ply":
        return bool(form) and FORMATS[form].has_points
    head, end, _ = beginning(path, 1 << 16).partition(b"end_header")
    return bool(end) and not _PLY_FACES.search(head)


def has_hemisphere(name: str) -> bool:
    """Return whether a file is named as FreeSurfer names those of a hemisphere: lh.pial, sub-01_rh.thickness."""
    return bool(_HEMISPHERE.search(name))


def hemisphere_of(name: str) -> str:
    """Return "left" or "right" for the name of a surface that says it, such as lh.pial or sub-01_hemi-R; else ""."""
    return "left" if _LEFT.search(name) else "right" if _RIGHT.search(name) else ""


def files_of(path: str | os.PathLike[str]) -> list[str]:
    """Return the files of a mesh: of lh.pial+rh.pial two, if both are there and no file has that name.

    Those after the first are beside it if they are named without a folder.
    """
    text = os.fspath(path)
    if JOIN not in text or os.path.exists(text):
        return [text]
    first, *others = text.split(JOIN)
    folder = os.path.dirname(first)
    files = [first, *(each if os.path.dirname(each) else os.path.join(folder, each) for each in others)]
    return files if all(map(os.path.isfile, files)) else [text]


def is_there(path: str | os.PathLike[str]) -> bool:
    """Return whether all files of a mesh are there."""
    return all(map(os.path.exists, files_of(path)))


def mesh_name(path: str | os.PathLike[str]) -> str:
    """Name a mesh after its file, without the endings of the format: `lh.pial` for lh.pial.surf.gii.gz."""
    files = files_of(path)
    if len(files) > 1:
        return JOIN.join(map(mesh_name, files))
    name = os.path.basename(path)
    if name.lower().endswith(GZIP):
        name = name[: -len(GZIP)]
    stem, extension = os.path.splitext(name)
    if extension.lower() == ".gii":
        return re.sub(r"\.surf$", "", stem, flags=re.IGNORECASE)
    return name if mesh_format(name) == FREESURFER else stem


def is_mesh_file(path: Path) -> bool:
    """Return whether a file of a folder is a mesh, by its name; one of SHARED also by what it holds.

    A GIFTI file that cannot be read counts as a mesh, so that reading it says why.
    """
    form = mesh_format(path)
    if form not in SHARED or not path.is_file():
        return bool(form)
    if form == ".npy":
        return False  # values, more often than points
    if form in ARRAY_FILES:
        holds_mesh = import_module(".array_mesh", __package__).holds_mesh
        return bool(holds_mesh(beginning(path, -1), path.name))
    if _OTHER_GIFTI.search(path.name):
        return False
    if form == FREESURFER:
        return bool(_SURFACE.match(beginning(path)))
    content = beginning(path, _SEARCHED)
    return not content or b"NIFTI_INTENT_POINTSET" in content
