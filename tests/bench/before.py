"""The rows of an earlier commit, each right beside this tree's, in processes of their own."""

import json
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from .table import Line, from_json

ROOT = Path(__file__).resolve().parents[2]


@contextmanager
def checked_out(ref: str) -> Iterator[Path]:
    """The commit's files in a temporary folder, its kernel compiled; ValueError if there is no such commit."""
    words = ["git", "archive", "--format=tar", "--end-of-options", f"{ref}^{{commit}}"]
    archive = subprocess.run(words, cwd=ROOT, capture_output=True)
    if archive.returncode:
        raise ValueError(f"There is no commit {ref!r} to compare with.")
    with tempfile.TemporaryDirectory() as place:
        with tarfile.open(fileobj=BytesIO(archive.stdout)) as files:
            files.extraction_filter = getattr(tarfile, "data_filter", None)  # of Python 3.11.4 and newer
            files.extractall(place)
        build = Path(place, "bihdist_core", "kernel", "build.py")
        if build.exists():
            subprocess.run([sys.executable, str(build)], cwd=place, check=True, stdout=subprocess.DEVNULL)
        yield Path(place)


def lines_of(tree: Path, row: int, arguments: Sequence[str]) -> list[Line]:
    """The lines of one row as that tree measures them; RuntimeError with its last line of stderr if it cannot."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place, "row.json")
        words = [sys.executable, "-m", "tests.bench", "--only", str(row), "--json", str(path), *arguments]
        run = subprocess.run(words, cwd=tree, env=os.environ | {"PYTHONPATH": str(tree)}, capture_output=True)
        if run.returncode or not path.exists():
            said = run.stderr.decode(errors="replace").strip().splitlines()
            raise RuntimeError(said[-1] if said else f"it ended with {run.returncode}")
        written = json.loads(path.read_text(encoding="utf-8"))["lines"]
    return from_json(written)


def beside(tree: Path, row: int, arguments: Sequence[str]) -> list[Line]:
    """This tree's lines of a row, with the seconds of the earlier tree's lines of the same words."""
    lines = lines_of(ROOT, row, arguments)
    try:
        earlier = {line.work: line.ours for line in lines_of(tree, row, arguments)}
    except RuntimeError as error:
        return [replace(line, note="; ".join(filter(None, (line.note, f"before: {error}")))) for line in lines]
    return [replace(line, before=earlier.get(line.work)) for line in lines]
