"""All kinds of broken meshes in every file format that can hold them."""

import gzip
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np

from tests.core.mesh_samples import (
    freesurfer,
    freesurfer_text,
    gifti_surface,
    glb,
    gltf,
    gltf_parts,
    mat,
    mni,
    npz,
    obj,
    off,
    off_binary,
    ply,
    stl_binary,
    stl_text,
    vtk_old,
    written_by_vtk,
)

from .broken_kinds import KINDS
from .mesh_files import opened
from .outcome import Outcome


def _by_vtk(vertices: np.ndarray, faces: np.ndarray, path: Path) -> bytes:
    """IndexError for what VTK writes no file of."""
    if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
        raise IndexError
    return written_by_vtk(path, faces, vertices=vertices).read_bytes()


Write = Callable[[np.ndarray, np.ndarray, Path], str | bytes]
FORMATS: dict[str, Write] = {
    "a.off": lambda x, faces, _: off(x, faces),
    "binary.off": lambda x, faces, _: off_binary(x, faces),
    "a.obj": lambda x, faces, _: obj(x, faces),
    "a.ply": lambda x, faces, _: ply("ascii", faces, x),
    "little.ply": lambda x, faces, _: ply("binary_little_endian", faces, x),
    "big.ply": lambda x, faces, _: ply("binary_big_endian", faces, x),
    "text.stl": lambda x, faces, _: stl_text(x, faces),
    "binary.stl": lambda x, faces, _: stl_binary(x, faces),
    "a.vtk": lambda x, faces, _: vtk_old(x, faces),
    "binary.vtk": lambda x, faces, _: vtk_old(x, faces, binary=True),
    "a.vtp": lambda x, faces, folder: _by_vtk(x, faces, folder / "by_vtk.vtp"),
    "a.gltf": lambda x, faces, _: gltf(*gltf_parts(x, faces)),
    "a.glb": lambda x, faces, _: glb(*gltf_parts(x, faces, "<u4")),
    "a.surf.gii": lambda x, faces, _: gifti_surface(x, faces),
    "lh.white": lambda x, faces, _: freesurfer(x, faces),
    "lh.white.asc": lambda x, faces, _: freesurfer_text(x, faces),
    "mni.obj": lambda x, faces, _: mni(x, faces),
    "little.obj": lambda x, faces, _: mni(x, faces, order="<"),
    "a.mat": lambda x, faces, _: mat(x, faces),
    "a.npz": lambda x, faces, _: npz(x, faces),
    "a.off.gz": lambda x, faces, _: gzip.compress(off(x, faces).encode()),
}
WORDS = f"{len(KINDS)} kinds of broken meshes in {len(FORMATS)} formats"
SEEDS, BLOCK, SECONDS = 20, len(KINDS) * len(FORMATS), 30.0


def case(seed: int, number: int, folder: Path) -> Outcome | None:
    """A kind in a format; nothing where the format cannot hold it."""
    turn, which = divmod(number, len(KINDS))
    # The first of a block are all kinds, in different formats.
    kind, name = list(KINDS)[which], list(FORMATS)[(turn + which) % len(FORMATS)]
    vertices, faces = KINDS[kind](np.random.default_rng([seed, number]))
    path = folder / name
    try:
        with np.errstate(all="ignore"):
            content = FORMATS[name](vertices, faces, folder)
    except (IndexError, OverflowError, struct.error):
        return None
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    outcome = opened(path, number)
    return Outcome(outcome.kind, outcome.text and f"{kind}: {outcome.text}", outcome.ratio)
