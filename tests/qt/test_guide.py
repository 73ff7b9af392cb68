"""Help > Guide opens the installed guide in the browser, and says so where it cannot."""

from pathlib import Path

from tests.qt.parts import parts


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


def test_no_browser(screen, built_guide, monkeypatch):
    asked = browser(monkeypatch, opens=False)
    s = screen()
    said = failures(s.window)
    s.window.context.actions["guide"].trigger()
    assert len(asked) == 1
    assert said == [f"No browser could be started; open {built_guide} in one."]


def test_a_guide_that_is_not_built_opens_as_text(screen, built_guide, monkeypatch, tmp_path):
    asked = browser(monkeypatch)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name: tmp_path / name)
    built_guide.unlink()
    s = screen()
    said = failures(s.window)
    s.window.context.actions["guide"].trigger()
    (page,) = asked
    assert "<h1" in Path(page).read_text(encoding="utf-8")
    assert said == []


def test_the_palette_finds_it(screen):
    from app.qt.pages.palette import found

    s = screen()
    for typed in ("guide", "manual", "documentation"):
        assert found(parts(s.window).guide.commands(), typed)[0].title.endswith("Guide"), typed
