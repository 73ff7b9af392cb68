"""Help > Guide opens the installed guide in the browser, and says so where it cannot."""

import pytest

from tests.qt.parts import parts

pytest.importorskip("qtpy")


def browser(monkeypatch, opens=True):
    """The files that the desktop is asked to open, from now on."""
    from qtpy import QtGui

    asked = []
    monkeypatch.setattr(
        QtGui.QDesktopServices, "openUrl", staticmethod(lambda url: asked.append(url.toLocalFile()) or opens)
    )
    return asked


def failures(window):
    said = []
    window.context.failed.connect(said.append)
    return said


def test_the_menu_opens_it(screen, built_guide, monkeypatch):
    asked = browser(monkeypatch)
    s = screen()
    said = failures(s.window)
    s.window.context.actions["guide"].trigger()
    assert (asked, said) == ([str(built_guide)], [])


def test_no_browser_and_no_guide(screen, built_guide, monkeypatch):
    asked = browser(monkeypatch, opens=False)
    s = screen()
    said = failures(s.window)
    s.window.context.actions["guide"].trigger()
    built_guide.unlink()
    s.window.context.actions["guide"].trigger()
    assert len(asked) == 1
    assert said[0] == f"No browser could be started; open {built_guide} in one."
    assert "Run `make guide`" in said[1]


def test_the_palette_finds_it(screen):
    from app.qt.pages.commands import found

    s = screen()
    for typed in ("guide", "manual", "documentation"):
        assert found(parts(s.window).guide.commands(), typed)[0].title.endswith("Guide"), typed
