"""`bihdist field`: distances of all vertices, into a file."""

import argparse

from bihdist_core.counts import counted

from ..document.field_names import distinct, field_name
from .array_output import check_array_output
from .field_of import field_of
from .mesh import add_meshes, into_each
from .options import add_areas, add_distance, add_output, add_sources
from .result import Facts, Result
from .terminal import progress_line

WORDS = "distances of all vertices from one or more sources"
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `field` to its parser."""
    add_meshes(parser)
    add_sources(parser, "where distances start, a field each")
    add_output(parser, "a .npy, .csv, .ply, .vtp, .func.gii or .shape.gii file; {name} is that of each mesh")
    add_distance(parser, is_field=True)
    add_areas(parser)


def run(options: argparse.Namespace) -> Result:
    """Write the distances of all vertices from each source; the exit status is 1 if a mesh failed."""
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    from bihdist_core.distances.difference import PERCENTAGE_POINTS
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields

    check_array_output(options.output, FIELD_FORMATS, "fields")
    with progress_line() as progress:
        it = field_of(options, options.distance, progress, several=True)
    label = f"{it.label}, {it.unit}" if it.unit == PERCENTAGE_POINTS else it.label
    names = distinct([field_name(it.shows, [each]) for each in it.sources])
    write_fields(options.output, it.surface, dict(zip(names, it.field.T, strict=True)))
    size = f"{it.field.shape[0]:,} vertices, {counted(it.field.shape[1], 'source')}"
    print(f"{options.output}: {label}, {size}{it.estimate}")
    return {**it.facts, "shape": list(it.field.shape), "columns": names}
