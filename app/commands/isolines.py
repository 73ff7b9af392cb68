"""`bihdist isolines`: the isolines of a distance as coordinates, and the region between two values, into files."""

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.errors import OutputError, ParameterError

from ..document.looks import TWENTY_STEPS, Isolines
from ..figures.look_options import ISOLINES, isolines_with
from .field import CommandField, field_of
from .mesh import ids_beside
from .options import add_areas, add_distance, add_mesh, add_output, add_rows, add_sources, given
from .terminal import Facts, Result, progress_line

if TYPE_CHECKING:
    from bihdist_core.arrays import FloatArray


WORDS = "trace isolines of a distance, and cut out the region between two values"
EXAMPLES = (
    "bihdist isolines hand --sources 12 --isolines 20 -o lines.csv",
    "bihdist isolines hand --sources 12 --isoline-values 0.2,0.4 -o lines.obj",
    "bihdist isolines hand --sources 12 --region 20%:40% --region-mesh band.ply",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `isolines` to its parser."""
    add_mesh(parser)
    add_sources(parser, "the source where the distance starts")
    add_output(parser, "the isolines: a .csv, .obj, .vtp or .json file", required=False)
    parser.add_argument("--region-ids", metavar="OUT", help="write the vertices of --region: a .txt, .npy or .csv file")
    parser.add_argument(
        "--region-mesh", metavar="OUT", help="write --region, cut out along its isolines: a .ply or .vtp file"
    )
    add_distance(parser, is_field=True)
    add_areas(parser)
    parser.add_argument(
        "--region", metavar="LOW:HIGH", help="the region between two values, or two fractions of the maximum: 20%%:40%%"
    )
    add_rows(parser, ISOLINES)


def run(options: argparse.Namespace) -> Result:
    """Print the lengths of isolines, and write them and the region between two values where asked."""
    from bihdist_core.analysis.bands import band
    from bihdist_core.analysis.isoline_tracing import ISOLINE_FORMATS, isolines, write_isolines
    from bihdist_core.analysis.level_words import region_from_words
    from bihdist_core.analysis.selecting import SELECTION_WAYS, write_ids
    from bihdist_core.file_output import check_outputs
    from bihdist_core.formats.field_output import write_fields

    if not (options.output or options.region):
        raise ParameterError("There is nothing to do; name a file of isolines with -o, or values with --region.")
    if (options.region_ids or options.region_mesh) and not options.region:
        raise ParameterError("Which region? Name its values with --region, such as 20%:40%.")
    if (options.output or "").lower().endswith(".svg"):
        raise OutputError(
            f"{options.output}: an SVG is a picture; draw it by `bihdist figure {options.mesh} --style lines -o "
            f"{options.output}`. Coordinates are written as {', '.join(ISOLINE_FORMATS)}."
        )
    check_outputs(
        (options.output, ISOLINE_FORMATS),
        (options.region_ids, SELECTION_WAYS["ids"]),
        (options.region_mesh, SELECTION_WAYS["mesh"]),
    )
    wanted = isolines_with(TWENTY_STEPS, given(options, ISOLINES))
    with progress_line() as progress:
        it = field_of(options, options.distance, progress)
    wanted = wanted.scaled(it.answer.scale)
    files = (options.output, ids_beside(options), options.region_ids, options.region_mesh)
    facts: Facts = {"mesh": options.mesh, **it.facts, "outputs": [file for file in files if file]}
    if options.output:
        values = _values(it, wanted, options.isoline_through or ())
        lines = isolines(it.surface, it.field, values)
        write_isolines(options.output, lines)
        length = sum(line.length for line in lines)
        size = f"{counted(len(lines), 'curve')} at {counted(len(values), 'value')}, together {length:.6g} long"
        print(f"{options.output}: {it.answer.label}, {size}{it.accuracy}")
        facts |= {"values": values, "n_curves": len(lines), "length": length}
    if options.region:
        # Of a difference 5 % are five percentage points, and not a fraction of its largest value.
        ends = region_from_words(options.region, 1.0 if it.answer.scale != 1 else it.answer.maximum)
        found = band(it.surface, it.field, *(it.answer.scale * end for end in ends))
        if options.region_ids:
            write_ids(options.region_ids, found.vertices)
            print(f"{options.region_ids}: {counted(len(found.vertices), 'vertex', 'vertices')}")
        if options.region_mesh:
            write_fields(options.region_mesh, found.surface, {it.word: found.along(it.field)})
            print(f"{options.region_mesh}: {counted(len(found.surface.faces), 'face')}")
        part = found.area / it.surface.face_areas.sum()
        held = counted(len(found.vertices), "vertex", "vertices")
        print(f"region {options.region}: area {found.area:.6g}, {part:.1%}, {held}")
        low, high = (it.answer.scale * end for end in ends)
        facts["region"] = {
            "low": low, "high": high, "area": found.area, "area_fraction": part, "n_vertices": len(found.vertices)
        }  # fmt: skip
    return Result(facts)


def _values(it: CommandField, wanted: Isolines, through: Sequence[int]) -> "FloatArray":
    """Return the values at which a figure would have isolines."""
    from ..scene.levels import levels, too_many

    it.surface.check_vertices(list(through))
    found = levels(
        wanted,
        it.answer.maximum,
        it.answer.maximum,
        it.answer.is_signed,
        [float(it.field[vertex]) for vertex in through],
    )
    if reason := too_many(found, wanted, it.answer.maximum):
        raise ParameterError(reason)
    if not len(found.values):
        raise ParameterError("There are no isolines; name a number of steps with --isolines.")
    return found.values
