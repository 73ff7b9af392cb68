"""Doing a task, anywhere.

Whatever goes wrong with one result ends no other: it becomes a failure with its reason.

What is there already is not done again.  A task of a large mesh comes back with parts, blocks of columns that several
processes may do; when all are there, the last task puts them together.
"""

import csv
import hashlib
import io
import os
import time
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from bihdist_core.analysis.parcels import ParcelSums, labelled, parcel_sums
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.errors import BihdistError, OutputError
from bihdist_core.formats.array_file import array_in, put_array
from bihdist_core.solver.blas import one_blas_thread
from bihdist_core.solver.worker_threads import without_workers

from ..document.sources import FILE
from ..session.repaired_surface import ids_table
from .layouts import NORMALISED, laid_out
from .maps import evaluated
from .matlab_ids import for_matlab
from .memory import PART_BYTES, allowed, needed
from .results import Blocks, facts_of, write_facts, write_result
from .storage import Folder
from .task import Failure, Part, Report, Row, Task, done_before
from .work_kinds import KINDS, MAXIMA
from .works import (
    WORK,
    Made,
    Mesh,
    facts_of_fields,
    fields,
    neighbours,
    neighbours_made,
    pairs_made,
    parcels_made,
)

MASKED = "vertices with 0 do not count; distances still cross them, as they do not cross what is cut"
"""What a result's JSON says of a mask."""
PARTS = ".parts"
"""The folder of parts, until they are put together."""
SECONDS = "seconds"
"""The ending of the file beside a part with the time that it took."""
PART_COLUMNS = 8192
"""Columns of a part of the means between parcels, or of neighbours, which keep little of them."""


def do(task: Task) -> Report:
    """Do what is missing of a task; never raises for what is wrong with its mesh or its results."""
    with one_blas_thread(), without_workers():
        if task.part is None:
            return _do_mesh(task)
        part = task.part
        if task.needs > allowed(is_expected=True):
            return Report(task, needs=task.needs)
        try:
            # Asked again of what has been put together, as clusters do that have lost a worker, its parts are gone.
            name = task.result_name(part.work, part.distance)
            facts = facts_of(Folder(task.out), name, task.key(part.work, part.distance), task.wanted.verify)
            if facts is not None:
                row = Row(task.name, part.work, part.distance, True, facts)
                return Report(task, (row,) if part.is_whole else ())
            return (_join if part.is_whole else _do_part)(task, part)
        except Exception as error:
            return Report(task, failures=(Failure(task.name, part.work, part.distance, failure_in_words(error)),))


def _do_mesh(task: Task) -> Report:
    there = done_before(task)
    if there is not None:
        return there
    wanted, folder = task.wanted, Folder(task.out)
    try:
        mesh = mesh_of(task)
    except Exception as error:
        reason = failure_in_words(error)
        return Report(task, failures=tuple(Failure(task.name, *each, reason) for each in wanted.results()))
    if mesh.new_ids is not None:
        folder.write(_ids_name(task), ids_table(mesh.new_ids).encode())
    needs = needed(_vertices(task, mesh), wanted, _sources_from_file(mesh))
    if needs > allowed(is_expected=bool(task.needs)):
        return Report(task, needs=needs)
    rows, failures, more = [], [], []
    for work, distance in wanted.results():
        name, key = task.result_name(work, distance), task.key(work, distance)
        facts = facts_of(folder, name, key, wanted.verify)
        if facts is not None:
            rows.append(Row(task.name, work, distance, False, facts))
            continue
        try:
            # Before anything is computed.
            folder.check_free(f"{name}.json")
            folder.check_free(f"{name}.{wanted.arrays}", is_folder=wanted.arrays == "zarr")
            if parts := _parts(task, mesh, work, distance):
                more += [replace(task, part=part, needs=needs) for part in parts]
                continue
            rows.append(Row(task.name, work, distance, True, _made(task, mesh, work, distance)))
        except Exception as error:
            failures.append(Failure(task.name, work, distance, failure_in_words(error)))
    return Report(task, tuple(rows), tuple(failures), tuple(more))


def _ids_name(task: Task) -> str:
    """The file with the new ids of merged vertices."""
    return f"{task.name}.ids.csv"


def _vertices(task: Task, mesh: Mesh) -> int:
    """Of the mesh, or of the one that a map leads to if that is larger, by the sizes of their files."""
    more = 1.0 if task.map is None else os.path.getsize(task.map.other) / max(1, os.path.getsize(task.mesh))
    return int(len(mesh.surface.vertices) * max(1.0, more))


def _sources_from_file(mesh: Mesh) -> int:
    """How many there are; 0 if the sources are others, or a file of them is none, which is said where they are read."""
    if mesh.wanted.sources.rule != FILE:
        return 0
    try:
        return len(mesh.sources(mesh.wanted.distances[0]))
    except BihdistError:
        return 0


def _made(task: Task, mesh: Mesh, work: str, distance: str) -> dict[str, Any]:
    begin = time.monotonic()
    if work == "figure":
        from .figures import figure_made

        folder, name = Folder(task.out), task.result_name(work, distance)
        facts = {**figure_made(task.mesh, mesh, folder, f"{name}.png"), **_facts_of_mesh(task, mesh, work)}
        return write_facts(folder, name, task.key(work, distance), f"{name}.png", facts, begin)
    if task.map is not None:
        made = evaluated(mesh, task.map)
    elif work == MAXIMA:
        from .figures import maxima_made

        made = maxima_made(task.mesh, mesh)
    else:
        made = WORK[work](mesh, distance)
    return _written(task, mesh, work, distance, made, begin)


def _written(task: Task, mesh: Mesh, work: str, distance: str, made: Made, begin: float) -> dict[str, Any]:
    which = Folder(task.out), task.result_name(work, distance), task.key(work, distance)
    facts = {**made.facts, **_facts_of_mesh(task, mesh, work)}
    if facts.get("accuracy_text") and work != "fps" and task.wanted.dtype == "float32":
        facts["accuracy_text"] += ", written in single precision: within 6e-8 of each value"
    if "names" in made.facts:
        facts["parcels"] = f"{which[1]}.parcels.csv"
        which[0].write(facts["parcels"], _parcel_table(made.facts))
    layout = task.wanted.layout if work == "pairs" else ""
    if not layout:
        format = task.wanted.arrays if work != MAXIMA else "npy"
        # Files of several arrays say themselves what rows and columns are.
        arrays = {**made.arrays, **(_numbers(made.facts) if format in ("npz", "mat") else {})}
        if format == "mat":
            arrays, of_ids = for_matlab(arrays, task.wanted.one_based)
            facts |= of_ids
        if format in ("npz", "mat") and "names" in made.facts:
            # Of objects MATLAB makes a cell array.
            arrays["names"] = np.array(made.facts["names"], object if format == "mat" else str)
        return write_result(*which, arrays, facts, begin, format)
    if layout == "dist" and not task.wanted.normalise:
        facts["note"] = NORMALISED
    arrays = dict(laid_out(layout, made.arrays["dist"], made.facts["sqrt_area"]))
    return write_result(*which, arrays, facts, begin, "mat", f"{layout}/{task.name}.mat")


def _parcel_table(facts: dict[str, Any]) -> bytes:
    """What the rows of a matrix between parcels are: the label, its name, and of how many vertices."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("label", "name", "vertices"))
    writer.writerows(zip(facts["labels"], facts["names"], facts["counts"], strict=True))
    return text.getvalue().encode()


def _numbers(facts: dict[str, Any]) -> dict[str, FloatArray]:
    """The vertices that are sources, and the labels of parcels, counted from 0."""
    given = {name: facts.get(name) for name in ("sources", "labels")}
    return {
        name: np.array(numbers)
        for name, numbers in given.items()
        if isinstance(numbers, list) and numbers and all(isinstance(each, int) for each in numbers)
    }


def _facts_of_mesh(task: Task, mesh: Mesh, work: str) -> dict[str, Any]:
    surface, notes = mesh.surface, surface_notes(mesh.surface)
    own, others = task.read(work)
    scaled: dict[str, Any] = {}
    if task.wanted.normalise and work in WORK:
        scaled = {"scaled_by": mesh.scale}
        if work != "eigen":
            scaled["normalisation"] = task.wanted.normalise
    crossed = {"mask": MASKED} if task.wanted.mask and "mask" in KINDS[work].fields else {}
    return {
        "mesh": surface.name,
        "checksum": own,
        **crossed,
        **({"checksums": others} if others else {}),
        "n_vertices": surface.n_vertices,
        "n_faces": surface.n_faces,
        "n_components": surface.n_components,
        "area": surface.area,
        **scaled,
        "repairs": list(notes.repairs),
        **({} if mesh.new_ids is None else {"new_ids": _ids_name(task)}),
        "warnings": list(notes.warnings),
        "areas": task.wanted.areas,
        "version": task.version,
    }


# ---------------------------------------------------------------------- large meshes
def _parts(task: Task, mesh: Mesh, work: str, distance: str) -> list[Part]:
    """The parts of a result, none if it is done at once."""
    n, wanted = len(mesh.surface.vertices), task.wanted
    if work == "pairs" and wanted.labels:
        total = len(labelled(mesh.surface, mesh.labels, mesh.mask))
        step = PART_COLUMNS
    elif work == "nearest":
        total, step = len(mesh.sources(distance)), PART_COLUMNS
    elif work in ("fields", "pairs"):
        total = len(mesh.sources(distance))
        step = max(1, int(PART_BYTES // (8 * n)))
    else:
        return []
    if total <= step:
        return []
    return [Part(work, distance, begin, min(begin + step, total), total) for begin in range(0, total, step)]


def _part_name(task: Task, part: Part, ending: str = "npy") -> str:
    return f"{_parts_folder(task, part)}/{part.begin}-{part.end}.{ending}"


def _parts_folder(task: Task, part: Part) -> str:
    """Of this mesh alone: others may have the same content, and are done at the same time."""
    which = f"{task.name} {task.key(part.work, part.distance)}"
    return f"{PARTS}/{hashlib.sha256(which.encode()).hexdigest()[:32]}"


def _do_part(task: Task, part: Part) -> Report:
    folder, name = Folder(task.out), _part_name(task, part)
    if folder.size(name) is None:
        mesh, begin = mesh_of(task), time.monotonic()
        if task.wanted.labels and part.work == "pairs":
            sums = parcel_sums(mesh.distance(part.distance), mesh.labels, mesh.mask, part.begin, part.end)
            columns: Any = sums.sums
        elif part.work == "nearest":
            made: Mapping[str, Any] = neighbours(mesh, part.distance, part.begin, part.end).arrays
            # Whole numbers this small are exact as float64.
            columns = np.stack([made["indices"], made["distances"]])
        else:
            made = fields(mesh, part.distance, part.begin, part.end).arrays
            columns = made["fields"]
            if part.work == "pairs":
                columns = columns[np.array(mesh.sources(part.distance))].T
        with folder.writing(name) as path:
            with path.open("wb") as file:
                put_array(file, np.asarray(columns))
            # First, so that no part is there without.
            folder.write(_part_name(task, part, SECONDS), f"{time.monotonic() - begin:.3f}".encode())
    return Report(task)


def _join(task: Task, part: Part) -> Report:
    """The result of which all parts are there."""
    folder, mesh = Folder(task.out), mesh_of(task)
    parts = _parts(task, mesh, part.work, part.distance)
    begin = time.monotonic() - sum(_seconds(folder, task, each) for each in parts)
    if part.work == "pairs" and task.wanted.labels:
        names, of_each = np.unique(mesh.labels[labelled(mesh.surface, mesh.labels, mesh.mask)], return_counts=True)
        sums = sum(_read_part(folder, task, each) for each in parts)
        found = ParcelSums(names, of_each, np.asarray(sums), of_each).parcels
        made = parcels_made(mesh, mesh.distance(part.distance), found)
    elif part.work == "nearest":
        indices, values = np.concatenate([_read_part(folder, task, each) for each in parts], axis=1)
        distance, sources = mesh.distance(part.distance), mesh.sources(part.distance)
        made = neighbours_made(mesh, distance, sources, indices.astype(int), values)
    else:
        distance, sources = mesh.distance(part.distance), mesh.sources(part.distance)
        rows = len(mesh.surface.vertices) if part.work == "fields" else part.total
        axis = 1 if part.work == "fields" else 0
        is_both = part.work == "pairs" and not distance.is_symmetric

        def each() -> Iterator[FloatArray]:
            return _both_ways(folder, task, parts) if is_both else (_read_part(folder, task, p) for p in parts)

        blocks = Blocks((rows, part.total), np.dtype(task.wanted.dtype), axis, each)
        if part.work == "fields":
            made = Made({"fields": blocks}, facts_of_fields(distance, sources, task.wanted.sources.rule))
        else:
            made = Made(*pairs_made(mesh, distance, sources, blocks))
    facts = _written(task, mesh, part.work, part.distance, made, begin)
    folder.remove(_parts_folder(task, part))
    return Report(task, (Row(task.name, part.work, part.distance, True, facts),))


def _seconds(folder: Folder, task: Task, part: Part) -> float:
    return float(folder.read(_part_name(task, part, SECONDS)) or 0)


def _read_part(folder: Folder, task: Task, part: Part) -> FloatArray:
    name = _part_name(task, part)
    try:
        if folder.local is not None and (folder.local / name).exists():
            # As much of it as is looked at.
            array: FloatArray = np.load(folder.local / name, mmap_mode="r", allow_pickle=False)
            return array
        content = folder.read(name)
        if content is not None:
            return array_in(io.BytesIO(content), len(content))
    except Exception:  # of whatever reads what is damaged
        folder.remove(name)
    raise OutputError(f"A part of the result is gone or damaged, {name}; the same command makes it again.")


def _both_ways(folder: Folder, task: Task, parts: list[Part]) -> Iterator[FloatArray]:
    """Rows of a matrix of pairs of which each part has those from its sources: the means of both ways, and 0."""
    for part in parts:
        rows = np.array(_read_part(folder, task, part))
        back = [np.array(_read_part(folder, task, each)[:, part.begin : part.end]) for each in parts]
        rows = (rows + np.concatenate(back).T) / 2
        rows[np.arange(len(rows)), np.arange(part.begin, part.end)] = 0
        yield rows


_last: tuple[tuple[Any, ...], Mesh] | None = None


def mesh_of(task: Task) -> Mesh:
    """The mesh of a task; parts of one mesh that the same process does share it, with its factor."""
    global _last
    which, last = (task.mesh, task.checksums, task.wanted), _last  # which other threads may replace
    if last is None or last[0] != which:
        last = _last = None  # its memory is needed
        last = _last = (which, Mesh(task.mesh, task.name, task.wanted))
    return last[1]
