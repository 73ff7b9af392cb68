"""Rows 21 and 22: many meshes in one command, and means between parcels without the distances between all vertices."""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from bihdist_core import BiharmonicDistance, Surface, read_surface, write_mesh
from bihdist_core.analysis.parcels import parcel_means
from bihdist_core.applications.perturbation import noisy
from bihdist_core.applications.resizing import resized

from . import peers
from .child import forget_peak, in_child, peak_memory
from .size import Size
from .table import Line

ROOT = Path(__file__).resolve().parents[2]
LEAST, MOST = 2_000, 28_000
"""Vertices of the meshes of the set."""
BATCH_BOUND = 0.5
"""Of the time of a plain loop over potpourri3d's heat method, on one core for each of ours."""
MEMORY_BOUND = 1e9
"""Bytes of the largest process."""
PARCEL_MEMORY = 2e9
SAME, SINGLE = 1e-9, 1e-6
"""Of the maximum, in double and in single precision."""


def batch(size: Size) -> Iterator[Line]:
    """The set in one command, with as many workers as there are cores, and the scaling over workers."""
    with tempfile.TemporaryDirectory() as place:
        meshes, few = Path(place, "meshes"), Path(place, "few")
        names = _set(meshes, size.meshes)
        few.mkdir()
        for name in names[:: max(1, len(names) // 20)]:
            os.link(meshes / name, few / name)
        workers = os.cpu_count() or 1
        seconds, memory = in_child(_batch_alone, meshes, Path(place, "out"), size.sources, workers)
        looped = _loop(few, size.sources) / sum(f.stat().st_size for f in few.iterdir())
        peer = looped * sum(f.stat().st_size for f in meshes.iterdir())
        # By the first mesh, field by field.
        out = Path(place, "out")
        (first, *_) = sorted(out.glob("*.fields.*.json"))
        facts = json.loads(first.read_text())
        distance = BiharmonicDistance(read_surface(meshes / facts["mesh"]))
        expected = distance.from_sources(facts["sources"])
        error = float(np.abs(np.load(out / facts["file"]) - expected).max() / expected.max())
        yield Line(
            21,
            f"{len(names)} meshes of {LEAST:,} to {MOST:,} vertices, {size.sources} sources each, on {workers} cores",
            seconds,
            peer,
            seconds / peer,
            bound=BATCH_BOUND,
            memory=memory,
            error=error,
            tolerance=SINGLE,
            note=f"peer: a loop over potpourri3d's heat method, of {len(list(few.iterdir()))} meshes by their sizes",
        )
        yield Line(
            21,
            "the largest of its processes: GB against 1",
            seconds,
            value=memory / MEMORY_BOUND,
            bound=1.0,
            memory=memory,
        )
        if size.is_quick:  # what follows is the same command on the same meshes
            return
        one = _batch(few, Path(place, "one"), size.sources, 1)
        for count in [n for n in (2, 4) if n <= workers]:
            several = _batch(few, Path(place, f"of{count}"), size.sources, count)
            yield Line(
                21,
                f"the same of {len(list(few.iterdir()))} meshes with {count} workers, against one",
                several,
                one,
                several / one,
                bound=1.0,
                note=f"{one / several / count:.0%} of {count} times the speed of one worker",
            )


def parcels(size: Size) -> Iterator[Line]:
    """Two cortex-like components, alone in a process."""
    seconds, memory, n, p = in_child(_parcels, size.cortex, size.parcels)
    surface, labels = _cortex(400, 6)
    rows = BiharmonicDistance(surface).from_sources(np.arange(len(labels)))
    of = [labels == k for k in range(labels.max() + 1)]
    expected = np.array([[rows[np.ix_(a, b)].mean() for b in of] for a in of])
    found = parcel_means(BiharmonicDistance(surface), labels, memory=1e5).distances
    is_same = np.array_equal(np.isnan(found), np.isnan(expected))
    yield Line(
        22,
        f"means between {p} parcels of two components, {n:,} vertices: seconds, and GB against 2",
        seconds,
        value=memory / PARCEL_MEMORY,
        bound=1.0,
        memory=memory,
        error=float(np.nanmax(np.abs(found - expected)) / np.nanmax(expected)) if is_same else np.inf,
        tolerance=SAME,
        note="every column once; error: against the means of full rows on a small one",
    )


# ---------------------------------------------------------------------- meshes
def _set(folder: Path, count: int) -> list[str]:
    """Samples in other sizes, with noise, bent: the names of the files."""
    folder.mkdir()
    # The machine part cannot be simplified as far as that.
    samples = [path for path in sorted((ROOT / "assets").glob("*.ply")) if path.stem != "part"]
    sizes = np.geomspace(LEAST, MOST, count).astype(int).tolist() if count > 4 else [LEAST] * count
    made = [
        (samples[k % len(samples)], size, folder / f"{samples[k % len(samples)].stem}_{k:03}.ply", k)
        for k, size in enumerate(sizes)
    ]
    if count < 4:  # sooner made than a process is
        list(map(_one_of_set, made))
    else:
        with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
            list(pool.map(_one_of_set, made))
    return [path.name for _, _, path, _ in made]


def _one_of_set(made: tuple[Path, int, Path, int]) -> None:
    sample, size, path, seed = made
    surface = noisy(resized(read_surface(sample), size), 0.1, seed=seed, along="normals")
    write_mesh(path, _bent(surface, float(np.random.default_rng(seed).uniform(-0.5, 0.5))))


def _bent(surface: Surface, angle: float) -> Surface:
    """Turned about the longest axis, more the farther along it, by so many radians at the end."""
    x = surface.vertices - surface.vertices.mean(axis=0)
    axis = int(np.ptp(x, axis=0).argmax())
    u, v = (k for k in range(3) if k != axis)
    turn = angle * x[:, axis] / np.abs(x[:, axis]).max()
    bent = x.copy()
    bent[:, u] = np.cos(turn) * x[:, u] - np.sin(turn) * x[:, v]
    bent[:, v] = np.sin(turn) * x[:, u] + np.cos(turn) * x[:, v]
    return Surface(bent, surface.faces)


def _cortex(vertices: int, parcels: int) -> tuple[Surface, np.ndarray]:
    """Two folded spheres beside each other with so many vertices together, and a label for each vertex."""
    from .meshes import bumpy_sphere

    x, faces = bumpy_sphere(vertices // 2)
    radius = np.linalg.norm(x, axis=1, keepdims=True)
    unit = x / radius
    folds = 1 + 0.08 * np.sin(23 * unit[:, :1] + 3 * np.sin(9 * unit[:, 1:2])) * np.cos(17 * unit[:, 2:])
    half = unit * folds
    both = np.concatenate([half - [1.2, 0, 0], half * [-1, 1, 1] + [1.2, 0, 0]])
    seeds = np.random.default_rng(22).choice(len(half), parcels // 2, replace=False)
    from scipy.spatial import KDTree

    _, near = KDTree(unit[seeds]).query(unit)
    labels = np.concatenate([near, near + len(seeds)])
    return Surface(both, np.concatenate([faces, faces[:, ::-1] + len(half)])), labels


# ---------------------------------------------------------------------- what is timed
def _batch(meshes: Path, out: Path, sources: int, workers: int) -> float:
    words = [sys.executable, "-m", "app", "batch", str(meshes), "-o", str(out), "--do", "fields"]
    words += ["--sources", f"farthest:{sources}", "--dtype", "float32", "--workers", str(workers)]
    begin = time.perf_counter()
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    return time.perf_counter() - begin


def _batch_alone(meshes: Path, out: Path, sources: int, workers: int) -> tuple[float, int]:
    """Return the seconds of a batch and the bytes of its largest process, to be called in a new process.

    Elsewhere the largest would be any child there has ever been, and a child's peak begins with its parent's.
    """
    seconds = _batch(meshes, out, sources, workers)
    return seconds, 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


def _loop(meshes: Path, sources: int) -> float:
    """A plain loop: farthest points, a field each, one array a mesh."""
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as out:
        for path in sorted(meshes.iterdir()):
            surface = read_surface(path)
            solver = peers.heat_solver(surface.vertices, surface.faces)
            fields, nearest, at = [], np.full(len(surface.vertices), np.inf), 0
            for _ in range(sources):
                fields.append(solver.compute_distance(at))
                nearest = np.minimum(nearest, fields[-1])
                at = int(nearest.argmax())
            np.save(Path(out, path.stem), np.array(fields, np.float32).T)
    return time.perf_counter() - begin


def _parcels(vertices: int, count: int) -> tuple[float, int, int, int]:
    surface, labels = _cortex(vertices, count)
    forget_peak()
    begin = time.perf_counter()
    found = parcel_means(BiharmonicDistance(surface), labels)
    return time.perf_counter() - begin, peak_memory(), len(surface.vertices), len(found.labels)
