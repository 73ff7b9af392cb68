"""A window that tests share is, once it has been reset, like a new one."""

import json
from dataclasses import replace

import numpy as np
from qtpy import QtWidgets

from app.document.edits import add_another, move_source
from app.document.form import document_data
from app.document.looks import Colours
from app.document.settings import SETTINGS
from app.document.shared_parts.pins import add_pins
from app.document.tools import docked_tools
from tests.qt.parts import parts
from tests.shapes import bumpy

SURFACE = bumpy(300)


def description(s):
    """Everything that a window says of itself."""
    window, context = s.window, s.window.context
    widgets = window.findChildren(QtWidgets.QWidget)
    seen = [each for each in widgets if each.isVisible()]
    return {
        "document": json.loads(json.dumps(document_data(s.document))),
        "title": (window.windowTitle(), window.isWindowModified()),
        "size": (window.width(), window.height(), window.windowState()),
        "steps": (s.session.can_undo, s.session.can_redo, s.session.history.origin),
        "actions": {word: (each.isEnabled(), each.isChecked()) for word, each in context.actions.items()},
        "docks": sorted(dock.windowTitle() for dock in window.findChildren(QtWidgets.QDockWidget)),
        "dialogs": [each for each in seen if each.isWindow()],
        "page": context.page,
        "preferences": context.preferences,
        "active": context.grid.active,
        "pointer": (context.hit, context.hit_in),
        "notice": window.notice.isVisible(),
        "said": [each.text() for each in seen if isinstance(each, QtWidgets.QLabel)],
        "buttons": [each.text() for each in seen if isinstance(each, QtWidgets.QAbstractButton)],
        "status": [each.accessibleName().partition(" in ")[0] for each in seen if window.status.isAncestorOf(each)],
        "file": parts(window).session_file.path,
        "live": (parts(window).gestures.is_live, parts(window).dragging.is_on),
        "told": (s.refusals, s.completions),
    }


def test_a_reset_window_is_like_a_new_one(screen, mesh_file, shared_screen):
    from app.qt.pages.palette import Palette

    s = shared_screen(SURFACE)
    new = screen()
    new.open(s.document.surfaces[0].path, 5)
    new.settle()
    new.completions.clear()
    expected, pictures = description(new), new.pictures()
    new.window.hide()
    its, context = parts(s.window), s.window.context
    for word in docked_tools():
        its.docks.toggle(word)
    s.session.show(add_pins(move_source(s.document, 0, 40), [7, 90]))
    s.session.show(add_another(s.document, s.document.panels[0].surface))
    s.session.show(replace(s.document, colours=Colours("uniform"), isolines=replace(s.document.isolines, count=5)))
    s.session.undo()
    its.views.set_view("back")
    its.choices.style("dark")
    for setting in SETTINGS:
        if setting.menu:
            its.choices.toggle(setting)
    context.prefer(turntable=True, wheel_reversed=True, last_folder="elsewhere")
    context.grid.activate(s.document.panels[1].id)
    its.choices.toggle_full_screen()
    context.fail("This is refused.")
    context.tell("This is told.")
    its.session_file.save(str(mesh_file(SURFACE).replace("mesh.off", "session.json")))
    its.guide.show_commands()
    its.choices.ask_preferences()
    its.gestures.set_live(True)
    s.window.resize(700, 500)
    s.settle()
    assert s.window.findChildren(Palette)
    again = shared_screen(SURFACE)
    assert again is s
    found = description(s)
    assert {key: found[key] for key in found if found[key] != expected[key]} == {
        key: expected[key] for key in found if found[key] != expected[key]
    }
    for one, other in zip(s.pictures(), pictures, strict=True):
        assert np.array_equal(one, other)
