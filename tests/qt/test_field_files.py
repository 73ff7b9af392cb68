"""Fields of panels, saved from the window as `bihdist field` writes them."""

import csv
import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets

from app.document.edits import add_panel, move_source
from app.document.looks import Colours
from app.document.quantities import quantity
from app.tools.correspondence.maps import MapColours
from app.tools.robustness.perturbed_documents import perturb_mesh
from bihdist_core.applications.changes import Perturbation
from bihdist_core.formats.field_output import FIELD_FORMATS
from bihdist_core.sources.source import SourceSet, SurfacePoint
from tests.qt.parts import parts
from tests.shapes import bumpy

ALL_FORMATS = (*FIELD_FORMATS, ".obj", ".glb")


@pytest.fixture
def paths(monkeypatch, tmp_path):
    """Answers for the dialog that asks where, one after the other, and what it was asked with: title and name."""
    answers, asked = [], []

    def ask(window, title, name, formats):
        assert formats in (FIELD_FORMATS, ALL_FORMATS)
        asked.append((title, name))
        return str(tmp_path / answers.pop(0))

    monkeypatch.setattr("app.qt.files.saving.ask_path", ask)
    return answers, asked


def entry(menu, text):
    """Of a menu, as it is pressed."""
    next(action for action in menu.actions() if action.text() == text).trigger()


def said(s):
    """What the status bar says, once something has been written."""
    s.until(lambda: s.window.status.message.text.startswith("Saved") or s.refusals)
    text = s.window.status.message.text
    s.window.context.tell("")
    return text


def written_by_the_command(mesh, source, panel, out):
    from app.main import main

    assert main(["field", mesh, "--sources", source, "--distance", str(panel.shows), "-o", str(out)]) == 0
    return Path(out).read_bytes()


def test_every_panel_saves_what_the_command_writes_in_every_format(screen, mesh_file, tmp_path, paths):
    answers, asked = paths
    mesh, s = mesh_file(bumpy(300)), screen()
    s.open(mesh, 5)
    s.session.show(add_panel(s.document, quantity("biharmonic - geodesic")))
    s.until(lambda: s.session.is_complete)
    assert len(s.panels) == 4
    # Eigenpairs of diffusion, the third, differ in their last bits with where arrays lie in memory.
    cases = [*zip(ALL_FORMATS, itertools.cycle((0, 1, 3))), (".npy", 2)]
    for extension, panel in cases:
        answers.append(f"mine{extension}")
        entry(s.panels[panel].head.more.menu(), "Save field…")
        assert said(s) == f"Saved mine{extension} in {tmp_path}"
        written = (tmp_path / f"mine{extension}").read_bytes()
        there = tmp_path / f"theirs{extension}"
        theirs = written_by_the_command(mesh, "5", s.document.panels[panel], there)
        if panel == 2:
            assert np.allclose(np.load(tmp_path / "mine.npy"), np.load(there), rtol=0, atol=1e-12)
        else:
            assert written == theirs
    assert asked[0] == ("Save the field", "mesh-field-biharmonic-from-5")
    assert ("Save the field", "mesh-field-biharmonic-minus-geodesic-percent-from-5") in asked
    # By the menu Panels that of the active panel, from a source of several parts.
    s.session.show(move_source(s.document, 0, SourceSet((7, SurfacePoint(12, (0.2, 0.5, 0.3))))))
    s.until(lambda: s.session.is_complete)
    s.window.grid.activate(s.document.panels[0].id)
    answers.append("again.csv")
    s.window.actions_by_word["save field"].trigger()
    assert said(s)
    theirs = written_by_the_command(mesh, "7+f12:0.2,0.5", s.document.panels[0], tmp_path / "theirs.csv")
    assert (tmp_path / "again.csv").read_bytes() == theirs


def test_the_menu_at_the_pointer_offers_it_on_the_surface_and_beside_it(shared_screen, tmp_path, paths):
    from app.qt.panels.events import MenuWanted

    s = shared_screen()
    answers, _ = paths
    view = s.panels[1].view
    for hit in (view.pick(view.rect().center()), None):
        answers.append("at.npy")
        view.happened.emit(MenuWanted(hit, QtCore.QPoint(5, 5)))
        menu = QtWidgets.QApplication.activePopupWidget()
        entry(menu, "Save field…")
        menu.close()
        assert said(s)
        assert np.array_equal(np.load(tmp_path / "at.npy"), s.answers[1].field)
        (tmp_path / "at.npy").unlink()


def test_vertices_have_the_colours_of_their_panel(shared_screen, tmp_path, paths):
    pyvista = pytest.importorskip("pyvista")
    s = shared_screen()
    s.session.show(replace(s.document, colours=Colours("safe", (), True), range="shared"))
    s.until(lambda: s.session.is_complete)
    paths[0].append("a.ply")
    entry(s.panels[0].head.more.menu(), "Save field…")
    assert said(s)
    scene, field = s.panels[0].view.scene, s.answers[0].field
    assert scene.field_actor.maximum > field.max()
    colours = scene.style.vertex_colours(field, scene.field_actor.maximum)
    assert np.array_equal(pyvista.read(tmp_path / "a.ply").point_data["RGB"], colours)
    assert len(np.unique(colours, axis=0)) > 20


def test_all_fields_are_columns_of_one_file_with_names_that_tell_them_apart(shared_screen, tmp_path, paths):
    answers, asked = paths
    s = shared_screen()
    for shows in ("diffusion(t=1/4)", "diffusion(t=1/4)"):
        s.session.show(add_panel(s.document, quantity(shows)))
    s.session.show(add_panel(s.document, MapColours()))
    s.until(lambda: s.session.is_complete)
    answers.append("all.csv")
    file = s.window.menuBar().actions()[0].menu()
    entry(file, "Save all &fields…")
    assert said(s) == f"Saved all.csv in {tmp_path}; Positions shows colours, and has no field."
    assert asked == [("Save all fields", "mesh-fields")]
    with open(tmp_path / "all.csv", newline="") as lines:
        header, *rows = csv.reader(lines)
    assert header == [
        "vertex",
        "biharmonic_from_5",
        "geodesic_from_5",
        "diffusion_from_5",
        "diffusion_t_1_4_from_5",
        "diffusion_t_1_4_from_5_5",
    ]
    values = np.array(rows, float)
    for column, answer in enumerate(s.answers[:-1], 1):
        assert np.array_equal(values[:, column], answer.field)


def test_two_meshes_have_a_file_each(shared_screen, tmp_path, paths):
    answers, asked = paths
    s = shared_screen()
    s.session.show(perturb_mesh(s.document, Perturbation(noise=0.1)))
    s.until(lambda: s.session.is_complete and len(s.document.surfaces) == 2)
    answers += ["one.npy", "other.npy"]
    s.window.actions_by_word["save fields"].trigger()
    s.until(lambda: (tmp_path / "other.npy").exists())
    assert asked == [(f"Save all fields of {letter}: mesh.off", f"mesh-{letter}-fields") for letter in "AB"]
    for mesh, name in zip(s.document.surfaces, ("one", "other"), strict=True):
        fields = [s.session.shown[panel.id].answer.field for panel in s.document.panels_of(mesh.name)]
        assert np.array_equal(np.load(tmp_path / f"{name}.npy"), np.column_stack(fields), equal_nan=True)


def test_a_field_that_is_not_there_is_not_saved(shared_screen, tmp_path, paths):
    s = shared_screen()
    s.session.show(move_source(s.document, 0, 9))
    assert not s.session.is_complete  # the answers are those of the source before
    parts(s.window).field_files.save(s.document.panels[0].id)
    parts(s.window).field_files.save_all()
    assert s.refusals == [
        "Biharmonic has no field yet.",
        "Biharmonic has no field yet. Geodesic has no field yet. Diffusion has no field yet.",
    ]
    s.until(lambda: s.session.is_complete)
    paths[0].append("nowhere/a.npy")
    parts(s.window).field_files.save(s.document.panels[0].id)
    s.until(lambda: len(s.refusals) == 3)
    assert "nowhere" in s.refusals[2]


def test_files_are_written_one_after_the_other_and_none_is_left_out(shared_screen, tmp_path):
    s = shared_screen()
    for number in range(5):
        parts(s.window).field_files.save(s.document.panels[number % 3].id, str(tmp_path / f"{number}.npy"))
    s.until(lambda: s.window.status.message.text.startswith("Saved 4.npy"))
    for number in range(5):
        assert np.array_equal(np.load(tmp_path / f"{number}.npy"), s.answers[number % 3].field)


def test_files_that_wait_when_the_window_closes_are_written(shared_screen, tmp_path):
    s = shared_screen()
    for number in range(4):
        parts(s.window).field_files.save(s.document.panels[0].id, str(tmp_path / f"{number}.npy"))
    s.window.close()
    for number in range(4):
        assert np.array_equal(np.load(tmp_path / f"{number}.npy"), s.answers[0].field)


def test_the_dialog_writes_the_format_that_is_chosen_in_it(shared_screen, tmp_path):
    s = shared_screen()
    s.window.context.preferences = replace(s.window.context.preferences, last_folder=str(tmp_path))

    def choose():
        dialog = QtWidgets.QApplication.activeModalWidget()
        (wanted,) = [each for each in dialog.nameFilters() if ".vtp" in each]
        box = dialog.findChild(QtWidgets.QComboBox, "fileTypeCombo")
        box.setCurrentText(wanted)
        dialog.filterSelected.emit(wanted)
        dialog.accept()

    QtCore.QTimer.singleShot(0, choose)
    parts(s.window).field_files.save(s.document.panels[0].id)
    assert said(s) == f"Saved mesh-field-biharmonic-from-5.vtp in {tmp_path}"
    assert b"biharmonic_from_5" in (tmp_path / "mesh-field-biharmonic-from-5.vtp").read_bytes()
