"""`bihdist field`: distances of all vertices, into a file."""

import argparse

from bihdist_core.counts import counted

from ..document.field_names import distinct, field_name
from .mesh import Facts, add_meshes, into_each, read_laplacian
from .options import SOURCE, add_areas, add_distance, quantities, source
from .terminal import accuracy, progress_line

WORDS = "distances of all vertices from one or more sources"
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `field` to its parser."""
    add_meshes(parser)
    parser.add_argument(
        "--source", type=source, metavar="V", nargs="+", required=True, help=f"{SOURCE}; several words, several fields"
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help="a .npy, .csv, .ply or .vtp file; {name} is that of each mesh",
    )
    add_distance(parser)
    add_areas(parser)


def run(options: argparse.Namespace) -> int:
    """Write the distances of all vertices from each source; the exit status is 1 if a mesh failed."""
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.difference import PERCENTAGE_POINTS, difference_in_unit
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.sources.pieces import pieces_of
    from bihdist_core.whole_file import check_output

    check_output(options.output, FIELD_FORMATS)
    (chosen,) = quantities(options, [options.distance])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        pieces = [pieces_of(each, laplacian.surface) for each in options.source]
        distances = Distances(laplacian)
        known = [distances.get(spec, progress) for spec in chosen.specs]
        fields = [distance.from_sources(options.source, progress) for distance in known]
        estimates = "".join(dict.fromkeys(accuracy(distance) for distance in known))
    labels = [" or ".join(dict.fromkeys(distance.label_from(each) for each in pieces)) for distance in known]
    columns, label = fields[0], " − ".join(labels)
    if chosen.is_difference:
        columns, unit = difference_in_unit(fields[0], fields[1], (known[0].unit, known[1].unit), not chosen.in_percent)
        label = f"{label}, {unit}" if unit == PERCENTAGE_POINTS else label
    names = distinct([field_name(chosen, [each]) for each in options.source])
    write_fields(options.output, laplacian.surface, dict(zip(names, columns.T, strict=True)))
    size = f"{columns.shape[0]:,} vertices, {counted(columns.shape[1], 'source')}"
    return {"said": [f"{label}, {size}{estimates}"], "label": label, "shape": list(columns.shape), "fields": names}
