"""Sample files: binary little-endian PLY, float positions and indices as short as they can be."""

from pathlib import Path

import numpy as np

HEADER = """ply
format binary_little_endian 1.0
comment {comment}
element vertex {vertices}
property float x
property float y
property float z
element face {faces}
property list uchar {index} vertex_indices
end_header
"""


def write_ply(path: Path, points: np.ndarray, faces: np.ndarray, comment: str) -> None:
    """Write (n, 3) points and (m, 3) faces."""
    name, kind = ("ushort", "<u2") if len(points) <= 65_536 else ("int", "<i4")
    rows = np.empty(len(faces), [("count", "u1"), ("corners", kind, 3)])
    rows["count"], rows["corners"] = 3, faces
    header = HEADER.format(comment=comment, vertices=len(points), faces=len(faces), index=name)
    path.write_bytes(header.encode("ascii") + points.astype("<f4").tobytes() + rows.tobytes())
