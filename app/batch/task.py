"""Tasks: a mesh with all that is wanted of it, or a part of a large result; and reports of what has become of them."""

import hashlib
from dataclasses import dataclass, field
from typing import Any

from .maps import Map
from .memory import too_big
from .results import existing_metadata
from .storage import Folder
from .work_order import KINDS, WorkOrder, result_name


@dataclass(frozen=True)
class TaskPart:
    """The columns `begin` to `end` of a result of `total` columns; with `is_whole`, all parts are there and are
    joined."""

    work: str
    distance: str
    begin: int
    end: int
    total: int
    is_whole: bool = False


@dataclass(frozen=True)
class Task:
    """All that is wanted of a mesh, or the errors of a map from it.

    `checksums` are those of the mesh and of other files that are read, `out` the address of the folder for results.
    `needs` are the bytes of memory for which room was found, 0 before the mesh has been read.
    """

    mesh: str
    name: str
    checksums: str
    wanted: WorkOrder
    out: str
    version: str
    part: TaskPart | None = None
    map: Map | None = None
    needs: int = 0

    @property
    def words(self) -> str:
        """The task in a line of progress."""
        if self.part is None:
            return self.name
        what = f"{self.name}: {self.part.work} {self.part.distance}".strip()
        return f"{what}, put together" if self.part.is_whole else f"{what}, {self.part.begin} to {self.part.end}"

    @property
    def digest(self) -> str:
        """A digest that is the same for the same task in any process."""
        return hashlib.sha256(repr(self).encode()).hexdigest()[:16]

    def key(self, work: str, distance: str) -> str:
        """Return the key of a result: what is wanted, the files that are read, and the version."""
        own, others = self.read(work)
        read = "+".join([own, *(f"{what}={sum}" for what, sum in others.items())])
        return self.wanted.key(work, distance, read, self.version)

    def result_name(self, work: str, distance: str) -> str:
        """Return the beginning of the names of a result's files."""
        return result_name(self.name, work, distance, self.wanted.layout)

    def read(self, work: str) -> tuple[str, dict[str, str]]:
        """Return the checksum of the mesh, and those of the other files that a kind of work reads, by what they are."""
        own, *others = self.checksums.split("+")
        files = dict(zip((self.map or self.wanted).files, others, strict=True))
        return own, {what: sum for what, sum in files.items() if self.map or what in KINDS[work].reads}


@dataclass(frozen=True)
class ResultRow:
    """A result that is there, with its metadata; `is_new` unless it was there before."""

    name: str
    work: str
    distance: str
    is_new: bool
    metadata: dict[str, Any] = field(hash=False)


@dataclass(frozen=True)
class Failure:
    """A result that could not be computed, and why, in a sentence."""

    name: str
    work: str
    distance: str
    reason: str


@dataclass(frozen=True)
class Report:
    """The results and failures of a task, and more tasks that it leads to.

    `needs` are the bytes that it takes and has no room for where it was tried, 0 if it was done.
    """

    task: Task
    rows: tuple[ResultRow, ...] = ()
    failures: tuple[Failure, ...] = ()
    more: tuple[Task, ...] = ()
    needs: int = 0


def existing_row(task: Task, work: str, distance: str, is_new: bool = False) -> ResultRow | None:
    """Return the row of a result that is complete, None if it is missing or of other work."""
    name, key = task.result_name(work, distance), task.key(work, distance)
    metadata = existing_metadata(Folder(task.out), name, key, task.wanted.verify)
    return None if metadata is None else ResultRow(task.name, work, distance, is_new, metadata)


def existing_report(task: Task) -> Report | None:
    """Return the report of a task all of whose results are there, None if any is missing."""
    rows = []
    for result in task.wanted.results():
        row = existing_row(task, *result)
        if row is None:
            return None
        rows.append(row)
    return Report(task, tuple(rows))


def failed_report(task: Task, reason: str) -> Report:
    """Report that nothing of a task could be computed."""
    results = [(task.part.work, task.part.distance)] if task.part else task.wanted.results()
    return Report(task, failures=tuple(Failure(task.name, *each, reason) for each in results))


def refused_report(report: Report, most: int) -> Report:
    """Report that a task needs more memory than there is anywhere."""
    return failed_report(report.task, too_big(report.needs, most))
