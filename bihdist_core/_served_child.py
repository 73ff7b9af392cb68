"""The program of processes that do what a module of ours serves; see `child_process`.

Started as a script with the parent's import path as arguments.  What it reads first is the name of the module, whose
`serve(requests, answers)` does the rest.
"""

import os
import signal
import sys


def main() -> None:
    """Serve until the parent closes the pipe."""
    # The folder of this script holds our modules under top-level names; the parent's path finds what it finds.
    sys.path[:] = sys.argv[1:]
    # Ctrl-C in a terminal reaches every process; the parent decides what it means and kills this one if need be.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(0, "rb", closefd=False), os.fdopen(os.dup(1), "wb")
    # What libraries print must not end up among the answers.
    os.dup2(2, 1)
    from importlib import import_module

    size = int.from_bytes(requests.read(8), sys.byteorder)
    import_module(requests.read(size).decode()).serve(requests, answers)
    # Threads may still read or draw, and what OpenGL says at the end helps nobody.
    os._exit(0)


if __name__ == "__main__":
    main()
