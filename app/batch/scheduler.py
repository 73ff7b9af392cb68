"""The scheduler: from meshes and maps to tasks, and from tasks to an outcome."""

import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace

from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import files_of

from ..document.file import checksum
from .engines import Engine
from .maps import Map
from .task import Failure, Report, ResultRow, Task, existing_report
from .work_order import MAXIMA, OWN, WorkOrder

Tell = Callable[[Report, int, int], None]
"""Called after each task: what has become of it, how many are done, and of how many."""


def tasks_for(
    meshes: dict[str, str], wanted: WorkOrder, address: str, version: str
) -> tuple[list[Task], list[Failure]]:
    """Return a task for each mesh, the largest file first, and failures of meshes that cannot be read.

    `address` is that of the folder for results.
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
    return sorted(tasks, key=lambda task: (-sum(map(os.path.getsize, files_of(task.mesh))), task.name)), failures


def _checksum(path: str) -> str:
    """Return the checksum of a file, "" if it cannot be read: what needs it will say so."""
    try:
        return checksum(path)
    except ParameterError:
        return ""


def tasks_for_maps(
    maps: Sequence[Map], wanted: WorkOrder, address: str, version: str
) -> tuple[list[Task], list[Failure]]:
    """Return a task for each map, and failures of maps that cannot be read."""
    tasks, failures = [], []
    wanted = replace(wanted, works=("evaluate",), layout="", cut="", merge=None, largest_component=False)
    for each in maps:
        try:
            sums = "+".join(map(checksum, [each.mesh, *each.files.values()]))
            tasks.append(Task(each.mesh, each.name, sums, wanted, address, version, map=each))
        except ParameterError as error:
            failures.append(Failure(each.name, "evaluate", "", str(error)))
    return tasks, failures


@dataclass
class Outcome:
    rows: list[ResultRow] = field(default_factory=list)
    failures: list[Failure] = field(default_factory=list)

    def add(self, report: Report) -> None:
        """Add the rows and the failures of a report."""
        self.rows += report.rows
        self.failures += report.failures


def run_batch(
    meshes: dict[str, str],
    maps: Sequence[Map],
    wanted: WorkOrder,
    address: str,
    version: str,
    engine: Engine,
    progress: Callable[[int], AbstractContextManager[Tell]],
    outcome: Outcome,
) -> None:
    """Compute everything that is wanted of meshes and maps; the outcome grows meanwhile, also of what is
    interrupted.

    `progress(total)` returns what is told of each of so many tasks.
    """
    # Colours that end alike on all meshes: the largest values are found before anything is drawn.
    is_shared = "figure" in wanted.works and wanted.range != OWN
    first = replace(wanted, works=(*(w for w in wanted.works if w != "figure"), MAXIMA)) if is_shared else wanted
    tasks, failures = tasks_for(meshes, first, address, version) if first.works != ("evaluate",) else ([], [])
    of_maps, unread = tasks_for_maps(maps, wanted, address, version)
    outcome.failures += [*failures, *unread]
    try:
        with progress(len(tasks) + len(of_maps)) as tell:
            run_tasks([*tasks, *of_maps], engine, tell, outcome)
    finally:
        # Nobody has asked for them: without its maxima a mesh has no figure.
        maxima = [row for row in outcome.rows if row.work == MAXIMA]
        outcome.rows = [row for row in outcome.rows if row.work != MAXIMA]
        missing = {each.name for each in outcome.failures if each.work == MAXIMA}
        outcome.failures = [replace(e, work="figure") if e.work == MAXIMA else e for e in outcome.failures]
    if not is_shared:
        return
    from .figures import shared_maxima

    rest = {name: path for name, path in meshes.items() if name not in missing}
    ends = shared_maxima([row.metadata for row in maxima], wanted.range)
    tasks, _ = tasks_for(rest, replace(wanted, works=("figure",), maxima=ends, layout=""), address, version)
    with progress(len(tasks)) as tell:
        run_tasks(tasks, engine, tell, outcome)


def run_tasks(tasks: Sequence[Task], engine: Engine, tell: Tell, outcome: Outcome | None = None) -> Outcome:
    """Run tasks, and those that they lead to."""
    outcome = outcome or Outcome()
    try:
        _run_tasks(tasks, engine, tell, outcome)
    finally:
        outcome.failures = _first_failures(outcome.failures)
    return outcome


def _run_tasks(tasks: Sequence[Task], engine: Engine, tell: Tell, outcome: Outcome) -> None:
    total, done = len(tasks), 0
    left: dict[tuple[str, str, str], int] = {}
    broken: set[tuple[str, str, str]] = set()
    waiting = []
    for task in tasks:
        report = existing_report(task)
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


def _first_failures(failures: Iterable[Failure]) -> list[Failure]:
    """Return one failure for each result, as its parts fail for the same reason."""
    first: dict[tuple[str, str, str], Failure] = {}
    for each in failures:
        first.setdefault((each.name, each.work, each.distance), each)
    return list(first.values())
