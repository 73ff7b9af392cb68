"""The version: one number in all places that say it."""

import re
from pathlib import Path

import pytest

from app.version import version

ROOT = Path(__file__).parents[2]

PLACES = {
    "CITATION.cff": r"^version: (.+)$",
    ".ci/conda/recipe.yaml": r'^  version: "(.+)"$',
    "CHANGELOG.md": r"^## \[(\d[^\]]*)\]",
}
"""Where it is repeated: the first match."""


@pytest.mark.parametrize("name", PLACES)
def test_what_repeats_the_version_says_the_same(name):
    said = re.search(PLACES[name], (ROOT / name).read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert said, name
    assert said[1] == version()
