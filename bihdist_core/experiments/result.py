"""Results of an experiment: numbers, fields to draw and charts to plot as data, and a verdict on each claim.

Nothing here draws.  A drawing program shows each `Panel` with its surface, and each `Chart` and `Table`, in order.
"""

import csv
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import AnyArray, FloatArray
from ..distances.distance_types import Spec
from ..errors import OutputError, ParameterError
from ..file_output import atomic_write
from ..surface import Surface
from ._stated_claims import CLAIMS
from ._stated_figures import FIGURES
from .parts import NotDone
from .verdicts import FAILS, BySource, Numbers, Part, Statement, Verdict, ends_of, number_of

Cell = str | int | float | None


ORDER = (*(f"fig{k}" for k in range(1, 11)), "table1", "table2", "alpha", "claims")
"""The experiments, as the page has them."""

STATEMENTS: dict[str, Statement] = {
    statement.id: statement
    for statement in sorted((*FIGURES, *CLAIMS), key=lambda s: ORDER.index(s.id.partition("-")[0]))
}
"""The statements by id: an experiment's id, a hyphen, and a number or a word."""


def statements_of(experiment: str) -> tuple[Statement, ...]:
    """Return the statements of an experiment, by its id."""
    return tuple(s for id, s in STATEMENTS.items() if id.partition("-")[0] == experiment)


@dataclass(frozen=True)
class Claim:
    """The measurements of a statement, by its id: numbers by the names of its parts.

    `note` has further numbers, in a sentence; `warning` says why the numbers may be off, such as a loaded computer;
    `failure` why there are none, or not all. `words` is the statement with the sizes that were measured, where it names
    others; `quick` is True of numbers of the quick version. Raises ParameterError for an unknown id or part.
    """

    id: str
    numbers: Mapping[str, Numbers] = field(default_factory=dict)
    note: str = ""
    warning: str = ""
    failure: str = ""
    words: str = ""
    quick: bool = False

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
        """The verdict by the rule; None where there are no numbers for one, or only quick ones that may not tell."""
        return self.statement.judge(self.numbers, self.quick)

    @property
    def verdict_words(self) -> str:
        """The verdict in words, "not judged" if there is none."""
        everywhere = " everywhere" if self.verdict == FAILS and self.statement.is_universal else ""
        return f"{self.verdict or 'not judged'}{everywhere}"

    @property
    def measured(self) -> str:
        """The claim's numbers in a line; why there are none, if so."""
        sentences = [f"{part.name}: {part.formatted(self.numbers[part.name])}" for part in self._measured()]
        return "; ".join(sentences) or self.failure or "not measured"

    def _measured(self) -> list[Part]:
        return [part for part in self.statement.parts if part.name in self.numbers]

    def rows(self) -> list[tuple[Cell, ...]]:
        """Return a row under `CLAIM_COLUMNS` for each part."""
        rows: list[tuple[Cell, ...]] = []
        for part in self.statement.parts:
            numbers = self.numbers.get(part.name)
            about = (self.id, self.text, self.statement.words, self.verdict or "", part.name)
            figures: tuple[Cell, ...] = (None, None, None, None, None)
            if numbers is not None:
                figures = (number_of(numbers), *ends_of(numbers), *part.counts(numbers))
            rows.append(
                (
                    *about,
                    part.judge(numbers, self.quick) or "",
                    *figures,
                    part.rule,
                    self.note,
                    self.warning,
                    self.failure,
                )
            )
        return rows


class Gathered:
    """Numbers by the names of statements' parts, of pictured and of random sources."""

    def __init__(self) -> None:
        self._pictured: dict[str, list[float]] = {}
        self._random: dict[str, list[float]] = {}

    def add(self, part: str, number: float, is_pictured: bool) -> None:
        """Add a number to the part of a statement, or to parts of several statements, with that name."""
        (self._pictured if is_pictured else self._random).setdefault(part, []).append(float(number))

    def numbers(self, name: str) -> BySource | None:
        """Return the numbers gathered under a name; None if there are none."""
        if name not in self._pictured and name not in self._random:
            return None
        return BySource(tuple(self._pictured.get(name, ())), tuple(self._random.get(name, ())))

    def claim(self, id: str, note: str = "", more: Mapping[str, Numbers] | None = None, failure: str = "") -> Claim:
        """Return the claim of a statement with what was gathered of its parts and with `more` numbers of other parts.

        `failure` says why some, or all, are missing.
        """
        numbers: dict[str, Numbers] = dict(more or {})
        for name in STATEMENTS[id].names:
            found = self.numbers(name)
            if found is not None:
                numbers[name] = found
        return Claim(id, numbers, note, failure=failure)


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

    Attributes
    ----------
    heading, surface : str
        The heading, and the surface's name.
    field : (n,) ndarray or None
        The field.
    row : str
        Panels of one row belong side by side.
    marks : tuple of Mark
        Marked vertices.
    views : tuple of str
        Directions: "front", "back", "source" (the side that sees the row's first mark best), or "zoom" (around
        `zoom_vertex`, showing `zoom_radius`, in the surface's unit).
    style : {"surface", "height"}
        "height" for a flat domain whose field is drawn as a height.
    isoline_count : int
        How many equally spaced isolines.
    exaggerate : float
        Colours show the field to this power; below 1 small values are spread out.
    failure : str
        Why a field is missing.
    distance : Spec or None
        The distance that computes the field anew, from the mark of a source; None where that is more than one.
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
    """A curve of a chart, x and y (k,), drawn in the style "line" or "points"."""

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
        """Return the cells of a column, in the rows that have the given cells in other columns."""
        at = self.columns.index(column)
        tests = [(self.columns.index(key.replace("_", " ")), value) for key, value in where.items()]
        return [row[at] for row in self.rows if all(row[k] == value for k, value in tests)]

    def value(self, column: str, **where: Cell) -> float:
        """Return the one number so described; ParameterError unless there is just one."""
        found = self.values(column, **where)
        if len(found) != 1 or not isinstance(found[0], (int, float)):
            raise ParameterError(f"{self.heading}: {column} where {where} is {found}, not one number.")
        return float(found[0])


@dataclass(frozen=True, eq=False)
class Findings:
    """The findings of one part of an experiment."""

    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    panels: Sequence[Panel] = ()
    charts: Sequence[Chart] = ()
    tables: Sequence[Table] = ()
    claims: Sequence[Claim] = ()


@dataclass(frozen=True, eq=False)
class Result:
    """The outcome of one experiment.

    `protocol` says how it was done, in sentences: sources, sizes and thresholds, all fixed before looking. `seconds` is
    how long it took, and `not_done` lists the parts that could not be done.
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
        """Return the table of that heading; ParameterError if there is none."""
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
        with atomic_write(paths[0]) as temporary, temporary.open("wb") as file:
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
    with atomic_write(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)  # type: ignore[arg-type]
    return path
