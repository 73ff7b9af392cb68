"""The program that `aside` runs in a process of its own.

Started as a script with the parent's import path as arguments.  It does the work that it reads from standard input, and
answers as `child_process` says.
"""

import os
import signal
import sys


def main() -> None:
    """Do the work."""
    # The folder of this script holds our modules under top-level names; the parent's path finds what it finds.
    sys.path[:] = sys.argv[1:]
    # Ctrl-C in a terminal reaches every process; the parent decides what it means and kills this one if need be.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(0, "rb", closefd=False), os.fdopen(os.dup(1), "wb")
    # What libraries print must not end up among the numbers.
    os.dup2(2, 1)
    from bihdist_core.solver.aside import serve

    serve(requests, answers)


if __name__ == "__main__":
    main()
