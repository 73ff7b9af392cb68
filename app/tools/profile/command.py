"""`bihdist profile`: distances along a path on a mesh, as numbers and as a chart."""

import argparse
import os

from ...commands.mesh import check_mesh
from ...commands.options import SOURCE, add_areas, add_distance, add_rows, quantities, source
from ...commands.pairs import pins_in
from ...commands.result import Result, panel_facts
from ...commands.terminal import judged, progress_line, tell_repairs
from .options import ACROSS, WAY
from .part import Profile

WORDS = "distances along a path through points of a mesh, as numbers and as a chart"
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `profile` to its parser."""
    parser.add_argument("mesh", help="mesh file, or the name of a sample")
    parser.add_argument("--source", type=source, metavar="V", help=f"{SOURCE} (default: the highest vertex)")
    parser.add_argument("--pins", metavar="FILE", help="a .csv, .json or MeshLab's .pp file")
    parser.add_argument(
        "--through",
        metavar="V,W,…",
        help="vertices, places in faces, source, pin:1 (default: all pins in their order; of one, from the source)",
    )
    add_rows(parser, WAY, ACROSS)
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        action="append",
        required=True,
        help="numbers: a .csv, .npy, .vtp or .json file; the chart: a .png, .pdf, .svg or .eps file; repeat for more",
    )
    add_distance(parser, "a curve; repeat for more (default: biharmonic, geodesic, diffusion(t=1))")
    add_areas(parser)
    parser.add_argument("--values", action="store_true", help="a chart of values, not of fractions of each maximum")
    parser.add_argument("--size", metavar="SIZE", default="", help="the width of the chart, such as 85mm or double")
    parser.add_argument("--style", metavar="NAME", default="paper", help="paper, uniform, lines or dark")
    parser.add_argument("--font", metavar="FAMILY", default="", help="of all words (default: DejaVu Sans)")
    parser.add_argument("--text", type=float, metavar="POINTS", help="the size of all text (default: 8)")


def run(options: argparse.Namespace) -> Result:
    """Write distances along a path as numbers or a chart; the exit status is 1 if one of them failed."""
    from dataclasses import replace

    from bihdist_core.analysis.profile_output import PROFILE_FORMATS, write_profile
    from bihdist_core.whole_file import check_output

    from ...document.document import COMPARISON, comparison
    from ...document.page import Page, Recipe
    from ...document.shared_parts.pins import add_pins
    from ...figures.draw import FIGURE_FORMATS
    from ...figures.export import compute, open_document
    from ...session.array_store import ArrayStore
    from .figure import save_profile_figure
    from .figure_curves import profile_fields, profile_figure
    from .part import with_profile, words_in
    from .paths import path_of

    for output in options.output:
        check_output(output, (*PROFILE_FORMATS, *FIGURE_FORMATS))
    check_mesh(options.mesh)
    shows = tuple(quantities(options, options.distance)) if options.distance else COMPARISON
    document = comparison(options.mesh, shows, (options.source,), options.areas or "voronoi")
    page = Page(size=options.size, style=options.style, font=options.font, text=options.text)
    with progress_line() as progress:
        document, surfaces = open_document(Recipe(document, page), ArrayStore())
        surface = surfaces[document.surfaces[0].name].surface
        tell_repairs(surface)
        if options.pins:
            document = add_pins(document, [int(vertex) for vertex in pins_in(options.pins, surface).vertices])
        through = words_in(options.through or "")
        document = with_profile(document, through, options.way or "auto", options.across)
        document = document.with_part(replace(document[Profile], shares=not options.values))
        _, path = path_of(document, surfaces)
        found = compute(document, surfaces, progress)
    answers = dict(zip((panel.id for panel in document.panels), found, strict=True))
    for output in options.output:
        if os.path.splitext(output)[1].lower() in PROFILE_FORMATS:
            write_profile(output, path, profile_fields(document, answers))
        else:
            save_profile_figure(profile_figure(document, page, path, answers), output)
        print(f"{output}: {path.label}, {len(path.points):,} points, {path.length:.6g} long")
    facts = {
        "mesh": options.mesh,
        "outputs": options.output,
        "path": {"label": path.label, "n_points": len(path.points), "length": path.length},
        "fields": [panel_facts(panel.shows, answers[panel.id]) for panel in document.panels],
    }
    return Result(facts, judged(found, surface.name))
