"""Runs of `bihdist batch`, and what they leave."""

import csv
from pathlib import Path

from app.main import main


def batch(meshes, out, *options):
    """The exit status; by one process, which is begun sooner than two, unless the options say otherwise."""
    workers = [] if "--workers" in options else ["--workers", "1"]
    return main(["batch", str(meshes), "-o", str(out), *workers, *map(str, options)])


def rows(out, table="summary"):
    """Of a table, by its columns."""
    with (Path(out) / f"{table}.csv").open(newline="") as file:
        return list(csv.DictReader(file))
