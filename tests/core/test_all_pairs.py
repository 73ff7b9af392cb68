"""All distances in a file: the array that memory would hold, whole or to be continued."""

import fcntl
import os
import shutil
from collections import namedtuple

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, DiffusionDistance, GeodesicDistance, Laplacian
from bihdist_core.analysis.all_pairs import begun, left_by_others, write_all_pairs
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import Cancelled, OutputError, ParameterError
from tests.shapes import bumpy, two_pieces


@pytest.fixture
def distance():
    return BiharmonicDistance(bumpy(150))


@pytest.mark.parametrize(("dtype", "rounding"), [(np.float32, 1e-7), (np.float64, 1e-12)])
def test_is_the_array_of_all_fields(distance, tmp_path, dtype, rounding):
    path = tmp_path / "D.npy"
    write_all_pairs(distance, path, dtype, memory=7 * 150 * 40)  # blocks of 7 rows, and a rest
    result, fields = np.load(path), distance.from_sources(np.arange(150))
    assert result.dtype == dtype
    assert np.abs(result - fields.T).max() <= rounding * fields.max()
    assert [p.name for p in tmp_path.iterdir()] == ["D.npy"]


def test_other_distances_and_vertices_without_one(tmp_path):
    surface = two_pieces()
    path = tmp_path / "D.npy"
    write_all_pairs(GeodesicDistance(surface, "dijkstra"), path, "float64")
    result = np.load(path)
    assert np.isnan(result[60]).all()
    assert np.isnan(result[:, 60]).all()
    assert np.isnan(result[0, 61:]).all()
    assert np.isfinite(result[:60, :60]).all()
    assert np.isfinite(result[61:, 61:]).all()


def stop_after(fraction):
    def progress(done, _text):
        if done >= fraction:
            raise Cancelled("enough")

    return progress


def counted(distance, monkeypatch):
    """The ids that are asked for from now on."""
    asked = []
    ask = distance.from_sources
    monkeypatch.setattr(distance, "from_sources", lambda ids, **how: (asked.extend(ids.tolist()), ask(ids, **how))[1])
    return asked


def test_goes_on_where_it_was_stopped(distance, tmp_path, monkeypatch):
    path, memory = tmp_path / "D.npy", 10 * 150 * 40
    with pytest.raises(Cancelled):
        write_all_pairs(distance, path, memory=memory, progress=stop_after(0.62))
    assert not path.exists()
    (partial,) = tmp_path.iterdir()
    with partial.open("r+b") as file:
        file.truncate(partial.stat().st_size - 5)  # the last row did not get to the disk
    asked = counted(distance, monkeypatch)
    write_all_pairs(distance, path, memory=memory)
    assert asked == list(range(89, 150))
    assert np.array_equal(np.load(path), distance.from_sources(np.arange(150)).T.astype(np.float32))
    assert [p.name for p in tmp_path.iterdir()] == ["D.npy"]


def test_what_was_begun_is_taken_up_by_another_distance_of_the_same_spec(distance, tmp_path, monkeypatch):
    path, spec = tmp_path / "D.npy", Spec.of("diffusion", t=0.3)
    with pytest.raises(Cancelled):
        write_all_pairs(spec.build(distance.laplacian), path, memory=10 * 150 * 40, progress=stop_after(0.62))
    again = spec.build(Laplacian(bumpy(150)))
    asked = counted(again, monkeypatch)
    write_all_pairs(again, path)
    assert asked == list(range(90, 150))


def test_takes_up_nothing_that_is_not_the_same(distance, tmp_path, monkeypatch):
    others = [
        (BiharmonicDistance(bumpy(150, seed=1)), np.float32),
        (distance, np.float64),
        (DiffusionDistance(distance.laplacian, t=1.0), np.float32),
        (DiffusionDistance(distance.laplacian, t=1.0 + 1e-9), np.float32),
    ]
    for number, (other, dtype) in enumerate(others):
        path = tmp_path / str(number) / "D.npy"
        path.parent.mkdir()
        with pytest.raises(Cancelled):
            write_all_pairs(distance, path, memory=10 * 150 * 40, progress=stop_after(0.5))
        assert len(list(path.parent.iterdir())) == 1
        asked = counted(other, monkeypatch)
        write_all_pairs(other, path, dtype)
        assert asked == list(range(150))
        monkeypatch.undo()


def test_what_was_begun_is_told_and_may_be_computed_anew(distance, tmp_path, monkeypatch):
    path, memory = tmp_path / "D.npy", 10 * 150 * 40
    assert begun(distance, path) is None
    with pytest.raises(Cancelled):
        write_all_pairs(distance, path, memory=memory, progress=stop_after(0.62))
    (partial,) = tmp_path.iterdir()
    known = begun(distance, path)
    assert (known.path, known.rows, known.n, known.bytes) == (partial, 90, 150, partial.stat().st_size)
    assert begun(distance, path, np.float64) is None
    assert left_by_others(distance, path) == []
    assert left_by_others(distance, path, np.float64) == [partial]
    assert left_by_others(distance, tmp_path / "D2.npy", np.float64) == []
    asked = counted(distance, monkeypatch)
    write_all_pairs(distance, path, fresh=True)
    assert asked == list(range(150))
    assert [p.name for p in tmp_path.iterdir()] == ["D.npy"]


def test_a_disk_too_small_is_refused_before_the_work(distance, tmp_path, monkeypatch):
    usage = namedtuple("usage", "free")
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage(80_000))
    asked = counted(distance, monkeypatch)
    with pytest.raises(OutputError, match=r"D\.npy cannot be written: it needs 0\.00 GB more"):
        write_all_pairs(distance, tmp_path / "D.npy")
    assert not asked
    assert not list(tmp_path.iterdir())


def test_refusals(distance, tmp_path):
    with pytest.raises(ParameterError, match="int32"):
        write_all_pairs(distance, tmp_path / "D.npy", np.int32)
    with pytest.raises(ParameterError, match="memory"):
        write_all_pairs(distance, tmp_path / "D.npy", memory=0)
    with pytest.raises(OutputError, match=r"\.csv"):
        write_all_pairs(distance, tmp_path / "D.csv")
    with pytest.raises(OutputError, match="no folder"):
        write_all_pairs(distance, tmp_path / "nowhere" / "D.npy")


def test_two_runs_into_one_file_do_not_mix(tmp_path):
    distance, path, refused = BiharmonicDistance(bumpy(60)), tmp_path / "all.npy", []

    def meanwhile(fraction, text):
        if 0 < fraction < 1 and not refused:
            with pytest.raises(OutputError, match=r"all\.npy is being written by another run; wait for it") as error:
                write_all_pairs(distance, path)
            refused.append(error)

    write_all_pairs(distance, path, memory=60 * 40 * 20, progress=meanwhile)
    assert refused
    assert np.load(path) == pytest.approx(distance.pairwise(np.arange(60)), rel=1e-6, abs=1e-6)
    assert [each.name for each in tmp_path.iterdir()] == ["all.npy"]
    write_all_pairs(distance, path)


@pytest.mark.skipif(os.name != "posix", reason="elsewhere files are not locked")
def test_a_run_that_comes_as_another_ends_is_refused(tmp_path, monkeypatch):
    """It has opened what is in its place by the time that it is locked."""
    distance, path, there = BiharmonicDistance(bumpy(60)), tmp_path / "all.npy", fcntl.flock

    def ended_before(file, how):
        os.replace(next(tmp_path.glob(".all-*.part")), path)
        there(file, how)

    monkeypatch.setattr(fcntl, "flock", ended_before)
    with pytest.raises(OutputError, match="is being written by another run"):
        write_all_pairs(distance, path)


@pytest.mark.skipif(os.name != "posix", reason="elsewhere files are not locked")
def test_a_file_system_without_locks_will_do(tmp_path, monkeypatch):
    def none(file, how):
        raise OSError(95, "Operation not supported")

    monkeypatch.setattr(fcntl, "flock", none)
    write_all_pairs(BiharmonicDistance(bumpy(60)), tmp_path / "all.npy")
    assert np.load(tmp_path / "all.npy").shape == (60, 60)
