"""Meshes that need repair."""

from pathlib import Path

import numpy as np


def with_fins(vertices: np.ndarray, faces: np.ndarray, count: int, path: Path) -> None:
    """Write a mesh (n, 3), (m, 3) as OFF with a third face on each of so many of its edges."""
    sides = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, first = np.unique(sides, axis=0, return_index=True)
    # Evenly among all, none of them twice.
    chosen = np.linspace(0, len(edges) - 1, count).round().astype(int)
    middle = vertices[faces[first[chosen] // 3]].mean(axis=1)
    tips = middle + 0.02 * np.ptp(vertices) * (middle - vertices.mean(axis=0))
    fins = np.column_stack([edges[chosen], len(vertices) + np.arange(count)])
    x, f = np.concatenate([vertices, tips]), np.concatenate([faces, fins])
    with path.open("w") as out:
        out.write(f"OFF\n{len(x)} {len(f)} 0\n")
        np.savetxt(out, x, fmt="%.9g")
        np.savetxt(out, np.column_stack([np.full(len(f), 3), f]), fmt="%d")
