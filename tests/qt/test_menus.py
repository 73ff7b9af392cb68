"""The menus: whole on a small screen, with no letter or key that means two things, and all keys in the palette."""

import re
from collections import Counter

import pytest

from tests.qt.parts import parts

pytest.importorskip("qtpy")

SMALL = 560
"""Height in pixels of what a small screen leaves below the menu bar."""


def all_menus(window):
    from qtpy import QtWidgets

    return [menu for menu in window.findChildren(QtWidgets.QMenu) if menu.actions()]


def test_every_menu_is_whole_on_a_small_screen(screen):
    s = screen()
    samples = s.window.menus.samples  # with pictures; Qt gives it columns
    high = {menu.title(): menu.sizeHint().height() for menu in all_menus(s.window) if menu is not samples}
    assert {title: height for title, height in high.items() if height > SMALL} == {}


def test_no_letter_means_two_things_in_a_menu_and_no_key_in_the_window(screen):
    from app.qt.acts import ALL

    s = screen()
    for menu in [*all_menus(s.window), s.window.menuBar()]:
        letters = Counter(
            found[1].lower() for action in menu.actions() if (found := re.search(r"&([^&])", action.text()))
        )
        assert {letter for letter, count in letters.items() if count > 1} == set(), menu
    keys = Counter(key for act in ALL for key in act.keys)
    assert {key for key, count in keys.items() if count > 1} == set()


def test_all_keys_are_in_the_palette(screen):
    from qtpy import QtGui

    from app.qt.acts import ALL

    s = screen()
    said = {
        keys for each in parts(s.window).guide.commands() for keys in each.keys.split(" or ") if each.action.shortcuts()
    }
    native = QtGui.QKeySequence.SequenceFormat.NativeText
    assert {QtGui.QKeySequence(key).toString(native) for act in ALL for key in act.keys} == said


def test_about_says_which_kernel_the_solver_runs_on(screen):
    from app.qt.pages.messages import Message
    from bihdist_core.kernel.library import description

    s = screen()
    parts(s.window).guide.show_about()
    (message,) = s.window.findChildren(Message)
    assert f"Solver: {description()}." in message.details.toPlainText()
    message.close()
