"""A second mesh in a document: what it brings, what goes with it, and how its camera follows."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.camera import Camera
from app.document.document import MeshFile, comparison
from app.document.edits import MOST_ADDED, add_another, show_in
from app.document.file import read_recipe, recipe_text
from app.document.history import History
from app.document.page import Recipe
from app.document.quantities import quantity
from app.document.second_mesh_edits import close_second_mesh, open_second_mesh, set_up_axis, set_view
from app.document.shared_parts.pins import Pins, add_pins
from app.scene.camera import follow_camera, frame, turned
from bihdist_core.errors import ParameterError

FIRST = comparison("first.off", (quantity("biharmonic"), quantity("biharmonic - geodesic")), (3,))
SECOND = MeshFile("", "second.off")
HOME = Camera((0, 0, 5), (0, 0, 0), (0, 1, 0), (0.2, 0.2))
OTHER = Camera((7, 1, 1), (1, 1, 1), (0, 0, 1), (0.2, 0.2))


def test_its_panels_show_the_same_from_a_source_of_its_own():
    document = open_second_mesh(FIRST, SECOND)
    assert [str(panel.shows) for panel in document.panels_of("B")] == [str(p.shows) for p in FIRST.panels]
    assert {name for panel in document.panels_of("B") for name in panel.shows.points} == {"source 2"}
    assert document.point("source 2").surface == "B"
    assert document.panels_of() == FIRST.panels


def test_closed_again_nothing_of_it_is_left():
    document = add_pins(open_second_mesh(FIRST, SECOND), [4], "B")
    closed = close_second_mesh(document)
    assert (closed.surfaces, closed.points, closed.panels, closed[Pins].pins) == (
        FIRST.surfaces,
        FIRST.points,
        FIRST.panels,
        (),
    )
    assert close_second_mesh(FIRST) == FIRST


def test_it_is_refused_where_there_is_no_room():
    full = FIRST
    while len(full.panels) < MOST_ADDED:
        full = add_another(full)
    with pytest.raises(ParameterError, match="6 panels already"):
        open_second_mesh(full, SECOND)


def test_a_panel_starts_from_a_point_of_its_own_surface_whatever_is_chosen():
    document = open_second_mesh(FIRST, SECOND)
    id = document.panels_of("B")[0].id
    assert show_in(document, id, quantity("commute-time")).panel(id).shows.points == ("source 2",)
    added = add_another(document, "B").panels[-1]
    assert (added.surface, added.shows.points) == ("B", ("source 2",))


def test_cameras_are_kept_in_files_and_are_no_steps(tmp_path):
    document = set_up_axis(set_view(open_second_mesh(FIRST, SECOND), OTHER, "B"), "z", "B")
    assert (document.camera_of("A"), document.up_of("B")) == ("auto", "z")
    document = set_view(document, OTHER, "B")
    path = tmp_path / "r.json"
    path.write_text(recipe_text(Recipe(document), "1"))
    assert read_recipe(path).document == document
    history = History(open_second_mesh(FIRST, SECOND))
    history.change(set_view(history.present, OTHER, "B"))
    assert not history.can_undo
    history.change(add_pins(history.present, [4], "B"))
    assert history.undo().camera_of("B") == OTHER


def test_a_camera_that_is_carried_turns_and_nears_as_the_other_does():
    after = turned(HOME, 40.0, np.array([1.0, 2.0, 0.5]))
    near = Camera(tuple(np.array(after.position) / 2), (0.0, 0.0, 0.0), after.up, after.extent)
    assert np.allclose(follow_camera(HOME, HOME, near).position, near.position)
    found = follow_camera(OTHER, HOME, near)
    assert np.allclose(frame(OTHER).T @ frame(found), frame(HOME).T @ frame(near))
    assert np.isclose(np.linalg.norm(np.subtract(found.position, found.focal_point)), 3.0)
    # There and back again nothing has changed.
    assert np.allclose(follow_camera(found, near, HOME).position, OTHER.position)


def test_of_two_that_were_seen_from_one_camera_the_second_stays_when_the_first_is_seen_from_elsewhere():
    together = replace(open_second_mesh(FIRST, SECOND), camera=HOME, second_views=())
    assert together.camera_of("B") == HOME
    apart = set_view(together, OTHER)
    assert (apart.camera_of("A"), apart.camera_of("B")) == (OTHER, HOME)
    assert set_view(FIRST, OTHER).second_views == ()
    history = History(together)
    history.change(apart)
    assert not history.can_undo
