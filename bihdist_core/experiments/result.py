"""What an experiment hands over: numbers, fields to draw and charts to plot as data, and what became of each claim.

Nothing here draws.  A drawing program shows each `Panel` with its surface, and each `Chart` and `Table`, in order.
"""

import csv
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import AnyArray, FloatArray
from ..distances.kinds import Spec
from ..errors import OutputError, ParameterError
from ..surface import Surface
from ..whole_file import whole_file
from .parts import NotDone
from .statements import STATEMENTS
from .verdicts import Numbers, Part, Statement, Verdict, ends_of, number_of

Cell = str | int | float | None


@dataclass(frozen=True)
class Claim:
    """What was measured of a statement, by its id: numbers by the names of its parts, and what there is to add.

    note: further numbers, in a sentence.  warning: why the numbers may be off, such as a loaded computer.  failure: why
    there are none, or not all.  words: the statement with the sizes that were measured, where it names others.
    ParameterError for an unknown id or part.
    """

    id: str
    numbers: Mapping[str, Numbers] = field(default_factory=dict)
    note: str = ""
    warning: str = ""
    failure: str = ""
    words: str = ""

    def __post_init__(self) -> None:
        if self.id not in STATEMENTS:
            raise ParameterError(f"There is no statement {self.id!r}.")
        for name in self.numbers:
            self.statement.part(name)

    @property
    def statement(self) -> Statement:
        """The statement with its rule."""
        return STATEMENTS[self.id]

    @property
    def text(self) -> str:
        """The statement in words."""
        return self.words or self.statement.text

    @property
    def verdict(self) -> Verdict | None:
        """Whether it holds, by the rule; None where there are no numbers to say so."""
        return self.statement.judge(self.numbers)

    @property
    def measured(self) -> str:
        """The claim's numbers in a line; why there are none, if so."""
        sentences = [f"{part.name}: {part.said(self.numbers[part.name])}" for part in self._measured()]
        return "; ".join(sentences) or self.failure or "not measured"

    def _measured(self) -> list[Part]:
        return [part for part in self.statement.parts if part.name in self.numbers]

    def rows(self) -> list[tuple[Cell, ...]]:
        """A row under `CLAIM_COLUMNS` for each part."""
        rows: list[tuple[Cell, ...]] = []
        for part in self.statement.parts:
            numbers = self.numbers.get(part.name)
            about = (self.id, self.text, self.statement.words, self.verdict or "", part.name)
            figures: tuple[Cell, ...] = (None, None, None, None, None)
            if numbers is not None:
                figures = (number_of(numbers), *ends_of(numbers), *part.counts(numbers))
            rows.append((*about, part.judge(numbers) or "", *figures, part.rule, self.note, self.warning, self.failure))
        return rows


CLAIM_COLUMNS = (
    *("id", "statement", "words", "verdict", "part", "verdict of the part", "number", "low", "high"),
    *("random or repeated", "of these meet the limit", "rule", "note", "warning", "failure"),
)


@dataclass(frozen=True)
class Mark:
    """A vertex to be marked, and what there is to say of it besides its kind, one of `MARKS`."""

    vertex: int
    kind: str
    words: str = ""


MARKS = ("source", "anchor", "target", "candidate", "place", "minimum", "maximum")
"""Kinds of marks; a target is looked for on another surface, where a candidate is found, and where its place is."""


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture: a field (n,) on the surface of that name in `Result.surfaces`, or the bare surface without field.

    row: panels of one row belong side by side.  style: "surface", or "height" for a flat domain whose field is drawn
    as a height.  views: names of directions, "front", "back", "source" (the side that sees the row's
    first mark best), or "zoom" (around `zoom_vertex`, showing `zoom_radius`, in the surface's unit).  Isolines:
    `isoline_count` equally spaced ones.  exaggerate: colours show the field to this power; below 1 small values are
    spread out.  failure: why a field is missing.  distance: what computes the field anew, from the mark of a source,
    None where that is more than one distance.
    """

    heading: str
    surface: str
    field: FloatArray | None = None
    row: str = ""
    marks: tuple[Mark, ...] = ()
    views: tuple[str, ...] = ("front",)
    style: str = "surface"
    zoom_vertex: int | None = None
    zoom_radius: float | None = None
    isoline_count: int = 20
    exaggerate: float = 1.0
    failure: str = ""
    distance: Spec | None = None


@dataclass(frozen=True, eq=False)
class Series:
    """One curve of a chart: x and y (k,).  style: "line" or "points"."""

    name: str
    x: AnyArray
    y: FloatArray
    style: str = "line"


@dataclass(frozen=True, eq=False)
class Chart:
    """Curves over common axes."""

    heading: str
    x_label: str
    y_label: str
    series: tuple[Series, ...]
    log_x: bool = False
    log_y: bool = False


@dataclass(frozen=True)
class Table:
    """Rows of texts and numbers under named columns."""

    heading: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def values(self, column: str, **where: Cell) -> list[Cell]:
        """The cells of a column, in the rows that have the given cells in other columns."""
        at = self.columns.index(column)
        tests = [(self.columns.index(key.replace("_", " ")), value) for key, value in where.items()]
        return [row[at] for row in self.rows if all(row[k] == value for k, value in tests)]

    def value(self, column: str, **where: Cell) -> float:
        """The one number so described; ParameterError unless there is just one."""
        found = self.values(column, **where)
        if len(found) != 1 or not isinstance(found[0], (int, float)):
            raise ParameterError(f"{self.heading}: {column} where {where} is {found}, not one number.")
        return float(found[0])


@dataclass(frozen=True, eq=False)
class Result:
    """The outcome of one experiment.

    protocol: how it was done, in sentences: sources, sizes, thresholds, all fixed before looking.  seconds: how long it
    took.  not_done: its parts that could not be done.
    """

    id: str
    title: str
    protocol: str
    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    panels: tuple[Panel, ...] = ()
    charts: tuple[Chart, ...] = ()
    tables: tuple[Table, ...] = ()
    claims: tuple[Claim, ...] = ()
    seconds: float = 0.0
    not_done: tuple[NotDone, ...] = ()

    def table(self, heading: str) -> Table:
        """The table of that heading; ParameterError if there is none."""
        for table in self.tables:
            if table.heading == heading:
                return table
        raise ParameterError(f"{self.id} has no table {heading!r} but {[t.heading for t in self.tables]}.")

    def save(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write ID.npz (fields, surfaces, curves) and a .csv for each table, each chart and the claims; their paths.

        Raises OutputError if a file cannot be written.
        """
        folder = Path(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"{folder} cannot be made: {error.strerror or error}.") from None
        paths = [folder / f"{self.id}.npz"]
        with whole_file(paths[0]) as temporary, temporary.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, **self._arrays())
        for k, table in enumerate(self.tables, 1):
            paths.append(_write_csv(folder / f"{self.id}_table{k}.csv", table.columns, table.rows))
        for k, chart in enumerate(self.charts, 1):
            rows = [(s.name, float(x), float(y)) for s in chart.series for x, y in zip(s.x, s.y, strict=True)]
            paths.append(_write_csv(folder / f"{self.id}_chart{k}.csv", ("curve", chart.x_label, chart.y_label), rows))
        claims = [row for claim in self.claims for row in claim.rows()]
        paths.append(_write_csv(folder / f"{self.id}_claims.csv", CLAIM_COLUMNS, claims))
        return paths

    def _arrays(self) -> dict[str, AnyArray]:
        arrays: dict[str, AnyArray] = {}
        for name, surface in self.surfaces.items():
            arrays[f"surface {name} vertices"] = surface.vertices
            arrays[f"surface {name} faces"] = surface.faces
        for k, panel in enumerate(self.panels, 1):
            if panel.field is not None:
                arrays[f"panel {k} {panel.row} {panel.heading} on {panel.surface}".replace("/", "_")] = panel.field
        for k, chart in enumerate(self.charts, 1):
            for series in chart.series:
                arrays[f"chart {k} {series.name}".replace("/", "_")] = np.stack([series.x, series.y], 1)
        return arrays


def _write_csv(path: Path, header: tuple[str, ...], rows: object) -> Path:
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)  # type: ignore[arg-type]
    return path
