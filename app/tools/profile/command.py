"""`bihdist profile`: distances along a path on a mesh, as numbers and as a chart."""

import argparse
from dataclasses import asdict

from ...commands.field import check_values
from ...commands.mesh import check_mesh, first_spec, one_source, sources_of_document, sources_of_mesh, write_ids_of
from ...commands.options import (
    add_areas,
    add_chart,
    add_distance,
    add_mesh,
    add_output,
    add_pins,
    add_rows,
    add_sources,
    chart_page,
    fields_of,
    quantities,
    repairs_of,
)
from ...commands.terminal import Result, panel_facts, progress_line, report_answers, tell_repairs
from ...document.document import COMPARISON
from .options import ACROSS, WAY
from .part import Profile

WORDS = "follow distances along a path, as numbers and as a chart"
EXAMPLES = (
    "bihdist profile hand --pins 12,900 -o path.csv",
    "bihdist profile hand --sources 12 --pins 12,400,900 --chart path.pdf",
    "bihdist profile hand --pins 12,900 --way section --across 0,0,1 -o path.obj",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `profile` to its parser."""
    add_mesh(parser)
    add_sources(parser, "the source where distances start")
    add_output(parser, "write the numbers: a .csv, .npy, .vtp or .json file; or the path alone: .obj", required=False)
    parser.add_argument("--chart", metavar="OUT", help="a .png, .pdf, .svg or .eps file")
    add_distance(parser, f"a curve each (default: {','.join(map(str, COMPARISON))})", is_field=True)
    add_areas(parser)
    add_pins(parser)
    parser.add_argument(
        "--through",
        metavar="V,…",
        help="vertices, places in faces, source, pin:1 (default: all pins in their order; of one, from the source)",
    )
    add_rows(parser, WAY, ACROSS)
    parser.add_argument("--values", action="store_true", help="chart values, not fractions of each maximum")
    add_chart(parser)


def run(options: argparse.Namespace) -> Result:
    """Write distances along a path as numbers or a chart; the exit status is 1 if one of them failed."""
    from bihdist_core.analysis.surface_paths import PROFILE_FORMATS, write_profile
    from bihdist_core.errors import ParameterError
    from bihdist_core.file_output import check_outputs

    from ...document.document import comparison
    from ...document.page import Recipe
    from ...document.repairs import with_repairs
    from ...document.shared_parts.pins import add_pins as pin_at
    from ...figures.draw import FIGURE_FORMATS
    from ...figures.export import compute, open_document
    from ...session.array_store import ArrayStore
    from .figure import profile_fields, profile_figure, save_profile_figure
    from .part import with_profile, words_in
    from .paths import path_of

    if not check_outputs((options.output, PROFILE_FORMATS), (options.chart, FIGURE_FORMATS)):
        raise ParameterError("There is nothing to write; name a file of numbers with -o, or one with --chart.")
    check_mesh(options.mesh)
    shows = tuple(quantities(options, options.distance)) if options.distance else COMPARISON
    page, areas = chart_page(options), options.areas or "voronoi"
    with progress_line() as progress:
        repairs = repairs_of(options, options.mesh)
        source = one_source(sources_of_document(options.sources, options.mesh, shows, areas, repairs, progress))
        document = comparison(options.mesh, shows, (source,), areas, fields_of(options))
        recipe = Recipe(with_repairs(document, **asdict(repairs)), page)
        document, surfaces = open_document(recipe, ArrayStore.read(recipe))
        surface = surfaces[document.surfaces[0].name].surface
        tell_repairs(surface)
        if options.pins:
            distances = surfaces[document.surfaces[0].name].distances(areas)
            by = first_spec(shows)
            pins = sources_of_mesh(options.pins, options.mesh, surface, lambda: distances.get(by, progress), progress)
            document = pin_at(document, pins.sources)
        through = words_in(options.through or "")
        document = with_profile(document, through, options.way or "auto", options.across)
        document = document.with_changed(Profile, shares=not options.values)
        _, path = path_of(document, surfaces)
        found = compute(document, surfaces, progress)
    check_values(*found)
    answers = dict(zip((panel.id for panel in document.panels), found, strict=True))
    if options.output:
        write_profile(options.output, path, profile_fields(document, answers))
    if options.chart:
        save_profile_figure(profile_figure(document, page, path, answers), options.chart)
    outputs = [file for file in (options.output, options.chart) if file]
    for output in outputs:
        print(f"{output}: {path.label}, {len(path.points):,} points, {path.length:.6g} long")
    outputs += write_ids_of(document, outputs[0])
    facts = {
        "mesh": options.mesh,
        "outputs": outputs,
        "path": {"label": path.label, "n_points": len(path.points), "length": path.length},
        "fields": [panel_facts(panel.shows, answers[panel.id]) for panel in document.panels],
    }
    return Result(facts, report_answers(found, surface.name))
