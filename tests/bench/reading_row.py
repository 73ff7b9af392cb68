"""Row 24: mesh files of text, read."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core import Surface, read_surface, write_mesh

from . import peers
from .meshes import bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import Comparison, alternate, timed

BOUNDS = {"off": 0.4, "obj": 1.0, "ply": 1.0}
OPTIONAL = {"meshio": peers.read_by_meshio, "trimesh": peers.read_by_trimesh, "libigl": peers.read_by_libigl}
PLY_HEADER = """ply
format ascii 1.0
element vertex {}
property double x
property double y
property double z
element face {}
property list uchar int vertex_indices
end_header
"""


def reading(size: Size) -> Iterator[Line]:
    """From a file to a surface, against the fastest of the readers that are installed."""
    readers = {"VTK": peers.read_by_vtk} | {name: OPTIONAL[name] for name in filter(peers.is_installed, OPTIONAL)}
    missing = ", ".join(name for name in OPTIONAL if name not in readers)
    surface = Surface(*bumpy_sphere(size.read))
    with tempfile.TemporaryDirectory() as folder:
        for kind, bound in BOUNDS.items():
            path = str(Path(folder, f"mesh.{kind}"))
            _write(path, surface)
            best, result = _in_turn(path, readers, size.rounds)
            is_same = np.array_equal(result.answer.faces, surface.faces)
            yield compared(
                24,
                f"{kind.upper()} file of text read, {len(surface.vertices):,}",
                result,
                bound=bound,
                error=float(np.abs(result.answer.vertices - surface.vertices).max()) if is_same else np.inf,
                tolerance=0.0,
                note=f"peer: {best}" + (f"; not installed: {missing}" if missing else ""),
            )


def _in_turn(path: str, readers: dict[str, Callable[[str], Any]], rounds: int) -> tuple[str, Comparison]:
    """The reader that is fastest once, and the times of ours and of it."""
    best = min(readers, key=lambda name: timed(lambda: readers[name](path))[0])
    return best, alternate(lambda: read_surface(path), lambda: readers[best](path), rounds)


def _write(path: str, surface: Surface) -> None:
    if not path.endswith(".ply"):
        write_mesh(path, surface)
        return
    # Below its header a PLY file of text is an OFF file.
    off = Path(path).with_suffix(".off").read_bytes()
    header = PLY_HEADER.format(len(surface.vertices), len(surface.faces))
    Path(path).write_bytes(header.encode() + off.split(b"\n", 2)[2])
