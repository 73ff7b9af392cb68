"""What files are called until the user types another name."""

import os
import re
from collections.abc import Sequence

from bihdist_core.formats.mesh_names import mesh_format, mesh_name


def file_name(meshes: Sequence[str], what: str, *of: str) -> str:
    """The meshes, what it is of them and of which distance, selection or way: "spot-field-biharmonic".

    meshes: their files or names.  Without an extension, and without what a shell or another system would stumble over.
    """
    stems = dict.fromkeys(
        mesh_name(mesh) if mesh_format(mesh) else re.sub(r"\.[A-Za-z]\w*$", "", os.path.basename(mesh))
        for mesh in meshes
    )
    words = (re.sub(r"[^\w.]+|_", "-", word).strip("-.") for word in (*stems, what, *of))
    return "-".join(word for word in words if word)
