"""How much memory there is: of the machine, of control groups of both versions, of a limit."""

import platform
import resource
import sys
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp

from bihdist_core import BiharmonicDistance, Laplacian, NotEnoughMemory, TruncatedBiharmonicDistance, machine_memory
from bihdist_core.analysis.all_pairs import check_block, write_all_pairs
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.kernel.library import library
from bihdist_core.machine_memory import available, check_memory, release_freed
from bihdist_core.solver import plain
from bihdist_core.solver.elimination_tree import canonical
from bihdist_core.solver.plain import PlainFactor, PlainTree
from bihdist_core.solver.spectrum import is_long
from bihdist_core.solver.worker_threads import Job
from tests.shapes import bumpy

GB = 10**9


@pytest.fixture
def machine(tmp_path):
    """Folders as those of a machine with 8 GB free; files by their names."""

    def make(group="", **files):
        for name, text in {"proc/meminfo": f"MemTotal: 9 kB\nMemAvailable: {8 * GB // 1024} kB\n", **files}.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        path = tmp_path / "proc/self/cgroup"
        path.parent.mkdir(exist_ok=True)
        path.write_text(group)
        return available(tmp_path / "proc", tmp_path / "groups")

    return make


def test_a_machine_without_groups_has_what_is_free(machine):
    assert machine() == pytest.approx(8 * GB, abs=1024)


def group(folder, limit, used, files=0):
    return {
        f"groups/{folder}memory.max": f"{limit}\n",
        f"groups/{folder}memory.current": f"{used}\n",
        f"groups/{folder}memory.stat": f"anon 5\ninactive_file {files}\n",
    }


def test_a_group_bounds_it_and_so_do_those_that_it_is_within(machine):
    assert machine("0::/a/b\n", **group("a/b/", 3 * GB, GB)) == 2 * GB
    assert machine("0::/a/b\n", **group("a/b/", 3 * GB, 2 * GB, GB)) == 2 * GB
    assert machine("0::/a/b\n", **group("a/b/", "max", GB), **group("a/", GB, 0)) == GB
    assert machine("0::/a/b\n", **group("a/b/", GB, 2 * GB)) == 0


def test_a_container_sees_its_own_group_as_the_root(machine):
    assert machine("0::/docker/12\n", **group("", 4 * GB, GB)) == 3 * GB


def test_a_group_of_version_1(machine):
    files = {
        "groups/memory/a/memory.limit_in_bytes": f"{2 * GB}",
        "groups/memory/a/memory.usage_in_bytes": f"{GB}",
        "groups/memory/a/memory.stat": "total_inactive_file 0\n",
    }
    assert machine("3:cpu:/x\n2:memory:/a\n", **files) == GB


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only there limits of a process are told")
def test_a_limit_of_the_process_bounds_it(monkeypatch, machine):
    monkeypatch.setattr(resource, "getrlimit", lambda _: (10**6 * resource.getpagesize(), 0))
    assert machine(**{"proc/self/statm": "999000 1 1\n"}) == 1000 * resource.getpagesize()


def test_what_has_no_room_is_a_sentence_with_the_choices(monkeypatch):
    monkeypatch.setattr(machine_memory, "available", lambda: GB)
    check_memory(0.99 * GB, "It", "choose less.")
    with pytest.raises(NotEnoughMemory, match=r"It needs about 2.5 GB of memory, and 1 GB are free here; choose less."):
        check_memory(2.5 * GB, "It", "choose less.")


@pytest.mark.skipif(not library(), reason="it is the compiled factor that knows its memory")
def test_a_factor_without_room_is_refused_before_it_is_made_and_made_once_there_is(monkeypatch):
    surface, spec = bumpy(3000), Spec.of("biharmonic")
    distances = Distances(Laplacian(surface))
    with monkeypatch.context() as patch:
        patch.setattr(machine_memory, "SMALL_BYTES", 0)
        patch.setattr(machine_memory, "available", lambda: 1000)
        answer = distances.answer(spec, 5)
    assert answer.field is None
    for words in ("The factor for 3,000 vertices needs about", "fewer panels", "--simplify", "cluster"):
        assert words in answer.failure
    assert np.isfinite(distances.answer(spec, 5).field).all()


@pytest.mark.skipif(not library(), reason="it is the compiled factor that knows its memory")
def test_a_factor_asks_for_no_less_than_it_takes(monkeypatch):
    asked = []
    monkeypatch.setattr("bihdist_core.solver.compiled_factor.check_memory", lambda needed, *_: asked.append(needed))
    factor = Laplacian(bumpy(3000)).components[0].factor(diagonals=True)
    assert factor.nbytes <= asked[0] < 6 * factor.nbytes


def test_the_plain_factor_asks_for_about_what_it_takes(monkeypatch):
    surface, asked = bumpy(1500), []
    component = Laplacian(surface).components[0]
    tree = PlainTree(canonical(component.stiffness), surface.vertices)
    matrix = canonical(component.stiffness + sp.identity(1500))
    monkeypatch.setattr(plain, "check_memory", lambda needed, *_: asked.append(needed))
    for areas in (None, component.areas):
        tracemalloc.start()
        PlainFactor(tree, matrix, areas, Job(None, "", 1))
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert 0.8 * most < asked.pop() < 1.5 * most


def test_eigenpairs_ask_for_about_what_they_take(monkeypatch):
    asked = []
    monkeypatch.setattr("bihdist_core.laplacian.check_memory", lambda needed, *_: asked.append(needed))
    component = Laplacian(bumpy(20_000)).components[0]
    component.factor(diagonals=True)
    assert not is_long(20_000, 60)
    tracemalloc.start()
    component.spectrum(60)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.8 * most < asked[0] < 1.5 * most


def test_what_has_no_room_for_eigenpairs_or_a_block_of_pairs_says_so(monkeypatch, tmp_path):
    distance = BiharmonicDistance(bumpy(3000))
    monkeypatch.setattr(machine_memory, "SMALL_BYTES", 0)
    monkeypatch.setattr(machine_memory, "available", lambda: 10**6)
    with pytest.raises(
        NotEnoughMemory, match=r"Finding 201 eigenpairs of 3,000 vertices needs about .*take fewer.*simplify.*cl"
    ):
        TruncatedBiharmonicDistance(distance.laplacian, 200)
    with pytest.raises(NotEnoughMemory, match=r"A block of 3,000 x 3,000 distances needs about .*--memory.*cluster"):
        write_all_pairs(distance, tmp_path / "all.npy")
    assert not list(tmp_path.iterdir())
    with pytest.raises(NotEnoughMemory, match=r"A block of 10 x 100,000 distances"):
        check_block(100_000, 4e7)
    write_all_pairs(distance, tmp_path / "all.npy", memory=9e5)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc keeps what is freed")
def test_freed_memory_is_returned_to_the_system():
    def resident():
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()

    # Too small for maps of their own, and the last one keeps the heap from shrinking.
    blocks = [bytes(10_000) for _ in range(10_000)]
    last = blocks[-1]
    blocks.clear()
    before = resident()
    release_freed()
    assert before - resident() > 5e7, len(last)
