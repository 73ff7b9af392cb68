"""What is to be cited is the same in `CITATION.cff`, in BibTeX and on the page that the README offers."""

import re
from pathlib import Path

import pytest

from app.citation import bibtex
from app.main import main
from app.version import version

ROOT = Path(__file__).parents[2]
KEYS = (
    *("title", "name", "version", "family-names", "given-names"),
    *("journal", "volume", "issue", "start", "end", "year", "doi"),
)


def test_the_entries_have_what_the_citation_file_has(capsys):
    file = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    values = {key: re.findall(rf'^[ -]*{key}: "?(.+?)"?$', file, flags=re.MULTILINE) for key in KEYS}
    assert all(values.values())
    entries = re.sub(r"[{}]", "", bibtex())
    assert [value for found in values.values() for value in found if value not in entries] == []
    with pytest.raises(SystemExit):
        main(["--cite"])
    assert capsys.readouterr().out == f"{bibtex()}\n"


def test_the_page_of_the_readme_is_of_this_version():
    assert f'"version":"{version()}"' in (ROOT / "assets/hand.html").read_text(encoding="utf-8")
