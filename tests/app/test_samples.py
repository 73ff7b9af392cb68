"""Sample meshes by name, from Python."""

import doctest

import pytest

from app.samples import sample, sample_names
from bihdist_core import MissingFileError


def test_a_sample_is_a_surface():
    assert {name: sample(name).name for name in sample_names()} == {name: f"{name}.ply" for name in sample_names()}


@pytest.mark.parametrize("name", ["hans", "hand.ply", "../hand", ""])
def test_what_is_none_is_refused_with_all_names(name):
    with pytest.raises(MissingFileError) as error:
        sample(name)
    assert str(error.value) == f"There is no sample {name!r}; there are {', '.join(sample_names())}."


def test_its_example():
    (example,) = doctest.DocTestFinder(recurse=False).find(sample, "sample", globs={"sample": sample})
    assert doctest.DocTestRunner().run(example).failed == 0
