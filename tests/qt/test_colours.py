"""Colours and ranges in the window: chosen in menus, undone, shown on the surface and the bar, and typed or taken."""

import json
from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore

from app.document.looks import CURVATURE, Base, Colours
from app.document.page import Recipe
from app.document.quantities import quantity
from app.document.settings import BANDS, RANGE
from app.scene.colour_maps import MAPS
from app.scene.style import STYLES
from app.session.array_store import ArrayStore
from app.session.recipe_file import recipe_written
from tests.qt.events import send_mouse
from tests.qt.parts import parts

WORDS = ("biharmonic", "geodesic")


@pytest.fixture
def shown(shared_screen):
    """A window in which two fields of a small surface have been computed."""
    return shared_screen(specs=tuple(quantity(word) for word in WORDS), source=None)


def test_nothing_is_chosen_without_a_mesh(screen, shown):
    menus = ("isolines", "colours", "range", "shading", "up")
    for s, has_mesh in ((screen(), False), (shown, True)):
        assert {getattr(s.window.menus, name).menuAction().isEnabled() for name in menus} == {has_mesh}


def choose(s, data):
    next(action for action in s.window.menus.colours.actions() if action.data() == data).trigger()
    s.settle()


def pixels(s):
    return [panel.view.shot() for panel in s.panels]


def are_equal(some, others):
    return all(np.array_equal(a, b) for a, b in zip(some, others, strict=True))


def test_a_map_is_chosen_shown_and_undone(shown):
    before = pixels(shown)
    choose(shown, ("map", "ember"))
    assert shown.document.colours == Colours("ember")
    assert shown.panels[0].view.scene.style.stops == MAPS["ember"].stops
    assert not are_equal(before, pixels(shown))
    assert "Ember" in shown.window.tool_bar.buttons["colours"].accessibleDescription()
    shown.window.actions_by_word["bands"].trigger()
    shown.window.actions_by_word["flip_scalars"].trigger()
    shown.settle()
    assert shown.document.colours == Colours("ember", (), True, True)
    assert shown.window.tool_bar.buttons["colours"].accessibleDescription() == "Ember, reversed, bands"
    for _ in range(3):
        shown.window.session.undo()
    shown.settle()
    assert shown.document.colours == Colours()
    assert are_equal(before, pixels(shown))
    assert not shown.window.actions_by_word["bands"].isChecked()


def test_the_map_of_the_style_is_reversed_and_put_back(shown):
    menu, before = shown.window.menus.colours, pixels(shown)
    menu.show_choice("paper", Colours(reversed=True))  # what is raised in a slot no test would see
    menu.show_choice("paper", Colours())
    for colours in (Colours(reversed=True), Colours()):
        shown.window.actions_by_word["flip_scalars"].trigger()
        shown.settle()
        assert shown.document.colours == colours
        assert shown.window.actions_by_word["flip_scalars"].isChecked() == colours.reversed
        assert are_equal(before, pixels(shown)) != colours.reversed


def ticked(s):
    return [action.text() for action in s.window.menus.colours.actions() if action.isChecked()]


def test_styles_and_maps_have_names_of_their_own_and_lines_have_no_map(shown):
    menu = shown.window.menus.colours
    names = [action.text() for action in menu.actions() if action.text()]
    assert len(set(names)) == len(names)
    choose(shown, ("map", "safe"))
    choose(shown, "dark")
    assert shown.document.colours == Colours("safe")
    assert ticked(shown) == ["Dark ground in figures", "Safe"]
    choose(shown, ("map", "paper"))
    assert shown.document.colours == Colours()
    choose(shown, ("map", "uniform"))
    assert shown.panels[0].view.scene.style.stops == STYLES["uniform"].stops
    choose(shown, "lines")
    assert not any(shown.window.actions_by_word[word].isEnabled() for word in ("bands", "flip_scalars"))
    assert menu.isEnabled()
    assert shown.window.tool_bar.buttons["colours"].accessibleDescription() == "Lines only"
    assert ticked(shown) == ["Lines only", "Uniform"]


def test_the_style_that_is_a_map_of_another_is_shown_as_that_map(shown):
    shown.window.context.page = replace(shown.window.context.page, style="uniform")
    shown.window.context.style_changed.emit()
    shown.window.context.choice_changed.emit()
    assert ticked(shown) == ["White ground in figures", "Uniform"]
    assert shown.window.tool_bar.buttons["colours"].accessibleDescription() == "Uniform"
    choose(shown, "dark")
    assert (shown.window.context.page.style, shown.document.colours) == ("dark", Colours("uniform"))
    assert ticked(shown) == ["Dark ground in figures", "Uniform"]


def test_bands_are_on_the_bar_where_the_isolines_are(shown):
    parts(shown.window).isolines.steps(6)
    parts(shown.window).choices.set(BANDS, True)
    shown.settle()
    bar = shown.panels[0].bar
    picture, box = bar.grab().toImage(), bar._layout.bar
    y = round(box.middle[1])
    scene = shown.panels[0].view.scene
    edges = scene.field_actor.levels.values / scene.field_actor.maximum
    assert len(edges) >= 3
    ends = [0.0, *edges, 1.0]
    for colour, start, end in zip(scene.style.band_colours(edges), ends[:-1], ends[1:], strict=True):
        for share in (0.1, 0.5, 0.9):
            seen = picture.pixelColor(round(box.x + (start + share * (end - start)) * box.width), y)
            assert np.abs(255 * colour - seen.getRgb()[:3]).max() <= 2


def test_a_map_from_a_file(shown, tmp_path):
    (tmp_path / "mine.csv").write_text("r,g,b\n10,20,30\n200,180,90\n")
    parts(shown.window).choices.take_colours(str(tmp_path / "mine.csv"))
    shown.settle()
    assert shown.document.colours.map == "mine"
    assert shown.window.tool_bar.buttons["colours"].accessibleDescription() == "mine"
    (tmp_path / "none.csv").write_text("10,20\n")
    parts(shown.window).choices.take_colours(str(tmp_path / "none.csv"))
    assert "none.csv, line 1: there are 2 numbers" in shown.refusals[-1]
    assert shown.document.colours.map == "mine"


# ---------------------------------------------------------------------- ranges
def bar_of(s, number=0):
    return s.panels[number].bar


def ticks(s, number=0):
    return [word.text for word in bar_of(s, number)._layout.ticks]


def test_an_end_is_typed_at_the_bar(shown):
    panel, own = shown.panels[0], shown.answers[0].maximum
    left = QtCore.Qt.MouseButton.LeftButton
    send_mouse(panel.bar, QtCore.QPoint(30, 30), left, left, kind=QtCore.QEvent.Type.MouseButtonDblClick)
    box = panel._end
    assert box.isVisible()
    assert float(box.box.text()) == pytest.approx(own, rel=1e-5)
    for wrong in ("", "far", "-1", "0"):
        box.box.setText(wrong)
        box.box.returnPressed.emit()
        assert "is not a positive number" in box.complaint.text()
    box.box.setText(f"{own / 2:.6g}")
    box.box.returnPressed.emit()
    shown.settle()
    assert not box.isVisible()
    end = shown.document.panels[0].maximum
    assert end == pytest.approx(own / 2, rel=1e-5)
    assert panel.view.scene.field_actor.maximum == end
    assert bar_of(shown)._colours.goes_beyond == (False, True)
    assert shown.document.panels[1].maximum is None
    assert shown.window.tool_bar.buttons["range"].accessibleDescription() == "Typed"
    assert [action.text() for action in shown.window.menus.range.actions() if action.isChecked()] == [
        "End of this colour bar…"
    ]
    panel.ask_end()
    box.own.click()
    shown.settle()
    assert shown.document.panels[0].maximum is None
    assert bar_of(shown)._colours.goes_beyond == (False, False)


def test_shares_are_read_on_the_bar_and_colour_as_before(shown):
    parts(shown.window).isolines.steps(0)  # those of shares are at round percentages
    shown.settle()
    before = pixels(shown)
    parts(shown.window).choices.end_at(1, 0.2)
    parts(shown.window).choices.set(RANGE, "fraction")
    shown.settle()
    assert ticks(shown)[0] == "0 %"
    assert ticks(shown)[-1].endswith("100 %")
    assert are_equal(before, pixels(shown))
    parts(shown.window).choices.set(RANGE, "own")
    shown.settle()
    assert shown.document.panels[1].maximum is None
    assert not any("%" in tick for tick in ticks(shown))


def saved(shown, tmp_path, **more):
    path = tmp_path / "other.json"
    with recipe_written(Recipe(shown.document), ArrayStore(), path, "test"):
        pass
    return path


def test_ends_are_taken_from_a_session(shown, tmp_path):
    path = saved(shown, tmp_path)
    own = [answer.maximum for answer in shown.answers]
    parts(shown.window).typed_source.choose(7)
    shown.until(lambda: shown.session.is_complete)
    said = []
    parts(shown.window).choices.ends.taken.connect(said.append)
    parts(shown.window).choices.ends.take(str(path))
    shown.until(lambda: said or shown.refusals)
    shown.settle()
    assert [panel.maximum for panel in shown.document.panels] == own
    assert said[0].startswith("Colour bars end as in other.json: biharmonic ")
    shown.window.session.undo()
    assert [panel.maximum for panel in shown.document.panels] == [None, None]


def test_ends_that_cannot_be_taken_are_refused_and_those_in_the_making_cancelled(shown, tmp_path):
    ends = parts(shown.window).choices.ends
    (tmp_path / "none.json").write_text(json.dumps({"a": 1}))
    ends.take(str(tmp_path / "none.json"))
    shown.until(lambda: shown.refusals)
    assert "none.json" in shown.refusals[-1]
    path = saved(shown, tmp_path)
    ends.take(str(path))
    ends.cancel()
    shown.settle(0.5)
    assert [panel.maximum for panel in shown.document.panels] == [None, None]
    ends.take(str(path))
    ends.take(str(path))
    shown.until(lambda: shown.document.panels[0].maximum is not None)
    assert len(shown.refusals) == 1


def test_lines_only_are_light_on_dark_where_the_window_is(shown):
    from app.qt.look.look import LOOK

    before = LOOK.choice
    try:
        LOOK.choose("dark")
        choose(shown, "lines")
        shown.settle()
        style, picture = shown.panels[0].view.scene.style, pixels(shown)
        assert sum(style.isoline) > 2 > 0.5 > sum(style.stops[0][1])
        # Of the surface there is no more than its lines.
        assert np.median(picture) < 60
        assert (np.asarray(picture) > 200).mean() < 0.2
    finally:
        LOOK.choose(before)


def test_a_panel_that_waits_to_be_drawn_anew_shows_what_it_did(shown, monkeypatch):
    view = shown.panels[1].view

    def colours():
        image = view.grab().toImage()
        places = [(k * image.width() // 20, image.height() // 2) for k in range(20)]
        return [image.pixelColor(*place).name() for place in places]

    before = colours()
    assert len(set(before)) > 3
    monkeypatch.setattr(view, "_waits", lambda: True)
    # It does not settle: this panel waits for ever.
    next(action for action in shown.window.menus.colours.actions() if action.data() == "lines").trigger()
    shown.until(lambda: not shown.panels[0].view.is_stale)
    assert view.is_stale
    assert colours() == before


def test_a_base_is_chosen_in_the_menu_shown_in_grey_and_undone(shown):
    def base(text):
        menu = next(each.menu() for each in shown.window.menus.colours.actions() if each.text() == "Base in grey")
        menu.aboutToShow.emit()
        next(action for action in menu.actions() if action.text() == text).trigger()
        shown.settle()

    def coloured():
        return [(np.ptp(picture[..., :3].astype(int), axis=2) > 40).mean() for picture in pixels(shown)]

    before = coloured()
    base("Mean curvature")
    assert shown.document.base == Base(CURVATURE)
    assert all(now < 0.5 * then for now, then in zip(coloured(), before, strict=True))
    with_lines = coloured()
    shown.window.actions_by_word["white_isolines"].trigger()
    shown.settle()
    assert all(now < 0.2 * then for now, then in zip(coloured(), with_lines, strict=True))
    for _ in range(2):
        shown.window.actions_by_word["undo"].trigger()
        shown.settle()
    assert coloured() == before
