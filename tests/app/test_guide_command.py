"""`bihdist guide` opens the guide, or its text where it has not been built, and says where it is."""

import re
import webbrowser
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from app.guide_pages import GUIDE
from app.main import main
from app.version import version
from assets.guide.building.links import wrong_links
from tests.commands import ran, refused

GUIDE_SOURCES = Path(__file__).parents[2] / "assets/guide"


@pytest.fixture
def opened(monkeypatch):
    """The addresses that are handed to a browser."""
    addresses = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


def test_it_is_looked_for_where_the_build_puts_it():
    assert GUIDE.parts[-3:] == ("app", "guide", "index.html")


def test_it_opens_in_the_browser(built_guide, opened, capsys):
    assert main(["guide"]) == 0
    assert opened == [built_guide.as_uri()]
    assert capsys.readouterr().out == f"{built_guide}\n"


def test_its_path_alone(built_guide, opened, capsys):
    assert (ran(capsys, "guide", "--where").out, opened) == (f"{built_guide}\n", [])


def test_no_browser(built_guide, monkeypatch, capsys):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert refused(capsys, "guide") == f"bihdist: No browser could be started; open {built_guide} in one."


@pytest.fixture
def cache(built_guide, monkeypatch, tmp_path):
    """A new user's cache; the guide has not been built."""
    built_guide.unlink()
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name: tmp_path / "cache" / name)
    return tmp_path / "cache" / "bihdist"


def test_a_guide_that_is_not_built_opens_as_text(cache, opened, capsys):
    page = Path(ran(capsys, "guide").out.strip())
    assert page == cache / f"guide-{version()}/index.html"
    assert opened == [page.as_uri()]
    pages = {path.relative_to(page.parent).with_suffix(".md") for path in page.parent.rglob("*.html")}
    assert pages == {path.relative_to(GUIDE_SOURCES) for path in GUIDE_SOURCES.rglob("*.md")}
    text = "".join(path.read_text(encoding="utf-8") for path in page.parent.rglob("*.html"))
    pictures = re.findall(r'<img src="([^"]+)"', text)
    assert pictures
    assert all(
        address.startswith("file:") and Path(url2pathname(urlsplit(address).path)).is_file() for address in pictures
    )
    assert [told for told in wrong_links(page.parent) if "='file:" not in told] == []


def test_the_text_reads_well(cache, opened):
    main(["guide", "--where"])
    text = "".join(path.read_text(encoding="utf-8") for path in cache.rglob("*.html"))
    assert "bihdist figure animal" in text
    assert "<kbd>G</kbd>" in text
    assert "<h3>Command line</h3>" in text
    assert "Try it" not in text  # of a page that is not there
    assert r"\frac{1}{A_i}" in text
    assert not re.search(r"\{(shell|python|toctree|kbd|doc|py:\w+)\}|:hide-|:link|:::", text)


def test_a_cache_that_cannot_be_written(cache, opened, capsys):
    cache.parent.mkdir()
    cache.write_text("a file")
    assert refused(capsys, "guide").startswith(f"bihdist: The guide cannot be written into {cache}")
    assert opened == []
