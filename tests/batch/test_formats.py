"""What is written, in every format: the numbers, and beside them what they are."""

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import loadmat

from app.batch.execution import run_task
from app.batch.mesh_files import find_mesh_files
from app.batch.scheduler import tasks_for
from app.batch.work_order import ARRAYS, GIFTI, LAYOUTS, WorkOrder, slug
from app.document.sources import Sources
from bihdist_core import (
    BiharmonicDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    nearest,
    read_surface,
    write_mesh,
)
from bihdist_core.laplacian import eigenpairs
from tests.shapes import bumpy

FIRST = {"fields": "fields", "pairs": "dist", "nearest": "indices", "eigen": "eigenvalues", "fps": "vertices"}
WORKS = tuple(FIRST)


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    place = tmp_path_factory.mktemp("meshes")
    write_mesh(place / "bumpy.off", bumpy(128))
    np.save(place / "labels.npy", np.arange(128) % 5)
    return place / "bumpy.off"


def made(mesh, out, **options):
    (task,), failures = tasks_for(find_mesh_files([str(mesh.parent)]).paths, WorkOrder(**options), str(out), "1.2")
    report = run_task(task)
    assert not failures
    assert not report.failures
    return {row.work: row.metadata for row in report.rows}


def loaded(path):
    """The arrays of a result by name; a single one by none."""
    if path.suffix == ".zarr":
        zarr = pytest.importorskip("zarr")
        group = zarr.open_group(path, mode="r")
        return {name: group[name][...] for name in group.array_keys()}
    if path.suffix == ".mat":
        return {name: np.squeeze(array) for name, array in loadmat(path).items() if not name.startswith("__")}
    found = np.load(path)
    return {"": found} if isinstance(found, np.ndarray) else dict(found.items())


@pytest.mark.parametrize("dtype", ["float32", "float64"])
@pytest.mark.parametrize("format", [each for each in ARRAYS if each != GIFTI])
def test_every_result_has_beside_it_what_it_is(mesh, tmp_path, format, dtype):
    if format == "zarr":
        pytest.importorskip("zarr")
    facts = made(
        mesh, tmp_path, works=WORKS, distances=("diffusion(t=1/4)",), sources=Sources("farthest", count=9),
        eigenpairs=7, nearest=4, arrays=format, dtype=dtype,
    )  # fmt: skip
    assert set(facts) == set(WORKS)
    expected = expectations(mesh)
    for work, said in facts.items():
        beside = json.loads((tmp_path / f"{(tmp_path / said['file']).with_suffix('').name}.json").read_text())
        assert beside == said
        assert said["checksum"] == hashlib.sha256(mesh.read_bytes()).hexdigest()
        assert said["version"] == "1.2"
        assert said["unit"]
        assert said["normalisation"]
        if work == "eigen":
            assert said["parameters"] == {"eigenpairs": 7}
        else:
            assert said["distance"].startswith("diffusion(t=1/4")
            assert said["parameters"]["t"] == 0.25
            assert said["unit"] == "1 / mesh units"
        arrays = loaded(tmp_path / said["file"])
        first = arrays.get("", arrays.get(FIRST[work]))
        assert list(first.shape) == said["shape"]
        if work in expected:
            np.testing.assert_allclose(first, expected[work], rtol=1e-9 if dtype == "float64" else 1e-6)
        if work in ("fields", "pairs"):
            assert first.dtype == dtype
    assert loaded(tmp_path / facts["nearest"]["file"])["distances"].dtype == dtype


def expectations(mesh):
    distance = DiffusionDistance(read_surface(mesh), t=1 / 4)
    ids = made(
        mesh, mesh.parent / "ids", works=("fps",), distances=("diffusion(t=1/4)",), sources=Sources("farthest", count=9)
    )
    (path,) = (mesh.parent / "ids").glob("*.npy")
    points = np.load(path)
    assert ids["fps"]["shape"] == [9]
    return {
        "fps": points,
        "fields": distance.from_sources(points),
        "pairs": distance.pairwise(points),
        "nearest": nearest(distance, points, 4)[0],
    }


@pytest.mark.parametrize("one_based", [False, True])
def test_mat_files_say_from_where_vertex_ids_count(mesh, tmp_path, one_based):
    options = {"sources": Sources("farthest", count=9), "nearest": 128, "eigenpairs": 3}
    made(mesh, tmp_path, works=WORKS, arrays="npz", **options)
    facts = made(mesh, tmp_path / "mat", works=WORKS, arrays="mat", one_based=one_based, **options)
    held = {"fields": ["sources"], "pairs": ["sources"], "nearest": ["indices", "sources"], "fps": ["vertices"]}
    for work, said in facts.items():
        found = loaded(tmp_path / "mat" / said["file"])
        if work == "eigen":
            assert "ids_count_from" not in found
            continue
        right = loaded(tmp_path / said["file"].replace(".mat", ".npz"))
        assert int(found["ids_count_from"]) == said["mat_ids_count_from"] == one_based
        for name in held[work]:
            np.testing.assert_array_equal(found[name], right[name] + one_based)
        for name in set(right) - set(held[work]):
            np.testing.assert_allclose(found[name], right[name])
    # The mesh has fewer vertices than are asked for.
    assert loaded(tmp_path / "mat" / facts["nearest"]["file"])["indices"].min() == one_based - 1
    assert facts["nearest"]["indices"] == f"{one_based - 1} where there is none"
    # In JSON they count from 0.
    assert facts["fields"]["sources"] == right["vertices"].tolist()


def test_layouts_have_no_ids_and_nothing_that_benchmarks_do_not_know(mesh, tmp_path):
    said = made(mesh, tmp_path, works=("pairs",), sources=Sources("all"), layout="dist")["pairs"]
    assert set(loaded(tmp_path / said["file"])) == {"dist"}


def test_zarr_is_read_lazily_by_dask(mesh, tmp_path, monkeypatch):
    zarr = pytest.importorskip("zarr")
    array = pytest.importorskip("dask.array")
    monkeypatch.setattr("app.batch.results.ZARR_CHUNK", 50)
    said = made(mesh, tmp_path, works=("pairs",), sources=Sources("all"), arrays="zarr")["pairs"]
    lazy = array.from_zarr(str(tmp_path / said["file"]), component="dist")
    assert lazy.chunks == ((50, 50, 28), (50, 50, 28))
    # A part of it reads only its own chunk: the others may be gone.
    kept = tmp_path / said["file"] / "dist" / "c" / "1" / "0"
    expected = BiharmonicDistance(read_surface(mesh)).pairwise(np.arange(128))
    np.testing.assert_allclose(lazy.mean(axis=0).compute(), expected.mean(axis=0), rtol=1e-9)
    for chunk in kept.parent.parent.rglob("*"):
        if chunk.is_file() and chunk != kept:
            chunk.unlink()
    np.testing.assert_allclose(lazy[60:70, 10:20].compute(), expected[60:70, 10:20], rtol=1e-9)
    attributes = dict(zarr.open_group(tmp_path / said["file"], mode="r").attrs)
    for name in ("distance", "parameters", "unit", "normalisation", "checksum", "version", "sqrt_area"):
        assert attributes[name] == said[name]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_layouts_say_what_they_are_too(mesh, tmp_path, layout):
    said = made(mesh, tmp_path, works=("pairs",), sources=Sources("all"), layout=layout)["pairs"]
    assert said["file"] == f"{layout}/bumpy.mat"
    assert json.loads((tmp_path / f"bumpy.pairs.{layout}.json").read_text()) == said
    assert (said["distance"], said["unit"], said["normalisation"]) == ("biharmonic", "mesh units", "none")
    found = loaded(tmp_path / said["file"])
    assert found[layout].shape == (128, 128)


def read_by_geomfmaps(mat):
    return mat["Gamma"], mat["SQRarea"][0]


def read_by_geomfmaps_on_shrec(mat):
    return mat["Gamma"], mat["sqrt_area"][0].todense()


def read_by_duo_fm(mat):
    distances = mat["Gamma"] if "Gamma" in mat else mat["G"]
    return distances, mat["SQRarea"][0] if "SQRarea" in mat else 1


def read_by_attentive_fmaps(mat):
    return np.asarray(mat["geodist"], np.float32), mat["sqrt_area"].toarray().flatten()[0]


def read_by_ulrssm(mat):
    return mat["dist"], 1


@pytest.mark.parametrize("in_parts", [False, True])
def test_benchmarks_read_their_layouts_as_errors_over_the_root_of_the_area(mesh, tmp_path, monkeypatch, in_parts):
    surface, options = read_surface(mesh), {"distances": ("geodesic",), "sources": Sources("all")}
    found, right = np.arange(0, 120, 3), np.arange(1, 121, 3)
    expected = GeodesicDistance(surface).pairwise(np.arange(128))[right, found] / np.sqrt(surface.face_areas.sum())
    of_geodist = read_by_geomfmaps, read_by_geomfmaps_on_shrec, read_by_duo_fm, read_by_attentive_fmaps
    for layout, normalise, readers in (("geodist", "", of_geodist), ("dist", "area", (read_by_ulrssm,))):
        out = tmp_path / layout
        wanted = WorkOrder(("pairs",), **options, layout=layout, normalise=normalise)
        tasks, _ = tasks_for(find_mesh_files([str(mesh.parent)]).paths, wanted, str(out), "1")
        if in_parts:
            monkeypatch.setattr("app.batch.execution.PART_BYTES", 8 * 128 * 50)
            parts = run_task(tasks[0]).more
            assert len(parts) == 3
            tasks = [*parts, replace(parts[0], part=replace(parts[0].part, is_whole=True))]
        for task in tasks:
            report = run_task(task)
            assert not report.failures
        for reader in readers:
            distances, root = reader(loadmat(out / report.rows[0].metadata["file"]))
            errors = np.take(distances, np.ravel_multi_index((right, found), distances.shape)) / root
            np.testing.assert_allclose(np.ravel(errors), expected, rtol=1e-6)


def test_normalised_results_are_those_of_the_mesh_scaled_to_area_1(mesh, tmp_path):
    surface = read_surface(mesh)
    root = np.sqrt(surface.face_areas.sum())
    unit = replace(surface, vertices=surface.vertices / root)
    words = ("biharmonic", "diffusion(t=1/4)")
    options = {"distances": words, "sources": Sources("farthest", count=9), "eigenpairs": 7, "arrays": "npz"}
    (task,), _ = tasks_for(
        find_mesh_files([str(mesh.parent)]).paths, WorkOrder(WORKS, **options, normalise="area"), str(tmp_path), "1"
    )
    sources = np.load(tmp_path / "bumpy.fps.biharmonic.npz")["vertices"] if not run_task(task).failures else None
    fields = {word: np.load(tmp_path / f"bumpy.fields.{slug(word)}.npz")["fields"] for word in words}
    np.testing.assert_allclose(fields["biharmonic"], BiharmonicDistance(unit).from_sources(sources), rtol=1e-9)
    np.testing.assert_allclose(
        fields["biharmonic"], BiharmonicDistance(surface).from_sources(sources) / root, rtol=1e-9
    )
    pairs = np.load(tmp_path / "bumpy.pairs.biharmonic.npz")
    np.testing.assert_allclose(pairs["dist"], fields["biharmonic"][sources], atol=1e-9)
    assert pairs["sqrt_area"] == pytest.approx(1, rel=1e-12)
    eigen = np.load(tmp_path / "bumpy.eigen.npz")
    np.testing.assert_allclose(eigen["eigenvalues"], eigenpairs(Laplacian(unit), 7).eigenvalues, rtol=1e-9)
    for work in ("fields", "pairs", "nearest", "fps"):
        said = json.loads((tmp_path / f"bumpy.{work}.biharmonic.json").read_text())
        assert (said["normalisation"], said["scaled_by"]) == ("area", pytest.approx(1 / root, rel=1e-12))
        assert said["area"] == pytest.approx(root**2, rel=1e-12)
    assert json.loads((tmp_path / "bumpy.eigen.json").read_text())["scaled_by"] == pytest.approx(1 / root, rel=1e-12)


def test_the_layout_dist_says_when_its_metrics_want_another_scale(mesh, tmp_path):
    options = {"works": ("pairs",), "sources": Sources("all"), "layout": "dist"}
    assert "--normalise area" in made(mesh, tmp_path, **options)["pairs"]["note"]
    said = made(mesh, tmp_path, **options, normalise="area")["pairs"]
    assert "note" not in said
    assert said["sqrt_area"] == pytest.approx(1, rel=1e-12)


def test_other_files_have_checksums_of_their_own(mesh, tmp_path):
    labels = mesh.parent / "labels.npy"
    said = made(mesh, tmp_path, works=("pairs",), labels=str(labels))["pairs"]
    assert said["checksum"] == hashlib.sha256(mesh.read_bytes()).hexdigest()
    assert said["checksums"] == {"labels": hashlib.sha256(labels.read_bytes()).hexdigest()}


def test_neighbours_of_a_large_mesh_are_put_together(mesh, tmp_path, monkeypatch):
    monkeypatch.setattr("app.batch.execution.PART_COLUMNS", 50)
    (task,), _ = tasks_for(
        find_mesh_files([str(mesh.parent)]).paths,
        WorkOrder(("nearest",), sources=Sources("all"), nearest=5),
        str(tmp_path),
        "1",
    )
    parts = run_task(task).more
    assert [(each.part.begin, each.part.end) for each in parts] == [(0, 50), (50, 100), (100, 128)]
    for part in parts:
        run_task(part)
    (row,) = run_task(replace(parts[-1], part=replace(parts[-1].part, is_whole=True))).rows
    found = loaded(tmp_path / row.metadata["file"])
    indices, values = nearest(BiharmonicDistance(read_surface(mesh)), k=5)
    np.testing.assert_array_equal(found["indices"], indices)
    np.testing.assert_allclose(found["distances"], values, rtol=1e-9)
