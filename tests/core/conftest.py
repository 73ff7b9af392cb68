"""What tests of files share, and those of fields on a surface; and what becomes of tests where there is no kernel."""

import pytest

from bihdist_core import BiharmonicDistance, SolverError
from bihdist_core.kernel.library import library
from tests.shapes import bumpy


@pytest.fixture
def put(tmp_path):
    """Write a mesh file and give its path."""

    def write(name, content):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.fixture(scope="session")
def rough():
    """A closed surface without symmetry."""
    return bumpy(300)


@pytest.fixture(scope="session")
def field(rough):
    """(300,) the biharmonic distance on it from vertex 7."""
    field = BiharmonicDistance(rough).from_source(7)
    field.flags.writeable = False
    return field


def _skipped_without_kernel():
    try:
        return (yield)
    except SolverError as error:
        if library() is None and "needs the compiled kernel" in str(error):
            pytest.skip(str(error))
        raise


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item):
    """Most tests of geodesic distance need no more than this to run on a wheel without a kernel."""
    return (yield from _skipped_without_kernel())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    """As for fixtures."""
    return (yield from _skipped_without_kernel())
