"""Sources from files and by rules, masks and labels: what counts, and what is said of files that do not fit."""

import numpy as np
import pytest

from app.batch.execution import run_task
from app.batch.mesh_files import find_mesh_files
from app.batch.scheduler import tasks_for
from app.batch.task import existing_report
from app.batch.work_order import WorkOrder
from app.document.sources import Sources
from bihdist_core import BiharmonicDistance, Surface, write_mesh
from tests.shapes import bumpy

N = 90


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """A mesh with a vertex that belongs to no face, 90."""
    place = tmp_path_factory.mktemp("meshes")
    whole = bumpy(N)
    write_mesh(place / "shape.off", Surface(np.vstack([whole.vertices, [3.0, 3.0, 3.0]]), whole.faces))
    return place


def report(mesh, out, *works, **options):
    (task,), failures = tasks_for(find_mesh_files([str(mesh)]).paths, WorkOrder(works, **options), str(out), "1")
    assert not failures
    return run_task(task)


def written(path, values):
    if path.suffix == ".npy":
        np.save(path, values)
    else:
        path.write_text("".join(f"{value}\n" for value in values))
    return str(path)


MASK = np.append(np.arange(N) % 3 > 0, True)


@pytest.mark.parametrize(
    ("rule", "count"), [("all", 60), ("random", 20), ("farthest", 20)], ids=["all", "random", "farthest"]
)
def test_sources_by_a_rule_are_not_masked(mesh, tmp_path, rule, count):
    mask = written(tmp_path / "mask.npy", MASK)
    asked = Sources(rule, count=0 if rule == "all" else count)
    found = report(mesh, tmp_path, "fields", "pairs", "nearest", sources=asked, mask=mask, nearest=4)
    assert not found.failures
    facts = {row.work: row.metadata for row in found.rows}
    sources = np.array(facts["fields"]["sources"])
    assert len(set(sources.tolist())) == count
    assert MASK[sources].all()
    assert sources.max() < N
    distance = BiharmonicDistance(bumpy(N))
    np.testing.assert_allclose(np.load(tmp_path / facts["pairs"]["file"]), distance.pairwise(sources), atol=1e-9)
    fields = np.load(tmp_path / facts["fields"]["file"])
    assert np.isnan(fields[~MASK]).all()
    assert np.isnan(fields[N]).all()
    assert np.isfinite(fields[:N][MASK[:N]]).all()
    neighbours = np.load(tmp_path / facts["nearest"]["file"])["indices"]
    assert MASK[neighbours].all()


def test_all_says_which_they_are_where_some_are_left_out(mesh, tmp_path):
    (row,) = report(mesh, tmp_path, "pairs", sources=Sources("all")).rows
    assert row.metadata["shape"] == [N, N]
    assert row.metadata["sources"] == list(range(N))


FILES = {
    "sources": lambda path: {"sources": Sources("file", file=path)},
    "mask": lambda path: {"mask": path, "sources": Sources(members=(1, 2))},
    "labels": lambda path: {"labels": path},
}


@pytest.mark.parametrize(
    ("what", "name", "values", "words"),
    [
        ("sources", "a.txt", [1, N + 1], f"has no vertex {N + 1}; ids run from 0 to {N}"),
        ("sources", "a.txt", [-1], "vertex ids start at 0"),
        ("sources", "a.txt", [N], f"vertex {N} "),
        ("sources", "a.txt", ["one"], "line 1: 'one' is not a source"),
        ("sources", "a.txt", [], "names no source"),
        ("sources", "a.label.gii", None, "has a value for each vertex; sources are the ids of some"),
        ("sources", "a.csv", None, "cannot be read"),
        ("sources", "a.npy", None, "cannot be read: No such file"),
        ("mask", "a.npy", np.ones(N, bool), f"for each of the {N + 1:,} vertices of shape.off; this one has the shape"),
        ("mask", "a.npy", np.arange(N + 1) % 3, "vertex 2 has 2"),
        ("mask", "a.npy", np.arange(N + 1) == N, "leaves no vertex of shape.off"),
        ("mask", "a.txt", None, "cannot be read"),
        ("labels", "a.npy", np.zeros(N, int), f"one for each of the {N + 1:,} vertices of shape.off"),
        ("labels", "a.npy", np.full(N + 1, -1), "No vertex of shape.off has a label"),
        ("labels", "a.npy", np.linspace(0, 1, N + 1), "not whole numbers"),
        ("labels", "a.dat", None, "file of the labels"),
    ],
)
def test_files_that_do_not_fit_are_failures_of_what_reads_them_alone(mesh, tmp_path, what, name, values, words):
    path = str(tmp_path / name) if values is None else written(tmp_path / name, values)
    found = report(mesh, tmp_path, "pairs", "eigen", eigenpairs=5, **FILES[what](path))
    (failure,) = found.failures
    assert (failure.name, failure.work) == ("shape", "pairs")
    assert words in failure.reason
    assert failure.reason.endswith(".")
    assert [row.work for row in found.rows] == ["eigen"]


@pytest.mark.parametrize("text", ["# three\n0 7\n12 # the last\n", "0,7,12", "0.0e+00\n7.000000000000000000e+00\n12\n"])
def test_numbers_may_be_written_as_other_programs_do(mesh, tmp_path, text):
    (tmp_path / "a.txt").write_text(text)
    found = report(mesh, tmp_path, "fields", **FILES["sources"](str(tmp_path / "a.txt")))
    assert found.rows[0].metadata["sources"] == [0, 7, 12]


def test_labels_without_vertices_are_no_parcels(mesh, tmp_path):
    labels = np.append(np.array([7, 2, -1])[np.arange(N) % 3], 4)
    (row,) = report(mesh, tmp_path, "pairs", labels=written(tmp_path / "labels.npy", labels)).rows
    # The vertex with label 4 belongs to no face.
    assert row.metadata["labels"] == [2, 7]
    assert row.metadata["counts"] == [30, 30]
    assert row.metadata["shape"] == [2, 2]


def test_a_change_of_a_file_is_one_of_what_reads_it_alone(mesh, tmp_path):
    path = tmp_path / "sources.txt"
    options = {"sources": Sources("file", file=str(path)), "eigenpairs": 5}
    written(path, [3, 4])
    assert [row.is_new for row in report(mesh, tmp_path, "fields", "eigen", **options).rows] == [True, True]
    written(path, [4, 3])
    found = {row.work: row.is_new for row in report(mesh, tmp_path, "fields", "eigen", **options).rows}
    assert found == {"fields": True, "eigen": False}
    (task,), _ = tasks_for(
        find_mesh_files([str(mesh)]).paths, WorkOrder(("fields", "eigen"), **options), str(tmp_path), "1"
    )
    assert existing_report(task) is not None
