"""A desktop whose numbers have a decimal comma: files are the same, byte for byte, and what is typed is understood."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from bihdist_core.analysis.level_words import value_from_words
from bihdist_core.scalars import with_decimal_point

SCRIPT = Path(__file__).with_name("decimal_comma.py")
GERMAN = "de_DE.UTF-8"


@pytest.fixture(scope="module")
def locales(tmp_path_factory):
    """A folder with the German locale, which few machines have."""
    folder = tmp_path_factory.mktemp("locales")
    compiler = shutil.which("localedef")
    if compiler is None or subprocess.run(
        [compiler, "-i", "de_DE", "-f", "UTF-8", str(folder / GERMAN)], capture_output=True, check=False
    ).returncode not in (0, 1):
        pytest.skip("localedef cannot make the German locale here")
    return folder


def test_files_are_the_same_byte_for_byte(locales, tmp_path):
    said = {}
    for name in ("C", GERMAN):
        folder = tmp_path / name
        folder.mkdir()
        environment = {**os.environ, "LC_ALL": name, "LOCPATH": str(locales), "PYTHONPATH": str(SCRIPT.parents[2])}
        ended = subprocess.run(
            [sys.executable, SCRIPT, "."], cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        assert ended.returncode == 0, ended.stderr
        said[name] = (ended.stderr.splitlines()[0], ended.stdout.splitlines())
    assert (said["C"][0], said[GERMAN][0]) == (".", ",")
    assert len(said["C"][1]) > 40
    assert said["C"][1] == said[GERMAN][1]


@pytest.mark.parametrize(
    ("typed", "number"),
    [
        ("0.5", 0.5),
        ("0,5", 0.5),
        (" −0,25 ", -0.25),
        ("1,5e-3", 1.5e-3),
        ("0,500", 0.5),
        ("12,345", 12345),
        ("12,345.5", 12345.5),
        ("1,234,567", 1234567),
        ("1,2345", 1.2345),
        ("1234,567", 1234.567),
        (",5", 0.5),
    ],
)
def test_a_typed_number_has_a_point_or_a_comma(typed, number):
    assert float(with_decimal_point(typed)) == number
    assert value_from_words(typed, 8.0) == number
    assert value_from_words(f"{typed} %", 200.0) == 2 * number
