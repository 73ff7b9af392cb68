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
    """Return the names of the sample meshes, sorted."""
    return sorted(path.stem for path in SAMPLES.glob("*.ply"))


def sample_title(name: str) -> str:
    """Return the title of a sample: "Figure pose 2" for figure_pose2."""
    words = re.sub(r"(?<=[a-z])(?=[0-9])", " ", name.replace("_", " "))
    return words[:1].upper() + words[1:]


def thumbnail(name: str) -> Path:
    """Return the path of the thumbnail of a sample."""
    return SAMPLES / "thumbnails" / f"{name}.png"


def mesh_path(mesh: str) -> str:
    """Return the path of a mesh file, or of the sample of that name if there is no such file."""
    sample = SAMPLES / f"{mesh}.ply"
    if not os.path.exists(mesh) and os.path.basename(mesh) == mesh and os.path.isfile(sample):
        return str(sample)
    return mesh


def sample(name: str) -> Surface:
    """Read a sample mesh.

    Parameters
    ----------
    name : str
        Name of the sample, such as ``"hand"`` or ``"beast"``.

    Returns
    -------
    Surface
        The mesh.

    Raises
    ------
    MissingFileError
        If there is no sample of that name; the message lists all names.

    Examples
    --------
    >>> import bihdist
    >>> bihdist.sample("hand")
    Surface(hand.ply: 7,569 vertices, 15,082 faces)
    """
    from bihdist_core import MissingFileError, read_surface

    if name not in sample_names():
        raise MissingFileError(f"There is no sample {name!r}; choose from {', '.join(sample_names())}.")
    return read_surface(SAMPLES / f"{name}.ply")
