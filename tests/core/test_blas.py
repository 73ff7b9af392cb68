"""BLAS has one thread inside our kernels, whenever its libraries are loaded."""

from tests.programs import run_python

LATE = """
import numpy
from threadpoolctl import threadpool_info
from bihdist_core.solver.blas import one_blas_thread

def threads():
    return {each["filepath"]: each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"}

with one_blas_thread():
    first = threads()
import scipy.linalg
before = threads()
with one_blas_thread():
    with one_blas_thread():
        inside = threads()
assert set(first.values()) == {1}, first
assert set(inside.values()) == {1}, inside
assert threads() == before, (threads(), before)
"""

MEANWHILE = """
import numpy
from threadpoolctl import threadpool_info
from bihdist_core.solver.blas import one_blas_thread

before = {each["filepath"]: each["num_threads"] for each in threadpool_info()}
with one_blas_thread():
    import scipy.linalg
    with one_blas_thread():
        assert all(each["num_threads"] == 1 for each in threadpool_info() if each["user_api"] == "blas")
after = {each["filepath"]: each["num_threads"] for each in threadpool_info()}
assert all(after[path] == count for path, count in before.items()), (before, after)
"""

THREADS = """
import threading
import numpy
from threadpoolctl import threadpool_info
from bihdist_core.solver.blas import one_blas_thread

def threads():
    return {each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"}

found, entered, left = [], threading.Event(), threading.Event()
before = threads()

def first():
    with one_blas_thread():
        entered.set()
        left.wait()
    found.append(threads())

with one_blas_thread():
    assert threads() == {1}
assert threads() == before
# While this thread lives, another has kernels of its own; the one that enters first is not the last to leave.
thread = threading.Thread(target=first)
thread.start()
entered.wait()
assert threads() == {1}
with one_blas_thread():
    left.set()
    thread.join()
    assert threads() == {1}
assert found == [{1}]
assert threads() == before
thread = threading.Thread(target=lambda: found.append(one_blas_thread()(threads)()))
thread.start()
thread.join()
assert (found[1], threads()) == ({1}, before)
"""


def run(program):
    done = run_python("-c", program, OPENBLAS_NUM_THREADS="3")
    assert done.returncode == 0, done.stderr


def test_a_library_that_is_loaded_between_two_kernels_is_limited_too():
    run(LATE)


def test_one_that_is_loaded_inside_a_kernel_is_limited_by_the_next():
    run(MEANWHILE)


def test_any_thread_limits_it_and_any_other_restores_it():
    run(THREADS)
