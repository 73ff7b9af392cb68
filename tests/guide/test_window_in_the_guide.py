"""What the guide says of the window: its menu entries and keys are there, and its pictures are those of the command."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from qtpy import QtGui

from app.qt.pages.palette import GESTURES, plain
from tests.qt.guide_pictures import FRAME_MS, MOVING, MOVING_WIDTH, PICTURES, picture_names
from tests.qt.guide_scenes import SCENES
from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "assets/guide").rglob("*.md"))]
HELD = {"Ctrl", "Shift", "Alt"}
"""Keys that are held while the mouse does something."""

IN_THE_BROWSER = {"Ctrl+K"}
"""Keys of the built guide itself, which opens its search."""

LARGEST_PICTURE, LARGEST_MOVING = 130_000, 1_500_000
"""Bytes: the guide travels in the wheel."""


def said(role: str) -> list[tuple[str, str]]:
    """What stands in a role of any page, with the page."""
    found = [(page, re.findall(rf"\{{{role}\}}`([^`]+)`", page.read_text(encoding="utf-8"))) for page in PAGES]
    return [(" ".join(words.split()), page.relative_to(ROOT).as_posix()) for page, all_of in found for words in all_of]


@pytest.fixture(scope="module")
def window():
    """One that shows nothing, with its panels."""
    pytest.importorskip("qtpy")
    import os

    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        pytest.skip("there is no display; `make test` brings one")
    from app.document.document import COMPARISON, comparison
    from app.qt.application import application
    from app.qt.main_window import MainWindow

    application()
    window = MainWindow(comparison("", COMPARISON))
    window.context.quiet, window.context.remembers = True, False
    window.show()
    window.build_panels()
    yield window
    window.close()


def menus_by_title(window) -> dict:
    """Menus of the menu bar, of the tool bar's buttons by their words, and of a panel (its name, and ⋯)."""
    head = window.grid.panels[0].head if window.grid.panels else None
    found = {button.accessibleName(): button.menu() for button in window.tool_bar.buttons.values() if button.menu()}
    found |= {plain(action.text()): action.menu() for action in window.menuBar().actions()}
    return found | ({"⋯": head.more.menu()} if head else {})


def leads_somewhere(window, path: str) -> bool:
    """Whether there is an entry, by the menus it is in with `>` between; dots at the end may be left out."""
    first, *others = path.split(" > ")
    menu = menus_by_title(window).get(first)
    for place, text in enumerate(others):
        if menu is None:
            return False
        menu.aboutToShow.emit()
        entries = {name_of(plain(action.text())): action for action in menu.actions() if not action.isSeparator()}
        if name_of(text) not in entries:
            return False
        menu = entries[name_of(text)].menu()
        if menu is None:
            return place == len(others) - 1
    return menu is not None


def name_of(text: str) -> str:
    """What an entry is called: without dots, and without the explanation behind a colon."""
    return text.partition(":")[0].rstrip("…")


def keys_of(window) -> set[str]:
    """All that is a key in the window, as Qt writes it: of commands, of gestures, and those held."""
    from app.qt.acts import ALL

    found = {keys.toString() for action in window.actions() for keys in action.shortcuts()}
    found |= {QtGui.QKeySequence(key).toString() for act in ALL if act.of_view for key in act.keys}
    gestures = {word for each in GESTURES for word in re.findall(r"hold (\w)\b", each.keys)}
    return found | HELD | IN_THE_BROWSER | {QtGui.QKeySequence(key).toString() for key in gestures}


def test_entries_of_menus_exist(window):
    paths = said("menuselection")
    assert paths
    assert [each for each in paths if not leads_somewhere(window, each[0])] == []


def test_an_entry_that_is_gone_is_found(window):
    for path in ("File > Print…", "Nothing > Open…", "View > Range > Two for all panels", "File > Quit > Now"):
        assert not leads_somewhere(window, path)
    assert leads_somewhere(window, "View > Range > Own maximum of each panel")
    assert leads_somewhere(window, "View > Range")


def test_keys_exist(window):
    known, keys = keys_of(window), said("kbd")
    assert keys
    assert [each for each in keys if each[0] not in HELD and QtGui.QKeySequence(each[0]).toString() not in known] == []
    assert QtGui.QKeySequence("Ctrl+Shift+F9").toString() not in known


def test_pictures_are_those_that_the_command_makes():
    assert {path.stem for path in PICTURES.glob("*.png")} == picture_names()
    names = [name for scene in SCENES for name in scene.names]
    assert len(names) == len(set(names))


def test_pictures_that_pages_name_exist():
    for page in PAGES:
        for target in re.findall(r"\]\(([./\w-]+\.png)\)", page.read_text(encoding="utf-8")):
            path = (page.parent / target).resolve()
            assert path.parent != PICTURES or path.stem in picture_names(), f"{page}: {target}"


@pytest.mark.parametrize("name", sorted(picture_names()))
def test_pictures_are_small_and_of_few_colours(name):
    path = PICTURES / f"{name}.png"
    with Image.open(path) as picture:
        assert picture.mode == "P"
        assert picture.width <= 1200
        assert picture.height <= 750
    assert path.stat().st_size <= LARGEST_PICTURE


def test_the_moving_picture_moves_and_is_small():
    (name,) = (name for scene in SCENES if scene.is_moving for name in scene.names)
    path = MOVING / f"{name}.webp"
    assert path.stat().st_size <= LARGEST_MOVING
    with Image.open(path) as picture:
        assert picture.width == MOVING_WIDTH
        assert picture.n_frames * FRAME_MS / 1000 > 3


@pytest.mark.skipif(
    shutil.which("xvfb-run") is None or shutil.which("xdotool") is None, reason="needs xvfb-run and xdotool"
)
def test_a_picture_is_made_again_and_is_of_todays_window(tmp_path):
    pytest.importorskip("qtpy")
    command = [sys.executable, "-m", "tests.qt.guide_pictures", "start-page", "--out", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=PATIENCE)
    now, then = (Image.open(folder / "start-page.png").convert("RGB") for folder in (tmp_path, PICTURES))
    assert now.size == then.size
    # Where fonts are others, text differs; a page laid out otherwise differs by far more.
    assert np.abs(np.asarray(now, float) - np.asarray(then, float)).mean() < 8
