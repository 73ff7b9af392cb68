"""The program `exact_geodesic` runs in a process of its own; it imports numpy and pygeodesic, nothing of ours.

Started as a script with the parent's import path as arguments.  On standard input it reads int64 n and m, float64
(n, 3) vertices, int32 (m, 3) faces, then until the end questions: int64 k and int64 (k,) sources.  It answers each as
`child_process` says, with float64 (n,) distances.
"""

import os
import signal
import sys
from typing import BinaryIO


def main() -> None:
    """Answer sources until the parent closes the pipe."""
    # The folder of this script holds our modules under top-level names; the parent's path finds what it finds.
    sys.path[:] = sys.argv[1:]
    # Ctrl-C in a terminal reaches every process; the parent decides what it means and kills this one if need be.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(0, "rb", closefd=False), os.fdopen(os.dup(1), "wb")
    # pygeodesic prints its complaints; they must not end up among the numbers.
    os.dup2(2, 1)
    try:
        import numpy as np
        from pygeodesic.geodesic import PyGeodesicAlgorithmExact

        n, m = np.frombuffer(requests.read(16), np.int64)
        vertices = np.frombuffer(requests.read(24 * n), np.float64).reshape(n, 3)
        faces = np.frombuffer(requests.read(12 * m), np.int32).reshape(m, 3)
        algorithm = PyGeodesicAlgorithmExact(vertices, faces)
        while len(request := requests.read(8)) == 8:
            count = int.from_bytes(request, sys.byteorder)
            distances, _ = algorithm.geodesicDistances(np.frombuffer(requests.read(8 * count), np.int64))
            if distances is None or distances.shape != (n,):
                raise RuntimeError("pygeodesic refused the mesh")
            answer(answers, 0, np.ascontiguousarray(distances, np.float64).tobytes())
    except Exception as error:
        text = f"{type(error).__name__}: {error}".encode()
        answer(answers, 1, text)


def answer(answers: BinaryIO, status: int, content: bytes) -> None:
    """Write 8 bytes of status, 8 with the length of the content, and the content."""
    answers.write(status.to_bytes(8, sys.byteorder) + len(content).to_bytes(8, sys.byteorder) + content)
    answers.flush()


if __name__ == "__main__":
    main()
