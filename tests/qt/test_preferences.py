"""What is preferred comes back, whatever stands in the file; the dialog; where the window is."""

import os
from dataclasses import replace

import pytest
from qtpy.QtCore import QRect, QSettings, QSize
from qtpy.QtWidgets import QAbstractButton, QWidget

from app.document.settings import THEME, Preferences
from app.qt import preferences, remembered
from app.qt.look.look import LOOK
from app.qt.pages.preferences_dialog import PreferencesDialog
from app.qt.preferences import brought_back, first_place, load, save
from tests.qt.parts import parts
from tests.shapes import bumpy

MINE = Preferences("dark", 0, True, geometry=bytes(range(256)), last_folder="/tmp/Größe, 50% @x; [a]=b #c\\d")


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    if remembered.folder().parent != tmp_path:
        pytest.skip("the folder for data is not chosen by XDG_DATA_HOME here")
    return tmp_path


def written(text):
    preferences.path().parent.mkdir(exist_ok=True)
    preferences.path().write_bytes(text if isinstance(text, bytes) else text.encode())


def damaged():
    return preferences.path().with_name("preferences.ini.damaged")


def test_first_start_has_the_defaults_and_leaves_no_file():
    assert load() == Preferences()
    assert not preferences.path().exists()


@pytest.mark.parametrize("mine", [MINE, Preferences(), Preferences(last_folder="@Variant(x)", geometry=b"\0")])
def test_what_is_saved_comes_back(mine):
    save(mine)
    assert load() == mine
    save(Preferences(isolines=7))
    assert load() == Preferences(isolines=7)


def test_reset_forgets_all_but_what_is_not_ours():
    written("[General]\nversion=1\nisolines=5\nlater=17\n\n[other]\nx=y\n")
    assert load().isolines == 5
    save(MINE)
    save(Preferences())
    assert load() == Preferences()
    found = QSettings(str(preferences.path()), QSettings.Format.IniFormat)
    assert (found.value("later"), found.value("other/x"), int(found.value("version"))) == ("17", "y", 1)


def test_each_value_is_checked_by_itself():
    wrong = "theme=purple\nisolines=-3\ngeometry=xyz\nlast_folder=a, b\n"
    written(f"[General]\nversion=1\nwheel_reversed=true\n{wrong}")
    assert load() == Preferences(wheel_reversed=True)
    written("[General]\nversion=1\nisolines=1001\ntheme=light\nwheel_reversed=@Variant(\\0\\0\\0\\x7f\\0)\n")
    assert load() == Preferences(theme="light")
    assert not damaged().exists()


def test_a_newer_file_is_left_alone():
    text = b"[General]\nversion=2\nisolines=5\n"
    written(text)
    assert load() == Preferences()
    save(MINE)
    save(Preferences())
    assert preferences.path().read_bytes() == text
    assert not damaged().exists()


@pytest.mark.parametrize(
    "text",
    [bytes(range(256)) * 20, b"\0" * 1000, b"[General]\nversion=abc\nisolines=5\n", b"isolines=5\n", b"\xff\xfe"],
)
def test_a_damaged_file_is_put_aside(text, capfd):
    written(text)
    assert load() == Preferences()
    assert damaged().read_bytes() == text
    save(MINE)
    assert load() == MINE
    assert capfd.readouterr() == ("", "")


def test_random_bytes_never_stop_the_start():
    import random

    chance = random.Random(5)
    for _ in range(200):
        whole = bytearray(b"[General]\nversion=1\nisolines=5\ntheme=dark\ngeometry=00ff\nlast_folder=/tmp\n")
        for _ in range(chance.randrange(1, 6)):
            whole[chance.randrange(len(whole))] = chance.randrange(256)
        written(bytes(whole))
        found = load()
        assert found.theme in THEME.choices
        assert 0 <= found.isolines <= 1000


def test_an_empty_file_is_no_damage():
    written("")
    assert load() == Preferences()
    assert not damaged().exists()


def test_a_folder_in_its_place_is_put_aside():
    (preferences.path() / "inner").mkdir(parents=True)
    assert load() == Preferences()
    assert (damaged() / "inner").is_dir()
    save(MINE)
    assert load() == MINE


def test_where_nothing_can_be_written_nothing_is(home, capfd):
    (home / "bihdist").write_text("a file where the folder should be")
    save(MINE)
    assert load() == Preferences()
    assert capfd.readouterr() == ("", "")


@pytest.mark.skipif(
    os.name == "nt" or not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere"
)
def test_a_read_only_folder_is_read():
    save(MINE)
    preferences.path().parent.chmod(0o500)
    try:
        save(Preferences())
        assert load() == MINE
    finally:
        preferences.path().parent.chmod(0o700)


# ---------------------------------------------------------------------- where the window is
SCREEN, SECOND = QRect(0, 27, 1600, 973), QRect(1600, 0, 1280, 1024)


def test_the_first_window_fits_its_screen():
    assert first_place(SCREEN).size() == QSize(1400, 860)
    assert abs((first_place(SCREEN).center() - SCREEN.center()).manhattanLength()) <= 2
    small = QRect(100, 50, 1024, 600)
    assert first_place(small).size() == QSize(984, 560)
    assert small.contains(first_place(small))


@pytest.mark.parametrize("place", [QRect(100, 80, 900, 600), QRect(1500, 100, 900, 600), QRect(1700, 40, 1000, 800)])
def test_a_window_that_can_be_reached_stays(place):
    assert brought_back(place, [SCREEN, SECOND]) == place


@pytest.mark.parametrize(
    "place", [QRect(4000, 80, 900, 600), QRect(-880, 80, 900, 600), QRect(50, 990, 900, 600), QRect(0, -700, 900, 600)]
)
def test_a_window_off_every_screen_is_brought_back(place):
    found = brought_back(place, [SCREEN])
    assert SCREEN.contains(found)
    assert found.size() == place.size()


def test_a_window_larger_than_its_screen_is_made_smaller():
    assert SECOND.contains(brought_back(QRect(1700, 20, 3000, 700), [SCREEN, SECOND]))


def test_a_window_comes_back_where_it_was(application):
    one, other, away = QWidget(), QWidget(), QWidget()
    available = one.screen().availableGeometry()
    one.setGeometry(available.x() + 30, available.y() + 40, available.width() // 2, available.height() // 2)
    preferences.restore_geometry(other, Preferences(geometry=bytes(one.saveGeometry())))
    assert other.geometry() == one.geometry()
    away.setGeometry(90_000, 90_000, 700, 500)
    preferences.restore_geometry(other, Preferences(geometry=bytes(away.saveGeometry())))
    assert other.screen().availableGeometry().contains(other.geometry())
    for geometry in b"", b"no geometry":
        preferences.restore_geometry(one, Preferences(geometry=geometry))
        assert one.geometry() == first_place(one.screen().availableGeometry())


# ---------------------------------------------------------------------- the dialog
@pytest.fixture
def dialog(application):
    LOOK.choose("light")
    made = PreferencesDialog(Preferences("light", 12, True, geometry=b"\1", last_folder="/tmp"))
    made.show()
    yield made
    made.close()
    made.deleteLater()
    LOOK.choose("light")


def test_the_dialog_shows_and_gives_what_it_is_told(dialog):
    assert dialog.chosen() == Preferences("light", 12, True, geometry=b"\1", last_folder="/tmp")
    dialog.controls["isolines"].setValue(30)
    dialog.controls["wheel_reversed"].buttons[False].click()
    dialog.controls["turntable"].buttons[True].click()
    assert dialog.chosen() == Preferences("light", 30, False, True, geometry=b"\1", last_folder="/tmp")


def test_a_theme_is_seen_at_once_and_cancel_undoes_it(dialog):
    light = dialog.grab().toImage().pixelColor(3, 3)
    dialog.controls["theme"].buttons["dark"].click()
    assert LOOK.theme.word == "dark"
    assert dialog.grab().toImage().pixelColor(3, 3).lightness() < 64 < light.lightness()
    dialog.reject()
    assert (LOOK.choice, LOOK.theme.word) == ("light", "light")


def test_reset_is_of_everything_and_cancel_undoes_it(dialog):
    dialog.again.click()
    assert dialog.chosen() == Preferences()
    assert LOOK.choice == "desktop"
    dialog.reject()
    assert LOOK.choice == "light"


def test_the_chosen_word_has_room_and_does_not_move_the_others(dialog):
    from qtpy.QtGui import QFontMetrics

    metrics = QFontMetrics(LOOK.font(bold=True))
    for button in dialog.controls["wheel_reversed"].buttons.values():
        assert button.width() >= metrics.horizontalAdvance(button.text()) + 24  # what the style sheet puts beside it
    before = [button.geometry() for button in dialog.controls["theme"].buttons.values()]
    dialog.controls["theme"].buttons["dark"].click()
    assert [button.geometry() for button in dialog.controls["theme"].buttons.values()] == before


def test_controls_have_names_and_tips(dialog):
    for control in dialog.controls["theme"], dialog.controls["wheel_reversed"], dialog.controls["isolines"]:
        assert control.accessibleName()
        assert control.toolTip()
    for button in dialog.findChildren(QAbstractButton):
        assert button.accessibleName() or button.text()


@pytest.mark.parametrize("is_accepted", [True, False])
def test_asking_saves_unless_cancelled(application, is_accepted):
    from app.qt.main_window import MainWindow

    kept = Preferences(theme="light", geometry=b"\1\2")
    save(kept)
    window = MainWindow(preferences=kept)
    parts(window).choices.ask_preferences()
    dialog = window.findChild(PreferencesDialog)
    dialog.controls["isolines"].setValue(3)
    (dialog.accept if is_accepted else dialog.reject)()
    assert load() == window.context.preferences == replace(kept, isolines=3 if is_accepted else 20)
    window.context.remembers, window.context.quiet = False, True
    window.close()


def test_docks_that_were_open_and_the_size_come_back(screen, mesh_file):
    from app.document.document import Document
    from app.qt.start import as_preferred

    s = screen()
    s.window.context.remembers = True
    s.open(mesh_file(bumpy(60)), 5)
    parts(s.window).docks.toggle("statistics")
    parts(s.window).docks.toggle("pins")
    s.window.resize(1111, 707)
    # Without the end of the window: it may come by a crash.
    s.until(lambda: load().geometry)
    other = screen()
    preferences.restore_geometry(other.window, load())
    assert (other.window.width(), other.window.height()) == (1111, 707)
    assert as_preferred(Document(), load()).docks == ("statistics", "pins")
    assert as_preferred(Document(docks=("profile", "pins")), load()).docks == ("profile", "pins", "statistics")
    s.window.close()
    written("[General]\nversion=1\ndocks=pins, hammer\n")
    assert load().docks == "pins"
