"""`bihdist statistics`: statistics of a distance, or of how two are related, and their charts."""

import argparse
import os
from typing import TYPE_CHECKING

from ...commands.field import CommandField, field_of
from ...commands.options import add_areas, add_chart, add_distance, add_mesh, add_sources, chart_page, eigenpair_count
from ...commands.terminal import Facts, Result, facts_of, progress_line

if TYPE_CHECKING:
    from ...figures.chart_look import ChartLook

WORDS = "summarise a distance, or compare two, in numbers and charts"
EXAMPLES = (
    "bihdist statistics hand --sources 12",
    "bihdist statistics hand --sources 12 --histogram hand.pdf",
    "bihdist statistics hand --sources 12 --distance biharmonic,geodesic --scatter two.png",
)
TEXT = ".csv"
FIGURES, TABLES = (".pdf", ".png", ".svg", ".eps"), (".csv", ".npy")
BINS = 40
EIGENPAIRS = 200
"""The eigenpairs of a truncated distance, unless `--k` says otherwise."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `statistics` to its parser."""
    add_mesh(parser)
    add_sources(parser, "the source where distances start")
    parser.add_argument(
        "--histogram",
        metavar="OUT",
        help="histogram of the first distance, by area: a figure, or a .csv or .npy of bins",
    )
    parser.add_argument(
        "--scatter",
        metavar="OUT",
        help="scatter plot of the second distance over the first: a figure, or a .csv or .npy",
    )
    add_distance(
        parser,
        "one, or two to compare them (default: those of --field, else biharmonic)",
        k="the number of eigenpairs, for --truncation",
        is_field=True,
    )
    add_areas(parser)
    parser.add_argument("--values", action="store_true", help="compare values, not fractions of the maxima")
    parser.add_argument(
        "--truncation", action="store_true", help="what a sum over --k eigenpairs loses of the biharmonic distance"
    )
    add_chart(parser)


def run(options: argparse.Namespace) -> Result:
    """Print statistics of a field, or of the difference of two."""
    from bihdist_core.analysis.truncation import truncation_loss
    from bihdist_core.errors import ParameterError
    from bihdist_core.file_output import check_outputs

    words = options.distance or [field.name for field in options.fields or ()] or ["biharmonic"]
    if len(words) > 2:
        raise ParameterError(f"Two distances can be compared, not {len(words)}.")
    if options.scatter and len(words) != 2:
        raise ParameterError("A scatter is of two distances; name both with --distance.")
    check_outputs((options.histogram, FIGURES + TABLES), (options.scatter, FIGURES + TABLES))
    count = eigenpair_count(options, words, EIGENPAIRS) if options.truncation else 0
    with progress_line() as progress:
        first = field_of(options, words[0], progress)
        fields = [first, *(field_of(options, each, progress, first) for each in words[1:])]
        loss = None
        if options.truncation:
            loss = truncation_loss(first.laplacian, first.sources[0], counts=[count], progress=progress)
    facts: Facts = {
        "mesh": options.mesh,
        "outputs": [file for file in (options.histogram, options.scatter) if file],
        "fields": [_print_statistics(it) for it in fields],
    }
    if options.histogram:
        _save_histogram(options, first)
        print(f"{options.histogram}: histogram of {first.answer.label}")
    if len(fields) == 2:
        facts["agreement"] = _print_agreement(options, *fields)
    if loss is not None:
        print(
            f"biharmonic, the first {loss.counts[0]:,} eigenpairs: mean loss {loss.means[0]:.3%} of the maximum, "
            f"largest {loss.largest[0]:.3%} at vertex {loss.at[0]}"
        )
        facts["truncation"] = {
            "n_eigenpairs": loss.counts[0], "mean": loss.means[0], "largest": loss.largest[0], "largest_at": loss.at[0]
        }  # fmt: skip
    return Result(facts)


def _print_statistics(it: CommandField) -> Facts:
    from bihdist_core import field_statistics

    found = field_statistics(it.surface, it.field)
    print(f"{it.answer.label}{f', {it.answer.unit}' if it.answer.unit else ''}{it.accuracy}")
    print(f"  greatest {_format_value(found.greatest, it)} at vertex {found.greatest_at}")
    print(f"  least {_format_value(found.least, it)} at vertex {found.least_at}")
    print(f"  mean by area {_format_value(found.mean, it)}, standard deviation {_format_value(found.deviation, it)}")
    if it.answer.is_signed:
        print(f"  mean size by area {_format_value(found.mean_size, it)}")
    parts = ", ".join(f"{s:.0%} {_format_value(q, it)}" for s, q in zip(found.fractions, found.quantiles, strict=True))
    print(f"  quantiles by area: {parts}")
    names = ("greatest", "greatest_at", "least", "least_at", "mean", "deviation", "mean_size", "fractions", "quantiles")
    return {**it.facts, **facts_of(found, *names)}


def _format_value(value: float, it: CommandField) -> str:
    return f"{value:.2f}%" if it.answer.scale == 100 else f"{value:.6g}"


def _print_agreement(options: argparse.Namespace, one: CommandField, other: CommandField) -> Facts:
    from bihdist_core import field_agreement
    from bihdist_core.errors import ParameterError

    if options.values and one.answer.unit != other.answer.unit:
        units = f"{one.answer.unit or 'none'} and {other.answer.unit or 'none'}"
        raise ParameterError(f"Values in different units ({units}) cannot be compared; leave out --values.")
    found = field_agreement(one.surface, one.field, other.field, not options.values)
    print(f"{other.answer.label} over {one.answer.label}, {found.count:,} vertices")
    print(f"  rank correlation {found.spearman:.6g}, by area {found.by_area:.6g}")
    scales = (1.0, 1.0) if options.values else (one.answer.maximum, other.answer.maximum)
    at = found.largest_at
    sign = -1 if one.field[at] / scales[0] < other.field[at] / scales[1] else 1
    kind = ".6g" if options.values else ".2%"
    print(f"  mean deviation by area {found.mean:{kind}}")
    labels = f"{one.answer.label} − {other.answer.label}"
    print(f"  largest difference {sign * found.largest:+{kind}} at vertex {at} ({labels})")
    if options.scatter:
        _save_scatter(options, one, other, found.spearman, at)
        print(f"{options.scatter}: scatter of {found.count:,} vertices")
    return facts_of(found)


def _save_histogram(options: argparse.Namespace, it: CommandField) -> None:
    import numpy as np

    from bihdist_core import field_statistics
    from bihdist_core.formats.field_output import write_array

    found = field_statistics(it.surface, it.field, BINS)
    if _is_table(options.histogram):
        table = np.column_stack([found.bins[:-1], found.bins[1:], found.areas])
        write_array(options.histogram, table, ["from", "to", "area"])
        return
    from ...figures.histogram_figure import histogram_figure, save_histogram_figure

    figure = histogram_figure(it.surface, it.field, it.answer, it.answer.maximum, _look(options))
    save_histogram_figure(figure, options.histogram)


def _save_scatter(
    options: argparse.Namespace, one: CommandField, other: CommandField, correlation: float, largest: int
) -> None:
    import numpy as np

    from bihdist_core import field_scatter
    from bihdist_core.formats.field_output import write_array

    found = field_scatter(one.surface, one.field, other.field, not options.values)
    if _is_table(options.scatter):
        write_array(options.scatter, np.column_stack([found.ids, found.x, found.y]), ["vertex", one.word, other.word])
        return
    from ...figures.scatter_figure import ScatterFigure, axes_of, save_scatter_figure

    axes = axes_of(
        found, (one.answer.label, other.answer.label), (one.answer.unit, other.answer.unit), not options.values
    )
    figure = ScatterFigure(
        found, *axes, in_shares=not options.values, correlation=correlation, largest=largest, look=_look(options)
    )
    save_scatter_figure(figure, options.scatter)


def _is_table(path: str) -> bool:
    return os.path.splitext(path)[1].lower() in TABLES


def _look(options: argparse.Namespace) -> "ChartLook":
    from ...figures.chart_look import ChartLook
    from ...figures.scatter_figure import INCHES
    from ...scene.style import style_of

    page = chart_page(options)
    return ChartLook.of(page, style_of(page.style), INCHES)
