"""The dock of pins: typed ids, the list and the matrix with what the panels have there, files, sessions."""

import numpy as np
import pytest

from tests.shapes import bumpy

pytest.importorskip("qtpy")

from app.document.edits import move_source
from app.document.shared_parts.pins import Pins
from tests.qt.parts import parts
from tests.tools.pins.pinning import dock_of, ids, seen_vertices, shift_click, type_ids


@pytest.fixture
def loaded(shared_screen):
    return shared_screen(bumpy(1500))


def press(s, widget, key, modifier=None):
    from qtpy import QtCore, QtTest

    QtTest.QTest.keyClick(widget, key, modifier or QtCore.Qt.KeyboardModifier.NoModifier)
    s.settle(0.05)


def select_row(s, dock, row):
    from qtpy import QtCore, QtTest

    at = dock.table.visualRect(dock.table.model().index(row, 1)).center()
    QtTest.QTest.mouseClick(dock.table.viewport(), QtCore.Qt.MouseButton.LeftButton, pos=at)
    s.settle(0.05)


def read_number(text):
    return float(text.replace("−", "-").replace(",", ""))


def test_the_key_opens_the_dock_and_typed_ids_are_pinned(loaded):
    from qtpy import QtCore, QtTest

    s = loaded
    s.activate()
    QtTest.QTest.qWaitForWindowActive(s.window)
    QtTest.QTest.keyClick(s.panels[0].view, QtCore.Qt.Key.Key_P)
    s.settle(0.1)
    assert s.document.docks == ("pins",)
    dock = parts(s.window).docks._docks["pins"].content
    assert dock.empty.isVisible()
    type_ids(s, dock, "12, 40 700")
    assert ids(s) == [12, 40, 700]
    assert dock.box.text() == ""
    type_ids(s, dock, "3, 20000")
    assert ids(s) == [12, 40, 700]
    assert dock.wrong.text() == "No vertex 20000 here: 0 to 1499"
    type_ids(s, dock, "40")
    assert dock.wrong.text() == "Vertex 40 has a pin already."
    QtTest.QTest.keyClicks(dock.box, "p")
    assert s.document.docks == ("pins",)  # it was typed
    type_ids(s, dock, "20000")
    QtTest.QTest.keyClick(dock.box, QtCore.Qt.Key.Key_Escape)
    s.settle(0.1)
    assert (dock.box.text(), dock.wrong.isVisible(), dock.box.hasFocus()) == ("", False, False)


def test_the_list_says_what_every_panel_has_there(loaded):
    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    for row, vertex in zip(dock.table.rows, (12, 40), strict=True):
        assert row.vertex == str(vertex)
        for text, answer in zip(row.values, s.answers, strict=True):
            assert read_number(text) == pytest.approx(answer.field[vertex], rel=6e-4)
    from qtpy import QtCore, QtTest

    QtTest.QTest.mouseClick(dock.ways.buttons["share"], QtCore.Qt.MouseButton.LeftButton)
    for text, answer in zip(dock.table.rows[1].values, s.answers, strict=True):
        assert read_number(text.removesuffix(" %")) == pytest.approx(100 * answer.field[40] / answer.maximum, abs=0.06)
    # And of another source.
    parts(s.window).typed_source.choose(700)
    s.until(lambda: s.session.is_complete)
    s.settle(0.05)
    assert read_number(dock.table.rows[0].values[0].removesuffix(" %")) == pytest.approx(
        100 * s.answers[0].field[12] / s.answers[0].maximum, abs=0.06
    )


def test_the_matrix_is_what_the_command_writes(loaded, tmp_path, capsys):
    from app.main import main

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    s.until(lambda: dock.distances.matrix() is not None)
    type_ids(s, dock, "700 3 1200")  # some are known by now
    specs = [panel.shows.spec for panel in s.document.panels]
    s.until(lambda: all(dock.distances.known(spec) is not None for spec in specs))
    for spec in specs:
        out = tmp_path / f"{spec.word}.npy"
        path = s.document.surfaces[0].path
        main(["pairs", path, "--sources", "12,40,700,3,1200", "--distance", str(spec), "-o", str(out)])
        expected = np.load(out)
        found = dock.distances.known(spec)
        assert np.abs(found - expected).max() <= 1e-9 * expected.max()
    capsys.readouterr()


def test_pins_in_faces_are_listed_and_compared(loaded, tmp_path):
    from bihdist_core import SurfacePoint

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, f17:0.2,0.5")
    assert ids(s) == [12, SurfacePoint.of(17, 0.2, 0.5)]
    parts(s.window).snapping.set(False)
    (vertex,) = seen_vertices(s, 1)
    shift_click(s, vertex)
    place = ids(s)[2]
    assert isinstance(place, SurfacePoint)
    assert vertex in s.session.mesh().surface.faces[place.face]
    assert [row.vertex for row in dock.table.rows] == ["12", "f17", f"f{place.face}"]
    specs = [panel.shows.spec for panel in s.document.panels]
    s.until(lambda: all(dock.distances.known(spec) is not None for spec in specs))
    for spec in specs:
        distance = s.session.loaded().distances(s.document.areas).get(spec)
        expected = distance.pairwise(ids(s))
        assert np.abs(dock.distances.known(spec) - expected).max() <= 1e-9 * expected.max()
    type_ids(s, dock, "f17:0.2,0.5")
    assert dock.wrong.text() == "This place has a pin already."
    type_ids(s, dock, "f99999:0.2,0.5")
    assert "no face 99999" in dock.wrong.text()
    type_ids(s, dock, "f17:0.8,0.5")
    assert "add up to 1" in dock.wrong.text()
    # Files have vertices: how far away they are is said.
    said = []
    s.window.status.say = lambda text, holds=None: said.append(text)
    dock.files.save(str(tmp_path / "pins.csv"))
    assert said[-1].startswith("Saved 3 pins in pins.csv: 2 pins moved to a vertex, the farthest")
    select_row(s, dock, 1)
    dock.head[-1].menu().aboutToShow.emit()
    source_here = next(action for action in dock.head[-1].menu().actions() if action.text() == "Source here")
    source_here.trigger()
    assert s.source == SurfacePoint.of(17, 0.2, 0.5)
    # A menu whose pin is gone meanwhile does nothing.
    dock.remove(dock.table.points)
    s.settle(0.05)
    s.window.context.session.show(move_source(s.document, 0, 5))
    source_here.trigger()
    assert s.source == 5


def test_the_cell_under_the_pointer_says_the_pair_in_all_distances(loaded):
    from qtpy import QtTest

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40, 700")
    specs = [panel.shows.spec for panel in s.document.panels]
    s.until(lambda: all(dock.distances.known(spec) is not None for spec in specs))
    cells = dock.distances.cells
    QtTest.QTest.mouseMove(cells, cells._rect(0, 2).center().toPoint())
    s.settle(0.05)
    said = dock.distances.line.text()
    assert said.startswith("1 to 3")
    for spec, name in zip(specs, ("biharmonic", "geodesic", "diffusion"), strict=True):
        assert name in said
        from app.drawing.numbers import number

        assert f"<b>{number(float(dock.distances.known(spec)[0, 2]))}</b>" in said


def test_rows_are_renamed_moved_coloured_and_removed_by_keys_and_menu(loaded):
    from qtpy import QtCore, QtTest, QtWidgets

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40, 700")
    select_row(s, dock, 0)
    assert s.window.grid.marks.highlighted("pins") == (s.document[Pins].pins[0].point,)
    press(s, dock.table, QtCore.Qt.Key.Key_F2)
    editor = next(box for box in dock.table.findChildren(QtWidgets.QLineEdit) if box.isVisible())
    QtTest.QTest.keyClicks(editor, "nose")
    press(s, editor, QtCore.Qt.Key.Key_Return)
    assert [pin.name for pin in s.document[Pins].pins] == ["nose", "", ""]
    assert not any(box.isVisible() for box in dock.table.findChildren(QtWidgets.QLineEdit))
    press(s, dock.table, QtCore.Qt.Key.Key_Down, QtCore.Qt.KeyboardModifier.AltModifier)
    assert ids(s) == [40, 12, 700]
    assert dock.table.points == (s.document[Pins].pins[1].point,)
    dock.head[-1].menu().aboutToShow.emit()
    colours = next(action.menu() for action in dock.head[-1].menu().actions() if action.text() == "Colour")
    colours.actions()[8].trigger()
    assert s.document[Pins].pins[1].colour == 8
    press(s, dock.table, QtCore.Qt.Key.Key_Delete)
    assert ids(s) == [40, 700]
    assert s.window.grid.marks.highlighted("pins") == ()
    for _ in range(4):
        s.session.undo()
    assert ids(s) == [12, 40, 700]
    assert [pin.name for pin in s.document[Pins].pins] == ["", "", ""]


def test_a_row_is_dragged_to_another_place(loaded):
    from qtpy import QtCore, QtGui

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40, 700")
    select_row(s, dock, 0)
    table = dock.table

    class Drop(QtGui.QDropEvent):
        def source(self):
            return table

    # A drag that only may copy is not taken by a list whose rows are moved.
    assert table.supportedDropActions() == QtCore.Qt.DropAction.MoveAction
    at = table.visualRect(table.model().index(2, 1)).bottomLeft() - QtCore.QPoint(-5, 2)
    action = QtCore.Qt.DropAction.MoveAction
    button, modifier = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.KeyboardModifier.NoModifier
    table.dropEvent(Drop(QtCore.QPointF(at), action, QtCore.QMimeData(), button, modifier))
    assert ids(s) == [40, 700, 12]


def test_pins_come_back_from_each_format_and_moves_to_vertices_are_said(loaded, tmp_path):
    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40, 700")
    dock.rename(s.document[Pins].pins[1].point, "ear")
    for extension in ("csv", "json", "pp"):
        path = tmp_path / f"pins.{extension}"
        dock.files.save(str(path))
        dock.remove([pin.point for pin in s.document[Pins].pins])
        assert ids(s) == []
        dock.files.read(str(path))
        assert ids(s) == [12, 40, 700]
        assert s.document[Pins].pins[1].name == "ear"
        if extension == "pp":
            break
        for pin in s.document[Pins].pins:
            assert pin.name in ("", "ear")
    x, y, z = s.session.mesh().surface.vertices[5] * 1.01
    (tmp_path / "off.csv").write_text(f"x,y,z,name\n{x},{y},{z},nearby\n")
    said = []
    s.window.status.say = lambda text, holds=None: said.append(text)
    dock.files.read(str(tmp_path / "off.csv"))
    assert ids(s)[-1] == 5
    assert "1 pin moved to a vertex" in said[-1]
    dock.files.read(str(tmp_path / "absent.csv"))
    assert "cannot be read" in s.refusals[-1]


def test_what_is_copied_has_all_digits(loaded):
    from qtpy import QtWidgets

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    dock.rename(s.document[Pins].pins[0].point, "nose")
    dock.copy_list()
    head, first, _ = QtWidgets.QApplication.clipboard().text().strip().split("\n")
    cells = dict(zip(head.split("\t"), first.split("\t"), strict=True))
    assert cells["name"] == "nose"
    assert float(cells["Biharmonic"]) == s.answers[0].field[12]
    s.until(lambda: dock.distances.matrix() is not None)
    dock.copy_matrix()
    lines = [line.split("\t") for line in QtWidgets.QApplication.clipboard().text().split("\n")[:3]]
    assert lines[0] == ["", "nose", "2"]
    assert float(lines[1][2]) == dock.distances.matrix()[0, 1]


def test_how_pins_are_listed_is_undone(loaded):
    from qtpy import QtCore, QtTest

    from bihdist_core.distances.distance_types import Spec

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    by_value = dock.table.rows[0].values
    QtTest.QTest.mouseClick(dock.ways.buttons["share"], QtCore.Qt.MouseButton.LeftButton)
    dock.distances.distance.menu().aboutToShow.emit()
    next(action for action in dock.distances.distance.menu().actions() if action.text() == "Geodesic").trigger()
    dock.list_otherwise(positions=True)
    assert dock.table.titles[:3] == ("x", "y", "z")
    assert dock.distances.spec == Spec.of("geodesic")
    assert dock.distances.distance.text() == "Geodesic"
    s.session.undo()
    assert dock.table.titles[0] == "Biharmonic"
    assert dock.table.rows[0].values != by_value
    s.session.undo()
    assert dock.distances.distance.text() == "Biharmonic"
    s.session.undo()
    assert dock.table.rows[0].values == by_value
    assert dock.ways.choice() == "value"


def test_a_session_brings_pins_and_their_dock_back(loaded, screen, tmp_path):
    from bihdist_core.distances.distance_types import Spec

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    dock.rename(s.document[Pins].pins[0].point, "nose")
    dock.distances.choose_distance(Spec.of("geodesic", method="dijkstra"))
    dock.list_otherwise(shares=True)
    parts(s.window).session_file.save(str(tmp_path / "all.json"))
    other = screen()
    parts(other.window).files.open(str(tmp_path / "all.json"))
    other.until(lambda: other.session.is_complete)
    other.settle(0.1)
    assert ids(other) == [12, 40]
    assert [pin.name for pin in other.document[Pins].pins] == ["nose", ""]
    rows = parts(other.window).docks._docks["pins"].content.table.rows
    assert [row.name for row in rows] == ["nose", ""]
    assert [row.values for row in rows] == [row.values for row in dock.table.rows]
    listed = parts(other.window).docks._docks["pins"].content
    assert listed.distances.spec == Spec.of("geodesic", method="dijkstra")
    assert listed.ways.choice() == "share"


def test_all_columns_are_seen_at_the_default_width_under_short_titles(loaded):

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    s.settle(0.1)
    table = dock.table
    widths = [table.columnWidth(k) for k in range(table.columnCount())]
    assert len(widths) == 3 + len(s.panels) == 6
    assert sum(widths) <= table.viewport().width()
    heads = [table.horizontalHeaderItem(k).text() for k in range(3, 6)]
    assert heads == ["Biharm.", "Geod.", "Diffus."]


def test_titles_are_written_in_as_many_lines_as_they_need(loaded):
    from qtpy import QtGui

    from app.document.edits import add_panel
    from app.document.quantities import quantity

    s = loaded
    dock = dock_of(s)
    type_ids(s, dock, "12, 40")
    document = s.document
    for text in ("truncated(k=30)", "commute-time", "biharmonic - geodesic"):
        document = add_panel(document, quantity(text))
    s.session.show(document)
    s.until(lambda: s.session.is_complete)
    s.settle(0.1)
    table = dock.table
    header, heads = table.horizontalHeader(), [table.horizontalHeaderItem(k).text() for k in range(9)]
    assert ["".join(head.split()) for head in heads[3:]] == ["".join(title.split()) for title in table.short_titles]
    metrics = QtGui.QFontMetrics(header.font())
    for column in range(2, 9):
        text = heads[column]
        wide = max(metrics.horizontalAdvance(line) for line in text.split("\n"))
        assert wide <= header.sectionSize(column)
        assert metrics.lineSpacing() * len(text.split("\n")) <= header.height()
    assert any("\n" in head for head in heads[3:])
