"""Sample files: binary little-endian PLY, float positions and int indices."""

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
property list uchar int vertex_indices
end_header
"""


def write_ply(path: Path, points: np.ndarray, faces: np.ndarray, comment: str) -> None:
    """Write (n, 3) points and (m, 3) faces."""
    rows = np.empty(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    header = HEADER.format(comment=comment, vertices=len(points), faces=len(faces))
    path.write_bytes(header.encode("ascii") + points.astype("<f4").tobytes() + rows.tobytes())
