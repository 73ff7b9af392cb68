"""`xdg-open` opens meshes and sessions in the window, once `bihdist desktop --install` has run."""

import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress

import pytest

from app.document.document import COMPARISON, comparison
from app.document.file import recipe_text
from app.document.page import Recipe
from tests.shapes import bumpy
from tests.waiting import PATIENCE

PROGRAMS = ("xdg-open", "gio", "update-mime-database", "update-desktop-database", "xdotool")
MISSING = [name for name in PROGRAMS if shutil.which(name) is None]

pytestmark = [
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="desktops of this kind are Linux's"),
    pytest.mark.skipif(bool(MISSING), reason=f"not installed: {', '.join(MISSING)}"),
    pytest.mark.skipif(not os.environ.get("DISPLAY"), reason="there is no screen"),
]


def windows(environment):
    """The titles of the windows of the program's class, by their processes."""
    titles = {}
    for window in said("search", "--onlyvisible", "--class", "^bihdist$").split():
        process, title = said("getwindowpid", window), said("getwindowname", window)
        if process and _data_of(int(process)) == environment["XDG_DATA_HOME"]:
            titles[int(process)] = title
    return titles


def said(*words):
    return subprocess.run(["xdotool", *words], capture_output=True, text=True).stdout.strip()


def _data_of(process):
    """The data folder that a process has been told, which no process of another test has been."""
    with suppress(OSError), open(f"/proc/{process}/environ", encoding="utf-8") as file:
        return dict(row.partition("=")[::2] for row in file.read().split("\0")).get("XDG_DATA_HOME")
    return None


@pytest.fixture
def environment(tmp_path):
    """That of a user who has nothing but the entry in the menu."""
    data = tmp_path / "data"
    words = {"XDG_DATA_HOME": str(data), "XDG_CONFIG_HOME": str(tmp_path / "config"), "HOME": str(tmp_path)}
    found = {**os.environ, **words, "XDG_CURRENT_DESKTOP": "GNOME"}
    subprocess.run([sys.executable, "-m", "bihdist", "desktop", "--install", "--quiet"], env=found, check=True)
    yield found
    for process in windows(found):
        os.kill(process, signal.SIGKILL)


@pytest.mark.parametrize("kind", ["mesh", "session"])
def test_a_double_click_opens_the_window(environment, tmp_path, mesh_file, kind):
    path = mesh_file(bumpy(300), "my mesh.off")
    if kind == "session":
        path = str(tmp_path / "kept.json")
        (tmp_path / "kept.json").write_text(recipe_text(Recipe(comparison("my mesh.off", COMPARISON)), "0.2.0"))
    subprocess.run(["xdg-open", path], env=environment, check=True, cwd=tmp_path, timeout=PATIENCE)
    end, titles = time.monotonic() + PATIENCE, {}
    while not any("my mesh.off" in title for title in titles.values()):
        assert time.monotonic() < end, titles
        time.sleep(0.2)
        titles = windows(environment)
    (title,) = titles.values()
    assert title.endswith("Biharmonic distance")
