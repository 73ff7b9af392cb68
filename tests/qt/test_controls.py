"""What every control of the window owes its user: a tooltip, and a name for those who do not see it."""

import pytest

from tests.qt.events import press
from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")


def controls(window):
    """All that is there to be clicked or typed into."""
    from qtpy import QtWidgets

    kinds = (QtWidgets.QAbstractButton, QtWidgets.QLineEdit, QtWidgets.QAbstractSlider, QtWidgets.QComboBox)
    found = [each for kind in kinds for each in window.findChildren(kind)]
    return [each for each in found if each.isVisible() and not isinstance(each, QtWidgets.QScrollBar)]


def test_every_control_has_a_tooltip_and_a_name(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    there = controls(s.window)
    assert len(there) > 20
    assert [each for each in there if not each.toolTip()] == []
    assert [each for each in there if not (each.accessibleName() or each.text())] == []


def test_the_empty_window_s_controls_too(screen):
    s = screen()
    s.settle(0.1)
    there = controls(s.window)
    assert [each for each in there if not (each.accessibleName() or each.text())] == []


def test_every_action_of_the_tool_bar_names_its_key(screen):
    s = screen()
    for name, key in {"undo": "Ctrl+Z", "redo": "Ctrl+Shift+Z", "live": "L", "export": "Ctrl+E"}.items():
        assert f"({key})" in s.window.tool_bar.buttons[name].toolTip()


def test_no_two_actions_have_one_key():
    from app.qt.acts import ALL

    keys = [key for act in ALL for key in act.keys]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize("key", ["Ctrl+E", "Ctrl+T", "Ctrl+M"])
def test_keys_work_while_something_is_typed(screen, mesh_file, monkeypatch, key):

    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    s.activate()
    done = []
    for word in ("figure", "add panel", "movie"):
        action = s.window.actions_by_word[word]
        action.triggered.disconnect()
        shown = action.shortcut().toString()
        action.triggered.connect(lambda *_, shown=shown: done.append(shown))
    parts(s.window).typed_source.box.setFocus()
    s.settle(0.2)
    press(parts(s.window).typed_source.box, key)
    s.settle(0.1)
    assert done == [key]
    assert parts(s.window).typed_source.box.text() == "5"


def test_the_full_screen_of_a_talk_has_panels_only_and_one_comes_back(screen, mesh_file):
    from app.qt.look.look import LOOK, TALK

    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    usual = LOOK.scale
    bars = [s.window.menuBar(), s.window.tool_bar, s.window.status]
    for leave in ("Esc", "the desktop", "F11"):
        s.window.actions_by_word["full screen"].trigger()
        s.settle()
        assert ([bar.isVisible() for bar in bars], LOOK.scale) == ([False] * 3, TALK * usual)
        if leave == "Esc":
            s.window.context.actions["stop"].trigger()
        elif leave == "F11":
            s.window.actions_by_word["full screen"].trigger()
        else:
            s.window.setWindowState(s.window.windowState() & ~s.window.windowState())
        s.settle()
        assert ([bar.isVisible() for bar in bars], LOOK.scale) == ([True] * 3, usual)
        assert not s.window.actions_by_word["full screen"].isChecked()


def test_beside_values_the_buttons_that_are_meant_keep_their_words(screen, mesh_file):
    from app.qt.bars.tool_button import FULL, ICONS, VALUES

    s = screen()
    s.open(mesh_file(bumpy(100)))
    bar, window = s.window.tool_bar, s.window

    def written(width):
        window.resize(width, 700)
        s.settle(0)
        assert sum(button.width() for button in bar.buttons.values() if button.isVisible()) < width
        return {name: button._detail for name, button in bar.buttons.items()}

    assert set(written(bar._width_with(FULL, set()) + 2).values()) == {FULL}
    found = written(1590)
    assert all(found[name] == FULL for name in ("export", "open", "live", "add panel", "isolines"))
    just_fits = bar._width_with(VALUES, set())
    assert set(written(just_fits + 2).values()) == {VALUES}
    room = just_fits + bar.buttons["export"].width_with(FULL) - bar.buttons["export"].width_with(VALUES) + 2
    assert {name for name, detail in written(room).items() if detail == FULL} == {"export"}
    assert set(written(just_fits - 20).values()) == {ICONS}


def test_what_has_no_room_in_the_tool_bar_is_in_the_menu_of_the_dots_at_every_width(screen, mesh_file):
    from qtpy import QtWidgets

    s = screen()
    s.open(mesh_file(bumpy(100)))
    bar, window = s.window.tool_bar, s.window
    dots = bar.buttons["more"]

    def check(width):
        window.resize(width, 700)
        s.settle(0.05)
        seen = {name for name, button in bar.buttons.items() if button.isVisible()}
        assert {"open", "export"} <= seen
        assert (seen - {"more"}) | set(bar.left_out) == set(bar.buttons) - {"more"}  # nothing is lost
        assert ("more" in seen) == bool(bar.left_out)
        assert not seen & set(bar.left_out)
        for widget in [bar.source_box, *(bar.buttons[name] for name in seen)]:
            assert widget.geometry().right() < bar.width()
        assert bar.findChild(QtWidgets.QToolButton, "qt_toolbar_ext_button").isHidden()  # Qt's own way
        offered = [action for action in dots.menu().actions() if not action.isSeparator()]
        assert len(offered) == len(bar.left_out)
        return offered

    for source in ("5", "12+40+7+55+60+61+62+63"):
        parts(window).typed_source.box.setText(source)
        parts(window).typed_source.box._choose()
        s.until(lambda: s.session.is_complete)
        for width in (1600, 1500, 1400, 1250, 1100, 900, 800, 700, 640):
            check(width)
    offered = check(700)
    acts = window.actions_by_word
    assert acts["preferences"] in offered
    assert acts["dock pins"] in offered
    assert window.menus.up.menuAction() in offered
    # A value that becomes longer leaves room for all, too.
    window.resize(bar._width_with(2, set()) + 1, 700)
    s.settle(0.05)
    bar.buttons["views"].show_value("Something long")
    s.settle(0.05)
    assert bar.buttons["preferences"].geometry().right() < bar.width()
    next(action for action in check(700) if action is acts["dock pins"]).trigger()
    s.settle(0.05)
    assert s.document.docks == ("pins",)
