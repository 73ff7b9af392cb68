"""Mesh files into surfaces: OFF, OBJ, PLY, STL, VTK (legacy), VTP, VTU, glTF, GLB, GIFTI, FreeSurfer's and MNI's; and
points without faces: PLY, XYZ, PCD, NumPy.

All readers are our own and strict: a file is read whole or refused with a sentence, and vertex ids are the file's.
(VTK's readers split OBJ vertices along texture seams, return what is left of a truncated file, and can take the
process down on a damaged one.)
"""

import os
import stat
from importlib import import_module
from pathlib import Path

import numpy as np

from ..counts import counted
from ..errors import MeshError, MissingFileError
from ..mesh_arrays import check_size
from ..point_cloud import PointCloud
from ..surface import Surface
from ..tetrahedra import TetrahedralMesh
from .compression import unpacked
from .gifti import with_external_data
from .gltf_file import with_buffers
from .mesh_names import FORMATS, GZIP, JOIN, MESH_FORMATS, files_of, mesh_format
from .polygons import Polygons, triangulated

SAVED_BY = {"3MF": "MeshLab, Blender or another"} | dict.fromkeys(("LAS", "LAZ", "E57"), "CloudCompare or another")
"""Formats that are not read, and what saves them in another."""


def read_surface(path: str | os.PathLike[str]) -> Surface:
    """Read a mesh file.

    Parameters
    ----------
    path : str or path-like
        The extension, in any case, names the format, or a name such as lh.pial; FreeSurfer's surfaces may have any
        other name. A file with .gz behind it is unpacked.

    Returns
    -------
    Surface
        The surface, a `PointCloud` or `TetrahedralMesh` where the file holds these; vertex ids are the file's.
        Polygons are divided into triangles, and in STL files coincident vertices are merged, which `Surface.facts`
        says; what cannot be part of a surface is left out, which `Surface.repairs` says.

    Raises
    ------
    MissingFileError
        If there is no such file; it is a MeshError and a FileNotFoundError.
    MeshError
        For a file that is unreadable, truncated, damaged or of another kind, and for a mesh without faces, but in PLY,
        XYZ, PCD and NumPy files, of which points are read. The message names the file, the place in it and the value.

    Examples
    --------
    >>> import bihdist
    >>> from pathlib import Path
    >>> _ = Path("square.off").write_text('''OFF 4 1 0
    ... 0 0 0  1 0 0  1 1 0  0 1 0
    ... 4 0 1 2 3''')
    >>> square = bihdist.read_surface("square.off")
    >>> square.n_faces, square.facts
    (2, ('1 quad divided into 2 triangles',))
    """
    files = files_of(path)
    if len(files) > 1:
        return _joined([read_surface(file) for file in files])
    return surface_in(mesh_content(path), Path(path).name)


def _joined(surfaces: list[Surface]) -> Surface:
    """Return surfaces as one, whose facts say which vertices are of which."""
    starts = np.cumsum([0, *(len(surface.vertices) for surface in surfaces)])
    names = [surface.name for surface in surfaces]
    return Surface(
        np.concatenate([surface.vertices for surface in surfaces]),
        np.concatenate([surface.faces + start for surface, start in zip(surfaces, starts[:-1], strict=True)]),
        name=JOIN.join(names),
        repairs=[f"{surface.name}: {text}" for surface in surfaces for text in surface.repairs],
        facts=[f"vertices {a} to {b - 1} are of {name}" for a, b, name in zip(starts, starts[1:], names, strict=False)]
        + [f"{surface.name}: {text}" for surface in surfaces for text in surface.facts],
    )


def surface_in(content: bytes, name: str) -> Surface:
    """Make a surface of the content of a mesh file of this name; the second half of `read_surface`."""
    try:
        # Damaged bytes can be any number, a signalling NaN too; NumPy need not warn, Surface refuses and names them.
        with np.errstate(all="ignore"):
            if name.lower().endswith(GZIP):
                content = unpacked(content, name)
                if not content:
                    raise MeshError(f"{name} is empty.")
            polygons = read_polygons(content, name)
            if len(polygons.tetrahedra):
                return TetrahedralMesh(polygons.vertices, polygons.tetrahedra, name, polygons.facts)
            if not len(polygons.sizes) and FORMATS[mesh_format(name, content)].has_points:
                return PointCloud(polygons.vertices, name, facts=polygons.facts)
            if not len(polygons.sizes):
                held = counted(len(polygons.vertices), "vertex", "vertices")
                of_points = ", ".join(form for form, each in FORMATS.items() if each.has_points)
                raise MeshError(f"{name} has {held} but no faces; points without faces are read from {of_points}.")
            faces, left_out, divided = triangulated(polygons)
        repairs, facts = [*polygons.repairs, *left_out], [*polygons.facts, *divided]
        surface = Surface(polygons.vertices, faces, name=name, repairs=repairs, facts=facts)
        _check_extent(surface)
        return surface
    except MemoryError:
        raise MeshError(f"{name} is too large for the memory of this computer.") from None


def read_polygons(content: bytes, name: str) -> Polygons:
    """Read the polygons of a mesh file by the reader of its format."""
    reader = FORMATS[mesh_format(name, content)].reader
    polygons: Polygons = getattr(import_module(f".{reader}", __package__), f"read_{reader}")(content, name)
    return polygons


def _check_extent(surface: Surface) -> None:
    """Raise MeshError for a surface that nothing can be measured on: all of it in one place, too large or too small."""
    x, name = surface.vertices, surface.name
    # All is in one place only where the first face is.
    if not np.ptp(x[surface.faces[0]], axis=0).any() and not np.ptp(x[surface.faces], axis=(0, 1)).any():
        place = ", ".join(f"{c:g}" for c in x[surface.faces[0, 0]])
        raise MeshError(f"{name}: all corners of its faces are at ({place}); there is nothing to measure.")
    check_size(x, surface.faces, name)


def mesh_content(path: str | os.PathLike[str]) -> bytes:
    """Read the bytes of a mesh file, a .gltf or .gii with the files that it names; the first half of `read_surface`."""
    path = Path(path)
    try:
        kind = path.stat().st_mode
        if stat.S_ISDIR(kind):
            raise MeshError(f"{path} is a folder, not a mesh file.")
        form = path.suffix[1:].upper()
        if form in SAVED_BY:
            raise MeshError(
                f"{path.name} is a {form} file, which is not read; save it as PLY first, in {SAVED_BY[form]}."
            )
        if not mesh_format(path):
            formats = f"{', '.join(MESH_FORMATS)}, any of them with .gz, and FreeSurfer's such as lh.pial"
            ending = f"the extension {path.suffix!r}" if path.suffix else "no extension"
            raise MeshError(f"{path.name} has {ending}; mesh files that can be read are {formats}.")
        # A pipe would wait for ever.
        if not stat.S_ISREG(kind):
            raise MeshError(f"{path} is not a regular file.")
        content = path.read_bytes()
        if path.suffix.lower() == ".gltf":
            content = with_buffers(content, path)
        elif path.suffix.lower() == ".gii":
            content = with_external_data(content, path)
    except MeshError:
        raise  # it is a ValueError too
    except FileNotFoundError:
        raise MissingFileError(f"There is no file {path}.") from None
    except PermissionError:
        raise MeshError(f"{path} cannot be read: permission denied.") from None
    except (OSError, ValueError) as error:
        raise MeshError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}.") from None
    except MemoryError:
        raise MeshError(f"{path.name} is too large for the memory of this computer.") from None
    if not content:
        raise MeshError(f"{path.name} is empty.")
    return content
