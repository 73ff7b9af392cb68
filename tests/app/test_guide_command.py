"""`bihdist guide` opens the installed guide, says where it is, or how to build it."""

import webbrowser

import pytest

from app.guide_pages import GUIDE
from app.main import main


@pytest.fixture
def opened(monkeypatch):
    """The addresses that are handed to a browser."""
    addresses = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


@pytest.fixture
def page(tmp_path, monkeypatch):
    """A guide that has been built."""
    page = tmp_path / "index.html"
    page.write_text("<title>The guide</title>")
    monkeypatch.setattr("app.guide_pages.GUIDE", page)
    return page


def test_it_is_looked_for_where_the_build_puts_it():
    assert GUIDE.parts[-3:] == ("app", "guide", "index.html")


def test_it_opens_in_the_browser(page, opened, capsys):
    assert main(["guide"]) == 0
    assert opened == [page.as_uri()]
    assert capsys.readouterr().out == f"{page}\n"


def test_its_path_alone(page, opened, capsys):
    assert main(["guide", "--where"]) == 0
    assert (capsys.readouterr().out, opened) == (f"{page}\n", [])


def test_no_browser(page, monkeypatch, capsys):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert main(["guide"]) == 2
    assert capsys.readouterr().err == f"bihdist: No browser could be started; open {page} in one.\n"


def test_a_guide_that_is_not_built(page, opened, capsys):
    page.unlink()
    assert main(["guide"]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"bihdist: The guide has not been built: there is no {page}. Run `make guide`")
    assert opened == []
