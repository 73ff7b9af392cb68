"""`bihdist correspond`: from a few known pairs, the vertex of one mesh that fits each vertex of another."""

import argparse

from bihdist_core.counts import counted

from ...commands.mesh import ids_beside, laplacian_of, name_output
from ...commands.options import add_areas, add_distance, add_output, add_pairs, add_two_meshes, repairs_of, specs
from ...commands.terminal import Facts, Result, accuracy, distance_facts, progress_line, tell
from .options import PAIRS_MEANING

WORDS = "map one mesh to another, from a few pairs of corresponding vertices"
EXAMPLES = (
    "bihdist correspond figure figure_pose2 --pairs 1:1,300:300,900:900 -o map.npy",
    "bihdist correspond figure figure_pose2 --pairs @pairs.txt --truth identity -o map.txt",
    "bihdist correspond a.ply b.ply --pairs @a.fcsv,b.fcsv -o map.npy",
)
TEXT = ".txt"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `correspond` to its parser."""
    add_two_meshes(parser)
    add_pairs(parser, PAIRS_MEANING, required=True)
    files = "a .npy or .txt file: the vertex of B for each vertex of A, -1 where none can be compared"
    add_output(parser, files, usual="-map.txt")
    add_distance(parser)
    add_areas(parser)
    parser.add_argument("--truth", metavar="MAP", help="the correct map, to report errors: `identity`, or a file")


def run(options: argparse.Namespace) -> Result:
    """Write the map of the first mesh to the second that corresponding points predict."""
    import numpy as np

    from bihdist_core.applications.correspondence import Correspondence
    from bihdist_core.distances.answers import Distances, same_on
    from bihdist_core.file_output import check_output
    from bihdist_core.formats.vertex_maps import MAP_FORMATS, read_map, read_pairs, write_map

    from .evaluate_command import curve_facts, described_errors

    name_output(options)
    check_output(options.output, MAP_FORMATS)
    (chosen,) = specs(options, [options.distance])
    ids_files = [ids_beside(options, letter) for letter in "AB"]
    with progress_line() as progress:
        one, two = (
            laplacian_of(mesh, options.areas, repairs_of(options, mesh), ids_file)
            for mesh, ids_file in zip((options.mesh, options.other), ids_files, strict=True)
        )
        pairs = (
            read_pairs(options.pairs, (one.surface, two.surface), tell)
            if isinstance(options.pairs, str)
            else np.array(options.pairs)
        )
        truth = read_map(options.truth, one.surface, two.surface) if options.truth else None
        sides = Distances(one), Distances(two)
        spec = same_on(chosen, sides, progress)
        on_one, on_two = (side.get(spec, progress) for side in sides)
        found = Correspondence(on_one, on_two, pairs, progress=progress).map(progress=progress)
        estimate = accuracy(max(on_one, on_two, key=lambda distance: distance.accuracy or 0.0))
    write_map(options.output, found)
    missing = int((found < 0).sum())
    none = f", {missing} without one to compare" if missing else ""
    size = f"{len(found):,} vertices to {len(two.surface.vertices):,}"
    print(f"{options.output}: {on_one.label}, {counted(len(pairs), 'pair')}, {size}{none}{estimate}")
    facts: Facts = {
        "mesh": options.mesh, "other": options.other, **distance_facts(on_one, spec),
        "outputs": [options.output, *filter(None, ids_files)],
        "n_pairs": len(pairs), "n_vertices": len(found), "n_missing": missing,
    }  # fmt: skip
    if truth is not None:
        with progress_line() as progress:
            (line,), (curve,) = described_errors(two, found[:, None], truth, progress=progress)
        print(f"{options.output}: {line}")
        facts["errors"] = curve_facts(curve)
    return Result(facts)
