"""What the tests of figures share."""

import pytest

from app.main import main
from tests.figures.recipes import SMALL
from tests.shapes import bumpy


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(300))


@pytest.fixture
def drawn(mesh, tmp_path):
    words = ["--distance", "biharmonic,diffusion", "--sources", "4", "--isolines", "9", "--crop"]
    assert main(["figure", mesh, *words, *SMALL, "-o", str(tmp_path / "f.png")]) == 0
    return tmp_path
