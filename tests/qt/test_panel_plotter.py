"""What those who know PyVista put into a panel: its plotter, and the mesh with its field by name."""

from dataclasses import replace

import numpy as np
import pytest
import pyvista
from PIL import Image

import app
from app.document.document import Inset
from app.document.looks import Shading
from app.qt.look.look import LOOK
from tests.shapes import bumpy, grid

SURFACE = bumpy(300)
ADDED = (255, 0, 255)
"""A colour that no field has."""


@pytest.fixture
def viewer(application, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    viewer = app.show(SURFACE, ["biharmonic", "geodesic"], source=7, block=False)
    yield viewer
    viewer.close()
    LOOK.choose("light")


def views(viewer):
    return [panel.view for panel in viewer._window.grid.panels]


def shots(viewer):
    viewer.panels  # noqa: B018  (waits)
    return [view.shot() for view in views(viewer)]


def outside(viewer):
    """(1, 3) a place beside the surface, seen from everywhere."""
    return 1.1 * SURFACE.vertices[[SURFACE.vertices[:, 1].argmax()]]


def added(picture):
    """(k, 2) where a picture (h, w, 3) has the colour of what was added."""
    return np.argwhere((np.abs(picture.astype(int) - ADDED) < 40).all(axis=-1))


def add_points(viewer, panel=0):
    plotter = viewer.panels[panel].plotter
    return plotter.add_points(outside(viewer), color=ADDED, point_size=16, lighting=False)


def test_fields_are_arrays_of_the_meshes_by_their_names(viewer):
    for panel in viewer.panels:
        assert isinstance(panel.mesh, pyvista.PolyData)
        assert np.array_equal(panel.mesh.points, SURFACE.vertices)
        assert np.array_equal(panel.mesh.regular_faces, SURFACE.faces)
        assert panel.mesh.point_data.keys() == [panel.quantity]
        assert np.array_equal(panel.mesh[panel.quantity], panel.field)


def test_what_is_written_into_a_mesh_changes_nothing_else(viewer):
    panel, shot = viewer.panels[0], shots(viewer)[0]
    field, vertices = panel.field.copy(), SURFACE.vertices.copy()
    panel.mesh["biharmonic"][:] = 5
    panel.mesh.points[:] = 0
    views(viewer)[0].redraw()
    assert np.array_equal(shots(viewer)[0], shot)
    assert np.array_equal(viewer.panels[0].field, field)
    assert np.array_equal(SURFACE.vertices, vertices)


@pytest.mark.parametrize(
    ("surface", "look"), [(SURFACE, {"shading": Shading("creased", 5.0)}), (grid(8, 6), {"warp_factor": 0.5})]
)
def test_at_creases_vertices_are_points_once_and_those_of_height_fields_are_raised(application, surface, look):
    viewer = app.show(surface, ["biharmonic"], block=False)
    try:
        viewer.document = replace(viewer.document, **look)
        mesh = viewer.panels[0].mesh
        assert (mesh.n_points, mesh.n_cells) == (len(surface.vertices), len(surface.faces))
        assert (np.abs(mesh.points - surface.vertices).max() > 0.1) == ("warp_factor" in look)
        assert ("shading" in look) == (views(viewer)[0].scene.field_actor.mesh.GetNumberOfPoints() > mesh.n_points)
    finally:
        viewer.close()


def test_the_panel_s_own_surface_cannot_be_removed(viewer):
    before, plotter = shots(viewer)[0], viewer.panels[0].plotter
    assert len(plotter.actors) > 1
    for name, actor in plotter.actors.items():
        for asked in (name, actor, [actor]):
            with pytest.raises(ValueError, match="own"):
                plotter.remove_actor(asked)
    plotter.clear()
    plotter.clear_actors()
    plotter.close()
    views(viewer)[0].redraw()
    assert np.array_equal(shots(viewer)[0], before)


def test_points_are_seen_in_one_panel_alone_until_they_are_removed(viewer):
    before = shots(viewer)
    camera = viewer.panels[0].plotter.camera_position
    actor = add_points(viewer)
    assert [view.is_stale for view in views(viewer)] == [True, False]
    first, second = shots(viewer)
    assert len(added(first)) > 50
    assert np.array_equal(second, before[1])
    assert viewer.panels[0].plotter.camera_position == camera
    viewer.panels[0].plotter.remove_actor(actor)
    assert all(np.array_equal(*both) for both in zip(shots(viewer), before, strict=True))


def test_meshes_arrows_and_lines_stand_there_too(viewer):
    plotter, seen = viewer.panels[1].plotter, [shots(viewer)[1]]
    at = outside(viewer)
    for add in (
        lambda: plotter.add_mesh(pyvista.Sphere(radius=0.1, center=at[0]), color=ADDED),
        lambda: plotter.add_arrows(at, np.array([[1.0, 0, 0]]), mag=0.5, color=ADDED),
        lambda: plotter.add_lines(np.concatenate([at, -at]), color=ADDED, width=3),
    ):
        add()
        seen.append(shots(viewer)[1])
        assert not np.array_equal(seen[-1], seen[-2])
    plotter.clear()
    assert np.array_equal(shots(viewer)[1], seen[0])


def test_it_turns_with_the_surface(viewer):
    add_points(viewer)
    before = added(shots(viewer)[0]).mean(axis=0)
    view = views(viewer)[1]
    view.turn_by(0, 2)
    after = added(shots(viewer)[0]).mean(axis=0)
    assert np.hypot(*(after - before)) > 20
    there = views(viewer)[0].place_of(outside(viewer)[0])
    assert np.hypot(*(after[::-1] / view.devicePixelRatioF() - (there.x(), there.y()))) < 10  # its size


def test_it_is_in_pictures_of_the_window(viewer, tmp_path):
    before = added(np.array(Image.open(viewer.screenshot(tmp_path / "before.png")).convert("RGB")))
    add_points(viewer)
    after = added(np.array(Image.open(viewer.screenshot(tmp_path / "after.png")).convert("RGB")))
    assert len(before) == 0
    assert len(after) > 50


def test_it_is_in_insets(viewer):
    highest = int(SURFACE.vertices[:, 1].argmax())
    viewer.document = replace(viewer.document, insets=(Inset(highest, 2.0),))
    add_points(viewer)
    shot = shots(viewer)[0]
    ((left, bottom, width, height),) = views(viewer)[0].scene.insets.placed.values()
    top = shot.shape[0] - bottom - height
    assert len(added(shot[top : top + height, left : left + width])) > 50
    viewer.panels[0].plotter.clear()
    assert len(added(shots(viewer)[0])) == 0


def test_it_outlasts_another_look_but_not_the_surface(viewer):
    add_points(viewer)
    LOOK.choose("dark")
    assert len(added(shots(viewer)[0])) > 50
    other = app.show("genus3", ["biharmonic"], block=False)
    try:
        viewer.document = other.document
        assert len(added(shots(viewer)[0])) == 0
    finally:
        other.close()


def test_clicks_go_through_it(viewer):
    view = views(viewer)[0]
    middle = view.rect().center()
    before = view.pick(middle)
    nearer = 0.5 * (before.position + np.array(view.camera.GetPosition()))
    viewer.panels[0].plotter.add_mesh(pyvista.Sphere(radius=0.1, center=nearer), color=ADDED)
    assert len(added(shots(viewer)[0])) > 50
    assert view.pick(middle).vertex == before.vertex


def test_other_plotters_may_all_be_closed(viewer):
    before = shots(viewer)
    pyvista.close_all()
    views(viewer)[0].redraw()
    assert np.array_equal(shots(viewer)[0], before[0])


def test_the_window_opens_before_pyvista_is_imported(application):
    """Asked in a process of its own, as others have imported it here."""
    import subprocess
    import sys

    code = (
        "import os, sys\n"
        "from app.qt.application import application\n"
        "from app.qt.main_window import MainWindow\n"
        "from app.document.settings import Preferences\n"
        "app = application()\n"
        "window = MainWindow(None, Preferences())\n"
        "window.remembers, window.context.quiet = False, True\n"
        "window.show(); app.processEvents(); window.build_panels(); app.processEvents()\n"
        "print('pyvista' in sys.modules, flush=True)\n"
        "window.close()\n"
        # Left to the interpreter, Qt's and VTK's objects go in an order that nobody decides, and it may crash.
        "os._exit(0)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False"]
