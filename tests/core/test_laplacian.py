"""The Laplacian's components and what they compute once."""

import threading
import time

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    Laplacian,
    ParameterError,
    SolverError,
    VertexError,
    eigenpairs,
)
from bihdist_core.operators import operators
from bihdist_core.progress import part
from bihdist_core.solver.blas import one_blas_thread
from tests import dense_reference as dense
from tests.shapes import bumpy, grid, spike, torus, two_pieces


def test_eigenpairs_of_one_component():
    s = torus()
    spectrum = eigenpairs(s, 20)
    values, _ = dense.full_spectrum(s)
    assert spectrum.eigenvalues == pytest.approx(values[:20], rel=1e-8)
    lap = Laplacian(s)
    residual = lap.stiffness @ spectrum.eigenvectors - lap.areas[:, None] * spectrum.eigenvectors * spectrum.eigenvalues
    assert np.abs(residual).max() < 1e-5


def test_eigenpairs_of_several_components_are_merged_and_leave_their_constants_out():
    s = two_pieces()
    spectrum = eigenpairs(s, 40)
    parts = [dense.full_spectrum(s.component(k)[0])[0] for k in (0, 1)]
    assert spectrum.eigenvalues == pytest.approx(np.sort(np.concatenate(parts))[:40], rel=1e-8)
    assert (spectrum.eigenvectors[60] == 0).all()
    areas = Laplacian(s).areas
    gram = spectrum.eigenvectors.T @ (areas[:, None] * spectrum.eigenvectors)
    assert np.abs(gram - np.eye(40)).max() < 1e-8


def test_all_eigenpairs_there_are_and_not_one_more():
    s = two_pieces()
    assert len(eigenpairs(s, 59 + 3).eigenvalues) == 62
    for count in (0, 63):
        with pytest.raises(ParameterError, match=f"62 eigenpairs besides the constant, and k is {count}"):
            eigenpairs(s, count)


def test_the_spectrum_grows_and_is_kept():
    component = Laplacian(bumpy(500)).components[0]
    small = component.spectrum(10)
    assert component.spectrum(5) is small
    large = component.spectrum(30)
    assert large.eigenvalues[:10] == pytest.approx(small.eigenvalues, rel=1e-9)


def test_the_factor_and_its_diagonals_are_computed_once():
    component = Laplacian(grid(8, 8)).components[0]
    plain = component.factor()
    assert component.factor() is plain
    full = component.factor(diagonals=True)
    assert full is not plain
    assert component.factor() is full
    assert component.tree() is component.tree()


def test_a_cancelled_factor_leaves_nothing_behind():
    component = Laplacian(bumpy(500)).components[0]

    def stop(_fraction, _text):
        raise Cancelled

    with pytest.raises(Cancelled):
        component.factor(stop)
    b = np.zeros(500)
    b[[1, 2]] = 1, -1
    x = component.solve(b)
    assert np.abs(component.stiffness @ x - b).max() < 1e-10


def test_several_threads_may_ask_at_once():
    lap, results = Laplacian(bumpy(500)), {}

    def ask(source):
        results[source] = BiharmonicDistance(lap).from_source(source)

    threads = [threading.Thread(target=ask, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone = BiharmonicDistance(bumpy(500)).from_sources(np.arange(6))
    for source, field in results.items():
        assert np.abs(field - alone[:, source]).max() <= 1e-9 * alone.max()  # rounding of sums in another order
    assert len(results) == 6


def test_vertices_find_their_component():
    lap = Laplacian(two_pieces())
    assert [lap.component_of(v).index for v in (0, 59, 61)] == [0, 0, 1]
    assert lap.components[1].local(np.array([61, 64])).tolist() == [0, 3]
    with pytest.raises(VertexError):
        lap.component_of(60)


def test_blas_has_one_thread_inside_and_its_own_again_outside():
    from threadpoolctl import threadpool_info

    def threads():
        return [lib["num_threads"] for lib in threadpool_info() if lib["user_api"] == "blas"]

    before = threads()
    with one_blas_thread():
        with one_blas_thread():
            assert set(threads()) <= {1}
        assert set(threads()) <= {1}
    assert threads() == before


def test_a_part_of_a_progress_is_its_share():
    said = []
    half = part(lambda fraction, text: said.append((fraction, text)), 0.5, 1)
    half(0.5, "x")
    assert said == [(0.75, "x")]
    part(None, 0, 1)(0.3, "nobody listens")


def test_what_cannot_be_computed_names_the_mesh_and_what_would_help():
    component = Laplacian(spike(60, 1e13)).components[0]
    with pytest.raises(SolverError, match=r"spike: The first 10 eigenpairs cannot be found .* Remeshing would help"):
        component.spectrum(10)
    component = Laplacian(bumpy(60)).components[0]
    component.stiffness = -component.stiffness
    with pytest.raises(SolverError, match=r"The Laplacian of bumpy cannot be factored: .* Remeshing would help"):
        component.factor()


def test_what_is_computed_once_is_so_for_several_threads(monkeypatch):
    calls, start = [], threading.Barrier(4)

    def slow(*of):
        calls.append(of)
        time.sleep(0.05)
        return operators(*of)

    monkeypatch.setattr("bihdist_core.laplacian.operators", slow)
    laplacian, found = Laplacian(bumpy(60)), []

    def ask():
        start.wait()
        found.append(laplacian.stiffness)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(calls) == 1
    assert all(matrix is found[0] for matrix in found)


def test_laplacians_and_distances_say_what_they_are():
    laplacian = Laplacian(bumpy(60), "barycentric")
    assert repr(laplacian) == "Laplacian(Surface(bumpy: 60 vertices, 116 faces), barycentric areas)"
    distance = BiharmonicDistance(laplacian)
    assert repr(distance) == "BiharmonicDistance(biharmonic, exact, on Surface(bumpy: 60 vertices, 116 faces))"
