"""The tables of a batch: summary.csv, a row for each result, and failures.csv, one for each that is missing."""

import csv
import io
from collections.abc import Iterable, Mapping, Sequence

from .results import is_complete, metadata_in
from .storage import Folder
from .task import Failure, ResultRow
from .work_order import ALL, LAYOUTS, result_name

COLUMNS = (
    "mesh", "work", "distance", "file", "shape", "dtype", "unit", "accuracy", "n_vertices", "n_faces", "n_components",
    "area", "repairs", "mean", "median", "area_under_curve", "seconds",
)  # fmt: skip
NUMBERS = ("accuracy", "mean", "median", "area_under_curve")
REASONS = ("mesh", "work", "distance", "reason")

TableRow = dict[str, str]


def write_tables(
    folder: Folder,
    rows: Iterable[ResultRow],
    failures: Iterable[Failure],
    meshes: Iterable[str],
    maps: Iterable[str] | None = None,
) -> None:
    """Write the tables, and remove failures.csv if nothing failed.

    Rows of earlier commands with other options stay: results while their files are there, failures of these meshes, and
    of these maps, or of all maps if they are None.
    """
    summary = [_summary_row(row) for row in rows]
    missing = [
        {"mesh": each.name, "work": each.work, "distance": each.distance, "reason": each.reason} for each in failures
    ]
    known = {_result_of(row) for row in (*summary, *missing)}
    names, map_names = set(meshes), None if maps is None else set(maps)

    def may_stay(row: TableRow) -> bool:
        if row["work"] == "evaluate":
            return map_names is None or row["mesh"] in map_names
        return row["mesh"] in names

    taken = {row["file"] for row in summary}  # the file of a layout is that of the last distance
    for row in _read_rows(folder, "summary.csv", COLUMNS):
        if _result_of(row) not in known and row["file"] not in taken and _is_there(folder, row):
            summary.append(row)
    for row in _read_rows(folder, "failures.csv", REASONS):
        if _result_of(row) not in known and may_stay(row):
            missing.append(row)
    folder.write("summary.csv", _table(COLUMNS, summary))
    if missing:
        folder.write("failures.csv", _table(REASONS, missing))
    else:
        folder.remove("failures.csv")


def _result_of(row: TableRow) -> tuple[str, str, str]:
    return row["mesh"], row["work"], row["distance"]


def _is_there(folder: Folder, row: TableRow) -> bool:
    """Return whether a row of the summary is of a result that is complete."""
    file = row["file"]
    layout = next((each for each in LAYOUTS if file.startswith(f"{each}/")), "")
    if row["mesh"] == ALL:
        return folder.size(file) is not None
    metadata = metadata_in(folder, result_name(*_result_of(row), layout))
    return metadata is not None and metadata.get("file") == file and is_complete(folder, metadata)


def _read_rows(folder: Folder, name: str, columns: Sequence[str]) -> list[TableRow]:
    """Return the rows of a table, none if it is missing, damaged or has other columns."""
    try:
        header, *lines = csv.reader(io.StringIO((folder.read(name) or b"").decode()))
    except (ValueError, csv.Error):
        return []
    if header != list(columns):
        return []
    return [dict(zip(columns, line, strict=True)) for line in lines if len(line) == len(columns)]


def _summary_row(row: ResultRow) -> TableRow:
    cells: Mapping[str, object] = {
        **row.metadata,
        **{name: _number(row.metadata.get(name)) for name in NUMBERS},
        "mesh": row.name,
        "work": row.work,
        "distance": row.distance,
        "shape": " x ".join(map(str, row.metadata.get("shape", []))),
        "repairs": "; ".join(row.metadata.get("repairs", [])),
        "seconds": "" if (seconds := row.metadata.get("seconds")) is None else f"{seconds:.3f}",
    }
    return {name: str(cells.get(name, "")) for name in COLUMNS}


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"


def _table(columns: Sequence[str], rows: Iterable[TableRow]) -> bytes:
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(sorted(rows, key=lambda row: [row[name] for name in columns]))
    return text.getvalue().encode()
