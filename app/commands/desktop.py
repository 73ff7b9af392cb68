"""`bihdist desktop`: the program in the menu of a desktop, and as what opens mesh files."""

import argparse

from .result import Result
from .terminal import tell

WORDS = "put the viewer into the desktop's menu, and have mesh files opened by it (Linux)"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `desktop` to its parser."""
    either = parser.add_mutually_exclusive_group(required=True)
    either.add_argument("--install", action="store_true", help="a menu entry, its icon, and the types of mesh files")
    either.add_argument("--remove", action="store_true", help="take all of it away")


def run(options: argparse.Namespace) -> Result:
    """Install or remove, and say where."""
    from ..desktop.installation import data_folder, install, remove

    files, notes = install() if options.install else remove()
    for note in notes:
        tell(note)
    if options.install:
        print(f"{len(files)} files in {data_folder()}: the viewer is in the menu, and opens mesh files")
    elif files:
        print(f"{len(files)} files removed from {data_folder()}")
    else:
        print(f"There was nothing of it in {data_folder()}")
    paths: list[str] = [str(file) for file in files]
    return Result({"outputs": paths if options.install else [], "removed": [] if options.install else paths})
