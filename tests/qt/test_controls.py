"""What every control of the window owes its user: a tooltip, and a name for those who do not see it."""

import numpy as np
import pytest
from qtpy import QtWidgets

from app.qt.acts import ALL
from tests.qt.events import press
from tests.qt.painting import painted
from tests.qt.parts import parts
from tests.shapes import bumpy


def controls(window):
    """All that is there to be clicked or typed into."""
    kinds = (QtWidgets.QAbstractButton, QtWidgets.QLineEdit, QtWidgets.QAbstractSlider, QtWidgets.QComboBox)
    found = [each for kind in kinds for each in window.findChildren(kind)]
    return [each for each in found if each.isVisible() and not isinstance(each, QtWidgets.QScrollBar)]


def count_of_controls(window):
    """How many controls are seen, the menus included, and how many of them are disabled; the source's are one."""
    there = [each for each in controls(window) if each.window() is window]
    there = [each for each in there if each is window.tool_bar.source_box or not is_of_source(window, each)]
    menus = [action for action in window.menuBar().actions() if action.isVisible()]
    return len(there) + len(menus), sum(not each.isEnabled() for each in there)


def is_of_source(window, control):
    return window.tool_bar.source.isAncestorOf(control)


@pytest.mark.parametrize("size", [(1600, 1000), (900, 600)])
def test_there_are_few_controls_at_the_start_and_with_a_mesh(screen, mesh_file, size):
    s = screen()
    s.window.resize(*size)
    s.settle(0.1)
    count, disabled = count_of_controls(s.window)
    recent = sum(row.isVisible() for row in s.window.show_start().rows)
    assert (count - recent, disabled) <= (13, 0)
    s.open(mesh_file(bumpy(300)), 5)
    heads = sum(each.window() is s.window for panel in s.panels for each in controls(panel.head))
    count, disabled = count_of_controls(s.window)
    assert count - heads <= 18
    assert disabled <= 2  # there is nothing to undo yet


def test_without_a_mesh_the_tool_bar_has_two_buttons_and_no_menu_is_dead(screen):
    s = screen()
    s.settle(0.1)
    bar = s.window.tool_bar
    assert [name for name, button in bar.buttons.items() if button.isVisible()] == ["open", "preferences"]
    assert not bar.source.isVisible()
    menus = [action.menu() for action in s.window.menuBar().actions() if action.isVisible()]
    assert all(any(action.isEnabled() for action in menu.actions() if not action.isSeparator()) for menu in menus)


def test_the_tools_are_in_one_menu_with_their_names_and_keys(screen):
    from app.document.tools import docked_tools

    s = screen()
    shown = [
        (action.text(), action.shortcut().toString()) for action in s.window.tool_bar.buttons["tools"].menu().actions()
    ]
    assert shown == [(tool.text, tool.key) for tool in docked_tools().values() if tool.menu == "Tools"]
    assert len(shown) == 9


def test_every_tool_tip_begins_with_the_name_and_the_key(screen):
    s = screen()
    for act in ALL:
        tip, name = s.window.actions_by_word[act.word].toolTip(), act.text.replace("&", "").removesuffix("…")
        assert tip.startswith(f"{name} (" if act.keys else name)
        if act.tip:
            assert act.tip[1:] in tip.partition(": ")[2]


def test_the_tool_bar_stays_where_it_is_however_long_the_source_is(shared_screen):
    s = shared_screen()
    bar, box = s.window.tool_bar, s.window.tool_bar.source_box
    assert box.seen == box.text() == "5"
    places = {name: button.geometry() for name, button in bar.buttons.items()}
    box.setText("12+40+7+55+60+61+62+63")
    box._choose()
    s.until(lambda: s.session.is_complete)
    s.settle(0.1)
    assert {name: button.geometry() for name, button in bar.buttons.items()} == places
    assert box.text() == "12+40+7+55+60+61+62+63"
    assert box.text() in box.toolTip()
    assert box.seen.startswith("12+40+7")
    assert box.seen.endswith("…")


def test_words_of_a_source_begin_at_the_same_place_whether_they_are_cut_or_not(shared_screen):
    s = shared_screen()
    box = s.window.tool_bar.source_box
    s.panels[0].view.setFocus()
    fitting, cut = (first_ink(box, text) for text in ("12+40", "12+40+7+55+60+61+62+63"))
    assert box.seen.endswith("…")
    assert cut == fitting


def first_ink(box, text):
    """Return the first column of a box in which its words are."""
    box.setText(text)
    box.setCursorPosition(0)
    left = box.textMargins().left()
    words = painted(box)[6:-6, left : box.width() - box.textMargins().right()]
    return left + int(np.flatnonzero((words != words[0, 0]).any(axis=(0, 2)))[0])


def test_a_seventh_panel_is_not_offered_and_the_button_says_why(shared_screen):
    s = shared_screen()
    button, action = s.window.tool_bar.buttons["add panel"], s.window.actions_by_word["add panel"]
    for _ in range(3):
        assert button.isEnabled()
        action.trigger()
    s.until(lambda: s.session.is_complete)
    assert len(s.document.panels) == 6
    assert not action.isEnabled()
    assert not button.isEnabled()
    assert "six panels already" in button.toolTip()
    s.session.undo()
    assert button.isEnabled()
    assert "six panels already" not in button.toolTip()


def test_the_button_of_the_source_is_lit_while_drags_draw_one(shared_screen):
    s = shared_screen()
    button = s.window.tool_bar.source.menu_button
    assert not button.isChecked()
    s.window.actions_by_word["draw source"].trigger()
    assert button.isChecked()
    assert "(D)" in button.toolTip()
    s.window.actions_by_word["stop"].trigger()
    assert not button.isChecked()


def test_every_control_has_a_tooltip_and_a_name(shared_screen):
    s = shared_screen()
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
    bar = s.window.tool_bar
    for button, key in {"undo": "Ctrl+Z", "redo": "Ctrl+Shift+Z", "export": "Ctrl+E"}.items():
        assert f"({key})" in bar.buttons[button].toolTip()
    assert "(L)" in bar.source.live.toolTip()


def test_no_two_actions_have_one_key():
    keys = [key for act in ALL for key in act.keys]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize("key", ["Ctrl+E", "Ctrl+T", "Ctrl+M"])
def test_keys_work_while_something_is_typed(shared_screen, monkeypatch, key):

    s = shared_screen()
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


def test_the_full_screen_of_a_talk_has_panels_only_and_one_comes_back(shared_screen):
    from app.qt.look.look import LOOK, TALK

    s = shared_screen()
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


def test_where_there_is_less_room_words_go_first_and_nouns_last(shared_screen):
    from app.qt.bars.tool_bar import STEPS
    from app.qt.bars.tool_button import FULL, ICONS

    s = shared_screen(bumpy(100), source=None)
    bar, window = s.window.tool_bar, s.window

    def written(width):
        window.resize(width, 700)
        s.settle(0)
        assert bar.source.width() + sum(b.width() for b in bar.buttons.values() if b.isVisible()) < width
        return {name: button._detail for name, button in bar.buttons.items()}

    details = dict.fromkeys(bar.buttons, ICONS)
    for name, detail in STEPS:
        wider = {**details, name: detail}
        assert written(bar.width_with(wider) - 1) == details
        assert written(bar.width_with(wider)) == wider
        details = wider
    assert all(details[name] == FULL for name in ("open", "tools", "range", "views", "export"))
    assert written(900)["tools"] == FULL


def test_what_has_no_room_in_the_tool_bar_is_in_the_menu_of_the_dots_at_every_width(shared_screen):
    s = shared_screen(bumpy(100), source=None)
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
        for widget in [bar.source, *(bar.buttons[name] for name in seen)]:
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
    offered = check(640)
    acts = window.actions_by_word
    assert acts["preferences"] in offered
    # A value that becomes longer leaves room for all, too.
    window.resize(bar.width_with(dict.fromkeys(bar.buttons, 2)) + 1, 700)
    s.settle(0.05)
    bar.buttons["views"].show_value("Something long")
    s.settle(0.05)
    assert bar.buttons["preferences"].geometry().right() < bar.width()
    next(action for action in check(400) if action is window.menus.tools.menuAction()).menu().actions()[0].trigger()
    s.settle(0.05)
    assert len(s.document.docks) == 1
