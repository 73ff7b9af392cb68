"""`bihdist field`: distances of all vertices, into a file."""

import argparse

from .mesh import read_laplacian
from .options import add_areas, add_distance, specs, vertex
from .terminal import accuracy, counted, progress_line

WORDS = "distances of all vertices from one or more sources"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", help="mesh file, or the name of a sample")
    parser.add_argument("--source", type=vertex, metavar="V", nargs="+", required=True, help="vertex ids")
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="a .npy, .csv, .ply or .vtp file")
    add_distance(parser)
    add_areas(parser)


def run(options: argparse.Namespace) -> None:
    from bihdist_core.distances.answers import Distances
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.whole_file import check_output

    check_output(options.output, FIELD_FORMATS)
    (chosen,) = specs(options, [options.distance])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        laplacian.surface.check_vertices(options.source)
        distance = Distances(laplacian).get(chosen, progress)
        columns = distance.from_sources(options.source, progress)
        said = accuracy(distance)
    names = [f"{chosen.word}_from_{v}" for v in options.source]
    write_fields(options.output, laplacian.surface, dict(zip(names, columns.T, strict=True)))
    size = f"{columns.shape[0]} vertices, {counted(columns.shape[1], 'source')}"
    print(f"{options.output}: {distance.label}, {size}{said}")
