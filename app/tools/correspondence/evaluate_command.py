"""`bihdist evaluate`: how far maps between two meshes are from the truth."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.distances.distance_types import distance_type

from ...commands.mesh import laplacian_of
from ...commands.options import add_cut, add_output, add_two_meshes, count, repairs_of
from ...commands.terminal import Facts, Result, progress_line

if TYPE_CHECKING:
    import numpy as np

    from bihdist_core.applications.map_errors import ErrorCurve
    from bihdist_core.laplacian import Laplacian
    from bihdist_core.progress import Progress

WORDS = "measure how far maps between meshes are from the truth"
EXAMPLES = (
    "bihdist evaluate figure figure_pose2 map.npy --truth identity",
    "bihdist evaluate figure figure_pose2 map.npy --truth identity --samples 400 -o curve.pdf",
    "bihdist evaluate figure figure_pose2 ours.npy theirs.npy --truth identity -o curves.csv",
)
TEXT = ".csv"
METHODS = distance_type("geodesic").parameter("method").choices


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `evaluate` to its parser."""
    add_two_meshes(parser)
    parser.add_argument(
        "maps",
        metavar="MAP",
        nargs="+",
        help="maps: the vertex of B for each vertex of A, counted from 0; a .npy or .txt file",
    )
    add_output(parser, "write the error curves: a .csv, .png, .pdf, .svg or .eps file", required=False)
    add_cut(parser)
    parser.add_argument("--truth", metavar="MAP", required=True, help="the correct map: `identity`, or such a file")
    parser.add_argument(
        "--symmetry",
        metavar="MAP",
        help="the symmetric partner of each vertex of B, which also counts as correct; both errors are printed",
    )
    parser.add_argument(
        "--samples", type=count, metavar="N", help="errors of N vertices of A, spaced evenly by id (default: all)"
    )
    parser.add_argument(
        "--method",
        choices=METHODS,
        default="auto",
        help="how the geodesic distance of errors is computed (default: auto, exact where that takes minutes at most)",
    )


def run(options: argparse.Namespace) -> Result:
    """Print the errors of maps between two meshes, and write their curves where asked."""
    import numpy as np

    from bihdist_core.applications.map_errors import sampled_vertices
    from bihdist_core.file_output import check_outputs
    from bihdist_core.formats.vertex_maps import read_map

    from ...figures.error_figure import ERROR_FORMATS, ErrorFigure, save_error_figure

    check_outputs((options.output, ERROR_FORMATS))
    both = options.mesh, options.other
    one, two = (laplacian_of(mesh, repairs=repairs_of(options, mesh)) for mesh in both)
    truth = read_map(options.truth, one.surface, two.surface)
    maps = {path: read_map(path, one.surface, two.surface) for path in dict.fromkeys(options.maps)}
    partners = read_map(options.symmetry, two.surface, two.surface) if options.symmetry else None
    # What is cut out of A has no right place; where B has none, no error is known.
    is_cut = repairs_of(options, options.mesh).is_any
    left = np.flatnonzero(one.surface.component_of_vertex >= 0) if is_cut else np.arange(len(truth))
    ids = left[sampled_vertices(len(left), options.samples)]
    curves, facts = {}, []
    columns = np.stack([found[ids] for found in maps.values()], axis=1)
    for words, also in (("", None), *([(", partners count", partners)] if partners is not None else [])):
        with progress_line() as progress:
            lines, found_curves = described_errors(two, columns, truth[ids], also, options.method, progress)
        for path, line, curve in zip(maps, lines, found_curves, strict=True):
            curves[f"{Path(path).stem}{words}"] = curve
            print(f"{path}: {line}{words}")
            facts.append({"map": path, "partners_count": also is not None, **curve_facts(curve)})
    if options.output:
        save_error_figure(ErrorFigure(curves), options.output)
        print(f"{options.output}: {counted(len(curves), 'curve')}")
    outputs = [options.output] if options.output else []
    return Result({"mesh": options.mesh, "other": options.other, "maps": facts, "outputs": outputs})


def curve_facts(curve: "ErrorCurve") -> Facts:
    """Return the errors of a map over the root of the area; None for those that are infinite, as a vertex has no
    image."""
    return {"mean": curve.mean, "median": curve.median, "area_under_curve": curve.area, "n_vertices": len(curve.errors)}


def described_errors(
    laplacian: "Laplacian",
    found: "np.ndarray",
    truth: "np.ndarray",
    partners: "np.ndarray | None" = None,
    method: str = "auto",
    progress: "Progress | None" = None,
) -> "tuple[list[str], list[ErrorCurve]]":
    """Return the errors of maps (m, q) to a surface, each in words and as a curve."""
    import numpy as np

    from bihdist_core.applications.map_errors import LIMIT, error_curve, error_distance, map_errors

    distance = error_distance(laplacian, len(np.unique(truth)), method, progress)
    lines, curves = [], []
    for errors in map_errors(distance, found, truth, partners, progress).T:
        curve = error_curve(errors)
        lost = int(np.isinf(errors).sum())
        none = f", {counted(lost, 'vertex', 'vertices')} mapped nowhere" if lost else ""
        lines.append(
            f"mean {curve.mean:.4g}, median {curve.median:.4g}, area under the curve to {LIMIT:g} {curve.area:.4g}; "
            f"{distance.label} over root of area, {counted(len(curve.errors), 'vertex', 'vertices')}{none}"
        )
        curves.append(curve)
    return lines, curves
