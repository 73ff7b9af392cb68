"""What tests of files share, and those of fields on a surface."""

import pytest

from bihdist_core import BiharmonicDistance
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
