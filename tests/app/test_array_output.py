"""Formats of arrays that only batches write: other commands name the batch that does."""

import re

import pytest

from app.main import main
from tests.shapes import bumpy


@pytest.mark.parametrize(
    ("command", "extension"),
    [
        (["field", "--sources", "3"], "mat"),
        (["field", "--sources", "3"], "npz"),
        (["pairs", "--sources", "3,7"], "MAT"),
        (["pairs", "--sources", "all"], "npz"),
        (["pairs", "--nearest", "--k", "3"], "mat"),
    ],
)
def test_the_batch_that_writes_a_format_is_named_and_does(mesh_file, tmp_path, capsys, command, extension):
    mesh, (word, *options) = mesh_file(bumpy(60)), command
    assert main([word, mesh, *options, "-o", str(tmp_path / f"x.{extension}")]) == 2
    said = capsys.readouterr().err
    found = re.search(r"by `bihdist (batch --do \w+ --format \w+) -o FOLDER`; here the formats are .*\.npy", said)
    assert found, said
    words = [*found[1].split(), *options, "--workers", "1", "-o", str(tmp_path / "results")]
    if "--nearest" in words:
        words.remove("--nearest")
    assert main([words[0], mesh, *words[1:]]) == 0
    assert list((tmp_path / "results").glob(f"*.{extension.lower()}"))


@pytest.mark.parametrize("word", ["field", "pairs"])
def test_formats_that_nothing_writes_are_refused_as_ever(mesh_file, tmp_path, capsys, word):
    assert main([word, mesh_file(bumpy(60)), "--sources", "3,7", "-o", str(tmp_path / "x.foo")]) == 2
    assert "has the extension '.foo'; this can be written as .npy, .csv" in capsys.readouterr().err
