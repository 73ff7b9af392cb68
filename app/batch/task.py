"""A task: a mesh with all that is wanted of it, or a part of what takes long of a large one; and what becomes of it."""

import hashlib
from dataclasses import dataclass, field
from typing import Any

from .maps import Map
from .memory import too_big
from .results import facts_of
from .storage import Folder
from .work_kinds import KINDS
from .work_order import WorkOrder, result_name


@dataclass(frozen=True)
class Part:
    """The columns begin to end of a result, of `total` in all; with `is_whole`, all parts are there and are joined."""

    work: str
    distance: str
    begin: int
    end: int
    total: int
    is_whole: bool = False


@dataclass(frozen=True)
class Task:
    """mesh: its path; checksums: of it and of what else is read; out: the address of the folder that results go to;
    map: the one from it that is to be evaluated, instead of all else.  needs: bytes of memory, 0 before the mesh has
    been looked at; whoever gives them has found room for it."""

    mesh: str
    name: str
    checksums: str
    wanted: WorkOrder
    out: str
    version: str
    part: Part | None = None
    map: Map | None = None
    needs: int = 0

    @property
    def words(self) -> str:
        """What it is, for a line of progress."""
        if self.part is None:
            return self.name
        what = f"{self.name}: {self.part.work} {self.part.distance}".strip()
        return f"{what}, put together" if self.part.is_whole else f"{what}, {self.part.begin} to {self.part.end}"

    @property
    def digest(self) -> str:
        """The same for the same task, in any process."""
        return hashlib.sha256(repr(self).encode()).hexdigest()[:16]

    def key(self, work: str, distance: str) -> str:
        """What tells the result of a kind of work apart: what is wanted, the files that are read, and the version."""
        own, others = self.read(work)
        read = "+".join([own, *(f"{what}={sum}" for what, sum in others.items())])
        return self.wanted.key(work, distance, read, self.version)

    def result_name(self, work: str, distance: str) -> str:
        """The beginning of the names of a result's files."""
        return result_name(self.name, work, distance, self.wanted.layout)

    def read(self, work: str) -> tuple[str, dict[str, str]]:
        """The checksum of the mesh, and those of what else a work reads, by what it is."""
        own, *others = self.checksums.split("+")
        files = dict(zip((self.map or self.wanted).files, others, strict=True))
        return own, {what: sum for what, sum in files.items() if self.map or what in KINDS[work].reads}


@dataclass(frozen=True)
class Row:
    """A result that is there: facts are those of its JSON; is_new unless it was there before."""

    name: str
    work: str
    distance: str
    is_new: bool
    facts: dict[str, Any] = field(hash=False)


@dataclass(frozen=True)
class Failure:
    """What could not be done, and why, in a sentence."""

    name: str
    work: str
    distance: str
    reason: str


@dataclass(frozen=True)
class Report:
    """What has become of a task.  more: those that it leads to.  needs: the bytes that it takes and has no room
    for where it was tried, 0 if it was done."""

    task: Task
    rows: tuple[Row, ...] = ()
    failures: tuple[Failure, ...] = ()
    more: tuple[Task, ...] = ()
    needs: int = 0


def done_before(task: Task) -> Report | None:
    """The report of a task all of whose results are there; None if any is missing."""
    folder, rows = Folder(task.out), []
    for work, distance in task.wanted.results():
        facts = facts_of(folder, task.result_name(work, distance), task.key(work, distance), task.wanted.verify)
        if facts is None:
            return None
        rows.append(Row(task.name, work, distance, False, facts))
    return Report(task, tuple(rows))


def gone(task: Task, reason: str) -> Report:
    """The report of a task that did not come back."""
    results = [(task.part.work, task.part.distance)] if task.part else task.wanted.results()
    return Report(task, failures=tuple(Failure(task.name, *each, reason) for each in results))


def refused(report: Report, most: int) -> Report:
    """The report of a task that fits nowhere."""
    return gone(report.task, too_big(report.needs, most))
