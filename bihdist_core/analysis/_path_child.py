"""The program `geodesic_paths` runs in a process of its own; it imports numpy, pygeodesic and potpourri3d, nothing of
ours.

Started as a script with the parent's import path as arguments.  On standard input it reads requests until the end:
int64 kind, and for kind 0 (a mesh) int64 n and m, float64 (n, 3) vertices, int32 (m, 3) faces, for kind 1 (the shortest
path) and 2 (a straightened one) int64 start and stop.  It answers each as `child_process` says, with float64 (k, 3)
points from start to stop, or nothing for a mesh.
"""

import os
import signal
import sys
from typing import Any, BinaryIO


class Paths:
    """The paths of the mesh that was sent last; what they need is made when first asked for."""

    def __init__(self) -> None:
        self.vertices: Any = None
        self.faces: Any = None
        self.exact: Any = None
        self.straight: Any = None

    def read_mesh(self, requests: BinaryIO) -> bytes:
        """Read a mesh: counts of vertices and faces, both as arrays; nothing is answered."""
        import numpy as np

        n, m = np.frombuffer(requests.read(16), np.int64)
        self.vertices = np.frombuffer(requests.read(24 * n), np.float64).reshape(n, 3)
        self.faces = np.frombuffer(requests.read(12 * m), np.int32).reshape(m, 3)
        self.exact = self.straight = None
        return b""

    def shortest(self, start: int, stop: int) -> bytes:
        """(k, 3) float64, as bytes: points of the shortest path between two vertices."""
        import numpy as np
        from pygeodesic.geodesic import PyGeodesicAlgorithmExact

        self.exact = self.exact or PyGeodesicAlgorithmExact(self.vertices, self.faces)
        _, points = self.exact.geodesicDistance(stop, start)
        if points is None or not len(points):
            raise RuntimeError("pygeodesic found no path")
        points = np.asarray(points, np.float64)
        ends = self.vertices[[start, stop]]
        if np.abs(points[[0, -1]] - ends).max() > np.abs(points[[-1, 0]] - ends).max():
            points = points[::-1]
        return np.ascontiguousarray(points).tobytes()

    def straightened(self, start: int, stop: int) -> bytes:
        """(k, 3) float64, as bytes: points of a path along edges that was straightened by flipping edges."""
        import numpy as np
        from potpourri3d import EdgeFlipGeodesicSolver

        self.straight = self.straight or EdgeFlipGeodesicSolver(self.vertices, self.faces)
        points = np.asarray(self.straight.find_geodesic_path(start, stop), np.float64)
        if len(points) < 2 or not np.isfinite(points).all():
            raise RuntimeError("potpourri3d found no path")
        return points.tobytes()


def main() -> None:
    """Answer requests until the parent closes the pipe."""
    # The folder of this script holds our modules under top-level names; the parent's path finds what it finds.
    sys.path[:] = sys.argv[1:]
    # Ctrl-C in a terminal reaches every process; the parent decides what it means and kills this one if need be.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(0, "rb", closefd=False), os.fdopen(os.dup(1), "wb")
    # The libraries print their complaints; they must not end up among the numbers.
    os.dup2(2, 1)
    paths = Paths()
    while len(request := requests.read(8)) == 8:
        kind = int.from_bytes(request, sys.byteorder)
        try:
            if kind == 0:
                content = paths.read_mesh(requests)
            else:
                start, stop = (int.from_bytes(requests.read(8), sys.byteorder) for _ in range(2))
                content = (paths.shortest if kind == 1 else paths.straightened)(start, stop)
            status = 0
        except Exception as error:
            status, content = 1, f"{type(error).__name__}: {error}".encode()
        answers.write(status.to_bytes(8, sys.byteorder) + len(content).to_bytes(8, sys.byteorder) + content)
        answers.flush()


if __name__ == "__main__":
    main()
