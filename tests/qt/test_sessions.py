"""Sessions: saved and opened again, asked about, offered after a crash; recipes in and out of the window."""

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.document.camera import Camera
from app.document.document import comparison
from app.document.edits import add_panel, move_source
from app.document.file import read_recipe, recipe_text
from app.document.looks import Colours
from app.document.page import Page, Recipe
from app.document.quantities import quantity
from app.main import main
from app.scene.picking import Hit
from app.session.array_store import comparison_of_arrays
from app.session.recipe_file import recipe_written
from bihdist_core.distances.distance_types import Spec
from tests.commands import refused
from tests.programs import run_app
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

pytestmark = pytest.mark.usefixtures("own_folder")


def arranged(s, mesh):
    """A window that shows something of its own."""
    s.open(mesh, 5)
    document = add_panel(move_source(s.document, 0, 9), quantity("biharmonic - geodesic"))
    s.session.show(replace(document, isolines=12))
    s.panels[2].head.controls[0].chosen.emit(0.25)
    parts(s.window).views.reset("left")
    s.until(lambda: s.session.is_complete)
    s.settle()


def test_a_session_opened_again_is_the_same_document_and_the_same_pictures(screen, mesh_file, tmp_path):
    one, other = screen(), screen()
    arranged(one, mesh_file(bumpy(400)))
    path = tmp_path / "s.json"
    parts(one.window).session_file.save(str(path))
    other.open(mesh_file(grid(4, 4), "other.off"))
    parts(other.window).session_file.open(str(path))
    other.until(lambda: other.session.is_complete and other.session.mesh().surface.name == "mesh.off")
    other.settle()
    assert other.document == one.document
    # Eigenpairs that were computed in another order differ in their last digits, and so do some pixels.
    assert all((a != b).mean() < 0.005 for a, b in zip(one.pictures(), other.pictures(), strict=True))
    other.session.undo()
    other.until(lambda: other.session.is_complete)
    assert other.session.mesh().surface.name == "other.off"


def test_a_session_is_drawn_by_the_command_line_and_may_move_with_its_mesh(screen, mesh_file, tmp_path):
    s = screen()
    mesh = mesh_file(bumpy(300))
    arranged(s, mesh)
    parts(s.window).session_file.save(str(tmp_path / "s.json"))
    assert json.loads((tmp_path / "s.json").read_text())["document"]["surfaces"][0]["path"] == "mesh.off"
    (tmp_path / "moved").mkdir()
    for name in ("s.json", "mesh.off"):
        os.rename(tmp_path / name, tmp_path / "moved" / name)
    assert main(["figure", "--recipe", str(tmp_path / "moved" / "s.json"), "-o", str(tmp_path / "f.png")]) == 0


def test_a_recipe_opened_and_exported_again_has_the_same_bytes(screen, mesh_file, tmp_path):
    from app.qt.files.figure_actions import export_figure

    camera = Camera((3.0, 1.0, 2.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.4, 0.3))
    document = comparison(mesh_file(bumpy(300)), (Spec.of("biharmonic"), Spec.of("commute-time")), (4, 9))
    document = replace(document, camera=camera, isolines=12)
    (tmp_path / "a.json").write_text(recipe_text(Recipe(document, Page(size="600x300", columns=2)), "0"))
    assert main(["figure", "--recipe", str(tmp_path / "a.json"), "-o", str(tmp_path / "f.png")]) == 0
    s = screen()
    parts(s.window).session_file.open(str(tmp_path / "f.json"))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert len(s.panels) == 4
    assert [p.shows.point for p in s.document.panels] == ["source", "source", "source 2", "source 2"]
    dialog = export_figure(s.window.context)
    ended = []
    parts(s.window).exports.saved.connect(ended.append)
    parts(s.window).exports.failed.connect(ended.append)
    dialog.export(str(tmp_path / "g.png"))
    s.until(lambda: ended)
    assert (tmp_path / "g.json").read_bytes() == (tmp_path / "f.json").read_bytes()
    assert (tmp_path / "g.png").read_bytes() == (tmp_path / "f.png").read_bytes()


def test_a_mesh_that_is_gone_or_has_changed_is_said_and_another_can_be_pointed_at(
    screen, mesh_file, tmp_path, monkeypatch
):
    s = screen()
    mesh = mesh_file(bumpy(300))
    arranged(s, mesh)
    parts(s.window).session_file.save(str(tmp_path / "s.json"))
    before = s.document
    os.rename(mesh, tmp_path / "elsewhere.off")
    parts(s.window).session_file.open(str(tmp_path / "s.json"))
    assert "mesh.off was not found" in s.refusals[-1]
    assert s.document == before
    elsewhere = str(tmp_path / "elsewhere.off")
    monkeypatch.setattr("app.qt.files.session_actions._mesh_instead", lambda window, message, path: elsewhere)
    parts(s.window).session_file.open(str(tmp_path / "s.json"))
    s.until(lambda: s.session.is_complete and s.session.mesh().surface.name == "elsewhere.off")
    assert (s.source, len(s.panels)) == (9, 4)


def test_recent_files_are_listed_the_last_first(screen, mesh_file, tmp_path, monkeypatch):
    from app.qt import remembered

    monkeypatch.setattr(remembered, "MOST_RECENT", 3)
    s = screen()
    s.window.context.remembers = True
    meshes = [mesh_file(bumpy(100), f"m{k}.off") for k in range(4)]
    for mesh in meshes:
        s.open(mesh)
    parts(s.window).session_file.save(str(tmp_path / "s.json"))
    assert remembered.recent() == [str(tmp_path / "s.json"), *meshes[:1:-1]]
    os.unlink(meshes[-1])
    assert meshes[-1] not in remembered.recent()
    (remembered.folder() / "recent.json").write_text("[1, {")
    assert remembered.recent() == []


def test_view_saves_its_session(mesh_file, tmp_path):
    meshes = [mesh_file(bumpy(100), "a.off"), mesh_file(bumpy(120), "b.off")]
    words = ["--sources", "7,110", "--distance", "biharmonic - geodesic", "--cmap", "safe", "--bands"]
    outputs = ["--screenshot", tmp_path / "w.png", "--save-session", tmp_path / "s.json"]
    done = run_app("view", *meshes, *words, *outputs)
    assert done.returncode == 0, done.stderr
    document = read_recipe(tmp_path / "s.json").document
    assert [(point.at, point.surface) for point in document.points] == [(7, "A"), (110, "B")]
    assert {str(panel.shows) for panel in document.panels} == {"biharmonic - geodesic"}
    assert document.colours == Colours("safe", bands=True)
    assert not (tmp_path / "data").exists()
    done = run_app("view", tmp_path / "s.json", "--screenshot", tmp_path / "again.png")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "w.png") as one, Image.open(tmp_path / "again.png") as other:
        assert one.size == other.size
        assert (np.asarray(one) != np.asarray(other)).any(axis=2).mean() < 0.01


def test_a_session_whose_arrays_are_gone_ends_the_command_with_a_sentence(application, tmp_path):
    document, given = comparison_of_arrays(bumpy(60), ["biharmonic"], {}, (3,))
    with recipe_written(Recipe(document), given, tmp_path / "s.json", "9"):
        pass
    archive = Path(read_recipe(tmp_path / "s.json").arrays)
    archive.unlink()
    done = run_app("view", tmp_path / "s.json", "--screenshot", tmp_path / "w.png")
    assert done.returncode == 2
    assert archive.name in done.stderr


def test_a_session_is_opened_as_it_is_and_options_beside_it_are_refused(mesh_file, tmp_path, capsys):
    path = tmp_path / "s.json"
    path.write_text(recipe_text(Recipe(comparison(mesh_file(bumpy(60)))), "9"))
    for words in (["--sources", "3"], ["--distance", "geodesic"], ["--areas", "voronoi"], ["--t", "0.5"]):
        assert f"leave out {words[0]}" in refused(capsys, "view", path, *words)


def test_what_of_a_recipe_the_window_does_not_show_is_said_and_kept(screen, mesh_file, tmp_path):
    document = comparison(mesh_file(bumpy(300)), (Spec.of("biharmonic"),), (4,))
    recipe = Recipe(document, Page(style="lines", views=("home", "back")))
    (tmp_path / "r.json").write_text(recipe_text(recipe, "0"))
    s = screen()
    parts(s.window).session_file.open(str(tmp_path / "r.json"))
    s.until(lambda: s.session.is_complete)
    chip = s.window.status.notes
    assert chip.sentences[-1] == "in figures only: views but the first of 2, outlines"
    assert (chip.isVisible(), chip.words) == (True, f"{len(chip.sentences)} note{'s' * (len(chip.sentences) > 1)}")
    assert s.window.context.page == recipe.page


def corner(surface, vertex):
    """The pointer over a vertex."""
    face, number = np.argwhere(surface.faces == vertex)[0]
    return Hit(int(face), np.eye(3)[number], surface.vertices[vertex], vertex)


def test_random_actions_undone_and_redone_by_keyboard_give_the_same_pictures(screen, mesh_file):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    from app.document.panel_edits import panel_edits, possible_edits
    from app.qt.panels.events import MarkDrag, MarkRelease

    s = screen()
    meshes = [mesh_file(bumpy(250)), mesh_file(grid(7, 7), "grid.off")]
    s.open(meshes[0], 5)
    s.settle(0.6)
    random = np.random.default_rng(3)
    words = ("commute-time", "biharmonic - diffusion", "geodesic(method=heat)", "truncated")
    shows = [quantity(text) for text in words]

    def pictures():
        s.until(lambda: s.session.is_complete)
        s.settle(0.2)
        return s.pictures()

    def same(one, other):
        return len(one) == len(other) and all(
            a.shape == b.shape and (a != b).mean() < 0.005 for a, b in zip(one, other, strict=True)
        )

    first = pictures()
    for number in range(30):
        panels = [panel.id for panel in s.document.panels]
        panel = int(random.choice(panels))
        action = number % 5
        if action == 0:
            s.session.show(move_source(s.document, panel, int(random.integers(40))))
        elif action == 1:
            parts(s.window).choices.choose(panel, shows[random.integers(len(shows))])
        elif action == 2:
            parts(s.window).isolines.steps(int(random.integers(5, 40)))
        elif action == 3:
            possible = sorted(possible_edits(s.document, panel, 4))
            if possible:
                s.session.show(panel_edits()[str(random.choice(possible))].edit(s.document, panel))
        elif number % 15 == 4:
            s.open(meshes[number // 15 % 2], 3)
        else:
            for vertex in random.integers(40, size=2):
                s.panels[0].view.happened.emit(MarkDrag("", 0, corner(s.session.mesh().surface, int(vertex))))
            s.panels[0].view.happened.emit(MarkRelease(""))
    last, document = pictures(), s.document
    s.activate()
    parts(s.window).typed_source.ask()
    s.settle()

    def press(modifiers, is_there):
        steps = 0
        while is_there():
            QTest.keyClick(s.window.focusWidget(), Qt.Key_Z, modifiers)
            s.settle(0.02)
            steps += 1
            assert steps < 200
        return steps

    history = s.session.history
    back = press(Qt.ControlModifier, lambda: history.can_undo)
    assert same(first, pictures())
    assert press(Qt.ControlModifier | Qt.ShiftModifier, lambda: history.can_redo) == back >= 20
    assert same(last, pictures())
    assert replace(s.document, camera="home") == replace(document, camera="home")


def test_the_menu_offers_only_steps_that_there_are(screen, mesh_file):
    s = screen()

    def offered():
        actions, tools = s.window.actions_by_word, s.window.tool_bar.buttons
        found = [actions[word].isEnabled() for word in ("undo", "redo")]
        assert found == [tools[word].isEnabled() for word in ("undo", "redo")]
        return tuple(found)

    assert offered() == (False, False)
    s.open(mesh_file(bumpy(100)), 5)
    assert offered() == (False, False)
    s.session.show(move_source(s.document, 0, 9))
    assert offered() == (True, False)
    s.window.actions_by_word["undo"].trigger()
    assert (offered(), s.source) == ((False, True), 5)
