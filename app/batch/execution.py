"""Running a task, in any process.

An error in one result does not end the others: it becomes a failure with its reason. Results that are there are not
computed again. The task of a large mesh returns parts, blocks of columns that several processes may compute; the
last task joins them.
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
from bihdist_core.analysis.signature_types import is_signature
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.analysis.upright import guess_up
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.errors import BihdistError, OutputError
from bihdist_core.experiments import EXPERIMENTS, Parts, Shapes
from bihdist_core.experiments.result import CLAIM_COLUMNS
from bihdist_core.formats.array_file import array_in, put_array
from bihdist_core.machine_memory import release_freed
from bihdist_core.solver.blas import one_blas_thread
from bihdist_core.solver.worker_threads import without_workers

from ..document.sources import FILE
from ..session.repaired_surface import ids_table
from .jobs import (
    WORK,
    BatchMesh,
    Computed,
    fields,
    fields_computed,
    neighbours,
    neighbours_computed,
    pairs_computed,
    parcels_computed,
)
from .maps import evaluate_map
from .memory import PART_BYTES, allowed, needed
from .results import NORMALISED, ArrayBlocks, for_matlab, laid_out, write_metadata, write_result
from .storage import Folder
from .task import Failure, Report, ResultRow, Task, TaskPart, existing_report, existing_row, failed_report
from .work_order import KINDS, MAXIMA, STATEMENTS


def write_statements(mesh: BatchMesh, folder: Folder, file: str) -> dict[str, Any]:
    """Measure the statements of the wanted experiments and write the table; return what could not be done."""
    wanted, parts = mesh.wanted, Parts()
    up = wanted.up or parts.do("which way is up", guess_up, mesh.surface, mesh.extension) or "y"
    shapes = Shapes(own=mesh.surface, up=up)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(CLAIM_COLUMNS)
    for id in wanted.experiments:
        result = parts.do(id, EXPERIMENTS[id].compute, shapes, wanted.quick)
        if result is not None:
            writer.writerows(row for claim in result.claims for row in claim.rows())
            for each in result.not_done:
                parts.note(f"{id}, {each.part}", each.reason)
    folder.write(file, text.getvalue().encode())
    return {"up": up, "not_done": [str(each) for each in parts.not_done]}


MASKED = "vertices with 0 are left out of results; distances still cross them"
"""The remark on a mask in the metadata."""
PARTS = ".parts"
"""The folder of parts until they are joined."""
SECONDS = "seconds"
"""The ending of the file beside a part with the time that it took."""
PART_COLUMNS = 1024
"""Columns of a part of the means between parcels, or of neighbours, which keep little of them: half a minute of exact
geodesics of a cortical surface of 10,242 vertices."""


def run_task(task: Task) -> Report:
    """Compute what is missing of a task; never raises for errors of its mesh or its results."""
    with one_blas_thread(), without_workers():
        if task.part is None:
            return _run_mesh(task)
        part = task.part
        if task.needs > allowed(is_expected=True):
            return Report(task, needs=task.needs)
        try:
            # Asked again of what has been put together, as clusters do that have lost a worker, its parts are gone.
            row = existing_row(task, part.work, part.distance, is_new=True)
            if row is not None:
                return Report(task, (row,) if part.is_whole else ())
            return (_join if part.is_whole else _run_part)(task, part)
        except Exception as error:
            return failed_report(task, failure_in_words(error))


def _run_mesh(task: Task) -> Report:
    there = existing_report(task)
    if there is not None:
        return there
    wanted, folder = task.wanted, Folder(task.out)
    try:
        mesh = mesh_of(task)
    except Exception as error:
        return failed_report(task, failure_in_words(error))
    if mesh.new_ids is not None:
        folder.write(_ids_name(task), ids_table(mesh.new_ids).encode())
    needs = needed(_vertices(task, mesh), wanted, _sources_from_file(mesh))
    if needs > allowed(is_expected=bool(task.needs)):
        return Report(task, needs=needs)
    rows, failures, more = [], [], []
    for work, distance in wanted.results():
        row = existing_row(task, work, distance)
        if row is not None:
            rows.append(row)
            continue
        try:
            # Before anything is computed.
            name = task.result_name(work, distance)
            folder.check_free(f"{name}.json")
            folder.check_free(f"{name}.{wanted.arrays}", is_folder=wanted.arrays == "zarr")
            if parts := _parts(task, mesh, work, distance):
                more += [replace(task, part=part, needs=needs) for part in parts]
                continue
            rows.append(ResultRow(task.name, work, distance, True, _compute(task, mesh, work, distance)))
        except Exception as error:
            failures.append(Failure(task.name, work, distance, failure_in_words(error)))
    return Report(task, tuple(rows), tuple(failures), tuple(more))


def _ids_name(task: Task) -> str:
    """Return the name of the file with the new ids of merged vertices."""
    return f"{task.name}.ids.csv"


def _vertices(task: Task, mesh: BatchMesh) -> int:
    """Return the number of vertices of the mesh, or of the mesh that a map leads to if its file is larger."""
    more = 1.0 if task.map is None else os.path.getsize(task.map.other) / max(1, os.path.getsize(task.mesh))
    return int(len(mesh.surface.vertices) * max(1.0, more))


def _sources_from_file(mesh: BatchMesh) -> int:
    """Count the sources in a file; 0 for other sources, and for a file that cannot be read."""
    if mesh.wanted.sources.rule != FILE:
        return 0
    try:
        return len(mesh.sources(mesh.wanted.distances[0]))
    except BihdistError:
        return 0


def _compute(task: Task, mesh: BatchMesh, work: str, distance: str) -> dict[str, Any]:
    begin = time.monotonic()
    if work in ("figure", STATEMENTS):
        folder, name = Folder(task.out), task.result_name(work, distance)
        if work == "figure":
            from .figures import draw_figure

            file = f"{name}.png"
            metadata = draw_figure(task.mesh, mesh, folder, file)
        else:
            file = f"{name}.csv"
            metadata = write_statements(mesh, folder, file)
        metadata |= _mesh_metadata(task, mesh, work)
        return write_metadata(folder, name, task.key(work, distance), file, metadata, begin)
    if task.map is not None:
        made = evaluate_map(mesh, task.map)
    elif work == MAXIMA:
        from .figures import compute_maxima

        made = compute_maxima(task.mesh, mesh)
    else:
        made = WORK[work](mesh, distance)
    return _write(task, mesh, work, distance, made, begin)


def _write(task: Task, mesh: BatchMesh, work: str, distance: str, made: Computed, begin: float) -> dict[str, Any]:
    which = Folder(task.out), task.result_name(work, distance), task.key(work, distance)
    metadata = {**made.metadata, **_mesh_metadata(task, mesh, work)}
    if metadata.get("accuracy_text") and work != "fps" and task.wanted.dtype == "float32":
        metadata["accuracy_text"] += ", written in single precision: within 6e-8 of each value"
    if "names" in made.metadata:
        metadata["parcels"] = f"{which[1]}.parcels.csv"
        which[0].write(metadata["parcels"], _parcel_table(made.metadata))
    layout = task.wanted.layout if work == "pairs" else ""
    if not layout:
        format = task.wanted.arrays if work != MAXIMA else "npy"
        # Files of several arrays say themselves what rows and columns are.
        arrays = {**made.arrays, **(_numbers(made.metadata) if format in ("npz", "mat") else {})}
        if format == "mat":
            arrays, of_ids = for_matlab(arrays, task.wanted.one_based)
            metadata |= of_ids
        if format in ("npz", "mat") and "names" in made.metadata:
            # Of objects MATLAB makes a cell array.
            arrays["names"] = np.array(made.metadata["names"], object if format == "mat" else str)
        return write_result(*which, arrays, metadata, begin, format)
    if layout == "dist" and not task.wanted.normalise:
        metadata["note"] = NORMALISED
    arrays = dict(laid_out(layout, made.arrays["dist"], made.metadata["sqrt_area"]))
    return write_result(*which, arrays, metadata, begin, "mat", f"{layout}/{task.name}.mat")


def _parcel_table(metadata: dict[str, Any]) -> bytes:
    """Return the table of the rows of a matrix between parcels: label, name and number of vertices."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("label", "name", "vertices"))
    writer.writerows(zip(metadata["labels"], metadata["names"], metadata["counts"], strict=True))
    return text.getvalue().encode()


def _numbers(metadata: dict[str, Any]) -> dict[str, FloatArray]:
    """Return the vertices that are sources and the labels of parcels."""
    given = {name: metadata.get(name) for name in ("sources", "labels")}
    return {
        name: np.array(numbers)
        for name, numbers in given.items()
        if isinstance(numbers, list) and numbers and all(isinstance(each, int) for each in numbers)
    }


def _mesh_metadata(task: Task, mesh: BatchMesh, work: str) -> dict[str, Any]:
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
        "operator": task.wanted.operator,
        "version": task.version,
    }


# ---------------------------------------------------------------------- large meshes
def _parts(task: Task, mesh: BatchMesh, work: str, distance: str) -> list[TaskPart]:
    """Return the parts of a result, none if it is computed at once."""
    if is_signature(distance):
        return []
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
    return [TaskPart(work, distance, begin, min(begin + step, total), total) for begin in range(0, total, step)]


def _part_name(task: Task, part: TaskPart, ending: str = "npy") -> str:
    return f"{_parts_folder(task, part)}/{part.begin}-{part.end}.{ending}"


def _parts_folder(task: Task, part: TaskPart) -> str:
    """Return the folder of the parts of this mesh alone, as another may have the same content."""
    which = f"{task.name} {task.key(part.work, part.distance)}"
    return f"{PARTS}/{hashlib.sha256(which.encode()).hexdigest()[:32]}"


def _run_part(task: Task, part: TaskPart) -> Report:
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


def _join(task: Task, part: TaskPart) -> Report:
    """Join the parts of a result."""
    folder, mesh = Folder(task.out), mesh_of(task)
    parts = _parts(task, mesh, part.work, part.distance)
    begin = time.monotonic() - sum(float(folder.read(_part_name(task, each, SECONDS)) or 0) for each in parts)
    if part.work == "pairs" and task.wanted.labels:
        names, of_each = np.unique(mesh.labels[labelled(mesh.surface, mesh.labels, mesh.mask)], return_counts=True)
        sums = sum(_read_part(folder, task, each) for each in parts)
        found = ParcelSums(names, of_each, np.asarray(sums), of_each).parcels
        made = parcels_computed(mesh, part.distance, found)
    elif part.work == "nearest":
        indices, values = np.concatenate([_read_part(folder, task, each) for each in parts], axis=1)
        made = neighbours_computed(mesh, part.distance, indices.astype(int), values)
    else:
        are_fields = part.work == "fields"
        is_both = not are_fields and not mesh.distance(part.distance).is_symmetric

        def each() -> Iterator[FloatArray]:
            return _both_ways(folder, task, parts) if is_both else (_read_part(folder, task, p) for p in parts)

        shape = (len(mesh.surface.vertices) if are_fields else part.total, part.total)
        blocks = ArrayBlocks(shape, np.dtype(task.wanted.dtype), int(are_fields), each)
        made = (fields_computed if are_fields else pairs_computed)(mesh, part.distance, blocks)
    metadata = _write(task, mesh, part.work, part.distance, made, begin)
    folder.remove(_parts_folder(task, part))
    return Report(task, (ResultRow(task.name, part.work, part.distance, True, metadata),))


def _read_part(folder: Folder, task: Task, part: TaskPart) -> FloatArray:
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
    raise OutputError(f"Part of the result, {name}, is missing or damaged; run the same command to compute it again.")


def _both_ways(folder: Folder, task: Task, parts: list[TaskPart]) -> Iterator[FloatArray]:
    """Yield the rows of a symmetric matrix of pairs: the means of the distances both ways, and 0 on the diagonal."""
    for part in parts:
        rows = np.array(_read_part(folder, task, part))
        back = [np.array(_read_part(folder, task, each)[:, part.begin : part.end]) for each in parts]
        rows = (rows + np.concatenate(back).T) / 2
        rows[np.arange(len(rows)), np.arange(part.begin, part.end)] = 0
        yield rows


_last: tuple[tuple[Any, ...], BatchMesh] | None = None


def mesh_of(task: Task) -> BatchMesh:
    """Return the mesh of a task; parts of one mesh in the same process share it, with its factor."""
    global _last
    which, last = (task.mesh, task.checksums, task.wanted), _last  # which other threads may replace
    if last is None or last[0] != which:
        last = _last = None  # its memory is needed
        release_freed()
        last = _last = (which, BatchMesh(task.mesh, task.name, task.wanted))
    return last[1]
