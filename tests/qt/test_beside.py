"""Two meshes in one window: panels of each, a camera for each, linked or not; closing the second again."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from qtpy import QtCore, QtTest

from app.document.document import MeshFile
from app.document.file import read_recipe, recipe_text
from app.document.second_mesh_edits import open_second_mesh
from app.document.shared_parts.pins import Pins
from app.document.tools import docked_tools
from app.scene.camera import frame
from bihdist_core import Surface
from bihdist_core.distances.distance_types import Spec
from tests.conftest import write_off
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

ONE = (Spec.of("geodesic", method="dijkstra"),)


pytestmark = pytest.mark.usefixtures("own_folder")


def turned_and_larger(surface):
    """The same faces elsewhere: a second pose."""
    return Surface(3 * surface.vertices[:, [1, 2, 0]] + 5, surface.faces)


@pytest.fixture
def two(shared_screen):
    """A bumpy ball, and beside it the same one larger, turned and elsewhere."""
    s = shared_screen(specs=ONE, source=7)
    beside(s, write_off(turned_and_larger(bumpy(300)), Path(s.path).with_name("second.off")))
    return s


def beside(s, path):
    s.session.open_second_mesh(str(path))
    s.until(lambda: len(s.document.surfaces) == 2 and s.session.is_complete and not s.session.is_opening)
    s.settle(0.1)


def seen(s):
    return [eye.seen for eye in s.window.grid.camera_controllers]


def click(s, number, vertex, modifier=QtCore.Qt.KeyboardModifier.NoModifier):
    """A click on a vertex that is seen in a panel."""
    view = s.panels[number].view
    place = view.place_of(s.panels[number].positions[vertex])
    QtTest.QTest.mouseClick(
        view, QtCore.Qt.MouseButton.LeftButton, modifier, QtCore.QPoint(round(place.x()), round(place.y()))
    )
    s.until(lambda: s.session.is_complete)


def foremost(s, number):
    panel = s.panels[number]
    return int((panel.positions @ -np.array(panel.view.camera.GetDirectionOfProjection())).argmax())


def test_a_second_mesh_has_panels_a_letter_and_a_source_of_its_own(two):
    s = two
    assert [panel.surface for panel in s.document.panels] == ["A", "B"]
    assert [panel.head.letter for panel in s.panels] == ["A", "B"]
    assert s.session.mesh().surface.name == "mesh.off"
    s.until(lambda: s.window.windowTitle().startswith("mesh.off, second.off"))
    assert s.window.status.counts.text == "A  300 vertices   B  300 vertices"
    # Two poses of one shape: the source is the same place of it.
    assert [s.document.point(name).at for name in ("source", "source 2")] == [7, 7]
    one, other = (answer.field for answer in s.answers)
    assert np.allclose(other, 3 * one)


def test_a_click_on_one_moves_only_its_source_and_a_pin_lies_on_its_surface(two):
    s = two
    vertex = foremost(s, 1)
    click(s, 1, vertex)
    assert [s.document.point(name).at for name in ("source", "source 2")] == [7, vertex]
    click(s, 1, vertex, QtCore.Qt.KeyboardModifier.ShiftModifier)
    assert s.document.point(s.document[Pins].pins[0].point).surface == "B"
    s.session.undo()
    s.session.undo()
    assert s.document.point("source 2").at == 7


def test_the_table_of_quality_names_panels_of_two_meshes_by_their_letters(two):
    parts(two.window).docks.toggle("quality")
    two.until(lambda: two.session.is_complete)
    dock = parts(two.window).docks._docks["quality"].content
    names = [dock.table.horizontalHeaderItem(k).text() for k in range(dock.table.columnCount())]
    assert names == ["A Geodesic", "B Geodesic"]
    assert dock.text().startswith("\tA Geodesic\tB Geodesic\n")


def test_linked_cameras_turn_by_the_same_rotation_each_about_its_own_shape(two):
    s = two
    before = seen(s)
    s.panels[0].view.turn_by(2, 1)
    s.panels[0].view.zoom(1.5)
    after = seen(s)
    turns = [frame(old).T @ frame(new) for old, new in zip(before, after, strict=True)]
    assert not np.allclose(turns[0], np.eye(3), atol=0.1)
    assert np.allclose(turns[0], turns[1], atol=1e-9)
    distances = [
        np.linalg.norm(np.subtract(new.position, new.focal_point))
        / np.linalg.norm(np.subtract(old.position, old.focal_point))
        for old, new in zip(before, after, strict=True)
    ]
    assert np.allclose(distances, 1 / 1.5)
    # Both are kept in the document.
    assert [s.document.camera_of(name) for name in "AB"] == after


def test_unlinked_cameras_are_each_for_themselves_and_a_standard_view_is_of_the_active_panel(two):
    s = two
    s.window.actions_by_word["link"].trigger()
    assert not s.document.linked
    first, second = seen(s)
    s.panels[1].view.turn_by(1, 0)
    assert seen(s)[0] == first
    assert seen(s)[1] != second
    s.window.grid.activate(s.panels[0].id)
    turned = seen(s)[1]
    parts(s.window).views.reset("top")
    assert (s.document.camera, seen(s)[1]) == ("top", turned)
    s.window.actions_by_word["link"].trigger()
    parts(s.window).views.reset("left")
    assert [s.document.camera_of(name) for name in "AB"] == ["left", "left"]


def test_the_second_mesh_can_be_closed_undone_and_replaced(two, mesh_file):
    s = two
    s.window.actions_by_word["close beside"].trigger()
    assert [mesh.name for mesh in s.document.surfaces] == ["A"]
    assert [point.name for point in s.document.points] == ["source"]
    assert [panel.head.letter for panel in s.panels] == [""]
    assert not s.window.actions_by_word["close beside"].isEnabled()
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    assert [panel.head.letter for panel in s.panels] == ["A", "B"]
    # One of another size takes its place.
    beside(s, mesh_file(grid(4, 4), "third.off"))
    assert [panel.surface for panel in s.document.panels] == ["A", "B"]
    assert len(s.answers[1].field) == 25
    assert s.document.up_of("B") == s.session.loaded("B").up


def test_a_session_of_two_meshes_is_opened_again_and_drawn(two, screen, tmp_path):
    from app.main import main

    s, path = two, Path(two.path).with_name("s.json")
    s.window.actions_by_word["link"].trigger()
    s.panels[1].view.turn_by(1, 1)
    parts(s.window).session_file.save(str(path))
    recipe = read_recipe(str(path))
    assert recipe.document.second_views == s.document.second_views
    assert recipe.document.second_views[0].camera != "home"
    other = screen(ONE)
    parts(other.window).session_file.open(str(path))
    other.until(lambda: other.session.is_complete and len(other.document.surfaces) == 2)
    other.settle()
    assert other.document == s.document
    assert all((a != b).mean() < 0.005 for a, b in zip(s.pictures(), other.pictures(), strict=True))
    assert main(["figure", "--recipe", str(path), "-o", str(tmp_path / "f.png")]) == 0


def test_three_meshes_are_refused_in_a_sentence(two, tmp_path):
    from app.document.page import Recipe

    s = two
    more = replace(s.document, surfaces=(*s.document.surfaces, replace(s.document.surfaces[0], name="C")))
    (tmp_path / "three.json").write_text(recipe_text(Recipe(more), "1"))
    parts(s.window).session_file.open(str(tmp_path / "three.json"))
    assert "up to 2 meshes" in s.refusals[-1]


def test_all_docks_live_with_a_second_mesh_of_another_size(shared_screen, mesh_file):
    s = shared_screen(specs=ONE, source=7)
    s.session.show(open_second_mesh(s.document, MeshFile("", str(mesh_file(bumpy(500), "second.off")))))
    s.until(lambda: len(s.document.surfaces) == 2 and s.session.is_complete)
    for word in docked_tools():
        parts(s.window).docks.toggle(word)
        s.settle(0.1)
        for number in (1, 0):
            s.window.grid.activate(s.panels[number].id)
            view = s.panels[number].view
            QtTest.QTest.mouseMove(view, QtCore.QPoint(view.width() // 2, view.height() // 2))
            s.settle(0.1)
            click(s, number, foremost(s, number), QtCore.Qt.KeyboardModifier.ShiftModifier)
    s.until(lambda: s.session.is_complete)
    parts(s.window).docks.close_all()
    assert not s.refusals
