"""The errors of all maps of a set in one figure: the curve of each, and their mean."""

from collections.abc import Sequence

from bihdist_core.applications.map_errors import ErrorCurve, MeanCurve, error_curve
from bihdist_core.arrays import FloatArray
from bihdist_core.errors import ParameterError

from ..figures.error_figure import ErrorFigure, save_error_figure
from .maps import WITH_PARTNERS
from .results import read_arrays
from .storage import Folder
from .task import ResultRow
from .work_order import ALL

ENDINGS = ("pdf", "svg", "png", "csv")
NAME = "evaluate"


def write_curves(folder: Folder, rows: Sequence[ResultRow]) -> tuple[list[str], list[ResultRow]]:
    """Write the error curves of all maps as figures and as a table.

    Returns the names of the files, and a row on all maps for the summary; nothing if no map has a vertex with a
    known truth.
    """
    curves, with_partners = {}, {}
    for row in sorted((row for row in rows if row.work == "evaluate"), key=lambda row: row.name):
        arrays = read_arrays(folder, row.metadata["file"])
        if (curve := _curve(arrays.get("errors", arrays.get("")))) is not None:
            curves[row.name] = curve
        if (curve := _curve(arrays.get(WITH_PARTNERS))) is not None:
            with_partners[row.name] = curve
    if not curves:
        return [], []
    count = f"{len(curves)} map{'s' * (len(curves) > 1)}"
    means = {f"mean of {count}": MeanCurve(tuple(curves.values()))}
    if with_partners:
        means[f"mean of {count}, partners count"] = MeanCurve(tuple(with_partners.values()))
    files = [f"{NAME}.{ending}" for ending in ENDINGS]
    for file in files:
        with folder.writing(file) as path:
            save_error_figure(ErrorFigure(curves, means=means), path)
    overall = next(iter(means.values()))
    metadata = {
        "file": files[0], "shape": [len(curves)], "unit": "no unit",
        "mean": overall.mean, "median": overall.median, "area_under_curve": overall.area,
    }  # fmt: skip
    return files, [ResultRow(ALL, "evaluate", "", False, metadata)]


def _curve(errors: FloatArray | None) -> ErrorCurve | None:
    try:
        return None if errors is None else error_curve(errors)
    except ParameterError:
        return None
