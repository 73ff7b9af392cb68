"""What is said where no window can be shown: no display, one that does not answer, libraries that are missing."""

import ctypes
import os
import shutil
import socket
import subprocess
import sys

import pytest

from app.qt import screen
from bihdist_core import BihdistError
from tests import programs
from tests.programs import ROOT
from tests.shapes import bumpy
from tests.waiting import PATIENCE, without_progress

SET_UP = ROOT / ".ci" / "set-up"

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="of Linux")


@pytest.fixture
def plain(monkeypatch):
    """An environment in which Qt would take X."""
    monkeypatch.delenv("QT_QPA_PLATFORM", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    return monkeypatch


def without(monkeypatch, missing):
    """As if the system had no such library."""
    there = ctypes.CDLL

    def load(name, *rest, **options):
        if missing in str(name):
            raise OSError(f"{missing}: cannot open shared object file: No such file or directory")
        return there(name, *rest, **options)

    monkeypatch.setattr(screen.ctypes, "CDLL", load)


@pytest.mark.parametrize("library", screen.DRAWING)
def test_a_library_that_draws_is_named_with_what_to_install(plain, library):
    without(plain, library)
    with pytest.raises(BihdistError, match=rf"needs {library}, which is not installed.*apt-get install libegl1 libgl1"):
        screen.check_libraries()


def test_a_library_of_the_plugin_for_x_is_named(plain):
    pytest.importorskip("qtpy")
    plain.setenv("DISPLAY", ":0")
    there = ctypes.CDLL
    tried = []

    def load(name, *rest):
        if name.endswith("libqxcb.so"):
            tried.append(name)
            raise OSError("libxcb-icccm.so.4: cannot open shared object file: No such file or directory")
        return there(name, *rest)

    plain.setattr(screen.ctypes, "CDLL", load)
    with pytest.raises(BihdistError, match=r"needs libxcb-icccm\.so\.4, .* libxcb-icccm4 "):
        screen.check_libraries()
    assert os.path.exists(tried[0])  # Qt's own file, not a guess
    plain.setenv("QT_QPA_PLATFORM", "offscreen")
    screen.check_libraries()


def importing(monkeypatch, failing, error):
    """As if the import of a module failed."""
    there = screen.import_module

    def load(name):
        if name.startswith(failing):
            raise error
        return there(name)

    monkeypatch.setattr(screen, "import_module", load)


def test_a_library_that_qt_links_is_named(plain):
    words = "libglib-2.0.so.0: cannot open shared object file: No such file or directory"
    importing(plain, "qtpy.QtGui", ImportError(words))
    with pytest.raises(BihdistError, match=r"needs libglib-2\.0\.so\.0, .* libglib2\.0-0 "):
        screen.check_libraries()


def test_where_no_binding_can_be_imported_the_first_ones_reason_is_told(plain):
    class QtBindingsNotFoundError(ImportError):
        pass

    importing(plain, "qtpy", QtBindingsNotFoundError("No Qt bindings could be found"))
    plain.setattr(screen, "find_spec", lambda name: None)
    with pytest.raises(BihdistError, match=r"needs Qt, which cannot be loaded: No Qt bindings could be found\."):
        screen.check_libraries()
    plain.setattr(screen, "find_spec", lambda name: name == "PyQt6")
    bindings = ImportError("libgthread-2.0.so.0: cannot open shared object file: No such file or directory")

    def load(name):
        raise bindings if name.startswith("PyQt6") else QtBindingsNotFoundError("No Qt bindings could be found")

    plain.setattr(screen, "import_module", load)
    with pytest.raises(BihdistError, match=r"needs libgthread-2\.0\.so\.0, which is not installed"):
        screen.check_libraries()


def test_the_packages_are_those_of_the_set_up():
    text = SET_UP.read_text().replace("\n    ", " ")
    named = [line.split('"')[1] for line in text.splitlines() if line.startswith(("figures=", "window="))]
    assert screen.PACKAGES.split() == " ".join(named).split()


# ---------------------------------------------------------------------- displays
@pytest.mark.parametrize("display", [":7654", "localhost:7654", "nonsense"])
def test_a_display_that_is_not_there_is_a_sentence(plain, display):
    plain.setenv("DISPLAY", display)
    with pytest.raises(BihdistError, match=rf"DISPLAY names \({display}\) does not answer"):
        screen.check_screen()


def test_a_display_that_is_silent_is_not_waited_for(plain):
    plain.setattr(screen, "ANSWER_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1] - 6000
        if number < 0:
            pytest.skip("a port below those of displays")
        plain.setenv("DISPLAY", f"127.0.0.1:{number}")
        with pytest.raises(BihdistError, match="does not answer"):
            screen.check_display()


def test_displays_that_qt_will_not_use_are_not_asked(plain):
    plain.setenv("DISPLAY", ":7654")
    plain.setenv("QT_QPA_PLATFORM", "offscreen")
    screen.check_display()
    plain.delenv("DISPLAY")
    plain.delenv("QT_QPA_PLATFORM")
    plain.setenv("WAYLAND_DISPLAY", "wayland-0")
    screen.check_display()


def test_a_screen_that_is_there_will_do(plain):
    pytest.importorskip("qtpy")
    if not os.environ.get("DISPLAY"):
        pytest.skip("no display")
    screen.check_screen()


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="xvfb-run is not installed")
def test_asking_a_display_does_not_close_it_to_who_comes_next():
    asked = "from app.qt.screen import check_display\nfor _ in range(200): check_display()"
    done = programs.run("xvfb-run", "-a", sys.executable, "-c", asked)
    assert done.returncode == 0, done.stderr


# ---------------------------------------------------------------------- the command and `show`
def run(code, **changes):
    environment = {k: v for k, v in os.environ.items() if k not in ("WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    environment.update(changes)
    return subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, timeout=PATIENCE
    )


VIEW = "import sys; from app.main import main; sys.exit(main(['view', 'hand']))"
BROKEN = """
import sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name in ("PyQt5.QtGui", "PyQt6.QtGui", "PySide6.QtGui"):
            raise ImportError("libGL.so.1: cannot open shared object file: No such file or directory")
sys.meta_path.insert(0, Finder())
"""


def test_view_ends_with_a_sentence_where_the_display_is_dead():
    done = run(VIEW, DISPLAY=":7654")
    assert done.returncode == 2
    assert done.stderr.startswith("bihdist: The viewer needs a display")
    assert done.stderr.count("\n") == 1


def test_view_and_show_end_with_a_sentence_where_libraries_are_missing():
    pytest.importorskip("qtpy")
    # A platform that needs no display, so that the libraries' turn comes anywhere.
    settings = {"DISPLAY": ":0", "QT_QPA_PLATFORM": "offscreen"}
    done = run(BROKEN + VIEW, **settings)
    assert done.returncode == 2
    assert done.stderr.startswith("bihdist: The window needs libGL.so.1, which is not installed; on Debian or Ubuntu: ")
    done = run(BROKEN + "import app\ntry: app.show('hand')\nexcept app.BihdistError as error: print(error)", **settings)
    assert done.stdout.startswith("The window needs libGL.so.1")


def view_of(mesh, out, **environment):
    """The window is started with other settings."""
    command = [sys.executable, "-m", "app", mesh, "--screenshot", str(out)]
    return programs.run(*command, **{"XDG_DATA_HOME": str(out.parent / "data"), **environment})


def ours(done):
    """What we say, among what drivers and Qt say."""
    assert "Traceback" not in done.stderr
    return [line for line in without_progress(done.stderr).splitlines() if line.startswith("bihdist: ")]


NO_DRIVER = {"LIBGL_DRIVERS_PATH": "/nonexistent", "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}


@pytest.mark.usefixtures("application")
@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (NO_DRIVER, "Drawing needs OpenGL, and no driver is there"),
        ({"QT_QPA_PLATFORM": "nonsense"}, "no plug-in for the platform nonsense: there are eglfs, "),
    ],
)
def test_view_ends_with_a_sentence_without_a_driver_and_without_a_plug_in(settings, words, mesh_file, tmp_path):
    done = view_of(mesh_file(bumpy(100)), tmp_path / "a.png", **settings)
    assert done.returncode == 2
    (line,) = ours(done)
    assert words in line


@pytest.mark.usefixtures("application")
def test_a_window_is_shown_without_fonts_of_the_system(mesh_file, tmp_path):
    settings = {"FONTCONFIG_FILE": "/nonexistent", "FONTCONFIG_PATH": "/nonexistent"}
    done = view_of(mesh_file(bumpy(100)), tmp_path / "a.png", **settings)
    assert (done.returncode, ours(done)) == (0, [])
    assert (tmp_path / "a.png").exists()


def test_a_qt_without_any_plug_in_is_said(plain, tmp_path):
    plain.setenv("DISPLAY", ":0")
    plain.setattr(screen, "_platforms", lambda: str(tmp_path))
    with pytest.raises(BihdistError, match="no plug-in for the platform xcb: there is none in"):
        screen._check_platform()
    (tmp_path / "libqwayland-generic.so").write_text("")
    plain.delenv("DISPLAY")
    screen._check_platform()
    plain.setenv("QT_QPA_PLATFORM", "xcb;wayland:a=b")
    screen._check_platform()


@pytest.mark.parametrize("settings", [NO_DRIVER, {"DISPLAY": ":7654"}], ids=["no driver", "dead display"])
def test_a_figure_without_a_driver_is_a_sentence_and_a_dead_display_costs_none(settings, mesh_file, tmp_path):
    words = ["figure", mesh_file(bumpy(100)), "--size", "200x200", "-o", str(tmp_path / "a.png")]
    command = [sys.executable, "-m", "app", *words]
    own = {name: value for name, value in os.environ.items() if name != "DISPLAY"} | settings
    done = subprocess.run(command, cwd=ROOT, env=own, capture_output=True, text=True, timeout=PATIENCE, check=False)
    if settings is NO_DRIVER:
        assert done.returncode == 2
        assert "Drawing needs OpenGL" in ours(done)[0]
    else:
        assert (done.returncode, without_progress(done.stderr)) == (0, "")
