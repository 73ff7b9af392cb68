"""What a recipe has besides panels, in the window: insets, anchors, reliefs and styles."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy.QtGui import QColor

from app.document.document import Inset, Point, comparison
from app.document.edits import move_source
from app.document.file import recipe_text
from app.document.page import Page, Recipe
from app.qt.look.canvas import canvas_style
from app.qt.look.look import LOOK
from app.scene.style import STYLES
from app.tools.interpolation.part import Anchor, Anchors
from bihdist_core.distances.distance_types import Spec
from tests.qt.painting import painted
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

SIZE = 2  # device pixels by which a place may be off
USUAL = Page()


@pytest.fixture
def shown(screen, mesh_file, tmp_path):
    """A window with a recipe opened in it."""

    def show(surface, page=USUAL, source=4, **others):
        document = comparison(mesh_file(surface), (Spec.of("biharmonic"), Spec.of("geodesic")), (source,))
        document = replace(document, **others)
        (tmp_path / "r.json").write_text(recipe_text(Recipe(document, page), "0"))
        s = screen()
        parts(s.window).session_file.open(str(tmp_path / "r.json"))
        s.until(lambda: s.session.is_complete or s.refusals)
        assert s.refusals == []
        s.settle()
        return s

    return show


@pytest.fixture
def theme(application):
    """Choose the window's theme, for one test."""
    before = LOOK.choice
    yield LOOK.choose
    LOOK.choose(before)


def seen_at(panel, vertex, renderer=None):
    """The device pixel at which a vertex of a panel's surface is drawn, y up."""
    renderer = renderer or panel.view.renderer
    renderer.SetWorldPoint(*panel.positions[vertex], 1)
    renderer.WorldToDisplay()
    return np.array(renderer.GetDisplayPoint()[:2])


def colour_at(panel, pixel):
    """RGB, 0 to 1, the mean of a few pixels."""
    picture = panel.view.shot()[::-1]
    x, y = np.round(pixel).astype(int)
    return picture[y - 1 : y + 2, x - 1 : x + 2].mean(axis=(0, 1)) / 255


def facing(s):
    """A vertex in the middle of what is seen."""
    return hit(s.panels[0], 0.55).vertex


def hit(panel, height):
    """What is seen in the middle, at a share of the view's height."""
    width, top = panel.view.pixels
    return panel.view.picker.pick(panel.view.renderer, width / 2, height * top)


# ---------------------------------------------------------------------- insets
def test_an_inset_enlarges_what_the_panel_shows(shown):
    surface = bumpy(2000)
    s = shown(surface)
    vertex = facing(s)
    s.session.show(replace(s.document, insets=(Inset(vertex, 4.0, "top left"),)))
    s.settle()
    panel = s.panels[0]
    (inset,) = panel.view.scene.insets.renderers
    centre = np.array(inset.GetOrigin()) + np.array(inset.GetSize()) / 2
    assert np.abs(seen_at(panel, vertex, inset) - centre).max() <= SIZE
    # Four times as far from each other, whatever the direction.
    for other in surface.faces[(surface.faces == vertex).any(axis=1)].ravel():
        apart = seen_at(panel, other) - seen_at(panel, vertex)
        assert np.allclose(seen_at(panel, other, inset) - seen_at(panel, vertex, inset), 4 * apart, atol=SIZE)
    # It is square, in its corner, and follows the camera.
    width, height = panel.view.pixels
    assert inset.GetSize()[0] == pytest.approx(0.4 * min(width, height), abs=2)
    assert inset.GetOrigin()[0] < 10
    assert inset.GetOrigin()[1] + inset.GetSize()[1] > height - 10
    s.window.grid.camera_controller.camera.Azimuth(20)
    s.window.grid.redraw()
    s.settle()
    assert np.abs(seen_at(panel, vertex, inset) - centre).max() <= SIZE


def test_a_click_in_an_inset_selects_what_is_seen_there(shown):
    from qtpy import QtCore, QtTest

    s = shown(bumpy(2000), source=9)
    vertex = facing(s)
    assert vertex != s.source
    s.session.show(replace(s.document, insets=(Inset(vertex, 5.0, "top right"),)))
    s.settle()
    panel = s.panels[1]
    (inset,) = panel.view.scene.insets.renderers
    x, y = np.array(inset.GetOrigin()) + np.array(inset.GetSize()) / 2
    place = QtCore.QPoint(int(x), int(panel.view.height() - y))
    QtTest.QTest.mouseClick(panel.view, QtCore.Qt.MouseButton.LeftButton, pos=place)
    assert s.source == vertex


def test_an_inset_that_may_stand_anywhere_hides_the_least(shown):
    """A strip along one diagonal of the view leaves two corners free."""
    surface = grid(30, 30)
    x = surface.vertices
    keep = np.abs(x[surface.faces].mean(axis=1) @ [1, -1, 0]) < 0.25 * np.ptp(x[:, 0])
    strip = type(surface)(x, surface.faces[keep], "strip")
    used = np.unique(strip.faces)
    middle = int(used[np.abs(x[used] - x[used].mean(axis=0)).sum(axis=1).argmin()])
    s = shown(strip, source=middle, insets=(Inset(middle, 6.0), Inset(middle, 6.0)))
    assert sorted(s.panels[0].view.scene.insets.corners) == ["bottom right", "top left"]


def test_insets_come_and_go_with_the_document(shown):
    s = shown(bumpy(300), insets=(Inset(7), Inset(9, corner="bottom left")))
    window = s.panels[0].view.renderer.GetRenderWindow()
    count = window.GetRenderers().GetNumberOfItems()
    before = s.pictures()
    s.session.show(replace(s.document, insets=()))
    s.settle()
    assert window.GetRenderers().GetNumberOfItems() == count - 2 * len(s.panels)  # one window draws all panels
    assert all((a != b).any() for a, b in zip(before, s.pictures(), strict=True))
    s.session.undo()
    s.settle()
    assert all((a != b).mean() < 0.005 for a, b in zip(before, s.pictures(), strict=True))


# ---------------------------------------------------------------------- anchors
def test_anchors_are_light_in_their_middle_whatever_their_values(shown):
    s = shown(bumpy(2000))
    vertex, top = facing(s), s.answers[0].maximum
    for value in (None, 0.0, 0.5 * top, 9 * top):
        points = (s.document.point("source"), Point("anchor", vertex))
        s.session.show(replace(s.document, points=points).with_part(Anchors(anchors=(Anchor("anchor", value),))))
        s.settle(0.1)
        x, y = np.round(seen_at(s.panels[0], vertex)).astype(int)
        assert painted(s.panels[0].view)[::-1][y - 1 : y + 2, x - 1 : x + 2].min() > 230
    s.session.show(s.document.with_part(Anchors(anchors=())))
    s.settle(0.1)
    assert not len(s.panels[0].view.over.points.positions("anchors"))


# ---------------------------------------------------------------------- reliefs
def test_a_flat_surface_becomes_a_relief_of_each_panels_field_and_flat_again(shown):
    surface = grid(12, 12)
    s = shown(surface, warp_factor=0.4)
    for panel, answer in zip(s.panels, s.answers, strict=True):
        raised = surface.vertices[:, 2] + 0.4 * np.ptp(surface.vertices, axis=0).max() * answer.field / answer.maximum
        assert np.allclose(panel.positions[:, 2], raised)
        # A click finds the vertices where they are now.
        vertex = int(np.abs(surface.vertices - surface.vertices.mean(axis=0)).sum(axis=1).argmin())
        assert panel.view.picker.pick(panel.view.renderer, *seen_at(panel, vertex)).vertex == vertex
    s.session.show(replace(s.document, warp_factor=0.0))
    s.settle()
    assert all(np.array_equal(panel.positions, surface.vertices) for panel in s.panels)
    s.session.undo()
    s.settle()
    assert all(np.ptp(panel.positions[:, 2]) > 0 for panel in s.panels)


def test_a_surface_that_is_not_flat_stays_as_it_is(shown):
    surface = bumpy(300)
    s = shown(surface, warp_factor=0.4)
    assert all(np.array_equal(panel.positions, s.session.mesh().surface.vertices) for panel in s.panels)


# ---------------------------------------------------------------------- styles
def is_on_the_windows_ground(panel):
    return np.allclose(colour_at(panel, (5, 5)), QColor(LOOK.theme.canvas).getRgbF()[:3], atol=0.01)


def test_a_recipe_is_shown_in_its_style_on_the_windows_ground_and_the_next_in_its_own(shown, tmp_path):
    s = shown(bumpy(300), Page(style="uniform"), insets=(Inset(7, corner="top right"),))

    def styles():
        assert all(is_on_the_windows_ground(panel) for panel in s.panels)
        assert all(panel.view.scene.field_actor.maximum > 0 for panel in s.panels)
        return {panel.view.scene.style for panel in s.panels}

    assert styles() == {canvas_style("uniform", LOOK.theme)}
    parts(s.window).choices.add_panel()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert (len(s.panels), styles()) == (3, {canvas_style("uniform", LOOK.theme)})
    (tmp_path / "p.json").write_text(recipe_text(Recipe(s.document), "0"))
    parts(s.window).session_file.open(str(tmp_path / "p.json"))
    s.until(lambda: s.window.context.page == Page())
    s.settle()
    assert styles() == {canvas_style("paper", LOOK.theme)}


def test_another_theme_has_the_twin_of_a_style_and_changes_no_page_and_nothing_of_what_is_shown(shown, theme):
    theme("dark")
    anchor = {"parts": (Anchors((Anchor("source", 0.1),)),), "warp_factor": 0.3}
    s = shown(grid(12, 12), Page(style="dark"), insets=(Inset(7, corner="top right"),), **anchor)
    pictures, isolines = {}, [panel.view.scene.field_actor.levels.values for panel in s.panels]
    assert all(map(len, isolines))
    # The menu bar has its height from the first change of the theme on, and so have the views.
    for word, style in (("light", "paper"), ("dark", "dark"), ("light again", "paper"), ("dark again", "dark")):
        theme(word.split()[0])
        s.settle()
        pictures[word] = s.pictures()
        assert s.window.context.page == Page(style="dark")
        for panel, lines in zip(s.panels, isolines, strict=True):
            scene = panel.view.scene
            assert (scene.style.stops, is_on_the_windows_ground(panel)) == (STYLES[style].stops, True)
            assert len(scene.insets.renderers) == 1
            assert np.array_equal(scene.field_actor.levels.values, lines)
            assert len(panel.view.over.points.positions("anchors"))
            assert np.ptp(panel.positions[:, 2]) > 0
    for word in ("light", "dark"):
        assert all(np.array_equal(a, b) for a, b in zip(pictures[word], pictures[f"{word} again"], strict=True))
    assert all((a != b).mean() > 0.5 for a, b in zip(pictures["light"], pictures["dark"], strict=True))


def test_a_relief_higher_than_its_colour_bar_stays_in_view(shown):
    surface = grid(12, 12)
    s = shown(surface, warp_factor=0.4)
    panels = tuple(replace(panel, maximum=s.answers[0].maximum / 8) for panel in s.document.panels)
    s.session.show(replace(s.document, panels=panels))
    s.settle()
    extent = np.ptp(surface.vertices, axis=0).max()
    assert s.panels[0].positions[:, 2].max() == pytest.approx(surface.vertices[0, 2] + 0.4 * extent)
    pixels = np.array([seen_at(s.panels[0], vertex) for vertex in range(len(surface.vertices))])
    assert (pixels >= 0).all()
    assert (pixels <= s.panels[0].view.pixels).all()


# ---------------------------------------------------------------------- what cannot be, and what must not stay
def test_an_inset_at_a_vertex_that_there_is_not_is_refused_and_nothing_changes(shown):
    s = shown(bumpy(100))
    before = s.document
    s.session.show(replace(before, insets=(Inset(99_999),)))
    assert "no vertex 99999" in s.refusals.pop()
    assert s.document == before
    s.settle(0.1)


def test_the_mark_of_the_source_is_not_held_through_an_inset_over_it(shown):
    s = shown(bumpy(2000))
    panel = s.panels[0]
    vertex = hit(panel, 0.75).vertex
    s.session.show(move_source(s.document, s.document.panels[0].id, vertex))
    s.settle()
    s.until(lambda: s.session.is_complete)
    place = s.point_of(panel, vertex)
    assert panel.view.mark_at(place) == 0
    panel.view.scene.insets.renderer_at = lambda x, y: None  # an inset stands there
    assert panel.view.mark_at(place) < 0


def test_a_panel_that_is_removed_keeps_nothing_of_what_it_showed(shown):
    import gc
    import weakref

    s = shown(bumpy(300))
    shown_by = weakref.ref(s.answers[1].field)
    kept = s.panels[1]
    parts(s.window).choices.edit_panel(s.document.panels[1].id, "Remove panel")
    s.session._answering._kept = type(s.session._answering._kept)()
    s.settle()
    gc.collect()
    assert shown_by() is None
    assert kept.loaded is None
    s.window.session.undo()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert s.panels[1].answer.field is s.answers[1].field


@pytest.mark.parametrize("chosen_in", ["recipe", "menu"])
def test_a_style_leaves_nothing_of_the_one_before(shown, chosen_in):
    s = shown(bumpy(300), insets=(Inset(7),))
    panel = s.panels[0]

    def counted():
        window, props = panel.view.renderer.GetRenderWindow(), panel.view.renderer.GetViewProps()
        return window.GetRenderers().GetNumberOfItems(), props.GetNumberOfItems()

    before, pictures = counted(), s.pictures()
    entries = {"uniform": [("map", "uniform")], "lines": ["lines"], "paper": ["paper", ("map", "paper")]}
    for style, chosen in entries.items():
        if chosen_in == "recipe":
            s.window.show_document(s.document, Page(style=style))
        else:
            for word in chosen:
                next(each for each in s.window.menus.colours.actions() if each.data() == word).trigger()
        s.settle(0.1)
        assert panel.view.scene.style.stops == STYLES[style].stops
        assert counted() == before
        assert all((a != b).any() == (style != "paper") for a, b in zip(pictures, s.pictures(), strict=True))
    assert s.window.context.page == Page()
