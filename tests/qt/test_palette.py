"""The palette of commands: made from the menus, found by the words people know, run by the keyboard alone."""

import pytest
from qtpy import QtCore, QtGui, QtWidgets
from qtpy.compat import isalive
from qtpy.QtTest import QTest

from app.qt.pages.palette import NO_MESH, Command, commands_of
from tests.qt.parts import parts
from tests.shapes import bumpy

KEYS = QtCore.Qt.Key


def native(keys):
    return QtGui.QKeySequence(keys).toString(QtGui.QKeySequence.SequenceFormat.NativeText)


def test_commands_are_made_from_the_menus(application):
    bar = QtWidgets.QMenuBar()
    file, view = bar.addMenu("&File"), bar.addMenu("&View")
    opening = file.addAction("&Open…")
    opening.setShortcut("Ctrl+O")
    closing = file.addAction("&Save && close")
    closing.setShortcuts([QtGui.QKeySequence("Ctrl+S"), QtGui.QKeySequence("F2")])
    file.addSeparator()
    view.addAction("Hidden").setVisible(False)
    view.addAction("Style").setProperty("heading", True)
    undo = view.addAction("Undo")
    undo.setEnabled(False)
    undo.setProperty("lack", "nothing to undo")
    colours = view.addMenu("Co&lours")
    ember = colours.addAction("Ember\tE")
    colours.menuAction().setEnabled(False)
    found = commands_of([("", file), ("", view)], has_mesh=True)
    assert [(each.title, each.keys, each.action, each.can_run, each.lack) for each in found] == [
        ("Open…", native("Ctrl+O"), opening, True, ""),
        ("Save & close", f"{native('Ctrl+S')} or F2", closing, True, ""),
        ("Undo", "", undo, False, "nothing to undo"),
        ("Colours: Ember", "E", ember, False, ""),
    ]
    assert commands_of([("", view)], has_mesh=False)[1].lack == NO_MESH
    assert isinstance(found[0], Command)


def test_what_can_be_run_and_what_has_the_words_in_its_title_stands_first():
    from app.qt.pages.palette import Command, found

    rows = [
        Command("Redo", "Ctrl+Y", "again", can_run=True),
        Command("Shift it", "", "save", can_run=True),
        Command("Nothing to save", can_run=True),
        Command("Save session", "Ctrl+S"),
        Command("Save as", can_run=True),
        Command("Reversed colours", "", "", can_run=True),
    ]

    def titles(typed):
        return [each.title for each in found(rows, typed)]

    assert titles("save") == ["Save as", "Nothing to save", "Shift it", "Save session"]
    assert titles("ctrl y") == ["Redo"]
    assert titles("COLOR rev") == titles("colour") == titles("ever") == ["Reversed colours"]
    assert titles("nowhere") == []
    assert len(titles("")) == len(rows)


@pytest.fixture
def shown(shared_screen):
    return shared_screen()


def palette_of(s):
    """LoadedMesh by its key, where the keys are."""
    s.activate()
    QTest.qWaitForWindowActive(s.window)
    QTest.keyClick(s.window, KEYS.Key_F1)
    s.settle(0.1)
    (palette,) = (
        each for each in s.window.findChildren(QtWidgets.QFrame) if hasattr(each, "rows") and each.isVisible()
    )
    return palette


def titles(palette):
    return [palette.rows.item(k).text() for k in range(palette.rows.count())]


def current(palette):
    return palette.rows.currentItem().text()


def test_the_words_people_know_find_what_they_mean_and_all_synonyms_belong_to_something(shown):
    from app.qt.pages.palette import MENU_SYNONYMS, found, plain

    commands = parts(shown.window).guide.commands()
    for typed, meant in {
        "rotate": "Turn left",
        "difference": "Difference with: Geodesic",
        "save": "Save session",
        "colour": "Colours: Ember",
        "color": "Colours: Ember",
        "measure": "Pins",
        "compare": "Add panel",
        "zoom": "Zoom in",
        "contours": "Isolines: About 20",
        "dark mode": "Theme: Dark",
    }.items():
        rows = found(commands, typed)
        assert [each.title for each in rows if each.title.endswith(meant) and each.can_run], typed
        assert rows[0].can_run
    menus = shown.window.findChildren(QtWidgets.QMenu)
    known = {plain(menu.title()) for menu in menus} | {"Show here"}
    known |= {each.title.rpartition(": ")[2] for each in commands}
    assert set(MENU_SYNONYMS) - known == set()


def test_the_keyboard_alone_finds_and_runs_a_command_and_leaves(shown):
    palette = palette_of(shown)
    assert "Rotate all panels" in titles(palette)
    QTest.keyClicks(palette.box, "wirefr")
    assert current(palette) == "Shading: Show edges"
    QTest.keyClick(palette.box, KEYS.Key_Return)
    shown.settle()
    assert shown.document.shading.show_edges
    assert not isalive(palette) or not palette.isVisible()
    palette = palette_of(shown)
    assert current(palette) == "Shading: Show edges"  # what was run last
    assert palette.rows.currentItem().data(QtCore.Qt.ItemDataRole.UserRole).is_on
    QTest.keyClick(palette.box, KEYS.Key_Down)
    QTest.keyClick(palette.box, KEYS.Key_Down)
    assert palette.rows.currentRow() == 2
    QTest.keyClick(palette.box, KEYS.Key_Up)
    assert palette.rows.currentRow() == 1
    QTest.keyClick(palette.box, KEYS.Key_Escape)
    shown.settle()
    assert not isalive(palette) or not palette.isVisible()
    assert shown.document.shading.show_edges


def test_a_distance_of_the_active_panel_is_a_command(shown):
    palette = palette_of(shown)
    QTest.keyClicks(palette.box, "difference geodesic")
    QTest.keyClick(palette.box, KEYS.Key_Enter)
    shown.settle()
    assert [part.spec.word for part in shown.document.panels[0].shows.parts] == ["biharmonic", "geodesic"]


def test_what_cannot_be_run_says_why_and_stays(screen):
    s = screen()
    palette = palette_of(s)
    QTest.keyClicks(palette.box, "export figure")
    row = palette.rows.currentItem().data(QtCore.Qt.ItemDataRole.UserRole)
    assert (row.title, row.lack) == ("Export figure…", "open a mesh first")
    QTest.keyClick(palette.box, KEYS.Key_Return)
    s.settle(0.05)
    assert palette.isVisible()
    palette.box.setText("paint a selection")
    assert current(palette) == "Paint a selection"
    QTest.keyClick(palette.box, KEYS.Key_Return)
    assert palette.isVisible()
    palette.box.setText("gibberish")
    assert palette.nothing.isVisible()
    QTest.keyClick(palette.box, KEYS.Key_Return)
    palette.close()


FOUND = {
    "viridis": "Colours: Uniform",
    "inferno": "Colours: Ember",
    "cividis": "Colours: Safe",
    "coolwarm": "Colours: Paper",
    "rainbow": "Colours: Paper",
    "heat": "Show here: Diffusion",
    "heat method": "Show here: Geodesic",
    "eigenfunctions": "Show here: Biharmonic, truncated",
    "euclid": "Show here: Geodesic",
    "colorbar": "Range: Own maximum of each panel",
    "legend": "Range: Own maximum of each panel",
    "normalize": "Range: Own maximum of each panel",
    "two sources": "Add to the source",
    "height": "Up: ",
    "levels": "Isolines: ",
    "black": "Colours: Dark ground",
    "fullscreen": "Full screen",
    "ruler": "Pins",
    "lasso": "Scatter",
    "simplify": "Robustness",
    "accuracy": "Quality",
    "latex": "Export figure",
    "animate": "Export movie",
}
"""What people type, and what they mean: the beginning of a title that is found for it."""


def test_plain_words_find_what_they_mean(shown):
    from app.qt.pages.palette import GESTURES, found

    commands = [*parts(shown.window).guide.commands(), *GESTURES]
    missed = {
        words: [each.title for each in found(commands, words)][:5]
        for words, title in FOUND.items()
        if not any(each.title.startswith(title) for each in found(commands, words)[:5])
    }
    assert missed == {}


def test_recent_files_are_found_by_their_names_after_commands(shown, mesh_file, tmp_path, monkeypatch):
    from app.qt import remembered
    from app.qt.pages.palette import GESTURES, found

    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "mouse"))
    paths = [mesh_file(bumpy(60), name) for name in ("mouse.off", "sphere.off")]
    folder = tmp_path / "mouse"
    folder.mkdir(exist_ok=True)
    inside = folder / "cat.off"
    inside.write_text("OFF")
    for path in (*paths, str(inside)):
        remembered.remember(path)
    commands = [*parts(shown.window).guide.commands(), *GESTURES]
    titles = [each.title for each in found(commands, "mouse")]
    assert titles[-1].endswith("mouse.off")
    assert not any(title.endswith("cat.off") for title in titles)
    assert len(titles) > 5
    assert [each.title.rpartition("/")[2] for each in found(commands, "sphere")] == ["sphere.off"]
    assert len([each for each in found(commands, "recent") if each.file]) == 3
