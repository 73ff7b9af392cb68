"""`python -m tests.bench [--quick] [--only 1,2] [--before REF] [--mesh FILE] [--json FILE] [--chart FILE]`: all speeds.

What is judged are ratios of times measured in turn in the same run; the times themselves are only told.
"""

import argparse
import json
import os
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from datetime import date

from . import (
    anchor_row,
    batch_rows,
    before,
    chart,
    drag_row,
    exact_rows,
    figure_rows,
    geodesic_rows,
    growth_rows,
    live_row,
    machine,
    matrix_rows,
    moving_row,
    other_rows,
    peers,
    reading_row,
    region_row,
    scatter_row,
    thread_row,
    window_rows,
)
from .size import FULL, QUICK, Size
from .table import Line, as_json, from_json, render

ROWS: dict[int, Callable[[Size], Iterator[Line]]] = {
    1: exact_rows.set_up,
    2: exact_rows.one_field,
    3: exact_rows.many_sources,
    4: exact_rows.all_pairs,
    5: other_rows.eigenpairs,
    6: other_rows.heat_geodesic,
    7: growth_rows.growth,
    8: growth_rows.largest,
    9: growth_rows.shapes,
    10: window_rows.click,
    11: exact_rows.column,
    12: window_rows.start,
    13: window_rows.drawing,
    14: window_rows.stalls,
    15: drag_row.drag,
    16: moving_row.moving,
    17: region_row.regions,
    18: scatter_row.scatter,
    19: live_row.live,
    20: anchor_row.anchor_moved,
    21: batch_rows.batch,
    22: batch_rows.parcels,
    23: exact_rows.small_meshes,
    24: reading_row.reading,
    25: exact_rows.cholesky,
    26: thread_row.threads,
    27: geodesic_rows.exact_geodesics,
    28: figure_rows.figures,
    29: matrix_rows.matrices,
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.source and not options.chart:
        parser.error("--from draws a chart; name its file with --chart")
    size = QUICK if options.quick else FULL
    if options.mesh:
        size = replace(size, file=options.mesh)
    if options.source:
        with open(options.source, encoding="utf-8") as file:
            _draw(options.chart, from_json(json.load(file)["lines"]))
        return 0
    lines: list[Line] = []
    with ExitStack() as stack:
        measure = _row_here
        if options.before:
            try:
                tree = stack.enter_context(before.checked_out(options.before))
            except ValueError as error:
                print(error, file=sys.stderr)
                return 2
            passed = ["--quick"] * options.quick + (["--mesh", os.path.abspath(options.mesh)] if options.mesh else [])

            def measure(row: int, size: Size) -> Iterator[Line]:
                return iter(before.beside(tree, row, passed))

        for row in options.only or ROWS:
            for line in measure(row, size):
                lines.append(line)
                print(render([line]).splitlines()[-1], file=sys.stderr, flush=True)
    copied, multiplied = machine.limits()
    facts = {
        "date": date.today().isoformat(),
        "machine": machine.describe(),
        "versions": peers.versions(),
        "limits": f"copy {copied / 1e9:.1f} GB/s, matrix products {multiplied / 1e9:.1f} GFlop/s, on two threads",
    }
    print("\n".join([*(f"{name}: {fact}" for name, fact in facts.items()), "", render(lines)]))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(facts | {"quick": options.quick, "lines": as_json(lines)}, file, indent=1, default=float)
    _draw(options.chart, lines)
    return 0


def _draw(path: str | None, lines: list[Line]) -> None:
    if path:
        with open(path, "w", encoding="utf-8") as file:
            file.write(chart.chart(lines))


def _row_here(row: int, size: Size) -> Iterator[Line]:
    return ROWS[row](size)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__.split("\n\n")[1])
    parser.add_argument("--quick", action="store_true", help="small meshes and one round: checks the form, not times")
    parser.add_argument("--only", type=_numbers, metavar="1,2", help="these rows only")
    parser.add_argument("--before", metavar="REF", help="the rows of that commit beside this tree's")
    parser.add_argument("--json", metavar="FILE", help="write the table there as well")
    parser.add_argument("--chart", metavar="FILE", help="draw the ratios to other programs there, as SVG")
    parser.add_argument("--from", dest="source", metavar="FILE", help="draw from what --json wrote; measure nothing")
    mesh = "a mesh in place of the generated sphere in rows 1 to 6, 10, 11 and 25"
    parser.add_argument("--mesh", metavar="FILE", help=mesh)
    return parser


def _numbers(text: str) -> list[int]:
    numbers = [int(word) for word in text.split(",")]
    unknown = [str(number) for number in numbers if number not in ROWS]
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no row {', '.join(unknown)}")
    return numbers


if __name__ == "__main__":
    warnings.simplefilter("ignore", ResourceWarning)
    sys.exit(main())
