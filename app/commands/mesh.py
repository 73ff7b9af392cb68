"""The mesh that a command names."""

import argparse
from typing import TYPE_CHECKING

from ..document.document import AREAS
from ..samples import mesh_path
from .terminal import tell_repairs

if TYPE_CHECKING:
    from bihdist_core import Laplacian


def read_laplacian(options: argparse.Namespace) -> "Laplacian":
    """Read it, say what was repaired, and take the areas that were asked for."""
    from bihdist_core import Laplacian, read_surface

    surface = read_surface(mesh_path(options.mesh))
    tell_repairs(surface)
    return Laplacian(surface, options.areas or AREAS[0])
