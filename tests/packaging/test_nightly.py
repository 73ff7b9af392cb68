"""Tests that `make test` leaves to `make nightly` are called what the list of them says, and can be imported."""

from importlib import import_module
from pathlib import Path

import pytest

from tests.conftest import NIGHTLY

TESTS = Path(__file__).parents[1]


@pytest.mark.parametrize("name", NIGHTLY)
def test_every_nightly_test_is_there(name):
    path, _, test = name.partition("::")
    assert (TESTS / path).exists()
    assert not test or f"def {test}" in (TESTS / path).read_text()


@pytest.mark.parametrize("folder", ["bench", "browser", "qt", "stress"])
def test_nightly_tests_and_tools_can_be_imported(folder):
    pytest.importorskip("qtpy")
    for path in sorted((TESTS / folder).glob("*.py")):
        if not path.name.startswith(("_", "test_")):
            import_module(f"tests.{folder}.{path.stem}")
