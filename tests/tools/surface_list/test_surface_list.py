"""The list of what is on the surface: what it holds, hides and removes, in the window and in figures."""

import numpy as np
import pytest

from app.document.document import comparison
from app.document.edits import pass_through, show_dock
from app.document.form import document_data, document_from
from app.document.on_surface import (
    Hidden,
    by_products,
    clear_surface,
    hide,
    is_hidden,
    item_counts,
    remove_items,
    surface_items,
)
from app.document.page import Recipe
from app.document.shared_parts.pins import Pins, add_pins, remove_pins
from app.document.shared_parts.selections import Selections, select, without_selection
from app.figures.export import compute, figure_of, open_document
from app.marks.primitives import AreaMark, LineMark, PointMark
from app.session.array_store import ArrayStore
from app.tools.interpolation.part import Anchors, add_anchor
from app.tools.regions.part import DividedPanels, divide
from app.tools.surface_list.options import ROWS
from bihdist_core import ParameterError
from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")


def furnished(document):
    """Three pins with borders, two selections, two anchors and an isoline through a point."""
    document = divide(add_pins(document, [20, 60, 90]), "all")
    document = select(select(document, "selection", np.arange(30, 40)), "left horn", np.arange(50, 55))
    document, _ = add_anchor(document, 110, 1.0)
    document, _ = add_anchor(document, 120, 0.0)
    return pass_through(document, (130,))


@pytest.fixture
def document():
    return furnished(comparison("a.off", sources=(5,)))


def by_name(document):
    return {item.name: item for item in surface_items(document)}


# ---------------------------------------------------------------------- the document
def test_all_that_tools_mark_is_listed_in_groups(document):
    assert [(item.name, item.detail) for item in surface_items(document)] == [
        ("Source", "vertex 5"),
        ("Isolines through points", "1"),
        ("Pins", "3"),
        ("Selections", "2"),
        ("Borders of regions", "in 3 panels"),
        ("Anchors", "2 of Interpolation"),
    ]
    members = {item.name: [(each.name, each.detail) for each in item.members] for item in surface_items(document)}
    assert members["Pins"] == [("Pin 1", "vertex 20"), ("Pin 2", "vertex 60"), ("Pin 3", "vertex 90")]
    assert members["Selections"] == [("Selection", "10 vertices"), ("Selection", "left horn, 5 vertices")]
    assert item_counts(document) == (9, 0)


def test_a_selection_with_a_name_of_its_own_keeps_it(document):
    named = select(document, "selections of L-Ear", np.arange(1))
    row = next(item for item in surface_items(named) if item.word == "selections").members[-1]
    assert (row.name, row.detail) == ("Selection", "selections of L-Ear, 1 vertex")


def test_each_thing_can_be_removed_by_itself_and_the_source_stays(document):
    for item in surface_items(document):
        for each in (item, *item.members):
            if each.remove is None:
                assert item.name == "Source"
                continue
            after = remove_items(document, [each])
            left = [leaf.word for other in surface_items(after) for leaf in other.leaves]
            assert each.word not in left
            assert after.panels == document.panels
    cleared = clear_surface(document)
    assert [item.name for item in surface_items(cleared)] == ["Source"]
    assert cleared == comparison("a.off", sources=(5,))


def test_a_source_that_is_nowhere_yet_can_be_hidden():
    document = comparison("a.off")
    (source,) = surface_items(document)
    assert (source.name, source.detail) == ("Source", "")
    assert hide(document, source)[Hidden].hidden == ("source",)


def test_what_is_not_there_cannot_be_hidden_by_a_word():
    (row,) = ROWS
    document = add_pins(comparison("a.off"), [3])
    with pytest.raises(ParameterError, match="no 'anchors' on the surface to hide; there is source, pins, pins:1"):
        row.put(Recipe(document), {"hide": ["anchors"]})
    assert row.put(Recipe(document), {"hide": ["pins:1"]}).document[Hidden].hidden == ("pins:pin",)


def test_a_source_of_several_members_loses_one_at_a_time():
    document = comparison("a.off", sources=("5+9",))
    (sources,) = surface_items(document)
    assert [member.name for member in sources.members] == ["vertex 5", "vertex 9"]
    after = remove_items(document, [sources.members[0]])
    assert after.sources == (9,)
    (source,) = surface_items(after)
    assert source.remove is None
    assert remove_items(after, [source]) == after


def test_what_is_hidden_is_kept_in_files_and_shown_again(document):
    for item in surface_items(document):
        hidden = hide(document, item)
        assert is_hidden(hidden, item)
        assert document_from(document_data(hidden)) == hidden
        assert hide(hidden, item, is_hidden=False) == document
    one = hide(document, by_name(document)["Pins"].members[1])
    assert not is_hidden(one, by_name(one)["Pins"])
    assert item_counts(one) == (8, 1)


def test_what_comes_under_the_name_of_something_hidden_is_seen(document):
    hidden = hide(hide(document, by_name(document)["Pins"]), by_name(document)["Selections"])
    without = without_selection(remove_pins(hidden, hidden[Pins].points), "selection")
    assert without[Hidden].hidden == ("selections:left horn",)
    again = select(add_pins(without, [20]), "selection", np.arange(3))
    assert not is_hidden(again, by_name(again)["Pins"])
    assert [is_hidden(again, each) for each in by_name(again)["Selections"].members] == [True, False]


def test_esc_is_meant_for_selections_and_borders_of_closed_tools(document):
    assert [item.name for item in by_products(document)] == ["Selections", "Borders of regions"]
    is_open = show_dock(document, "scatter")
    assert [item.name for item in by_products(is_open, of_closed=True)] == ["Borders of regions"]
    assert len(by_products(is_open)) == 2


# ---------------------------------------------------------------------- figures
def marks_in_figure(document):
    document, surfaces = open_document(Recipe(document), ArrayStore())
    return figure_of(Recipe(document), surfaces, compute(document, surfaces)).panels[0]


def test_what_is_hidden_is_in_no_figure(mesh_file):
    document = furnished(comparison(str(mesh_file(bumpy(300))), sources=(5,)))
    panel = marks_in_figure(document)
    whole = len(panel.marks), len(panel.lines), len(panel.areas)
    lost = {}
    for item in surface_items(document):
        panel = marks_in_figure(hide(document, item))
        now = len(panel.marks), len(panel.lines), len(panel.areas)
        lost[item.name] = tuple(before - after for before, after in zip(whole, now, strict=True))
    borders = whole[1]
    assert borders > 0
    assert lost == {
        "Source": (1, 0, 0),
        "Isolines through points": (1, 0, 0),
        "Pins": (3, 0, 0),
        "Selections": (0, 0, 2),
        "Borders of regions": (0, borders, 0),
        "Anchors": (2, 0, 0),
    }


# ---------------------------------------------------------------------- the window
@pytest.fixture
def window(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    s.window.context.session.show(furnished(s.document))
    s.until(lambda: s.session.is_complete and parts(s.window).regions.dividing.is_complete)
    s.settle(0.1)
    return s


def drawn(s, kind):
    shown = s.panels[0].marks._shown
    return [mark for marks in shown.values() for mark in marks if isinstance(mark, kind)]


def dock_of(s):
    if "surface" not in s.document.docks:
        s.window.status.marks.click()
        s.settle(0.1)
    return parts(s.window).docks._docks["surface"].content


def test_the_chip_counts_what_is_there_and_opens_the_list(window):
    s = window
    chip = s.window.status.marks
    assert chip.words == "9 on the surface"
    dock = dock_of(s)
    assert s.document.docks == ("surface",)
    assert [row.item.name for row in dock.rows.values()][:3] == ["Source", "Isolines through points", "Pins"]
    chip.click()
    assert s.document.docks == ()
    s.window.context.session.show(clear_surface(s.document))
    assert not chip.isVisible()


def test_an_eye_hides_in_all_panels_and_is_undone(window):
    s, dock = window, dock_of(window)
    count, lines = len(drawn(s, PointMark)), len(drawn(s, LineMark))
    for word, kind, gone in (("source", PointMark, 1), ("pins", PointMark, 3), ("borders", LineMark, lines)):
        before = len(drawn(s, kind))
        dock.rows[word].eye.click()
        s.settle(0.05)
        assert len(drawn(s, kind)) == before - gone
        assert dock.rows[word].accessibleName().endswith(", hidden")
    assert not dock.note.isHidden()
    assert s.window.status.marks.words == "5 on the surface, 5 hidden"
    for _ in range(3):
        s.session.undo()
    s.settle(0.05)
    assert (len(drawn(s, PointMark)), len(drawn(s, LineMark))) == (count, lines)
    assert dock.note.isHidden()


def test_a_bin_removes_one_thing_and_the_keys_go_on_to_the_next(window):
    s, dock = window, dock_of(window)
    s.activate()
    row = dock.rows["selections:selection"]
    row.bin.setFocus()
    row.bin.click()
    s.settle(0.05)
    assert [each.name for each in s.document[Selections].selections] == ["left horn"]
    assert len(drawn(s, AreaMark)) == 1
    s.session.undo()
    assert list(dock.rows)[4:8] == ["pins:pin 2", "pins:pin 3", "selections", "selections:selection"]
    s.session.redo()
    # A group of one is one row.
    assert "selections" not in dock.rows
    assert dock.rows["selections:left horn"].eye.hasFocus()
    dock.clear.click()
    s.settle(0.05)
    assert list(dock.rows) == ["source"]
    assert not dock.clear.isEnabled()
    s.session.undo()
    assert len(s.document[Pins].pins) == 3
    assert s.document[Anchors].anchors


def test_esc_clears_selections_and_borders_of_closed_tools_in_one_step(window):
    s = window
    stop = s.window.actions_by_word["stop"]
    s.window.actions_by_word["dock regions"].trigger()
    stop.trigger()
    assert not s.document[Selections].selections
    assert s.document[DividedPanels].regions
    assert "Ctrl+Z" in s.window.status.message.text
    s.window.actions_by_word["dock regions"].trigger()
    stop.trigger()
    assert not s.document[DividedPanels].regions
    assert len(s.document[Pins].pins) == 3
    s.session.undo()
    s.session.undo()
    assert len(s.document[Selections].selections) == 2


def test_the_palette_finds_what_clears_a_selection(window):
    from app.qt.pages.palette import found

    s = window
    commands = parts(s.window).guide.commands()
    assert "Clear selections and borders" in [each.title for each in found(commands, "selection")][:3]
    titles = [each.title for each in found(commands, "delete")]
    assert titles
    assert not any("panel" in title.lower() for title in titles)
    next(each for each in commands if each.title == "Clear selections and borders").action.trigger()
    assert not s.document[Selections].selections
    assert not s.window.actions_by_word["clear by-products"].isEnabled()
