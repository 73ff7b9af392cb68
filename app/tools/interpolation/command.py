"""`bihdist interpolate`: values at a few vertices, interpolated on the whole mesh, into a file."""

import argparse

from bihdist_core.counts import counted

from ...commands.mesh import name_output, outputs_of, read_laplacian
from ...commands.options import add_areas, add_distance, add_mesh, add_output, as_argument, positive, share, specs
from ...commands.terminal import Result, accuracy, distance_facts, progress_line, tell_moved
from .options import AnchorFile, anchors_from_words, anchors_on

WORDS = "interpolate values at a few vertices over the whole mesh"
EXAMPLES = (
    "bihdist interpolate hand --anchors 12=0,400=1 -o values.npy",
    "bihdist interpolate hand --anchors 12=0,400=1 --distance biharmonic,geodesic -o values.csv",
    "bihdist interpolate hand --anchors @anchors.csv -o values.vtp",
)
TEXT = ".csv"
anchors = as_argument(anchors_from_words)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `interpolate` to its parser."""
    add_mesh(parser)
    parser.add_argument(
        "--anchors",
        metavar="V=VALUE,…|@FILE",
        type=anchors,
        required=True,
        help="vertices with values (12=0,40=1); or in a file, @FILE, or - for standard input: a .csv with a line "
        "`vertex,value` and one for each, .json, or landmarks such as MeshLab's .pp named by values",
    )
    add_output(parser, "a .npy, .csv, .ply or .vtp file", usual="-interpolated.npy")
    add_distance(parser, "a field each (default: biharmonic)")
    add_areas(parser)
    parser.add_argument(
        "--exponent", type=positive, default=1.0, metavar="P", help="the exponent of the weights (default: 1)"
    )
    parser.add_argument(
        "--smoothness",
        type=share,
        default=0.0,
        metavar="S",
        help="how far around an anchor its cone is rounded, a fraction from 0 to 1 (default: 0)",
    )


def run(options: argparse.Namespace) -> Result:
    """Write the interpolant of values at a few vertices, and print its other extrema."""
    import numpy as np

    from bihdist_core.analysis.persistence import other_extrema
    from bihdist_core.applications.interpolation import ShepardInterpolant
    from bihdist_core.applications.tips import at_tips, tips
    from bihdist_core.distances.answers import Distances
    from bihdist_core.file_output import check_output
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.sources.source import SourceSet

    name_output(options)
    check_output(options.output, FIELD_FORMATS)
    chosen = specs(options, list(dict.fromkeys(options.distance or ["biharmonic"])))
    fields, lines, facts = {}, [], []
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        surface, distances = laplacian.surface, Distances(laplacian)
        known = anchors_on(options.anchors, surface)
        if isinstance(options.anchors, AnchorFile):
            tell_moved(options.anchors.path, "anchor", known, known.names, surface)
        ends = tips(laplacian)
        for spec in chosen:
            distance = distances.get(spec, progress)
            field = ShepardInterpolant(
                distance, known.vertices, known.values, options.exponent, options.smoothness
            ).evaluate(progress)
            fields[str(spec)] = field
            others = "all of one value"
            n_extrema = near = 0
            if np.ptp(known.values) > 0:
                stray = other_extrema(surface, field, SourceSet(tuple(known.vertices))).vertices
                n_extrema, near = len(stray), int(at_tips(surface, stray, ends).sum())
                others = f"{counted(n_extrema, 'extremum', 'extrema')} besides the anchors, {near} at tips"
            lines.append(f"{distance.label}, {counted(len(known), 'anchor')}, {others}{accuracy(distance)}")
            missing = int(np.isnan(field).sum())
            if missing:
                lines[-1] += f"; {counted(missing, 'vertex', 'vertices')} on components without an anchor"
            counts = {"n_extrema": n_extrema, "n_extrema_at_tips": near, "n_missing": missing}
            facts.append({**distance_facts(distance, spec), **counts})
    write_fields(options.output, surface, fields)
    for line in lines:
        print(f"{options.output}: {line}")
    about = {"mesh": options.mesh, "outputs": outputs_of(options), "n_anchors": len(known)}
    return Result({**about, "fields": facts})
