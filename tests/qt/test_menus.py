"""The menus: whole on a small screen, with no letter or key that means two things, and all keys in the palette."""

import re
from collections import Counter
from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from app.document.shared_parts.pins import add_pins
from app.qt.acts import ALL
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import bumpy

SMALL = 560
"""Height in pixels of what a small screen leaves below the menu bar."""


def all_menus(window):
    return [menu for menu in window.findChildren(QtWidgets.QMenu) if menu.actions()]


def test_every_menu_is_whole_on_a_small_screen(screen):
    s = screen()
    samples = s.window.menus.samples  # with pictures; Qt gives it columns
    high = {menu.title(): menu.sizeHint().height() for menu in all_menus(s.window) if menu is not samples}
    assert {title: height for title, height in high.items() if height > SMALL} == {}


def test_menus_that_are_filled_again_delete_what_was_in_them(shared_screen):
    s = shared_screen(bumpy(200), [Spec.of("diffusion"), Spec.of("geodesic")])
    s.session.show(add_pins(s.document, [5, 9]))
    for panel in s.document.panels:
        parts(s.window).choices.edit_panel(panel.id, "Regions of the pins")
    for word in ("pins", "regions"):
        parts(s.window).docks.toggle(word)
    s.settle(0.05)
    pins = parts(s.window).docks._docks["pins"].content
    pins.table.selectAll()

    def fill() -> Counter:
        for menu in s.window.findChildren(QtWidgets.QMenu):
            menu.aboutToShow.emit()
        pins._open_row_menu(QtCore.QPoint())
        pins.row_menu.close()
        s.application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)
        return Counter(menu.title() for menu in s.window.findChildren(QtWidgets.QMenu))

    once = fill()
    assert once["Difference with"] == 2
    assert once["Colour"] == 2, "of all selected pins, in the whole menu and in that of the rows"
    assert fill() == once


def test_no_letter_means_two_things_in_a_menu_and_no_key_in_the_window(screen):
    s = screen()
    for menu in [*all_menus(s.window), s.window.menuBar()]:
        letters = Counter(
            found[1].lower() for action in menu.actions() if (found := re.search(r"&([^&])", action.text()))
        )
        assert {letter for letter, count in letters.items() if count > 1} == set(), menu
    keys = Counter(key for act in ALL for key in act.keys)
    assert {key for key, count in keys.items() if count > 1} == set()


def test_no_entry_needs_another_to_be_understood(screen):
    """Nouns instead of "it", as each entry stands alone in the palette."""
    from app.document.panel_edits import panel_edits

    s = screen()
    texts = [action.text() for menu in all_menus(s.window) for action in menu.actions()]
    assert [text for text in [*texts, *panel_edits()] if re.search(r"\b(it|this one|itself)\b", text)] == []


def test_all_keys_are_in_the_palette(screen):
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
    assert "doi     = {10.1145" in message.details.toPlainText()
    message.close()


def test_a_tick_says_what_is_shown_also_after_undo(shared_screen):
    from app.document.settings import SWITCHES
    from app.qt.actions import Action, Actions

    s = shared_screen(bumpy(200))
    ticks = s.window.actions_by_word
    for setting in SWITCHES:
        if not setting.is_preference:
            was = setting.is_on(s.window.context)
            ticks[setting.word].trigger()
            assert (setting.is_on(s.window.context), ticks[setting.word].isChecked()) == (not was, not was)
            s.session.undo()
            assert (setting.is_on(s.window.context), ticks[setting.word].isChecked()) == (was, was)
    # So does the entry of a tool, which says itself when it is ticked.
    assert len({act.word for act in ALL}) == len(ALL)
    own = Actions(s.window.context, [Action("own", "Own", lambda c: None, is_on=lambda c: bool(c.document.extrema))])
    for is_on in (True, False):
        s.session.show(replace(s.document, extrema=is_on))
        own.show()
        assert own["own"].isChecked() == is_on
