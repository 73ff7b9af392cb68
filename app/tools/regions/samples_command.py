"""`bihdist samples`: vertices spread over a mesh, into a file."""

import argparse

from bihdist_core.counts import counted

from ...commands.mesh import name_output, outputs_of, read_laplacian, sources_on
from ...commands.options import add_areas, add_distance, add_mesh, add_output, add_sources, specs
from ...commands.terminal import Result, accuracy, distance_facts, progress_line

WORDS = "spread vertices over a mesh, each farthest from those before it, or at random"
EXAMPLES = (
    "bihdist samples hand --sources farthest:100 -o samples.txt",
    "bihdist samples hand --sources random:100:7 -o samples.npy",
    "bihdist samples hand --sources farthest:20 --distance geodesic -o pins.json",
)
TEXT = ".txt"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `samples` to its parser."""
    add_mesh(parser)
    add_sources(parser, "the vertices to write", default="", required=True, are_vertices=True)
    files = "a .txt file, an id on each line, a .npy file, or pins as .csv, .json, MeshLab's .pp or other landmarks"
    add_output(parser, files, usual="-samples.txt")
    add_distance(parser)
    add_areas(parser)


def run(options: argparse.Namespace) -> Result:
    """Write the vertices that a rule chooses."""
    from bihdist_core.analysis.sampling import SAMPLE_FORMATS, write_samples
    from bihdist_core.distances.answers import Distances
    from bihdist_core.file_output import check_output

    from ...document.sources import FARTHEST

    name_output(options)
    check_output(options.output, SAMPLE_FORMATS)
    (chosen,) = specs(options, [options.distance])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distance = Distances(laplacian).get(chosen, progress)
        found = sources_on(options, laplacian.surface, lambda: distance, progress).vertices("Samples")
        by = f" by {distance.label}" if options.sources.rule == FARTHEST else ""
        estimate = accuracy(distance) if by else ""
    write_samples(options.output, laplacian.surface, found)
    print(f"{options.output}: {counted(len(found), 'sample')}{by}{estimate}")
    about = {"mesh": options.mesh, **(distance_facts(distance, chosen) if by else {}), "outputs": outputs_of(options)}
    return Result({**about, "vertices": found})
