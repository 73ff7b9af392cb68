"""`bihdist samples`: vertices spread over a mesh, into a file."""

import argparse

from bihdist_core.counts import counted

from ...commands.mesh import read_laplacian
from ...commands.options import add_areas, add_distance, count, source, specs
from ...commands.terminal import accuracy, progress_line

WORDS = "vertices spread over a mesh, each the farthest from those before it"
TEXT = ".txt"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `samples` to its parser."""
    parser.add_argument("mesh", help="mesh file, or the name of a sample")
    parser.add_argument("--count", type=count, metavar="K", required=True, help="so many, the source among them")
    parser.add_argument(
        "--source",
        type=source,
        metavar="V",
        help="the vertex to start from, or several, 12+40+7 (default: the highest of the largest component)",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help="a .txt file, an id on each line, a .npy file, or pins as .csv, .json or MeshLab's .pp",
    )
    add_distance(parser)
    add_areas(parser)


def run(options: argparse.Namespace) -> None:
    """Write vertices each of which is farthest from those before it."""
    from bihdist_core.analysis.sampling import SAMPLE_FORMATS, farthest_points, starts_of, write_samples
    from bihdist_core.analysis.upright import guess_up
    from bihdist_core.distances.answers import Distances
    from bihdist_core.formats.mesh_names import mesh_format
    from bihdist_core.whole_file import check_output

    from ...session.questions import source_at

    check_output(options.output, SAMPLE_FORMATS)
    (chosen,) = specs(options, [options.distance])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        surface = laplacian.surface
        starts = starts_of(source_at(options.source, surface, guess_up(surface, mesh_format(surface.name))), surface)
        distance = Distances(laplacian).get(chosen, progress)
        found = farthest_points(distance, starts, options.count, progress)
        estimate = accuracy(distance)
    write_samples(options.output, surface, found)
    print(f"{options.output}: {counted(len(found), 'sample')} by {distance.label}{estimate}")
