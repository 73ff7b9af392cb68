"""Mesh files into surfaces: OFF, OBJ, PLY, STL, VTK (legacy), VTP, VTU, glTF, GLB, GIFTI and FreeSurfer's.

All readers are our own and strict: a file is read whole or refused with a sentence, and vertex ids are the file's.
(VTK's readers split OBJ vertices along texture seams, return what is left of a truncated file, and can take the
process down on a damaged one.)
"""

import os
import stat
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..counts import counted
from ..errors import MeshError, MissingFileError
from ..surface import Surface
from .freesurfer import read_freesurfer
from .gifti import read_gifti
from .gltf import read_gltf
from .gltf_file import with_buffers
from .gzip_files import unpacked
from .mesh_names import FREESURFER, GZIP, MESH_FORMATS, mesh_format
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .polygons import Polygons, triangulated
from .stl import read_stl
from .vtk import read_vtk
from .vtp import read_vtp

_READERS: dict[str, Callable[[bytes, str], Polygons]] = {
    ".off": read_off,
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".vtk": read_vtk,
    ".vtp": read_vtp,
    ".vtu": read_vtp,
    ".gltf": read_gltf,
    ".glb": read_gltf,
    ".gii": read_gifti,
    FREESURFER: read_freesurfer,
}
LARGEST, SMALLEST = 1e75, 1e-75
"""Squares of areas of larger and of smaller surfaces are beyond what a float holds."""


def read_surface(path: str | os.PathLike[str]) -> Surface:
    """The surface in a mesh file; the extension, in any case, names the format, or a name such as lh.pial.  With .gz
    behind it the file is unpacked.

    Polygons are divided into triangles, and in STL files coincident vertices are merged, which `Surface.facts` says;
    what cannot be part of a surface is left out, which `Surface.repairs` says, both in words with counts.

    Raises MeshError, one sentence with the file, the place and the value, for a file that is missing (then it is a
    FileNotFoundError, too), unreadable, truncated, damaged or of another kind, and for a mesh without faces.

    >>> import bihdist
    >>> from pathlib import Path
    >>> _ = Path("square.off").write_text('''OFF 4 1 0
    ... 0 0 0  1 0 0  1 1 0  0 1 0
    ... 4 0 1 2 3''')
    >>> square = bihdist.read_surface("square.off")
    >>> square.n_faces, square.facts
    (2, ('1 quad divided into 2 triangles',))
    """
    return surface_in(mesh_content(path), Path(path).name)


def surface_in(content: bytes, name: str) -> Surface:
    """The surface in the content of a mesh file of this name; as `read_surface`, of which it is the second half."""
    try:
        # Damaged bytes can be any number, a signalling NaN too; NumPy need not warn, Surface refuses and names them.
        with np.errstate(all="ignore"):
            if name.lower().endswith(GZIP):
                content = unpacked(content, name)
                if not content:
                    raise MeshError(f"{name} is empty.")
            polygons = _READERS[mesh_format(name)](content, name)
            if not len(polygons.sizes):
                held = counted(len(polygons.vertices), "vertex", "vertices")
                raise MeshError(f"{name} has {held} but no faces; a surface needs at least one triangle.")
            faces, left_out, divided = triangulated(polygons)
        repairs, facts = [*polygons.repairs, *left_out], [*polygons.facts, *divided]
        surface = Surface(polygons.vertices, faces, name=name, repairs=repairs, facts=facts)
        _check_extent(surface)
        return surface
    except MemoryError:
        raise MeshError(f"{name} is too large for the memory of this computer.") from None


def _check_extent(surface: Surface) -> None:
    """MeshError for a surface that nothing can be measured on: all of it in one place, too large or too small."""
    x, name = surface.vertices, surface.name
    # All is small only where the first face is.
    if np.ptp(x[surface.faces[0]], axis=0).max() < SMALLEST:
        extent = float(np.ptp(x[surface.faces], axis=(0, 1)).max())
        if extent == 0:
            place = ", ".join(f"{c:g}" for c in x[surface.faces[0, 0]])
            raise MeshError(f"{name}: all corners of its faces are at ({place}); there is nothing to measure.")
        if extent < SMALLEST:
            raise MeshError(f"{name} measures {extent:g}; below {SMALLEST:g} areas have no numbers, so scale it up.")
    if max(float(x.max()), -float(x.min())) > LARGEST:
        k, axis = np.argwhere(np.abs(x) > LARGEST)[0]
        raise MeshError(
            f"{name}: vertex {k} has the coordinate {x[k, axis]:g}; beyond {LARGEST:g} areas have no numbers, so scale "
            "it down."
        )


def mesh_content(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a mesh file; as `read_surface`, of which it is the first half.

    Of a .gltf with the files that it names beside it, inside it.
    """
    path = Path(path)
    try:
        kind = path.stat().st_mode
        if stat.S_ISDIR(kind):
            raise MeshError(f"{path} is a folder, not a mesh file.")
        if path.suffix.lower() == ".3mf":
            raise MeshError(
                f"{path.name} is a 3MF file, which is not read; save it as PLY first, in MeshLab, Blender or another."
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
