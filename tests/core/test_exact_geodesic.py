"""Exact geodesic distance: known shapes, reference values, and the life of the process that computes it."""

import gc
import importlib.util
import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from bihdist_core.distances import exact_geodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.errors import Cancelled, ParameterError, SolverError, VertexError
from bihdist_core.surface import Surface
from tests.shapes import ORACLE, ORACLE_NAMES, needs_oracle, oracle_surface

ROUNDING = 1e-9
"""Of the largest distance: pygeodesic drops windows shorter than about 1e-10 of an edge."""


def grid(k):
    """A flat square of k x k cells of side 1."""
    x, y = np.meshgrid(np.arange(k + 1.0), np.arange(k + 1.0))
    a = (np.arange(k)[:, None] * (k + 1) + np.arange(k)).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + k + 2], 1), np.stack([a, a + k + 2, a + k + 1], 1)])
    return Surface(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], 1), faces)


def sphere(rounds):
    """The unit sphere: an octahedron, each face split into four, `rounds` times."""
    x = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    f = np.array([[a, b, c] for a in (0, 1) for b in (2, 3) for c in (4, 5)])
    for _ in range(rounds):
        pairs = np.sort(np.concatenate([f[:, [1, 2]], f[:, [2, 0]], f[:, [0, 1]]]), axis=1)
        edges, middle = np.unique(pairs, axis=0, return_inverse=True)
        a, b, c = middle.reshape(3, -1) + len(x)
        x = np.concatenate([x, x[edges].mean(axis=1)])
        x /= np.linalg.norm(x, axis=1, keepdims=True)
        p, q, r = f.T
        f = np.concatenate([np.stack(t, 1) for t in [(p, c, b), (c, q, a), (b, a, r), (a, b, c)]])
    return Surface(x, f)


def gone(process):
    if process.poll() is None:
        return False
    if os.name == "posix":
        with pytest.raises(ProcessLookupError):
            os.kill(process.pid, 0)
    return True


def at_report(action):
    """A progress that acts at its first report."""

    def progress(_fraction, _text):
        action()

    return progress


def cancel():
    raise Cancelled("stop")


def test_flat_square_is_euclidean():
    surface = grid(12)
    for source in (0, 84, 90):
        expected = np.linalg.norm(surface.vertices - surface.vertices[source], axis=1)
        np.testing.assert_allclose(ExactGeodesic(surface).distances(source), expected, atol=ROUNDING * 17)


def test_sphere_converges_to_great_circles():
    errors = []
    for rounds in (2, 3, 4):
        surface = sphere(rounds)
        angle = np.arccos(np.clip(surface.vertices @ surface.vertices[0], -1, 1))
        errors.append(np.abs(ExactGeodesic(surface).distances(0) - angle).max())
    # Second order: halving the edges divides the error by about 4.
    assert errors[0] / errors[1] > 3
    assert errors[1] / errors[2] > 3


def test_symmetric_and_scales_like_length():
    surface = sphere(2)
    solver = ExactGeodesic(surface)
    d = np.stack([solver.distances(v) for v in range(0, 66, 13)])[:, ::13]
    np.testing.assert_allclose(d, d.T, atol=ROUNDING * np.pi)
    # Edges reach pygeodesic near length 1, so a scale of 1e-9 meets none of its absolute tolerances.
    for scale in (1e-9, 3.0):
        scaled = ExactGeodesic(Surface(surface.vertices * scale, surface.faces)).distances(0)
        np.testing.assert_allclose(scaled, solver.distances(0) * scale, rtol=0, atol=ROUNDING * np.pi * scale)


def test_flat_faces_do_no_harm():
    corners = np.array([[0, 0, 0], [2, 0, 0], [1, 0, 0], [1, 1, 0], [1, -1, 0]], float)
    surface = Surface(corners, [[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 4]])
    assert len(surface.degenerate_faces) == 1
    expected = np.linalg.norm(corners - corners[4], axis=1)
    np.testing.assert_allclose(ExactGeodesic(surface).distances(4), expected, atol=ROUNDING * 2)


@needs_oracle
@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_reference_values(name):
    solver = ExactGeodesic(oracle_surface(name))
    expected = np.load(ORACLE / f"{name}_exactgeo_pygeodesic.npy")
    for column, source in enumerate(np.loadtxt(ORACLE / f"{name}_sources0.txt", dtype=int)[:3]):
        error = np.abs(solver.distances(source) - expected[:, column]).max()
        assert error <= 1e-8 * expected.max()  # the same program on the same mesh, but for the unit


def test_the_mesh_is_sent_once():
    solver = ExactGeodesic(grid(4))
    solver.distances(0)
    process = solver._child.process
    solver.distances(3)
    assert solver._child.process is process


def test_two_objects_and_many_threads():
    surfaces = [grid(6), sphere(2)]
    solvers = [ExactGeodesic(s) for s in surfaces]
    got = {}
    threads = [
        threading.Thread(target=lambda k=k, v=v: got.__setitem__((k, v), solvers[k].distances(v)))
        for k in (0, 1)
        for v in range(0, 40, 7)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(got) == len(threads)
    for (k, v), d in got.items():
        assert d[v] == 0
        assert np.array_equal(d, solvers[k].distances(v))


def test_who_waits_comes_before_who_asks_again():
    solver, order, has_begun = ExactGeodesic(grid(3)), [], threading.Event()

    def waits(share, text):
        has_begun.set()

    def ask():
        with solver._my_turn(waits):
            order.append("other")

    other = threading.Thread(target=ask)
    with solver._my_turn(waits):
        assert not has_begun.is_set()
        other.start()
        assert has_begun.wait(30)
    with solver._my_turn(waits):
        order.append("again")
    other.join(30)
    assert order == ["other", "again"]


def test_cancelling_kills_the_process_and_the_next_call_works(monkeypatch):
    # 4098 vertices take some 50 times longer, so the report comes while the process is at work.
    monkeypatch.setattr(exact_geodesic, "REPORT_EVERY", 0.001)
    solver = ExactGeodesic(sphere(5))
    expected = solver.distances(0)
    process = solver._child.process
    with pytest.raises(Cancelled):
        solver.distances(1, at_report(cancel))
    assert gone(process)
    assert np.array_equal(solver.distances(0), expected)


def test_progress_rises_below_one(monkeypatch):
    monkeypatch.setattr(exact_geodesic, "REPORT_EVERY", 0.01)
    seen = []
    ExactGeodesic(sphere(5)).distances(0, lambda fraction, text: seen.append((fraction, text)))
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions)
    assert all(0 <= fraction < 1 and text.startswith("exact geodesic") for fraction, text in seen)
    assert seen


def test_a_crash_is_a_solver_error_and_the_next_call_works(monkeypatch):
    monkeypatch.setattr(exact_geodesic, "REPORT_EVERY", 0.001)
    solver = ExactGeodesic(sphere(5))
    solver.distances(1)
    with pytest.raises(SolverError, match="died"):
        solver.distances(0, at_report(lambda: solver._child.process.kill()))
    # Between two questions as well.
    assert solver.distances(0)[0] == 0
    process = solver._child.process
    process.kill()
    process.wait()
    with pytest.raises(SolverError, match="died"):
        solver.distances(0)


def test_the_process_ends_with_its_object():
    solver = ExactGeodesic(grid(3))
    solver.distances(0)
    process = solver._child.process
    del solver
    gc.collect()
    assert gone(process)


def test_a_script_without_main_guard_exits_and_leaves_no_process():
    script = """
import numpy as np
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.surface import Surface
solver = ExactGeodesic(Surface(np.eye(3), [[0, 1, 2]]))
solver.distances(0)
print(solver._child.process.pid)
"""
    root = str(Path(exact_geodesic.__file__).parents[1])
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", script],
        capture_output=True,
        text=True,
        timeout=30,
        env={**os.environ, "PYTHONPATH": root},
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.count("\n") == 1
    if os.name == "posix":
        with pytest.raises(ProcessLookupError):
            os.kill(int(run.stdout), 0)


def test_huge_values_become_nan(monkeypatch):
    monkeypatch.setattr(exact_geodesic, "UNREACHED", 1.5)
    d = ExactGeodesic(grid(2)).distances(0)
    assert np.isnan(d).sum() == 5
    assert np.nanmax(d) < 1.5


def test_refusals(monkeypatch):
    triangle = np.eye(3)
    fan = np.concatenate([triangle, [[1, 1, 1], [2, 0, 1]]])
    with pytest.raises(ParameterError, match="heat method"):
        ExactGeodesic(Surface(fan, [[0, 1, 2], [0, 1, 3], [0, 1, 4]]))
    with pytest.raises(ParameterError, match="connected piece"):
        ExactGeodesic(Surface(fan, [[0, 1, 2]]))
    with pytest.raises(VertexError):
        ExactGeodesic(Surface(triangle, [[0, 1, 2]])).distances(3)
    with monkeypatch.context() as patch:
        patch.setattr(sys, "frozen", True, raising=False)
        with pytest.raises(SolverError, match="interpreter"):
            ExactGeodesic(Surface(triangle, [[0, 1, 2]]))
    monkeypatch.setattr(importlib.util, "find_spec", lambda _name: None)
    with pytest.raises(SolverError, match="pygeodesic"):
        ExactGeodesic(Surface(triangle, [[0, 1, 2]]))


def test_what_the_process_says_reaches_the_user(monkeypatch):
    solver = ExactGeodesic(Surface(np.eye(3), [[0, 1, 2]]))
    monkeypatch.setattr(sys, "path", [])
    with pytest.raises(SolverError, match="No module named 'numpy'"):
        solver.distances(0)
