"""Types are part of the packages, and the stub of the library's names says what is imported."""

from pathlib import Path

import pytest
from mypy import stubtest
from mypy.options import Options

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("package", ["app", "bihdist_core"])
def test_packages_are_marked_as_typed(package):
    assert (ROOT / package / "py.typed").exists()


def test_the_stub_is_what_is_imported():
    """All names in both, and each function of the signature, each class of the members that mypy reads of it."""
    options = Options()
    options.incremental, options.ignore_missing_imports, options.mypy_path = False, True, [str(ROOT)]
    stubtest.build_stubs(["bihdist_core"], options)
    # A type checker knows the names from the imports themselves.
    errors = [error.get_description(concise=True) for error in stubtest.test_module("bihdist_core")]
    assert errors == ["bihdist_core.__all__ is not present in stub"]
