"""From meshes to tasks, from tasks to results, from results to tables."""

import csv
import io
import os
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path

from bihdist_core.errors import ParameterError
from bihdist_core.file_content import file_text
from bihdist_core.formats.mesh_names import MESH_FORMATS, is_mesh_file, mesh_name
from bihdist_core.formats.whole_numbers import numbered_lines

from ..document.file import checksum
from ..samples import mesh_path
from .engines import Engine
from .maps import Map
from .results import facts_in, is_complete
from .storage import Folder
from .task import Failure, Report, Row, Task, done_before
from .work_kinds import MAXIMA
from .work_order import ALL, LAYOUTS, OWN, WorkOrder, result_name

COLUMNS = (
    "mesh", "work", "distance", "file", "shape", "dtype", "unit", "accuracy", "n_vertices", "n_faces", "n_components",
    "area", "repairs", "mean", "median", "area_under_curve", "seconds",
)  # fmt: skip
REASONS = ("mesh", "work", "distance", "reason")

Tell = Callable[[Report, int, int], None]
"""Called after each task: what has become of it, how many are done, and of how many."""


@dataclass(frozen=True)
class Meshes:
    """The paths of meshes by name; missing: of those that are not there, by name, why."""

    paths: dict[str, str]
    missing: dict[str, str]


def found_meshes(words: Sequence[str], list_file: str = "", list_text: str = "") -> Meshes:
    """The meshes that words name: files, samples, and folders of files; then those of a list with one on each line.

    The name is that of the file, with that of its folder before it where several files have the same.  list_file: its
    paths are taken from its folder first; list_text: what it holds where it cannot be read again.

    ParameterError if there is none at all, the list cannot be read, or two have the same name.
    """
    found: list[tuple[Path, str]] = []
    for word in words:
        found += _meshes_of(word, Path())
    if list_file:
        lines = numbered_lines(list_text or file_text(list_file, "list of meshes"))
        known = [(number, line) for number, line in lines if not line.startswith("#")]
        if not known:
            raise ParameterError(f"{list_file} names no mesh; it has a path on each line.")
        for number, line in known:
            for path, reason in _meshes_of(line, Path(list_file).parent):
                found.append((path, f"{list_file}, line {number}: {reason}" if reason else ""))
    reasons = [reason for _, reason in found if reason]
    if len(reasons) == len(found):
        raise ParameterError(reasons[0] if reasons else "Which meshes? Name files, folders, or a list with --list.")
    paths = {Path(os.path.abspath(path)): reason for path, reason in found}
    names = Counter(map(mesh_name, paths))
    meshes = Meshes({}, {})
    for each, reason in paths.items():
        # One folder for each subject, with the same names in all of them.
        name = mesh_name(each)
        name = name if names[name] == 1 else f"{each.parent.name}_{name}"
        if name in meshes.paths or name in meshes.missing:
            raise ParameterError(f"{meshes.paths.get(name, name)} and {each} have the same name, {name}; rename one.")
        if reason:
            meshes.missing[name] = reason
        else:
            meshes.paths[name] = str(each)
    return meshes


def _meshes_of(word: str, folder: Path) -> list[tuple[Path, str]]:
    """The paths that a word means, and why one is none, "" where it is."""
    beside = folder / word
    # os.path, for which a path that is too long is one that is not there.
    path = beside if os.path.exists(beside) else Path(mesh_path(word))
    if os.path.isdir(path):
        paths = sorted(each for each in path.iterdir() if is_mesh_file(each) and each.is_file())
        reason = f"There is no mesh in the folder {word}; meshes are {', '.join(MESH_FORMATS)} files and FreeSurfer's."
        return [(each, "") for each in paths] or [(path, reason)]
    return [(path, "" if os.path.isfile(path) else f"There is no file or folder {word}, nor a sample of that name.")]


def tasks_for(
    meshes: dict[str, str], wanted: WorkOrder, address: str, version: str
) -> tuple[list[Task], list[Failure]]:
    """A task for each mesh, the largest file first; failures of those whose files cannot be read.

    address: of the folder for results.
    """
    tasks, failures = [], []
    wanted = replace(wanted, works=tuple(work for work in wanted.works if work != "evaluate"))
    for name, path in meshes.items():
        own = replace(
            wanted,
            sources=replace(wanted.sources, file=wanted.file_for(wanted.sources.file, name)),
            cut=wanted.file_for(wanted.cut, name),
            labels=wanted.file_for(wanted.labels, name),
            mask=wanted.file_for(wanted.mask, name),
        )
        try:
            read = [checksum(path), *map(_checksum, own.files.values())]
            tasks.append(Task(path, name, "+".join(read), own, address, version))
        except ParameterError as error:
            failures += [Failure(name, *each, str(error)) for each in wanted.results()]
    return sorted(tasks, key=lambda task: (-os.path.getsize(task.mesh), task.name)), failures


def _checksum(path: str) -> str:
    """Nothing for a file that cannot be read: what needs it will say so, and nothing else will."""
    try:
        return checksum(path)
    except ParameterError:
        return ""


def tasks_for_maps(
    maps: Sequence[Map], wanted: WorkOrder, address: str, version: str
) -> tuple[list[Task], list[Failure]]:
    """The same for each map."""
    tasks, failures = [], []
    wanted = replace(wanted, works=("evaluate",), layout="", cut="", merge=None)
    for each in maps:
        try:
            sums = "+".join(map(checksum, [each.mesh, *each.files.values()]))
            tasks.append(Task(each.mesh, each.name, sums, wanted, address, version, map=each))
        except ParameterError as error:
            failures.append(Failure(each.name, "evaluate", "", str(error)))
    return tasks, failures


@dataclass
class Outcome:
    rows: list[Row] = field(default_factory=list)
    failures: list[Failure] = field(default_factory=list)

    def add(self, report: Report) -> None:
        """Add the rows and the failures of a report."""
        self.rows += report.rows
        self.failures += report.failures


def do_all(
    meshes: dict[str, str],
    maps: Sequence[Map],
    wanted: WorkOrder,
    address: str,
    version: str,
    engine: Engine,
    progress: Callable[[int], AbstractContextManager[Tell]],
    outcome: Outcome,
) -> None:
    """Everything that is wanted of meshes and maps, added to the outcome, also of what is interrupted.

    progress(total): for so many tasks, who is told of each.
    """
    # Colours that end alike on all meshes: the largest values are found before anything is drawn.
    is_shared = "figure" in wanted.works and wanted.range != OWN
    first = replace(wanted, works=(*(w for w in wanted.works if w != "figure"), MAXIMA)) if is_shared else wanted
    tasks, failures = tasks_for(meshes, first, address, version) if first.works != ("evaluate",) else ([], [])
    of_maps, unread = tasks_for_maps(maps, wanted, address, version)
    outcome.failures += [*failures, *unread]
    try:
        with progress(len(tasks) + len(of_maps)) as tell:
            drive([*tasks, *of_maps], engine, tell, outcome)
    finally:
        # Nobody has asked for them: without its maxima a mesh has no figure.
        maxima = [row for row in outcome.rows if row.work == MAXIMA]
        outcome.rows = [row for row in outcome.rows if row.work != MAXIMA]
        missing = {each.name for each in outcome.failures if each.work == MAXIMA}
        outcome.failures = [replace(e, work="figure") if e.work == MAXIMA else e for e in outcome.failures]
    if not is_shared:
        return
    from .figures import shared_ends

    rest = {name: path for name, path in meshes.items() if name not in missing}
    ends = shared_ends([row.facts for row in maxima], wanted.range)
    tasks, _ = tasks_for(rest, replace(wanted, works=("figure",), maxima=ends, layout=""), address, version)
    with progress(len(tasks)) as tell:
        drive(tasks, engine, tell, outcome)


def drive(tasks: Sequence[Task], engine: Engine, tell: Tell, outcome: Outcome | None = None) -> Outcome:
    """Do the tasks, and what they lead to."""
    outcome = outcome or Outcome()
    try:
        _drive(tasks, engine, tell, outcome)
    finally:
        outcome.failures = _once(outcome.failures)
    return outcome


def _drive(tasks: Sequence[Task], engine: Engine, tell: Tell, outcome: Outcome) -> None:
    total, done = len(tasks), 0
    left: dict[tuple[str, str, str], int] = {}
    broken: set[tuple[str, str, str]] = set()
    waiting = []
    for task in tasks:
        report = done_before(task)
        if report is None:
            waiting.append(task)
            continue
        outcome.add(report)
        done += 1
        tell(report, done, total)
    for task in waiting:
        engine.submit(task)
    for report in engine.reports():
        done += 1
        outcome.add(report)
        new = list(report.more)
        for task in new:
            assert task.part is not None
            which = (task.name, task.part.work, task.part.distance)
            left[which] = left.get(which, 0) + 1
        part = report.task.part
        if part is not None and not part.is_whole:
            which = (report.task.name, part.work, part.distance)
            left[which] -= 1
            broken |= {which} if report.failures else set()
            if not left[which] and which not in broken:
                new.append(replace(report.task, part=replace(part, is_whole=True)))
        total += len(new)
        for task in new:
            engine.submit(task)
        tell(report, done, total)


def _once(failures: Iterable[Failure]) -> list[Failure]:
    """One for each result: its parts fail for the same reason."""
    first: dict[tuple[str, str, str], Failure] = {}
    for each in failures:
        first.setdefault((each.name, each.work, each.distance), each)
    return list(first.values())


# ---------------------------------------------------------------------- tables
def write_tables(
    folder: Folder,
    outcome: Outcome,
    meshes: Iterable[str],
    maps: Iterable[str] | None = None,
    lines: Sequence[Row] = (),
) -> None:
    """summary.csv, a line for each result and those that are given, and failures.csv, one for each that is missing, if
    there is any.

    Lines of other work stay, those of earlier commands with other options: results while they are there, failures of
    these meshes, and of these maps or of all if None are evaluated.
    """
    rows = sorted([*outcome.rows, *lines], key=lambda row: (row.name, row.work, row.distance))
    cells = [(each.name, each.work, each.distance, each.reason) for each in outcome.failures]
    known = {line[:3] for line in cells} | {(row.name, row.work, row.distance) for row in rows}
    names, of_maps = set(meshes), None if maps is None else set(maps)

    def may_stay(name: str, work: str) -> bool:
        if work == "evaluate":
            return of_maps is None or name in of_maps
        return name in names

    kept = [line for line in _lines(folder, "summary.csv", COLUMNS) if tuple(line[:3]) not in known]
    table = [tuple(map(str, _cells(row))) for row in rows]
    taken = {row[3] for row in table}  # the file of a layout is that of the last distance
    table += [tuple(line) for line in kept if line[3] not in taken and _is_there(folder, line)]
    folder.write("summary.csv", _table(COLUMNS, sorted(table)))
    cells += [
        (line[0], line[1], line[2], line[3])
        for line in _lines(folder, "failures.csv", REASONS)
        if tuple(line[:3]) not in known and may_stay(line[0], line[1])
    ]
    if cells:
        folder.write("failures.csv", _table(REASONS, sorted(cells)))
    else:
        folder.remove("failures.csv")


def _is_there(folder: Folder, line: Sequence[str]) -> bool:
    """Whether a line of the summary is of a result that is complete."""
    name, work, distance, file = line[:4]
    layout = next((each for each in LAYOUTS if file.startswith(f"{each}/")), "")
    if name == ALL:
        return folder.size(file) is not None
    facts = facts_in(folder, result_name(name, work, distance, layout))
    return facts is not None and facts.get("file") == file and is_complete(folder, facts)


def _lines(folder: Folder, name: str, header: Sequence[str]) -> list[list[str]]:
    """Those of a table that is there, nothing if it is of another kind."""
    try:
        first, *lines = csv.reader(io.StringIO((folder.read(name) or b"").decode()))
    except (ValueError, csv.Error):
        return []
    return [line for line in lines if len(line) == len(header)] if first == list(header) else []


def _cells(row: Row) -> tuple[object, ...]:
    facts = row.facts
    shape = " x ".join(map(str, facts.get("shape", [])))
    of_mesh = [facts.get(name, "") for name in COLUMNS[8:12]]
    repairs = "; ".join(facts.get("repairs", []))
    own = (row.name, row.work, row.distance, facts["file"], shape, facts.get("dtype", ""), facts.get("unit", ""))
    of_maps = [_number(facts.get(name)) for name in COLUMNS[13:16]]
    seconds = facts.get("seconds")  # of all maps together there are none
    return (
        *own, _number(facts.get("accuracy")), *of_mesh, repairs, *of_maps, "" if seconds is None else f"{seconds:.3f}"
    )  # fmt: skip


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"


def _table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue().encode()
