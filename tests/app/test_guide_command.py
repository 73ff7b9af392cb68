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


def test_it_is_looked_for_where_the_build_puts_it():
    assert GUIDE.parts[-3:] == ("app", "guide", "index.html")


def test_it_opens_in_the_browser(built_guide, opened, capsys):
    assert main(["guide"]) == 0
    assert opened == [built_guide.as_uri()]
    assert capsys.readouterr().out == f"{built_guide}\n"


def test_its_path_alone(built_guide, opened, capsys):
    assert main(["guide", "--where"]) == 0
    assert (capsys.readouterr().out, opened) == (f"{built_guide}\n", [])


def test_no_browser(built_guide, monkeypatch, capsys):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert main(["guide"]) == 2
    assert capsys.readouterr().err == f"bihdist: No browser could be started; open {built_guide} in one.\n"


def test_a_guide_that_is_not_built(built_guide, opened, capsys):
    built_guide.unlink()
    assert main(["guide"]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"bihdist: The guide has not been built: there is no {built_guide}. Run `make guide`")
    assert opened == []
