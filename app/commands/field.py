"""`bihdist field`: distances of all vertices, into a file."""

import argparse
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError

from ..document.document import Document
from ..document.file_names import distinct, field_name
from ..document.page import Recipe
from ..document.repairs import NAME
from ..figures.look_options import COLOURS
from ..figures.options import with_rows
from .field_of import CommandField, field_of
from .figure_options import tell_other_colours
from .mesh import add_meshes, check_array_output, into_each, name_output
from .options import add_areas, add_distance, add_output, add_rows, add_sources, given, positive
from .result import Facts, Result
from .terminal import progress_line

if TYPE_CHECKING:
    from bihdist_core.arrays import ByteArray

COLOURS_OF_VERTICES = COLOURS[:2]
"""Without bands, which are made of triangles and not of vertices."""

WORDS = "compute distances of all vertices from one or more sources, or a signature of each"
EXAMPLES = (
    "bihdist field hand --sources 12 -o hand.npy",
    "bihdist field hand --sources 12,40 --distance 'diffusion(t=1/4)' -o hand.csv",
    "bihdist field hand --sources 12 --cmap safe -o hand.ply",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `field` to its parser."""
    add_meshes(parser)
    add_sources(parser, "where distances start, a field each")
    files = "a .npy, .csv, .vtp, .vtu, .func.gii or .shape.gii file, or with colours .ply, .obj or .glb"
    add_output(parser, f"{files}; {NAME} is that of each mesh", usual="-field.npy")
    add_distance(parser, is_field=True)
    add_areas(parser)
    add_rows(parser, *COLOURS_OF_VERTICES)
    parser.add_argument(
        "--clim",
        type=positive,
        metavar="END",
        help="the value at which the colours end, for a difference a fraction (default: the maximum)",
    )


def run(options: argparse.Namespace) -> Result:
    """Write the distances of all vertices from each source; the exit status is 1 if a mesh failed."""
    name_output(options)
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    from bihdist_core.distances.difference import PERCENTAGE_POINTS
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.formats.surface_output import COLOURED_FORMATS, write_coloured

    extension = check_array_output(options.output, tuple(dict.fromkeys((*FIELD_FORMATS, *COLOURED_FORMATS))), "fields")
    asked = [
        f"--{name}" for name in ("cmap", "flip-scalars", "clim") if getattr(options, name.replace("-", "_")) is not None
    ]
    if asked and extension not in COLOURED_FORMATS:
        raise ParameterError(f"{asked[0]} goes with {', '.join(COLOURED_FORMATS)}; {extension} has no colours.")
    with progress_line() as progress:
        it = field_of(options, options.distance, progress, several=True)
    label = f"{it.answer.label}, {it.answer.unit}" if it.answer.unit == PERCENTAGE_POINTS else it.answer.label
    names = distinct([field_name(it.shows, [each] if it.shows.points else []) for each in it.sources])
    fields = dict(zip(names, it.field.T, strict=True))
    size = f"{it.field.shape[0]:,} vertices"
    size += f", {counted(it.field.shape[1], 'source')}" if it.shows.points else ""
    if extension in COLOURED_FORMATS and (len(fields) == 1 or asked or extension not in FIELD_FORMATS):
        if len(fields) > 1:
            raise ParameterError(
                f"The colours of vertices show one field, and --sources names {len(fields)}; name one, or write .vtp."
            )
        top = it.answer.maximum if options.clim is None else options.clim * it.answer.scale
        write_coloured(options.output, it.surface, _colours(options, it, top), fields)
        size += f", colours from {-top if it.answer.is_signed else 0:.4g} to {top:.4g}"
    else:
        write_fields(options.output, it.surface, fields)
    print(f"{options.output}: {label}, {size}{it.accuracy}")
    return {**it.facts, "shape": list(it.field.shape), "columns": names}


def _colours(options: argparse.Namespace, it: CommandField, top: float) -> "ByteArray":
    """Return the colours (n, 3) of the only field, as a panel with the colour map of the options shows them."""
    from ..scene.style import style_of

    values = given(options, *COLOURS_OF_VERTICES)
    tell_other_colours(values)
    colours = with_rows(Recipe(Document()), values, COLOURS_OF_VERTICES).document.colours
    return style_of("paper", colours).vertex_colours(it.field[:, 0], top, it.answer.is_signed)
