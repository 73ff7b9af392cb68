"""Points without faces in the window: picking, fields, and what needs faces."""

import numpy as np
import pytest
from qtpy import QtCore, QtTest, QtWidgets

from app.document.document import usual_specs
from bihdist_core import BiharmonicDistance, PointCloud, TetrahedralMesh
from bihdist_core.formats.field_output import write_fields
from tests.core.test_tetrahedra import ball
from tests.qt.parts import parts
from tests.shapes import bumpy


@pytest.fixture
def scan(shared_screen, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "scan.xyz"
    if not path.exists():
        np.savetxt(path, bumpy(900).vertices, fmt="%.17g")
    return shared_screen(path, usual_specs(str(path)))


def grabbed(view):
    return view.grab().toImage()


def test_a_click_puts_the_source_on_the_nearest_point(scan):
    view, surface = scan.panels[0].view, scan.session.mesh().surface
    assert isinstance(surface, PointCloud)
    parts(scan.window).snapping.set(False)
    vertex = view.pick(view.rect().center()).vertex
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.LeftButton, pos=scan.point_of(scan.panels[0], vertex))
    scan.until(lambda: scan.session.is_complete)
    assert scan.document.point("source").at == vertex
    field = BiharmonicDistance(surface).from_source(vertex)
    assert np.allclose(scan.panels[0].answer.field, field, atol=1e-12)
    assert [panel.answer.failure for panel in scan.panels] == ["", "", ""]


def test_it_says_that_there_are_points(scan):
    assert scan.window.status.counts.text == "900 points  no faces"
    view = scan.panels[0].view
    vertex = view.pick(view.rect().center()).vertex
    QtTest.QTest.mouseMove(view, scan.point_of(scan.panels[0], vertex))
    scan.until(lambda: scan.window.status.vertex.text == f"point {vertex}")
    parts(scan.window).typed_source.box.setText("900")
    QtTest.QTest.keyClick(parts(scan.window).typed_source.box, QtCore.Qt.Key.Key_Return)
    assert parts(scan.window).typed_source.box.wrong.text() == "No point 900 here: 0 to 899"
    assert [panel.shows.specs[0].word for panel in scan.document.panels] == ["biharmonic", "commute-time", "diffusion"]


def test_what_needs_faces_is_disabled_with_the_reason(scan):
    for word in ("profile", "regions", "statistics", "quality", "robustness"):
        action = scan.window.context.actions[f"dock {word}"]
        assert not action.isEnabled()
        assert action.property("lack") == "points have no faces"
    assert scan.window.context.actions["dock pins"].isEnabled()
    head, menu = scan.panels[0].head, QtWidgets.QMenu()
    head._fill_name_menu(menu)
    geodesic = next(each for each in menu.actions() if each.text() == "Geodesic")
    assert (geodesic.isEnabled(), geodesic.toolTip()) == (False, "Geodesic distance needs faces, and points have none")


def test_a_numpy_array_of_points_is_opened_unless_it_has_values_of_the_mesh(scan, mesh_file, tmp_path):
    np.save(tmp_path / "few.npy", np.ones(7))
    np.save(tmp_path / "more.npy", bumpy(60).vertices)
    scan.open(mesh_file(bumpy(300), "mesh.off"), 3)
    scan.until(lambda: scan.session.is_complete)
    parts(scan.window).files.open(str(tmp_path / "few.npy"))
    scan.until(lambda: scan.refusals)
    assert scan.refusals == ["few.npy has 7 values, and mesh.off has 300 vertices."]
    parts(scan.window).files.open(str(tmp_path / "more.npy"))
    scan.until(lambda: scan.session.is_complete and scan.window.status.counts.text == "60 points  no faces")


def test_a_solid_says_how_many_tetrahedra_there_are(scan, tmp_path):
    solid = TetrahedralMesh(*ball(60), "ball.vtu")
    write_fields(tmp_path / "ball.vtu", solid, {"x": solid.vertices[:, 0]})
    scan.open(str(tmp_path / "ball.vtu"))
    scan.until(lambda: scan.session.is_complete)
    assert scan.window.status.counts.text == f"60 vertices  {len(solid.tetrahedra)} tetrahedra"


def test_notes_make_way_for_the_progress(scan):
    scan.until(lambda: scan.session.is_complete)
    panel = scan.panels[0]
    panel.view.over.write(("3 maxima",))
    shown = grabbed(panel.view)
    panel.show_waiting((0.5, "Eigenpairs"), is_old=False)
    covered = grabbed(panel.view)
    panel.show_waiting(None)
    assert covered != shown
    assert grabbed(panel.view) == shown
    panel.view.over.write(())


def test_a_mesh_after_points_has_all_tools(scan, mesh_file):
    scan.open(mesh_file(bumpy(300), "mesh.off"), 3)
    scan.until(lambda: scan.session.is_complete)
    assert scan.window.context.actions["dock profile"].isEnabled()
    assert scan.window.status.counts.text == "300 vertices  596 faces"
