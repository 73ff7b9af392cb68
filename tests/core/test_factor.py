"""The factor against dense inverses, on graphs of all kinds, and what it promises beside numbers.

All of it holds for the compiled kernel and for the plain one.
"""

import threading
import time

import numpy as np
import pytest
import scipy.sparse as sp

from bihdist_core.errors import Cancelled, ParameterError, SolverError
from bihdist_core.kernel.library import library
from bihdist_core.solver import compiled_tree, elimination_tree
from bihdist_core.solver.blas import one_blas_thread
from bihdist_core.solver.elimination_tree import EliminationTree
from bihdist_core.solver.factor import Factor
from bihdist_core.solver.worker_threads import without_workers
from tests.core.graphs import SHAPES, grid, laplacian, path, star
from tests.waiting import PATIENCE

# Conditions are at most about 1e4 here, and a backward stable solve loses one digit per power of ten.
CLOSE = 1e-11

compiled = pytest.mark.skipif(library() is None, reason="there is no compiled kernel")


@pytest.fixture(params=[pytest.param("compiled", marks=compiled), "plain"], autouse=True)
def kernel(request, monkeypatch):
    if request.param == "plain":
        monkeypatch.setattr(elimination_tree, "library", lambda: None)


@pytest.fixture(params=SHAPES)
def shape(request):
    # Also for the dense reference: OpenBLAS' threads are slow on busy cores.
    with one_blas_thread():
        yield _with_areas(request.param)


def _with_areas(name):
    matrix, x = SHAPES[name]
    n = len(x)
    areas = np.random.default_rng(5).uniform(0, 2, n) * (np.arange(n) % 7 > 0)
    return matrix, x, areas


def close(value, exact, tolerance=CLOSE):
    return np.abs(value - exact).max(initial=0) <= tolerance * np.abs(exact).max(initial=0)


def test_all_equal_the_dense_inverse(shape):
    matrix, x, areas = shape
    n = len(x)
    factor = Factor(EliminationTree(matrix, x), matrix, areas)
    inverse = np.linalg.inv(matrix.toarray())
    sandwich = inverse @ (areas[:, None] * inverse)
    assert close(factor.diagonal, np.diag(inverse))
    assert close(factor.sandwich_diagonal, np.diag(sandwich))
    b = np.random.default_rng(0).normal(size=(n, 70))
    for k in (0, 1, 3, 20, 70):
        assert factor.solve(b[:, :k]).shape == (n, k)
        assert close(factor.solve(b[:, :k]), inverse @ b[:, :k])
    assert close(factor.solve(b[:, 0]), inverse @ b[:, 0])
    for k in (0, 1, 3, 50):
        index = np.random.default_rng(k).integers(0, n, k) if n else np.zeros(0, int)
        assert factor.sandwich_columns(index).shape == (n, len(index))
        assert close(factor.sandwich_columns(index), sandwich[:, index])


def test_right_hand_sides_of_few_entries(shape):
    """They take a way of their own up the tree."""
    matrix, x, _ = shape
    n = len(x)
    if n < 2:
        return
    factor = Factor(EliminationTree(matrix, x), matrix)
    inverse = np.linalg.inv(matrix.toarray())
    for rows in ([0], [n - 1, n // 2], np.arange(0, n, max(1, n // 5))):
        b = np.zeros((n, 2))
        b[rows] = np.random.default_rng(0).normal(size=(len(rows), 2))
        b[rows[0], 1] = 0
        assert close(factor.solve(b), inverse @ b)


def test_a_block_equals_its_columns():
    matrix, x = grid(30, 40)
    factor = Factor(EliminationTree(matrix, x), matrix, np.ones(1200))
    b = np.random.default_rng(0).normal(size=(1200, 80))
    # Only the order of additions differs.
    assert close(factor.solve(b), np.stack([factor.solve(c) for c in b.T], 1), 1e-13)
    index = np.arange(0, 1200, 20)
    singles = np.concatenate([factor.sandwich_columns([k]) for k in index], axis=1)
    assert close(factor.sandwich_columns(index), singles, 1e-13)


def test_columns_agree_with_diagonals_and_with_two_solves():
    matrix, x = grid(40, 60)
    areas = np.random.default_rng(0).uniform(size=2400)
    factor = Factor(EliminationTree(matrix, x), matrix, areas)
    index = np.arange(0, 2400, 37)
    columns = factor.sandwich_columns(index)
    assert close(columns[index, np.arange(len(index))], factor.sandwich_diagonal[index])
    unit = np.eye(2400)[:, index]
    assert close(columns, factor.solve(areas[:, None] * factor.solve(unit)))


def test_a_hub_of_ten_thousand_edges():
    n = 10_001
    matrix, x = star(n)
    factor = Factor(EliminationTree(matrix, x), matrix, np.ones(n))
    b = np.random.default_rng(0).normal(size=n)
    # Rounding of 1e-16 times entries of 1e4 times a solution of about 1e2.
    assert close(matrix @ factor.solve(b), b, 1e-9)
    assert factor.nbytes < 100e6


def test_a_needle():
    n = 20_000
    matrix, x = path(n)
    factor = Factor(EliminationTree(matrix, x), matrix, np.ones(n))
    # Resistance in series: as many ohms as edges from the pin; the condition is about n^2 = 4e8.
    exact = np.abs(np.arange(n) - n // 2).astype(float)
    exact[n // 2] = 1
    assert close(factor.diagonal, exact, 1e-8)


def test_one_tree_serves_matrices_with_fewer_entries():
    matrix, x = grid(30, 40)
    tree = EliminationTree(matrix, x)
    fewer = matrix.tolil()
    fewer[500, :], fewer[:, 500] = 0, 0
    fewer[500, 500] = 2
    for other in (matrix * 3, sp.csr_matrix(fewer), sp.diags(np.arange(1.0, 1201)), fewer.tocsr().tocsc()):
        b = np.random.default_rng(0).normal(size=1200)
        assert close(other @ Factor(tree, other).solve(b), b)


def test_equal_input_gives_equal_bits():
    matrix, x = grid(40, 60)
    areas = np.random.default_rng(0).uniform(size=2400)
    b = np.random.default_rng(0).normal(size=(2400, 70))

    def everything():
        factor = Factor(EliminationTree(matrix.copy(), x.copy()), matrix.copy(), areas.copy())
        return (
            factor.diagonal,
            factor.sandwich_diagonal,
            factor.solve(b),
            factor.solve(b[:, 0]),
            factor.sandwich_columns([5]),
        )

    first = everything()
    for _ in range(3):
        for one, other in zip(first, everything(), strict=True):
            assert np.array_equal(one, other)


def test_inputs_stay_as_they_are():
    matrix, x = grid(30, 40)
    # Explicit zeros and unsorted indices are things SciPy may tidy in place.
    matrix = matrix + sp.coo_matrix((np.zeros(1), ([3], [900])), shape=matrix.shape) * 0
    before = matrix.copy()
    areas, b = np.ones(1200), np.ones((1200, 40))
    copies = x.copy(), areas.copy(), b.copy()
    factor = Factor(EliminationTree(matrix, x), matrix, areas)
    factor.solve(b)
    factor.solve(b[:, :1])
    for name in ("data", "indices", "indptr"):
        assert np.array_equal(getattr(matrix, name), getattr(before, name))
    for one, other in zip(copies, (x, areas, b), strict=True):
        assert np.array_equal(one, other)


def test_repeated_entries_are_summed_and_sparse_formats_do_not_matter():
    matrix, x = grid(30, 40)
    b = np.random.default_rng(0).normal(size=1200)
    exact = Factor(EliminationTree(matrix, x), matrix).solve(b)
    coo = matrix.tocoo()
    order = np.random.default_rng(0).permutation(2 * coo.nnz)
    ends = np.r_[coo.row, coo.row][order], np.r_[coo.col, coo.col][order]
    twice = sp.coo_matrix((np.r_[coo.data, coo.data][order] / 2, ends), shape=coo.shape)
    # Rows in disorder, each entry in two halves.
    start = np.r_[0, np.cumsum(np.bincount(ends[0], minlength=1200))]
    rows = np.argsort(ends[0], kind="stable")
    unsorted = sp.csr_matrix((twice.data[rows], ends[1][rows], start), shape=coo.shape)
    for other in (twice, unsorted, matrix.tocsc(), sp.csr_array(matrix)):
        assert np.array_equal(Factor(EliminationTree(other, x), other).solve(b), exact)
    assert unsorted.nnz == 2 * coo.nnz


def test_right_hand_sides_of_any_kind():
    matrix, x = grid(20, 30)
    factor = Factor(EliminationTree(matrix, x), matrix)
    b = np.arange(600)
    exact = factor.solve(b.astype(float))
    assert np.array_equal(factor.solve(b), exact)
    assert np.array_equal(factor.solve(list(b)), exact)
    assert close(factor.solve(np.asfortranarray(np.stack([b, b], 1).astype(float)))[:, 1], exact, 1e-14)
    assert np.array_equal(factor.solve(np.repeat(b.astype(float), 2)[::2]), exact)


def test_several_threads_at_once():
    matrix, x = grid(40, 60)
    factor = Factor(EliminationTree(matrix, x), matrix, np.ones(2400))
    b = np.random.default_rng(0).normal(size=(2400, 70))
    exact = factor.solve(b), factor.sandwich_columns([7])
    wrong = []

    def work():
        for _ in range(5):
            if not (
                np.array_equal(factor.solve(b), exact[0]) and np.array_equal(factor.sandwich_columns([7]), exact[1])
            ):
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
    assert not wrong


# ---------------------------------------------------------------------- progress
def test_progress_ascends_to_one_in_the_calling_thread():
    matrix, x = grid(100, 150)
    told = []

    def progress(fraction, text):
        assert threading.current_thread() is threading.main_thread()
        assert text
        told.append(fraction)

    tree = EliminationTree(matrix, x, progress=progress)
    assert told
    assert told == sorted(told)
    assert told[0] >= 0
    assert told[-1] == 1
    told.clear()
    Factor(tree, matrix, np.ones(len(x)), progress)
    assert told == sorted(told)
    assert told[-1] == 1


def test_without_workers_one_thread_makes_the_same_bits(monkeypatch):
    matrix, x = grid(60, 80)
    sources = np.arange(0, len(x), 7)
    b = np.zeros((len(x), len(sources)))
    b[sources, np.arange(len(sources))] = 1
    expected = Factor(EliminationTree(matrix, x), matrix, np.ones(len(x))).solve(b)
    monkeypatch.setattr("bihdist_core.solver.worker_threads._pool", None)  # nobody may ask for it
    with without_workers():
        assert np.array_equal(Factor(EliminationTree(matrix, x), matrix, np.ones(len(x))).solve(b), expected)


@pytest.mark.parametrize("call", [1, 3])
def test_progress_can_stop_it(call, monkeypatch):
    monkeypatch.setattr("bihdist_core.solver.worker_threads.REPORT_SECONDS", 0.0)
    matrix, x = grid(100, 150)

    def stopper():
        calls = []

        def progress(*_):
            calls.append(time.process_time())
            if len(calls) == call:
                raise Cancelled("enough")
            assert len(calls) < call

        return progress, calls

    progress, calls = stopper()
    with pytest.raises(Cancelled, match="enough"):
        EliminationTree(matrix, x, progress=progress)
    # A promise to the user: half a second, here of the processor, which does not depend on what else is running.
    assert time.process_time() - calls[-1] < 0.5
    tree = EliminationTree(matrix, x)
    progress, calls = stopper()
    with pytest.raises(Cancelled, match="enough"):
        Factor(tree, matrix, np.ones(len(x)), progress)
    assert time.process_time() - calls[-1] < 0.5
    assert close(Factor(tree, matrix).solve(matrix @ np.ones(len(x))), 1.0, 1e-9)


# ---------------------------------------------------------------------- errors
def test_without_areas_there_are_no_diagonals():
    matrix, x = grid(5, 6)
    factor = Factor(EliminationTree(matrix, x), matrix)
    for ask in (lambda: factor.diagonal, lambda: factor.sandwich_diagonal, lambda: factor.sandwich_columns([0])):
        with pytest.raises(SolverError, match="without areas"):
            ask()


@pytest.mark.parametrize("size", [6, 40])
def test_what_is_not_positive_definite_is_refused(size):
    matrix, x = grid(size, size)
    tree = EliminationTree(matrix, x)
    indefinite = (matrix - 0.5 * sp.identity(size**2)).tocsr()
    for bad in (indefinite, -matrix, matrix * 0, matrix - sp.diags(matrix.diagonal())):
        with pytest.raises(SolverError, match="not positive definite"):
            Factor(tree, bad, np.ones(size**2))


def test_a_laplacian_without_a_pin_is_refused():
    n = 100
    matrix = laplacian(n, np.arange(n), (np.arange(n) + 1) % n)
    with pytest.raises(SolverError, match="not positive definite"):
        Factor(EliminationTree(matrix, np.random.default_rng(0).normal(size=(n, 3))), matrix)


def test_results_that_are_not_finite_are_refused():
    matrix, x = grid(5, 6)
    tree = EliminationTree(matrix, x)
    with pytest.raises(SolverError, match="finite"):
        Factor(tree, matrix * np.nan)
    with pytest.raises(SolverError, match="finite"):
        Factor(tree, matrix * 1e-200).solve(np.full(30, 1e200))
    with pytest.raises(SolverError, match="finite"):
        Factor(tree, matrix * 1e-200, np.ones(30))


def test_what_does_not_fit_is_refused():
    matrix, x = grid(30, 40)
    n = len(x)
    tree = EliminationTree(matrix, x)
    factor = Factor(tree, matrix, np.ones(n))
    outside = sp.lil_matrix(sp.identity(n) * 9.0)
    outside[0, n - 1] = outside[n - 1, 0] = 1
    with pytest.raises(ParameterError, match=r"\(1199, 0\)|\(0, 1199\)"):
        Factor(tree, outside.tocsr())
    lopsided = sp.coo_matrix((np.ones(1), ([0], [5])), shape=(n, n)) + matrix
    refused = [
        ("does not fit a tree", lambda: Factor(tree, matrix[:-1, :-1])),
        ("Areas", lambda: Factor(tree, matrix, np.ones(n - 1))),
        ("Areas", lambda: Factor(tree, matrix, -np.ones(n))),
        ("Areas", lambda: Factor(tree, matrix, np.full(n, np.nan))),
        ("right-hand side", lambda: factor.solve(np.ones(n - 1))),
        ("right-hand side", lambda: factor.solve(np.ones((n, 1, 1)))),
        ("right-hand side", lambda: factor.solve(1.0)),
        ("right-hand side", lambda: factor.solve(np.full(n, np.inf))),
        ("whole numbers", lambda: factor.sandwich_columns([n])),
        ("whole numbers", lambda: factor.sandwich_columns([-1])),
        ("whole numbers", lambda: factor.sandwich_columns([0.5])),
        ("whole numbers", lambda: factor.sandwich_columns(3)),
        ("do not fit", lambda: EliminationTree(matrix, x[:-1])),
        ("do not fit", lambda: EliminationTree(matrix[:-1], x)),
        ("finite", lambda: EliminationTree(matrix, x * np.nan)),
        ("not symmetric", lambda: EliminationTree(lopsided, x)),
    ]
    for message, call in refused:
        with pytest.raises(ParameterError, match=message):
            call()


def test_diagonals_cannot_be_written():
    matrix, x = grid(5, 6)
    factor = Factor(EliminationTree(matrix, x), matrix, np.ones(30))
    with pytest.raises(ValueError, match="read-only"):
        factor.diagonal[0] = 1


# ---------------------------------------------------------------------- two kernels
def tasks_of(tree):
    """How many branches a compiled tree has, and how many fronts above them."""
    return len(tree.layout.branches), len(tree.layout.tops)


@compiled
@pytest.mark.parametrize("kernel", ["compiled"], indirect=True)
@pytest.mark.parametrize("name", ["grid", "islands", "strip", "random dense", "star"])
def test_branches_side_by_side_give_the_same_answer(name, monkeypatch):
    """Large meshes are done by several tasks below a top; small limits bring that about on a small one."""
    matrix, x, areas = _with_areas(name)
    b = np.random.default_rng(0).normal(size=(len(x), 40))
    index = np.arange(0, len(x), 30)
    one = EliminationTree(matrix, x)
    monkeypatch.setattr(compiled_tree, "CUT_ALONE", 0)
    several = EliminationTree(matrix, x)
    assert tasks_of(one) == (1, 0)
    assert min(tasks_of(several)) > 1
    assert np.array_equal(one.layout.vertices, several.layout.vertices)
    first, second = Factor(one, matrix, areas), Factor(several, matrix, areas)
    for found, expected in (
        (second.diagonal, first.diagonal),
        (second.sandwich_diagonal, first.sandwich_diagonal),
        (second.solve(b), first.solve(b)),
        (second.solve(b[:, 0]), first.solve(b[:, 0])),
        (second.sandwich_columns(index), first.sandwich_columns(index)),
        (second.sandwich_columns(index[:1]), first.sandwich_columns(index[:1])),
    ):
        # The order of additions differs where branches meet.
        assert close(found, expected, 1e-13)
