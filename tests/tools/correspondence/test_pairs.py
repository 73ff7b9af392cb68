"""Correspondence in the window: pairs clicked on two meshes, predicted, accepted, dragged and removed."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import duplicate_panel
from app.document.file import read_recipe
from app.drawing.glyphs import CANDIDATE
from app.figures.export import compute, figure_of, open_document
from app.session.array_store import ArrayStore
from app.tools.correspondence.answers import KnownColumns
from app.tools.correspondence.pairs import half_pair
from app.tools.correspondence.quantity import Prediction
from bihdist_core import BiharmonicDistance, Correspondence, GeodesicDistance, Surface
from bihdist_core.distances.distance_types import Spec
from tests.qt.events import send_mouse
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore, QtTest

from app.tools.correspondence.pairs import Pairs
from tests.qt.parts import parts

LEFT, KEYS = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.Key
BIHARMONIC, GEODESIC = Spec.of("biharmonic"), Spec.of("geodesic")


@pytest.fixture
def alone(screen, mesh_file, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    s = screen((BIHARMONIC, GEODESIC))
    s.open(mesh_file(bumpy(500), "first.off"))
    s.settle()
    return s


@pytest.fixture
def two(alone, mesh_file):
    """Two shapes that are alike, with the tool."""
    s, ball = alone, bumpy(500)
    s.session.open_second_mesh(mesh_file(Surface(2 * ball.vertices * (1, 1.2, 0.9), ball.faces), "second.off"))
    s.until(lambda: len(s.document.surfaces) == 2 and not s.session.is_opening)
    complete(s)
    s.window.actions_by_word["dock pairs"].trigger()
    complete(s)
    return s


def complete(s):
    s.until(lambda: s.session.is_complete)
    s.settle(0.05)


def dock_of(s):
    return parts(s.window).docks._instrument("pairs")


def click(s, panel, vertex):
    QtTest.QTest.mouseClick(s.panels[panel].view, LEFT, pos=s.point_of(s.panels[panel], vertex))
    complete(s)


def press(s, panel, key):
    """On the view of a panel, which has the keys."""
    s.activate()
    s.panels[panel].view.setFocus()
    QtTest.QTest.keyClick(s.panels[panel].view, key)
    complete(s)


def places(s):
    return [tuple(s.document.point(name).at for name in pair.points) for pair in s.document[Pairs].pairs]


def paired(s, count=3):
    """So many pairs, alike on both."""
    pairs = list(zip(s.seen(count, 0), s.seen(count, 1), strict=True))
    for first, second in pairs:
        click(s, 0, first)
        click(s, 1, second)
    assert places(s) == pairs
    return pairs


def misfit(s, kind, at, turned=False):
    """From the first mesh to the second, or turned, of the pairs that are whole."""
    one, two = (kind(s.session.loaded(name).surface) for name in "AB")
    pairs = [pair for pair in places(s) if len(pair) == 2]
    if turned:
        one, two, pairs = two, one, [(b, a) for a, b in pairs]
    return Correspondence(one, two, pairs).misfit(at)


def test_with_one_mesh_the_tool_says_what_to_open_and_changes_nothing(alone):
    s, before = alone, alone.document.panels
    s.window.actions_by_word["dock pairs"].trigger()
    complete(s)
    assert dock_of(s).open_second_mesh.isVisible()
    assert "second one" in dock_of(s).hint.text()
    assert s.document.panels == before


def test_the_tool_shows_the_first_mesh_plain_and_the_second_for_each_distance(two):
    s = two
    assert [(p.surface, p.shows) for p in s.document.panels] == [
        ("A", Prediction(BIHARMONIC)),
        ("B", Prediction(BIHARMONIC)),
        ("B", Prediction(GEODESIC)),
    ]
    assert [panel.answer.field for panel in s.panels] == [None] * 3
    assert s.panels[0].head.name.text() == "first.off"
    assert not parts(s.window).typed_source.box.isEnabled()
    s.window.session.undo()
    complete(s)
    assert len(s.document.panels) == 4


@pytest.mark.parametrize("shows", ["predictions", "maps"])
@pytest.mark.parametrize("way", ["button", "closing"])
def test_the_button_and_closing_the_dock_bring_the_distances_back(two, shows, way):
    s = two
    paired(s)
    if shows == "maps":
        dock_of(s).errors.show_or_leave_maps()
        complete(s)
    if way == "button":
        dock_of(s).back.click()
    else:
        s.window.actions_by_word["dock pairs"].trigger()
    complete(s)
    assert all(panel.shows.is_distance for panel in s.document.panels)
    assert {panel.surface for panel in s.document.panels} == {"A", "B"}
    assert len(s.document[Pairs].pairs) == 3


def test_the_panels_stand_in_one_row_where_there_is_room(two):
    s = two
    s.session.show(duplicate_panel(s.document, s.document.panels[-1].id))
    complete(s)
    for width, rows in ((1590, 1), (1000, 2)):
        s.window.resize(width, 800)
        s.settle(0.1)
        tops = {panel.geometry().top() for panel in s.panels}
        assert len(s.panels) == 4
        assert len(tops) == rows
        assert min(panel.width() for panel in s.panels) >= 280


def candidate_in(panel):
    (found,) = [each for each in panel.view.over.points.placed("pairs") if each.mark.glyph is CANDIDATE]
    return found


def test_a_click_predicts_by_every_distance_and_enter_accepts(two):
    s = two
    paired(s)
    vertex = s.seen(6, 0)[-1]
    click(s, 0, vertex)
    assert half_pair(s.document) is not None
    for panel, kind in ((1, BiharmonicDistance), (2, GeodesicDistance)):
        expected = misfit(s, kind, vertex)
        assert s.answers[panel].field == pytest.approx(expected, abs=1e-9)
        candidate = candidate_in(s.panels[panel])
        assert (candidate.mark.number, candidate.mark.text) == (4, str(int(np.argmin(expected))))
        bar = s.panels[panel].bar._reading
        assert (bar.value, bar.unit) == (pytest.approx(expected.min(), abs=1e-9), "misfit of the best")
    assert "waits for its partner on B" in s.panels[0].bar.accessibleDescription()
    row = dock_of(s).rows[s.document[Pairs].pairs[-1].points[0]]
    best = int(np.argmin(misfit(s, BiharmonicDistance, vertex)))
    assert (row.first, row.second) == (str(vertex), f"{best} ?")
    press(s, 0, KEYS.Key_Return)
    assert places(s)[-1] == (vertex, best)
    assert half_pair(s.document) is None
    s.window.session.undo()
    complete(s)
    assert places(s)[-1] == (vertex,)
    assert s.answers[1].field is not None


def test_the_active_panel_says_which_candidate_is_accepted_and_its_drop_can_be_clicked(two):
    s = two
    paired(s)
    click(s, 0, s.seen(6, 0)[-1])
    best = [int(np.argmin(s.answers[k].field)) for k in (1, 2)]

    def highlighted():
        return [panel.view.over.points.is_target for panel in s.panels]

    # The click has made the panel of the first mesh active, and the first that predicts is meant.
    assert highlighted() == [False, True, False]
    assert f"Enter takes\u00a0{best[0]}, by\u00a0biharmonic;" in dock_of(s).or_click.text()
    label = s.panels[1].view.grab().toImage()
    s.window.grid.activate(s.panels[2].id)
    assert parts(s.window).pairs.candidate()[1].vertex == best[1]
    assert highlighted() == [False, False, True]
    assert f"Enter takes\u00a0{best[1]}, by\u00a0geodesic;" in dock_of(s).or_click.text()
    assert [row.second for row in dock_of(s).rows.values()][-1] == f"{best[1]} ?"
    assert s.panels[1].view.grab().toImage() != label  # it no longer stands out
    view = s.panels[2].view
    tip = view.place_of(candidate_in(s.panels[2]).position)
    QtTest.QTest.mouseClick(view, LEFT, pos=QtCore.QPoint(round(tip.x()), round(tip.y()) - 15))
    complete(s)
    assert places(s)[-1][1] == best[1]


def test_a_point_of_the_second_mesh_is_predicted_on_the_first_and_escape_gives_it_up(two):
    s = two
    pairs = paired(s)
    vertex = s.seen(6, 1)[-1]
    click(s, 1, vertex)
    assert s.answers[0].field == pytest.approx(misfit(s, BiharmonicDistance, vertex, turned=True), abs=1e-9)
    assert [answer.field for answer in s.answers[1:]] == [None, None]
    assert s.panels[0].head.name.text() == "Prediction"
    s.window.actions_by_word["stop"].trigger()
    complete(s)
    assert places(s) == pairs
    s.window.session.undo()
    complete(s)
    assert places(s) == [*pairs, (vertex,)]


def test_a_drag_of_a_drop_is_one_step_and_of_the_waiting_point_costs_no_solve(two):
    s = two
    paired(s)
    start, stop = s.seen(6, 0)[-2:]
    click(s, 0, start)

    def solved():
        return [s.session.loaded(name).memory(KnownColumns).solved for name in "AB"]

    before, view = solved(), s.panels[0].view
    drag(s, view, s.point_of(s.panels[0], start), s.point_of(s.panels[0], stop))
    assert (places(s)[-1], solved()) == ((stop,), before)
    assert not parts(s.window).dragging.is_on
    assert "Live" not in s.window.status.message.text
    assert s.answers[1].field == pytest.approx(misfit(s, BiharmonicDistance, stop), abs=1e-9)
    s.window.session.undo()
    complete(s)
    assert places(s)[-1] == (start,)
    first = places(s)[0][1]
    drag(s, s.panels[1].view, s.point_of(s.panels[1], first), s.point_of(s.panels[1], s.seen(6, 1)[-1]))
    assert places(s)[0][1] != first
    assert s.answers[1].field == pytest.approx(misfit(s, BiharmonicDistance, start), abs=1e-9)


def drag(s, view, start, stop):
    """A drop by its head, so that its tip goes from one place to another."""
    head = QtCore.QPoint(0, 15 if view.over.points.standing_at(start - QtCore.QPoint(0, 15)) is None else -15)
    QtTest.QTest.mousePress(view, LEFT, pos=start + head)
    for k in range(1, 7):
        place = start + head + (stop - start) * k / 6
        send_mouse(view, place, LEFT, LEFT)
    QtTest.QTest.mouseRelease(view, LEFT, pos=stop + head)
    complete(s)


def test_live_the_point_that_waits_follows_the_pointer_until_its_partner_is_clicked(two):
    s = two
    pairs = paired(s)
    s.window.actions_by_word["live"].trigger()
    start, stop = s.seen(6, 0)[-2:]
    solved = []
    for vertex in (start, stop):
        hover(s, 0, vertex)
        s.until(lambda vertex=vertex: places(s)[-1] == (vertex,))
        complete(s)
        solved.append([s.session.loaded(name).memory(KnownColumns).solved for name in "AB"])
    assert solved[0] == solved[1]  # a point that follows costs nothing
    assert s.answers[1].field == pytest.approx(misfit(s, BiharmonicDistance, stop), abs=1e-9)
    there = s.seen(6, 1)[-1]
    hover(s, 1, there)  # that is where the partner is looked for, and nothing moves
    assert places(s)[-1] == (stop,)
    click(s, 1, there)
    assert places(s)[-1] == (stop, there)
    # The partner is a step, and what was followed another, or two where the pointer rested between them.
    s.window.actions_by_word["live"].trigger()
    seen = []
    while len(seen) < 3 and pairs not in seen:
        s.window.session.undo()
        complete(s)
        seen.append(places(s))
    assert seen[0] == [*pairs, (stop,)]
    assert seen[1:] in ([pairs], [[*pairs, (start,)], pairs])


def hover(s, panel, vertex):
    """The pointer over a vertex, no button down."""
    s.hover(s.point_of(s.panels[panel], vertex), panel)
    s.settle(0.05)


def test_rows_are_chosen_walked_and_removed_by_bin_and_key(two):
    s = two
    pairs = paired(s, 4)
    rows = list(dock_of(s).rows.values())
    assert [(row.first, row.second) for row in rows] == [(str(a), str(b)) for a, b in pairs]
    QtTest.QTest.mouseClick(rows[1], LEFT, pos=QtCore.QPoint(40, 10))
    assert rows[1].point in s.window.grid.marks.highlighted("pairs")
    QtTest.QTest.keyClick(rows[1], KEYS.Key_Down)
    assert rows[2].point in s.window.grid.marks.highlighted("pairs")
    QtTest.QTest.keyClick(rows[2], KEYS.Key_Delete)
    complete(s)
    assert places(s) == [pairs[0], pairs[1], pairs[3]]
    QtTest.QTest.mouseClick(rows[0].bin, LEFT)
    complete(s)
    assert places(s) == [pairs[1], pairs[3]]
    # A point that a pair has already chooses that, and Delete over the panels removes it.
    parts(s.window).pairs.put(s.panels[0].id, pairs[1][0])
    press(s, 0, KEYS.Key_Delete)
    assert places(s) == [pairs[3]]


def test_pairs_are_read_and_saved_and_what_is_wrong_is_said(two, tmp_path, monkeypatch):
    s = two
    path = tmp_path / "pairs.csv"
    path.write_text("3,3\n40,41\n3,3\n")
    dock_of(s).read(str(path))
    complete(s)
    assert places(s) == [(3, 3), (40, 41)]
    refused = []
    s.window.refused.connect(refused.append)
    (tmp_path / "wrong.csv").write_text("3,3\n4,500\n")
    dock_of(s).read(str(tmp_path / "wrong.csv"))
    assert "line 2: second.off has vertices 0 to 499, not 500" in refused[-1]
    assert places(s) == [(3, 3), (40, 41)]
    monkeypatch.setattr("app.qt.files.saving.ask_path", lambda *_: str(tmp_path / "out.csv"))
    dock_of(s).choose_and_save()
    assert (tmp_path / "out.csv").read_text() == "3,3\n40,41\n"


def test_a_session_keeps_them_and_a_figure_draws_them(two, tmp_path):
    s = two
    paired(s)
    click(s, 0, s.seen(6, 0)[-1])
    parts(s.window).session_file.save(str(tmp_path / "session.json"))
    recipe = read_recipe(str(tmp_path / "session.json"))
    assert recipe.document[Pairs].pairs == s.document[Pairs].pairs
    assert "pairs" in recipe.document.docks
    document, surfaces = open_document(recipe, ArrayStore())
    panels = figure_of(replace(recipe, document=document), surfaces, compute(document, surfaces)).panels
    drops = [[(m.number, m.vertex) for m in panel.marks if m.number and m.glyph is not CANDIDATE] for panel in panels]
    assert drops[0] == [(k, pair[0]) for k, pair in enumerate(places(s), 1)]
    assert drops[1] == drops[2] == [(k, pair[1]) for k, pair in enumerate(places(s)[:3], 1)]
    for k in (1, 2):
        (candidate,) = [mark for mark in panels[k].marks if mark.glyph is CANDIDATE]
        assert (candidate.number, candidate.vertex) == (4, int(np.argmin(s.answers[k].field)))
    assert [panels[0].heading, panels[0].field] == ["first.off", None]
    assert "waits for its partner on B" in panels[0].hint


def test_distances_are_shown_again_and_closing_the_second_mesh_leaves_no_pair(two):
    s = two
    paired(s)
    dock_of(s).end_tool()
    complete(s)
    assert [panel.shows.spec for panel in s.document.panels] == [BIHARMONIC, BIHARMONIC, GEODESIC]
    assert dock_of(s).start.isVisible()
    QtTest.QTest.mouseClick(dock_of(s).start, LEFT)
    complete(s)
    assert len(s.document[Pairs].pairs) == 3
    s.session.close_second_mesh()
    complete(s)
    assert (s.document[Pairs].pairs, [panel.shows.spec for panel in s.document.panels]) == ((), [BIHARMONIC])
    assert dock_of(s).open_second_mesh.isVisible()
