"""The dock of the profile, by real keys and a real pointer: numbers equal to those of the core, and echoes."""

import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Document, Point, comparison
from app.document.edits import move_source
from app.document.shared_parts.pins import Pin, Pins, add_pins
from app.tools.profile.part import Profile, points_along
from app.tools.profile.paths import wanted_path
from bihdist_core import Laplacian, ParameterError
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import bumpy

with_pointer = pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")

TWO = (Spec.of("biharmonic"), Spec.of("geodesic", method="dijkstra"))


def run(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True)


def move_to(widget, point):
    at = widget.mapToGlobal(point)
    run("mousemove", at.x(), at.y())


@pytest.fixture
def loaded(shared_screen):
    s = shared_screen(bumpy(800), TWO, 5, (1100, 800))
    s.window.move(20, 40)
    s.settle(0.3)
    return s


def pinned(s, count=2):
    x = s.session.mesh().surface.vertices
    ids = [int(x[:, 0].argmin()), int(x[:, 0].argmax()), int(x[:, 1].argmax())][:count]
    s.session.show(add_pins(s.document, ids))
    return ids


def dock_of(s):
    return parts(s.window).docks._docks["profile"].content


def profiled(s, count=2):
    """The dock with the path through pins, once that is found."""
    pinned(s, count)
    parts(s.window).docks.toggle("profile")
    dock = dock_of(s)
    s.until(lambda: dock.path is not None)
    return dock


def with_profile(s, count=2):
    """The same by the key, with the pins' ids."""
    ids = pinned(s, count)
    run("windowfocus", "--sync", int(s.window.winId()), "key", "f")
    s.until(lambda: "profile" in s.document.docks)
    dock = dock_of(s)
    s.until(lambda: dock.path is not None)
    s.settle()
    return dock, ids


@with_pointer
def test_it_opens_by_its_key_and_its_numbers_are_the_cores(loaded):
    s = loaded
    dock, ids = with_profile(s)
    surface = s.session.mesh().surface
    path = GeodesicPaths(surface).path(ids)
    assert dock.path.label == path.label == "shortest geodesic, exact"
    assert np.array_equal(dock.path.points, path.points)
    places = dock.path.places
    assert np.allclose(
        np.einsum("kc,kcx->kx", places.weights, surface.vertices[places.corners]), path.points, atol=1e-12
    )
    distances = Distances(Laplacian(surface))
    for panel, spec in zip(s.document.panels, TWO, strict=True):
        field = distances.answer(spec, 5).field
        assert np.abs(dock.curves[panel.id].values - path.along(field)).max() <= 1e-9 * field.max()
        assert np.abs(dock.curves[panel.id].shares - path.along(field) / field.max()).max() <= 1e-9


@with_pointer
def test_the_chart_and_the_panels_mark_the_same_place(loaded):
    s = loaded
    dock, _ = with_profile(s)
    chart, path = dock.chart, dock.path
    move_to(chart.charts[0], chart.charts[0].plot.center().toPoint())
    s.until(lambda: chart.charts[0].at is not None)
    s.settle()
    arc = chart.charts[0].at
    assert arc == pytest.approx(path.length / 2, rel=0.02)
    place = path.at([arc]).values(s.session.mesh().surface.vertices)[0]
    for panel, answer in zip(s.panels, s.answers, strict=True):
        assert np.allclose(panel.view.over.pointed.position, place)
        assert panel.bar._reading.value == pytest.approx(float(path.at([arc]).values(answer.field)[0]))
    # The other way round, where the path is seen.
    parts(s.window).views.reset("back")
    s.settle()
    panel = s.panels[1]
    seen = [k for k in range(5, len(path.points) - 5) if panel.view.sees(path.points[k])]
    at = panel.view.place_of(path.points[seen[len(seen) // 2]]).toPoint()
    move_to(panel.view, at)
    s.until(lambda: chart.charts[0].at is not None and chart.charts[0].at != arc)
    s.settle()
    assert abs(chart.charts[0].at - path.arcs[seen[len(seen) // 2]]) < 2 * s.session.mesh().surface.mean_edge_length
    move_to(panel.head, panel.head.rect().center())
    s.until(lambda: chart.charts[0].at is None)
    assert all(panel.view.over.pointed is None for panel in s.panels)


@with_pointer
def test_values_have_a_chart_for_each_unit(screen, mesh_file):
    s = screen((*TWO, Spec.of("diffusion", t=1)))
    s.window.move(20, 40)
    s.window.resize(900, 600)
    s.open(mesh_file(bumpy(800)), 5)
    dock, _ = with_profile(s)
    charts = dock.chart
    assert [len(chart.curves) for chart in charts.shown] == [3]
    dock.scale.buttons["value"].click()
    s.settle()
    assert s.document[Profile] == Profile(shares=False)
    left, right = charts.shown
    assert [[curve.name for curve in chart.curves] for chart in (left, right)] == [
        ["Biharmonic", "Geodesic"],
        ["Diffusion"],
    ]
    assert (left.unit, right.unit) == ("mesh units", "1 / mesh units")
    for chart in (left, right):
        assert chart.up.high == pytest.approx(1.04 * max(curve.values.max() for curve in chart.curves))
    assert right.x() >= left.width()
    # One pointer for both.
    for chart in (right, left):
        move_to(chart, chart.plot.center().toPoint())
        s.until(lambda: left.at == pytest.approx(dock.path.length / 2, rel=0.02))
        assert left.at == right.at
        s.settle()
    s.session.undo()
    s.settle()
    assert [len(chart.curves) for chart in charts.shown] == [3]


def test_charts_stand_below_each_other_where_the_dock_is_narrow(application):
    from app.tools.profile.chart import ProfileCharts
    from app.tools.profile.curves import ProfileCurve

    charts = ProfileCharts()
    charts.show_curves([ProfileCurve(unit, "#000000", np.ones(2), 1.0, unit) for unit in "ab"], in_shares=False)
    left, right = charts.shown
    for width, height, is_row in ((700, 160, True), (400, 400, False), (400, 160, True)):
        charts.resize(width, height)
        charts.show()
        application.processEvents()
        assert (right.y() == 0) == is_row == (right.x() > 0)
        assert (left.width() == right.width()) or (left.height() == right.height())
    charts.close()


@with_pointer
def test_arrow_keys_go_along_the_path(loaded):
    from qtpy.QtCore import Qt

    s = loaded
    dock, _ = with_profile(s)
    dock.chart.setFocus(Qt.FocusReason.TabFocusReason)
    for key in ("Right", "Right", "shift+Right", "Left"):
        run("key", key)
        s.settle(0.1)
    assert dock.chart.charts[0].at == pytest.approx(0.1 * dock.path.length)
    assert all(panel.view.over.pointed is not None for panel in s.panels)
    run("key", "Escape")
    s.until(lambda: dock.chart.charts[0].at is None)


def test_the_path_is_dark_on_white_where_it_is_seen(loaded):
    s = loaded
    profiled(s)
    parts(s.window).views.reset("back")
    s.settle()
    view = s.panels[0].view
    picture = view.grab().toImage()
    pixels, is_seen = view.over.lines.pixels, view.over.lines.is_seen
    assert 0.2 < is_seen.mean() < 1
    ratio = view.devicePixelRatioF()
    well = np.flatnonzero(is_seen)[10:-10:20]
    dark = [picture.pixelColor(*(pixels[k] / ratio).astype(int).tolist()).value() for k in well]
    assert np.mean(np.array(dark) < 110) > 0.8
    parts(s.window).docks.close("profile")
    s.settle()
    assert not len(view.over.lines.pixels)


def test_curves_follow_the_source_and_the_path_stays(loaded):
    s = loaded
    dock = profiled(s)
    path = dock.path
    s.session.show(move_source(s.document, 0, 100))
    s.until(lambda: s.session.is_complete)
    assert dock.path is path
    for panel, answer in zip(s.document.panels, s.answers, strict=True):
        assert np.array_equal(dock.curves[panel.id].values, path.along(answer.field))


def test_ways_and_ends_are_steps_that_can_be_undone(loaded):
    s = loaded
    dock = profiled(s)
    first = dock.path
    dock.controls.choose_way("section")
    s.until(lambda: dock.path is not None and dock.path is not first)
    assert dock.path.label == "section by a plane" == dock.controls.way.text()
    assert s.document[Profile].across is not None
    across = s.document[Profile].across
    shorter = dock.path.length
    parts(s.window).views.reset("back")
    s.settle()
    dock.controls.choose_way("section-whole")
    s.until(lambda: dock.path is not None and dock.path.label == "the whole section by a plane")
    # The plane stays; it comes back to its first point.
    assert s.document[Profile].across == across
    assert s.document.camera == "back"
    assert [badge.name for _, badge in dock.chart.charts[0].knots] == ["pin 1", "pin 2", "pin 1"]
    assert dock.chart.charts[0].knots[1][0] == pytest.approx(shorter)
    dock.controls.turn_plane()
    assert s.document[Profile].across != across
    s.session.undo()
    s.session.undo()
    dock.controls.type_end(1, "300")
    s.until(lambda: dock._wanted.places[1] == 300)
    assert s.document[Pins].pins[-1].point == s.document[Profile].points[1]
    dock.controls.type_end(0, "100000")
    assert "100000" in s.refusals[-1]
    s.session.undo()
    s.session.undo()
    assert s.document[Profile] == Profile()
    s.until(lambda: dock.path is not None and dock.path.label == first.label)
    assert np.array_equal(dock.path.points, first.points)


def test_what_is_saved_is_what_is_shown(loaded, tmp_path):
    from app.tools.profile.figure import save_profile_figure

    s = loaded
    dock = profiled(s, 3)
    assert len(dock.chart.charts[0].knots) == 3
    dock.files.save_numbers(str(tmp_path / "along.csv"))
    lines = (tmp_path / "along.csv").read_text().splitlines()
    assert lines[0] == "arc,x,y,z,face,b0,b1,b2,biharmonic,geodesic(method=dijkstra)"
    table = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    assert np.array_equal(table[:, 0], dock.path.arcs)
    assert np.array_equal(table[:, 8:].T, [curve.values for curve in dock.curves.values()])
    for kind in ("svg", "pdf", "png"):
        for name in ("one", "two"):
            save_profile_figure(dock.files.figure(), tmp_path / f"{name}.{kind}")
        assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"two.{kind}").read_bytes()
    dock.files.save_figure(str(tmp_path / "saved.svg"))
    s.until(lambda: not parts(s.window).exports.running)
    assert (tmp_path / "saved.svg").read_bytes() == (tmp_path / "one.svg").read_bytes()
    drawn = (tmp_path / "one.svg").read_text()
    assert ">Biharmonic</text>" in drawn
    assert ">% of the maximum</text>" in drawn


def test_it_comes_back_with_its_session_and_leaves_with_its_mesh(loaded, screen, mesh_file, tmp_path):
    s = loaded
    dock = profiled(s)
    dock.controls.choose_way("edges")
    s.until(lambda: dock.path.label == "shortest path along edges")
    path = str(tmp_path / "it.json")
    parts(s.window).session_file.save(path)
    again = screen(TWO)
    parts(again.window).session_file.open(path)
    again.until(lambda: again.session.is_complete and "profile" in parts(again.window).docks._docks)
    other = dock_of(again)
    again.until(lambda: other.path is not None)
    assert again.document[Profile] == s.document[Profile]
    assert np.array_equal(other.path.points, dock.path.points)
    assert all(panel.head._dot for panel in again.panels)
    again.open(mesh_file(bumpy(300), "other.off"), 7)
    assert other.path is None
    assert "pin two points" in other.chart.sentence


def test_panels_come_and_go_while_the_chart_is_pointed_at(loaded):
    s = loaded
    dock = profiled(s)
    dock._point((dock.path.length / 3, 0.5))
    parts(s.window).choices.add_panel()
    s.until(lambda: s.session.is_complete and len(dock.curves) == 3)
    assert {curve.colour for curve in dock.curves.values()} == {panel.head._dot for panel in s.panels}
    parts(s.window).choices.edit_panel(s.document.panels[0].id, "Remove panel")
    s.until(lambda: s.session.is_complete and len(dock.chart.curves) == 2)
    s.settle()
    assert all(panel.view.over.pointed is not None for panel in s.panels[:1])
    parts(s.window).docks.close("profile")
    assert not any(panel.head._dot or len(panel.view.over.lines.points) for panel in s.panels)


def test_without_two_points_it_says_what_to_do(loaded):
    s = loaded
    parts(s.window).docks.toggle("profile")
    assert "pin two points" in dock_of(s).chart.sentence
    pinned(s, 1)
    assert points_along(s.document) == ("source", "pin")
    s.until(lambda: dock_of(s).path is not None)


def test_what_makes_no_path_is_named():
    document = replace(
        comparison("", TWO), points=(Point("source", 1), Point("pin", 2), Point("pin 2", 3), Point("loop", "loop:0"))
    ).with_part(Pins((Pin("pin"), Pin("pin 2"))))
    surface = bumpy(60)
    assert wanted_path(document, lambda name: surface).places == (2, 3)
    section = document.with_part(Profile(("source", "pin", "pin 2"), "section-whole", (0, 0, 1)))
    same = replace(document, points=(*document.points, Point("other", 2))).with_part(Profile(("pin", "other")))
    for wrong, said in (
        (document.with_part(Profile(("source", "loop"))), "'loop' is neither"),
        (section, "goes through two points"),
        (same, "There is no path from pin 1 to vertex 2: they are at the same place"),
        (Document(), "pin two points"),
    ):
        with pytest.raises(ParameterError, match=said):
            wanted_path(wrong, lambda name: surface)


def test_names_at_the_ends_never_touch():
    from app.tools.profile.chart import apart

    assert apart([10, 12, 13, 90], 14, 0, 100) == [10, 24, 38, 90]
    assert apart([95, 96, 97], 14, 0, 100) == [72, 86, 100]
