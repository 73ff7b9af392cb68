"""The meshes that come with the program, by name."""

from __future__ import annotations

import os
import re
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from bihdist_core import Surface

_ROOT = Path(__file__).resolve().parent.parent
# Installed, the folder is the package bihdist_assets beside this one; in a checkout it is assets.
SAMPLES = next((_ROOT / name for name in ("bihdist_assets", "assets") if (_ROOT / name).is_dir()), _ROOT / "assets")


def sample_names() -> list[str]:
    """The names of the sample meshes, sorted."""
    return sorted(path.stem for path in SAMPLES.glob("*.ply"))


def sample(name: str) -> Surface:
    """The sample mesh of a name such as "hand"; ParameterError if there is none.

    >>> import bihdist
    >>> bihdist.sample("hand").n_vertices
    7569
    """
    from bihdist_core import ParameterError, read_surface

    if name not in sample_names():
        raise ParameterError(f"There is no sample {name!r}; the samples are {', '.join(sample_names())}.")
    return read_surface(SAMPLES / f"{name}.ply")


def sample_title(name: str) -> str:
    """ "Figure pose 2" of figure_pose2."""
    words = re.sub(r"(?<=[a-z])(?=[0-9])", " ", name.replace("_", " "))
    return words[:1].upper() + words[1:]


def thumbnail(name: str) -> Path:
    """A small picture of a sample."""
    return SAMPLES / "thumbnails" / f"{name}.png"


def mesh_path(mesh: str) -> str:
    """The path of a mesh file; a bare word that is no file may be the name of a sample."""
    sample = SAMPLES / f"{mesh}.ply"
    if not os.path.exists(mesh) and os.path.basename(mesh) == mesh and os.path.isfile(sample):
        return str(sample)
    return mesh
