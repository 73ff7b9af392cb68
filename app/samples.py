"""The meshes that come with the program, by name."""

import os
from pathlib import Path

SAMPLES = Path(__file__).resolve().parent.parent / "assets"
if not SAMPLES.is_dir():
    # Installed: the folder is the package bihdist_assets beside this one.
    SAMPLES = Path(__file__).resolve().parent.parent / "bihdist_assets"


def sample_names() -> list[str]:
    return sorted(path.stem for path in SAMPLES.glob("*.ply"))


def mesh_path(mesh: str) -> str:
    """The path of a mesh file; a bare word that is no file may be the name of a sample."""
    sample = SAMPLES / f"{mesh}.ply"
    if not os.path.exists(mesh) and os.path.basename(mesh) == mesh and sample.is_file():
        return str(sample)
    return mesh
