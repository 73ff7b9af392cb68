"""The docks of quality and of regions in the real window, by mouse and keys."""

import numpy as np
import pytest

from app.document.edits import move_source, put_point
from app.document.shared_parts.pins import Pins
from app.drawing.glyphs import TRIANGLE_UP
from app.tools.regions.part import DividedPanels
from bihdist_core import farthest_points, read_surface, region_boundaries, region_mesh, voronoi_regions
from bihdist_core.distances.distance_types import Spec
from tests.qt.painting import painted
from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore

SHOWN = (Spec.of("biharmonic"), Spec.of("geodesic"), Spec.of("diffusion"))


@pytest.fixture
def loaded(screen, tmp_path):
    from bihdist_core.formats.field_output import write_fields

    surface = bumpy(300)
    write_fields(tmp_path / "bumpy.ply", surface, {"zero": np.zeros(len(surface.vertices))})
    s = screen(SHOWN)
    s.open(tmp_path / "bumpy.ply", 7)
    return s


def key(s, letter):
    from qtpy.QtTest import QTest

    view = s.panels[0].view
    s.activate()
    view.setFocus()
    s.until(view.hasFocus)
    QTest.keyClick(view, letter)
    s.settle(0.1)


def press(button, x=None):
    from qtpy.QtCore import QPoint, Qt
    from qtpy.QtTest import QTest

    place = button.rect().center() if x is None else QPoint(x, button.height() // 2)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton, pos=place)


def dock(s, word):
    return parts(s.window).docks._docks[word].content


def known(s):
    s.until(lambda: parts(s.window).quality.is_complete and parts(s.window).regions.dividing.is_complete)
    s.settle(0.1)  # what is known is on its way to the dock


def test_quality_opens_by_its_key_and_follows_the_source(loaded):
    s = loaded
    key(s, "q")
    known(s)
    table = dock(s, "quality").text()
    assert "…" not in table
    assert table.splitlines()[0].split("\t")[1:] == ["Biharmonic", "Geodesic", "Diffusion"]
    assert table.splitlines()[1].split("\t")[1:3] == ["0", "0"]
    extrema = parts(s.window).quality.found(0).extrema
    marks = s.panels[0].view.over.points
    assert marks.positions("quality").tolist() == s.session.mesh().surface.vertices[extrema.maxima].tolist()
    assert {each.mark.glyph for each in marks.placed("quality")} == {TRIANGLE_UP}
    s.session.show(move_source(s.document, 0, 200))
    s.until(lambda: s.session.is_complete)
    known(s)
    assert dock(s, "quality").text() != table
    assert parts(s.window).quality.found(0).whole.source == 200
    press(dock(s, "quality").copy_button)
    from qtpy.QtWidgets import QApplication

    copied = QApplication.clipboard().text()
    assert copied == dock(s, "quality").text()
    whole = parts(s.window).quality.found(0).whole
    said = {line.split("\t")[0]: line.split("\t")[1] for line in copied.splitlines()[1:]}
    assert (float(said["Isotropy"]), float(said["Largest kink"])) == (whole.isotropy, whole.kink)
    key(s, "q")
    assert not parts(s.window).docks._docks["quality"].isVisible()
    assert not len(marks.positions("quality"))


def test_a_difference_has_extrema_and_kinks_and_no_more(loaded):
    from app.document.edits import show_in
    from app.document.quantities import quantity

    s = loaded
    key(s, "q")
    s.session.show(show_in(s.document, 2, quantity("biharmonic - geodesic")))
    s.until(lambda: s.session.is_complete)
    known(s)
    minima, maxima, isotropy, kink, length, triangles = (
        line.split("\t")[3] for line in dock(s, "quality").text().splitlines()[1:]
    )
    extrema = parts(s.window).quality.found(2).extrema
    assert (minima, maxima) == (str(len(extrema.minima)), str(len(extrema.maxima))) != ("0", "0")
    assert (isotropy, triangles) == ("–", "–")
    assert float(kink) > 0 <= float(length)
    assert len(s.panels[2].view.over.points.positions("quality")) == len(extrema.minima) + len(extrema.maxima)
    table = dock(s, "quality").table
    assert "single source point" in table.item(2, 2).toolTip()
    assert "for distances only" in table.item(5, 2).toolTip()


def test_extrema_are_kept_on_the_surfaces_if_that_is_wanted(loaded, tmp_path):
    s = loaded
    key(s, "q")
    known(s)
    marks = s.panels[0].view.over.points
    shown = marks.positions("quality").tolist()
    press(dock(s, "quality").tick, 8)
    assert s.document.extrema
    key(s, "q")
    assert marks.positions("quality").tolist() == shown != []
    s.session.show(move_source(s.document, 0, 200))
    s.until(lambda: s.session.is_complete)
    known(s)
    found = parts(s.window).quality.found(0)
    assert marks.positions("quality").tolist() == s.session.mesh().surface.vertices[found.extrema.maxima].tolist()
    assert found.whole is None
    s.session.undo()
    s.session.undo()
    assert not s.document.extrema
    assert not len(marks.positions("quality"))
    key(s, "q")
    assert not dock(s, "quality").tick.isChecked()


def test_farthest_points_are_pinned_and_divide_the_panels(loaded, tmp_path):
    s = loaded
    key(s, "n")
    regions = dock(s, "regions")
    regions.sampler.count.setValue(5)
    assert not s.panels[1].head.edits["Regions of the pins"].isEnabled()
    press(regions.sampler.pin)
    s.until(lambda: len(s.document[Pins].pins) == 5)
    distance = s.session.loaded().distances("voronoi").get(SHOWN[0])
    wanted = farthest_points(distance, 7, 5)
    assert [s.document.point(pin.point).at for pin in s.document[Pins].pins] == wanted.tolist()
    before = [painted(panel.view) for panel in s.panels[:2]]
    press(regions.ticks[0], 8)
    assert s.document[DividedPanels].regions == (0,)
    known(s)
    columns = distance.from_sources(wanted)
    found = voronoi_regions(s.session.mesh().surface, columns)
    assert parts(s.window).regions.dividing.divided(0).regions.areas == pytest.approx(found.areas, rel=1e-9)
    after = [painted(panel.view) for panel in s.panels[:2]]
    assert (before[0] != after[0]).any()
    assert (before[1] == after[1]).all()
    # The same from the panel's own menu, and back.
    edit = s.panels[1].head.edits["Regions of the pins"]
    assert edit.isEnabled()
    edit.trigger()
    assert s.document[DividedPanels].regions == (0, 1)
    ticked = [p.head.edits["Regions of the pins"] for p in s.panels[:2]]
    assert all(each.isCheckable() and each.isChecked() for each in ticked)
    assert not s.panels[0].head.edits["Remove panel"].isCheckable()
    known(s)
    assert len(regions.text().splitlines()[1].split("\t")) == 3
    menu = regions.save_button.menu()
    menu.aboutToShow.emit()
    names = [f"Panel {k + 1}: {s.panels[k].head.name.text()}" for k in range(2)]
    assert [action.text() for action in menu.actions()] == names
    assert [len(action.menu().actions()) for action in menu.actions()] == [3, 3]
    s.session.undo()
    menu.aboutToShow.emit()
    assert [action.menu() for action in menu.actions()] == [None] * 3
    s.session.undo()
    assert s.document[DividedPanels].regions == ()
    s.settle(0.1)
    assert (painted(s.panels[0].view) == before[0]).all()
    s.session.redo()
    known(s)
    # Files are those that the library writes.
    regions.save(0, "labels", str(tmp_path / "labels.npy"))
    assert np.load(tmp_path / "labels.npy").tolist() == (found.labels + 1).tolist()
    regions.save(0, "mesh", str(tmp_path / "mesh.ply"))
    cut = read_surface(tmp_path / "mesh.ply")
    assert len(cut.faces) == len(region_mesh(s.session.mesh().surface, columns).surface.faces)
    regions.save(0, "boundaries", str(tmp_path / "boundaries.csv"))
    lines = (tmp_path / "boundaries.csv").read_text().splitlines()
    assert len({line.split(",")[0] for line in lines[1:]}) == len(region_boundaries(s.session.mesh().surface, found))
    regions.sampler.save_to(str(tmp_path / "ids.txt"))
    s.until(lambda: (tmp_path / "ids.txt").exists())
    assert (tmp_path / "ids.txt").read_text().split() == [str(id) for id in wanted]


def test_regions_follow_a_pin_that_is_moved(loaded):
    from app.document.shared_parts.pins import add_pins
    from app.tools.regions.part import show_regions

    s = loaded
    s.session.show(show_regions(add_pins(s.document, [7, 90, 200]), 0))
    known(s)
    s.session.show(put_point(s.document, s.document[Pins].pins[2].point, 150), key="drag", live=True)
    known(s)
    distance = s.session.loaded().distances("voronoi").get(SHOWN[0])
    wanted = voronoi_regions(s.session.mesh().surface, distance.from_sources([7, 90, 150]))
    assert parts(s.window).regions.dividing.divided(0).regions.areas == pytest.approx(wanted.areas, rel=1e-9)


def test_too_many_points_are_refused_in_the_dock(loaded):
    s = loaded
    key(s, "n")
    sampler = dock(s, "regions").sampler
    sampler.count.setValue(2_000)
    press(sampler.pin)
    s.until(lambda: "2,000 points asked for" in sampler.words.text())
    sampler.count.setValue(201)
    press(sampler.pin)
    s.until(lambda: "at most 200 pins" in sampler.words.text())
    assert s.document[Pins].pins == ()


def test_the_docks_come_back_with_a_session(loaded, tmp_path):
    s = loaded
    key(s, "q")
    key(s, "n")
    sampler = dock(s, "regions").sampler
    sampler.count.setValue(3)
    press(sampler.pin)
    s.until(lambda: len(s.document[Pins].pins) == 3)
    press(dock(s, "regions").ticks[1], 8)
    known(s)
    areas = dock(s, "regions").text()
    path = str(tmp_path / "session.json")
    parts(s.window).session_file.save(path)
    key(s, "q")
    parts(s.window).session_file.open(path)
    s.until(lambda: s.session.is_complete and "quality" in s.document.docks)
    known(s)
    assert dock(s, "regions").text() == areas
    assert "…" not in dock(s, "quality").text()


def test_no_number_and_no_head_is_cut_where_four_panels_have_little_room(loaded):
    from app.document.edits import add_panel
    from app.document.quantities import quantity

    s = loaded
    s.session.show(add_panel(s.document, quantity("truncated(k=20)")))
    s.until(lambda: s.session.is_complete)
    parts(s.window).docks.toggle("quality")
    s.until(lambda: parts(s.window).quality.is_complete)
    s.settle(0.1)
    table = dock(s, "quality").table
    heads = [table.horizontalHeaderItem(k).text() for k in range(4)]
    assert heads == ["Biharm.", "Geod.", "Diffus.", "Trunc."]
    for k in range(4):
        texts = [table.item(row, k).text() for row in range(table.rowCount())]
        in_cell, in_head = (each.fontMetrics().horizontalAdvance for each in (table, table.horizontalHeader()))
        assert table.columnWidth(k) >= 12 + max(in_head(heads[k]), *map(in_cell, texts))
    assert dock(s, "quality").text().splitlines()[0].split("\t")[1] == "Biharmonic"
    room = table.viewport().width()
    s.window.resizeDocks([parts(s.window).docks._docks["quality"]], [700], QtCore.Qt.Orientation.Horizontal)
    s.until(lambda: table.viewport().width() > room)
    s.settle(0.1)
    assert table.horizontalHeaderItem(3).text() == "Biharmonic, truncated"
    assert sum(table.columnWidth(k) for k in range(4)) == table.viewport().width()
