"""`bihdist batch` on folders of small meshes, in processes."""

import csv
import io
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from scipy.io import loadmat

from app.batch.engines import Processes
from app.batch.mesh_files import find_mesh_files
from app.main import main
from bihdist_core import BiharmonicDistance, Laplacian, ParameterError, read_surface, write_mesh
from bihdist_core.analysis.sampling import farthest_points
from bihdist_core.laplacian import eigenpairs
from tests.batch.runs import batch, rows
from tests.commands import ran
from tests.programs import ROOT
from tests.shapes import bumpy, torus, two_pieces
from tests.waiting import PATIENCE


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Three meshes; nobody writes here."""
    place = tmp_path_factory.mktemp("meshes")
    write_mesh(place / "bumpy.off", bumpy(200))
    write_mesh(place / "ring.off", torus(16, 8))
    write_mesh(place / "pieces.off", two_pieces())
    return place


@pytest.fixture(scope="module")
def done(folder, tmp_path_factory):
    """A whole run: where its results are."""
    out = tmp_path_factory.mktemp("out")
    options = ("--sources", "farthest:12", "--k", "9", "--workers", "2")
    assert batch(folder, out, "--do", "fields,pairs,eigen,fps", *options) == 0
    return out


# ---------------------------------------------------------------------- what is written
def test_results_are_those_of_the_core(folder, done):
    for name in ("bumpy", "ring", "pieces"):
        surface = read_surface(folder / f"{name}.off")
        distance = BiharmonicDistance(surface)
        ids = np.load(done / f"{name}.fps.biharmonic.npy")
        assert np.array_equal(ids, farthest_points(distance, ids[0], 12))
        fields = np.load(done / f"{name}.fields.biharmonic.npy", mmap_mode="r")
        np.testing.assert_array_equal(fields, distance.from_sources(ids))
        np.testing.assert_array_equal(np.load(done / f"{name}.pairs.biharmonic.npy"), distance.pairwise(ids))
        found = np.load(done / f"{name}.eigen.npz")
        np.testing.assert_allclose(found["eigenvalues"], eigenpairs(Laplacian(surface), 9).eigenvalues, rtol=1e-9)
        gram = found["eigenvectors"].T @ (found["areas"][:, None] * found["eigenvectors"])
        np.testing.assert_allclose(gram, np.eye(9), atol=1e-9)


def test_what_a_result_is_stands_beside_it(folder, done):
    facts = json.loads((done / "bumpy.fields.biharmonic.json").read_text())
    assert facts["file"] == "bumpy.fields.biharmonic.npy"
    assert facts["shape"] == [200, 12]
    assert (facts["distance"], facts["unit"], facts["normalisation"]) == ("biharmonic", "mesh units", "none")
    assert facts["sources"] == np.load(done / "bumpy.fps.biharmonic.npy").tolist()
    assert (facts["mesh"], facts["n_vertices"], facts["areas"]) == ("bumpy.off", 200, "voronoi")
    assert len(facts["checksum"]) == 64
    assert facts["version"]


def test_the_summary_has_a_line_for_each_result(done):
    found = [(row["mesh"], row["work"], row["distance"]) for row in rows(done)]
    works = [("eigen", ""), ("fields", "biharmonic"), ("fps", "biharmonic"), ("pairs", "biharmonic")]
    assert found == [(mesh, *work) for mesh in ("bumpy", "pieces", "ring") for work in works]
    assert not (done / "failures.csv").exists()


def test_several_distances_have_a_file_each(folder, tmp_path):
    options = ("--do", "fields", "--sources", "3,5", "--distance", "diffusion(t=1/4),commute-time")
    assert batch(folder, tmp_path, *options, "--dtype", "float32") == 0
    names = {path.name for path in tmp_path.glob("ring.fields.*.npy")}
    assert names == {"ring.fields.diffusion_t_1_4.npy", "ring.fields.commute-time.npy"}
    assert np.load(tmp_path / "ring.fields.commute-time.npy").dtype == np.float32


@pytest.mark.parametrize("format", ["npz", "mat", "zarr"])
def test_formats_hold_the_same_numbers(folder, done, tmp_path, format):
    if format == "zarr":
        zarr = pytest.importorskip("zarr")
    options = ("--do", "fields,pairs", "--sources", "farthest:12", "--format", format)
    assert batch(folder, tmp_path, *options) == 0
    expected = np.load(done / "ring.pairs.biharmonic.npy")
    path = tmp_path / f"ring.pairs.biharmonic.{format}"
    found = {"npz": np.load, "mat": loadmat, "zarr": lambda p: zarr.open_group(p, mode="r")}[format](path)
    np.testing.assert_array_equal(found["dist"][...], expected)
    area = read_surface(folder / "ring.off").face_areas.sum()
    root = found.attrs["sqrt_area"] if format == "zarr" else np.ravel(found["sqrt_area"])[0]
    assert root == pytest.approx(np.sqrt(area), rel=1e-12)


@pytest.mark.parametrize("layout", ["dist", "geodist"])
def test_benchmarks_find_their_folders(folder, tmp_path, layout):
    options = ("--do", "pairs", "--sources", "all", "--layout", layout, "--normalise", "area")
    assert batch(folder, tmp_path, *options) == 0
    found = loadmat(tmp_path / layout / "ring.mat")
    surface = read_surface(folder / "ring.off")
    expected = BiharmonicDistance(surface).pairwise(np.arange(128)) / np.sqrt(surface.face_areas.sum())
    np.testing.assert_allclose(found[layout], expected, atol=1e-12)


def test_parcels_masks_and_sources_are_named_by_the_mesh(folder, tmp_path):
    for name in ("bumpy", "ring", "pieces"):
        n = len(read_surface(folder / f"{name}.off").vertices)
        np.save(tmp_path / f"{name}_labels.npy", np.arange(n) % 4)
        np.save(tmp_path / f"{name}_mask.npy", (np.arange(n) % 5 > 0).astype(int))
        (tmp_path / f"{name}.txt").write_text("3\n1\n2\n")
    out = tmp_path / "out"
    options = ("--labels", tmp_path / "{name}_labels.npy", "--mask", tmp_path / "{name}_mask.npy")
    assert batch(folder, out, "--do", "pairs,fields", "--sources", f"@{tmp_path}/{{name}}.txt", *options) == 0
    distance = BiharmonicDistance(read_surface(folder / "bumpy.off"))
    rows_of, mask = distance.from_sources(np.arange(200)), np.arange(200) % 5 > 0
    of = [mask & (np.arange(200) % 4 == k) for k in range(4)]
    expected = [[rows_of[np.ix_(a, b)].mean() for b in of] for a in of]
    np.testing.assert_allclose(np.load(out / "bumpy.pairs.biharmonic.npy"), expected, rtol=1e-9)
    fields = np.load(out / "bumpy.fields.biharmonic.npy")
    np.testing.assert_array_equal(np.isnan(fields[:, 0]), ~mask)
    np.testing.assert_array_equal(fields[mask], distance.from_sources([3, 1, 2])[mask])


def test_maps_are_evaluated(folder, tmp_path):
    maps = tmp_path / "maps"
    maps.mkdir()
    shutil.copy(folder / "bumpy.off", tmp_path / "one.off")
    shutil.copy(folder / "bumpy.off", tmp_path / "two.off")
    found = np.arange(200)
    found[:50] = 7
    np.save(maps / "one-two.npy", found)
    np.save(maps / "two-one.npy", np.arange(200))
    out = tmp_path / "out"
    assert batch(tmp_path, out, "--do", "evaluate", "--maps", maps, "--truth", "identity") == 0
    facts = json.loads((tmp_path / "out/one-two.evaluate.json").read_text())
    errors = np.load(tmp_path / "out/one-two.evaluate.npy")
    assert (errors[50:] == 0).all()
    assert errors[:50].max() > 0.1
    assert facts["mean"] == pytest.approx(errors.mean(), rel=1e-12)
    assert facts["median"] == 0
    assert facts["normalisation"].startswith("over the root of the area")
    assert set(facts["checksums"]) == {"mapped_to", "map"}
    overall, one, two = rows(out)
    assert (overall["mesh"], one["mesh"], two["mesh"]) == ("(all maps)", "one-two", "two-one")
    assert float(overall["mean"]) == pytest.approx(errors.mean() / 2, rel=1e-5)
    assert (float(one["mean"]), float(two["mean"])) == (pytest.approx(errors.mean(), rel=1e-5), 0)
    with (out / "evaluate.csv").open(newline="") as file:
        header, first, *others = csv.reader(file)
    assert header == ["error", "mean of 2 maps", "one-two", "two-one"]
    assert [float(cell) for cell in first] == [0, 0.8775, 0.755, 1]  # vertex 7 is right
    assert len(others) == 250
    assert (out / "evaluate.pdf").read_bytes().startswith(b"%PDF")
    assert "<svg" in (out / "evaluate.svg").read_text()
    assert (out / "evaluate.png").read_bytes().startswith(b"\x89PNG")
    # A file that is missing costs the maps that need it.
    (tmp_path / "one.txt").write_text("".join(f"{k}\n" for k in range(200)))
    options = ("--maps", maps, "--truth", "identity", "--symmetry", tmp_path / "{name}.txt")
    assert batch(tmp_path, out, "--do", "evaluate", *options) == 1
    assert [row["mesh"] for row in rows(out, "failures")] == ["one-two"]
    found = np.load(out / "two-one.evaluate.npz")
    assert (found["errors_with_partners"] <= found["errors"]).all()


def test_tables_keep_what_other_commands_have_left(folder, tmp_path):
    meshes, out = tmp_path / "meshes", tmp_path / "out"
    shutil.copytree(folder, meshes)
    assert batch(meshes, out, "--do", "fields", "--sources", "150") == 1
    assert batch(meshes, out, "--do", "eigen", "--k", "3") == 0
    assert [(row["mesh"], row["work"]) for row in rows(out)] == [
        ("bumpy", "eigen"), ("bumpy", "fields"), ("pieces", "eigen"), ("ring", "eigen")
    ]  # fmt: skip
    assert [row["seconds"] != "" for row in rows(out)] == [True, True, True, True]
    assert {(row["mesh"], row["work"]) for row in rows(out, "failures")} == {("pieces", "fields"), ("ring", "fields")}
    (out / "bumpy.eigen.npz").unlink()
    (meshes / "ring.off").unlink()
    assert batch(meshes, out, "--do", "fields", "--sources", "3") == 0
    assert [(row["mesh"], row["work"]) for row in rows(out)] == [
        ("bumpy", "fields"), ("pieces", "eigen"), ("pieces", "fields"), ("ring", "eigen")
    ]  # fmt: skip
    assert not (out / "failures.csv").exists()
    # A line without its JSON is of a result that was being written when its process was killed.
    (out / "pieces.eigen.json").unlink()
    layout = ("--do", "pairs", "--sources", "all", "--layout", "dist", "--distance")
    for word in ("geodesic", "biharmonic"):
        assert batch(meshes, out, *layout, word) == 0
    assert [(row["mesh"], row["work"], row["distance"]) for row in rows(out)] == [
        ("bumpy", "fields", "biharmonic"), ("bumpy", "pairs", "biharmonic"), ("pieces", "fields", "biharmonic"),
        ("pieces", "pairs", "biharmonic"), ("ring", "eigen", ""),
    ]  # fmt: skip


def test_tables_keep_failures_of_maps_until_maps_are_evaluated_again(folder, tmp_path):
    maps, out = tmp_path / "maps", tmp_path / "out"
    maps.mkdir()
    np.save(maps / "bumpy-ring.npy", np.full(200, 500))
    np.save(maps / "ring-bumpy.npy", np.zeros(5, int))
    evaluate = ("--do", "evaluate", "--maps", maps, "--truth", "identity")
    assert batch(folder, out, *evaluate) == 1
    both = [("bumpy-ring", "evaluate"), ("ring-bumpy", "evaluate")]
    assert [(row["mesh"], row["work"]) for row in rows(out, "failures")] == both
    assert batch(folder, out, "--do", "eigen", "--k", "3") == 0
    assert [(row["mesh"], row["work"]) for row in rows(out, "failures")] == both
    (maps / "ring-bumpy.npy").unlink()
    assert batch(folder, out, *evaluate) == 1
    assert [(row["mesh"], row["work"]) for row in rows(out, "failures")] == both[:1]


# ---------------------------------------------------------------------- again
def test_what_is_there_is_not_done_again(folder, done, capsys):
    before = {path: path.stat().st_mtime_ns for path in done.glob("*.npy")}
    assert batch(folder, done, "--do", "fields,pairs,eigen,fps", "--sources", "farthest:12", "--k", "9") == 0
    assert {path: path.stat().st_mtime_ns for path in done.glob("*.npy")} == before
    assert "12 results of 3 meshes, 12 of them there before" in capsys.readouterr().out


def test_what_has_changed_is_done_again_and_no_more(folder, tmp_path):
    meshes, out = tmp_path / "meshes", tmp_path / "out"
    shutil.copytree(folder, meshes)
    options = ("--do", "fields", "--sources", "3")
    assert batch(meshes, out, *options) == 0
    first = {path.name: path.stat().st_mtime_ns for path in out.glob("*.npy")}
    write_mesh(meshes / "ring.off", torus(20, 8))
    (out / "pieces.fields.biharmonic.npy").write_bytes(b"cut off")
    assert batch(meshes, out, *options) == 0
    changed = {path.name for path in out.glob("*.npy") if path.stat().st_mtime_ns != first[path.name]}
    assert changed == {"ring.fields.biharmonic.npy", "pieces.fields.biharmonic.npy"}
    assert np.load(out / "ring.fields.biharmonic.npy").shape == (160, 1)
    # Other options are other work, from the same folder moved elsewhere as from here.
    moved = tmp_path / "moved"
    meshes.rename(moved)
    before = rows(out)
    assert batch(moved, out, *options) == 0
    assert rows(out) == before
    assert all(float(row["seconds"]) > 0 for row in before)
    assert batch(moved, out, *options, "--areas", "barycentric") == 0
    assert [row["seconds"] for row in rows(out)] != [row["seconds"] for row in before]


def test_one_mesh_that_cannot_be_done_costs_no_other(folder, tmp_path, capsys):
    meshes, out = tmp_path / "meshes", tmp_path / "out"
    shutil.copytree(folder, meshes)
    (meshes / "torn.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    assert batch(meshes, out, "--do", "fields", "--sources", "150") == 1
    assert [row["mesh"] for row in rows(out)] == ["bumpy"]
    reasons = {row["mesh"]: row["reason"] for row in rows(out, "failures")}
    assert set(reasons) == {"torn", "ring", "pieces"}
    assert "has no vertex 150" in reasons["ring"]
    assert "failures.csv says why" in capsys.readouterr().err
    (meshes / "torn.off").unlink()
    assert batch(meshes, out, "--do", "fields", "--sources", "3") == 0
    assert not (out / "failures.csv").exists()


def test_a_run_that_was_killed_goes_on_where_it_was(folder, tmp_path):
    meshes, out = tmp_path / "meshes", tmp_path / "out"
    meshes.mkdir()
    for k in range(12):
        write_mesh(meshes / f"m{k:02}.off", bumpy(2000, k))
    words = [sys.executable, "-m", "app", "batch", str(meshes), "-o", str(out), "--do", "fields,eigen"]
    words += ["--sources", "farthest:40", "--workers", "2"]
    run = subprocess.Popen(words, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    begin = time.monotonic()
    while len(list(out.glob("*.json"))) < 3 and time.monotonic() - begin < PATIENCE:
        time.sleep(0.02)
    run.send_signal(signal.SIGKILL)
    run.wait()
    there = {path.name: json.loads(path.read_text()) for path in out.glob("*.json")}
    assert 3 <= len(there) < 24
    assert subprocess.run(words, cwd=ROOT, capture_output=True).returncode == 0
    assert len(rows(out)) == 24
    # Also those of the first run, which has written no table.
    seconds = {row["file"]: float(row["seconds"]) for row in rows(out)}
    assert {facts["file"]: seconds[facts["file"]] for facts in there.values()} == {
        facts["file"]: facts["seconds"] for facts in there.values()
    }
    for path in out.glob("*.npy"):
        np.load(path)
    # The processes of the first run have ended with it.
    left = subprocess.run(["pgrep", "-f", str(out)], capture_output=True, text=True).stdout.split()
    assert left == []


def test_what_is_interrupted_says_what_is_there(folder, tmp_path, monkeypatch, capsys):
    def interrupted(self):
        for k, report in enumerate(reports(self)):
            yield report
            if k == 1:
                raise KeyboardInterrupt

    reports = Processes.reports
    monkeypatch.setattr(Processes, "reports", interrupted)
    assert batch(folder, tmp_path, "--do", "fields") == 130
    assert "interrupted; 2 results in" in capsys.readouterr().err
    assert len(rows(tmp_path)) == 2


# ---------------------------------------------------------------------- what is asked
def test_files_of_the_same_name_are_called_by_their_folders(tmp_path):
    for subject in ("one", "two"):
        (tmp_path / subject).mkdir()
        for mesh in ("left", subject):
            write_mesh(tmp_path / subject / f"{mesh}.off", bumpy(50))
    path = tmp_path / "list.txt"
    path.write_text("one/left.off\ntwo/left.off\none/one.off\n")
    assert list(find_mesh_files([], str(path)).paths) == ["one_left", "two_left", "one"]
    # A mesh that is named twice is one.
    path.write_text("one/left.off\none/left.off\n")
    assert list(find_mesh_files([str(tmp_path / "one")], str(path)).paths) == ["left", "one"]
    shutil.copytree(tmp_path / "one", tmp_path / "more" / "one")
    path.write_text("one/left.off\nmore/one/left.off\n")
    assert list(find_mesh_files([], str(path)).paths) == [f"{tmp_path.name}_one_left", "more_one_left"]
    write_mesh(tmp_path / "one" / "left.obj", bumpy(50))
    path.write_text("one/left.off\none/left.obj\n")
    with pytest.raises(ParameterError, match=r"left\.off and .*left\.obj have the same name"):
        find_mesh_files([], str(path))


def test_meshes_are_named_by_files_folders_samples_and_lists(folder, tmp_path):
    path = tmp_path / "list.txt"
    path.write_text(f"# two\n{os.path.relpath(folder / 'ring.off', tmp_path)}\nhand\n")
    assert list(find_mesh_files([], str(path)).paths) == ["ring", "hand"]
    assert list(find_mesh_files([str(folder / "ring.off"), "part"], str(path)).paths) == ["ring", "part", "hand"]
    found = find_mesh_files(["gone.off", str(folder)])
    assert list(found.paths) == ["bumpy", "pieces", "ring"]
    assert found.missing == {"gone": "There is no file or folder gone.off, nor a sample of that name."}
    (tmp_path / "empty").mkdir()
    assert "no mesh in the folder" in find_mesh_files([str(tmp_path / "empty"), "hand"]).missing["empty"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "names no mesh"),
        ("gone.off\n", "line 1: There is no file or folder gone.off"),
        (None, "cannot be read"),
    ],
)
def test_a_list_that_is_wrong_is_refused(tmp_path, text, words):
    path = tmp_path / "list.txt"
    if text is not None:
        path.write_text(text)
    with pytest.raises(ParameterError, match=words):
        find_mesh_files([], str(path))


def test_no_mesh_at_all_is_refused():
    with pytest.raises(ParameterError, match="Which meshes"):
        find_mesh_files([])
    with pytest.raises(ParameterError, match=r"no file or folder gone\.off"):
        find_mesh_files(["gone.off"])


def test_what_it_says_has_the_folder_as_it_was_typed(folder, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for typed in ("out", "out/", str(tmp_path / "out")):
        words = [str(folder / "ring.off"), "gone.off", "--do", "fields", "--workers", "1"]
        told, place = ran(capsys, "batch", *words, "-o", typed, status=1), typed.rstrip("/")
        assert f"{place}: 1 result of 2 meshes" in told.out.splitlines()[0]
        assert f"1 result missing; {place}/failures.csv says why." in told.err
        assert told.out.startswith(place)


def test_a_mesh_that_is_missing_costs_only_itself(folder, tmp_path, capsys):
    words = [str(folder / "ring.off"), "gone.off", "--do", "fields,eigen", "--k", "5", "--workers", "1"]
    assert main(["batch", *words, "-o", str(tmp_path)]) == 1
    assert [(row["mesh"], row["work"]) for row in rows(tmp_path)] == [("ring", "eigen"), ("ring", "fields")]
    failures = rows(tmp_path, "failures")
    assert [(row["mesh"], row["work"]) for row in failures] == [("gone", "eigen"), ("gone", "fields")]
    assert all("no file or folder gone.off" in row["reason"] for row in failures)
    assert "2 results of 2 meshes" in capsys.readouterr().out
    # Once it is there, so is its result.
    write_mesh(tmp_path / "gone.off", bumpy(50))
    words = [str(folder / "ring.off"), str(tmp_path / "gone.off"), *words[2:]]
    assert main(["batch", *words, "-o", str(tmp_path)]) == 0
    assert not (tmp_path / "failures.csv").exists()


def test_a_list_from_standard_input(folder, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{folder / 'ring.off'}\n"))
    words = ["--list", "-", "--do", "fields", "--sources", "3", "--workers", "1", "-o", str(tmp_path)]
    assert main(["batch", *words]) == 0
    assert [row["mesh"] for row in rows(tmp_path)] == ["ring"]


def test_sources_from_standard_input(folder, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO("3\n1 # the second\n"))
    words = ["--do", "fields", "--sources", "-", "--workers", "2", "-o", str(tmp_path)]
    assert main(["batch", str(folder / "ring.off"), str(folder / "bumpy.off"), *words]) == 0
    facts = json.loads((tmp_path / "bumpy.fields.biharmonic.json").read_text())
    assert facts["sources"] == [3, 1]


BOTH = ("--distance", "biharmonic,geodesic")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--do", "dance", "--samples", "3"), "no task 'dance'"),
        (("--do", "pairs"), "Pairs are among several sources"),
        (("--do", "fps"), "Farthest points need a number"),
        (("--do", "evaluate"), "evaluated with --maps"),
        (("--do", "pairs", "--sources", "all", *BOTH, "--layout", "dist"), "A layout"),
        (("--do", "pairs", "--sources", "all", "--layout", "dist", "--format", "npz"), "leave out --format npz"),
        (("--do", "fields", "--dask", "tcp://127.0.0.1:9"), "Dask"),
    ],
)
def test_what_cannot_be_is_said_before_anything_is_done(folder, tmp_path, capsys, options, words):
    assert batch(folder, tmp_path, *options) == 2
    assert words in capsys.readouterr().err
    assert not list(tmp_path.glob("*.npy"))
