"""Figures from the window: the same pixels as the command line's, cancelled without a trace, recipes opened."""

import os
import sys
from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Point, comparison
from app.document.edits import move_source
from app.document.file import read_recipe, recipe_text
from app.document.page import Page, Recipe
from app.main import main
from app.qt.files.figure_actions import export_figure, export_movie
from bihdist_core import SurfacePoint
from bihdist_core.distances.distance_types import Spec
from tests.qt.events import turn_wheel
from tests.qt.parts import parts
from tests.shapes import bumpy, grid


def exported(s, path, size=None):
    """The dialog's figure at a path, once it is there."""
    dialog = export_figure(s.window.context)
    if size is not None:
        dialog.size.write(size)
    ended = []
    parts(s.window).exports.saved.connect(ended.append)
    parts(s.window).exports.failed.connect(ended.append)
    dialog.export(str(path))
    s.until(lambda: ended)
    assert ended == [str(path)]


def test_the_window_exports_the_pixels_of_the_command_line(shared_screen, tmp_path):
    s = shared_screen(bumpy(800))
    s.window.grid.camera_controller.camera.Azimuth(40)
    s.panels[0].view.moved.emit()
    exported(s, tmp_path / "window.png", size="600x300")
    assert main(["figure", "--recipe", str(tmp_path / "window.json"), "-o", str(tmp_path / "again.png")]) == 0
    window, again = ((tmp_path / name).read_bytes() for name in ("window.png", "again.png"))
    assert window == again
    recipe = read_recipe(tmp_path / "window.json")
    camera = recipe.document.camera
    numbers = [*camera.position, *camera.focal_point, *camera.up, *camera.extent]
    words = ["--sources", "5", "--camera=" + ",".join(map(repr, numbers)), "--size", "600x300"]
    assert main(["figure", recipe.document.mesh().path, *words, "-o", str(tmp_path / "options.png")]) == 0
    assert (tmp_path / "options.png").read_bytes() == window


def test_the_wheel_scrolls_the_form_and_changes_nothing_that_has_no_focus(shared_screen):
    s = shared_screen(bumpy(800))
    dialog = export_figure(s.window.context)
    dialog.form.setFocus()
    before = dialog.chosen()
    assert not any(turn_wheel(control) for control in (dialog.names, dialog.size.unit, dialog.letters, dialog.columns))
    assert dialog.chosen() == before
    dialog.names.setFocus()
    s.until(dialog.names.hasFocus)
    dialog.names.setCurrentIndex(1)
    assert turn_wheel(dialog.names)
    assert dialog.names.currentIndex() == 0
    dialog.reject()


def test_an_export_that_is_cancelled_leaves_nothing(shared_screen, tmp_path):
    s = shared_screen(bumpy(800))
    dialog = export_figure(s.window.context)
    dialog.size.write("12000px")
    out = tmp_path / "out"
    out.mkdir()
    dialog.export(str(out / "large.png"))
    assert not dialog.isVisible()
    (export,) = parts(s.window).exports.running
    s.until(lambda: export.fraction > 0)
    parts(s.window).exports.cancel(export)
    s.until(lambda: not parts(s.window).exports.running)
    assert os.listdir(out) == []
    assert s.refusals == []


def test_closing_the_window_cancels_what_is_drawn(shared_screen, tmp_path):
    s = shared_screen(bumpy(800))
    dialog = export_movie(s.window.context)
    dialog.frames.setValue(2000)
    out = tmp_path / "out"
    out.mkdir()
    dialog.export(str(out / "long.gif"))
    (export,) = parts(s.window).exports.running
    s.until(lambda: export.words.startswith("frame"))
    s.window.close()
    assert parts(s.window).exports.running == []
    assert os.listdir(out) == []


def test_what_cannot_be_exported_is_said_at_once(shared_screen, tmp_path):
    s = shared_screen()
    dialog = export_figure(s.window.context)
    dialog.export(str(tmp_path / "no" / "f.png"))
    assert "no folder" in dialog.refusal.text()
    assert dialog.isVisible()
    dialog.close()


@pytest.mark.parametrize("is_closed", [False, True])
def test_a_figure_that_is_asked_for_too_early_opens_once_the_panels_are_complete(shared_screen, is_closed):
    from app.qt.files.export_dialog import ExportDialog

    s = shared_screen()
    s.session.show(move_source(s.document, 0, 9))
    assert export_figure(s.window.context) is None
    assert s.window.status.message.text == "The dialog opens once the panels are complete"
    if is_closed:
        s.session.close_meshes()
        s.session.undo()
    s.until(lambda: s.completions[-1:] == [9])
    dialogs = s.window.findChildren(ExportDialog)
    assert [dialog.isVisible() for dialog in dialogs] == [True] * (not is_closed)
    assert s.refusals == []
    assert s.window.status.message.text == ""
    for dialog in dialogs:
        dialog.close()


def test_a_movie_is_a_gif_at_first_where_no_mp4_can_be_written(shared_screen, monkeypatch, tmp_path):
    from qtpy import QtWidgets

    s = shared_screen(bumpy(100))
    s.window.context.prefer(movie_format="MP4")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    dialog = export_movie(s.window.context)
    assert dialog.kinds.choice() == "GIF"
    labels = [label.text() for label in dialog.findChildren(QtWidgets.QLabel) if label.isVisible()]
    assert "MP4 and WebM need the package imageio-ffmpeg" in labels
    copy = next(each for each in dialog.findChildren(QtWidgets.QPushButton) if each.text() == "Copy the command")
    copy.click()
    line = f"{sys.executable} -m pip install imageio-ffmpeg"
    assert s.application.clipboard().text() == line
    # It is said before a file is asked for.
    dialog.kinds.buttons["MP4"].click()
    dialog.choose_path()
    assert dialog.refusal.text() == f"MP4 and WebM need the package imageio-ffmpeg: {line}"
    assert dialog.findChildren(QtWidgets.QFileDialog) == []
    dialog.close()
    pytest.MonkeyPatch.undo(monkeypatch)
    pytest.importorskip("imageio_ffmpeg")
    dialog = export_movie(s.window.context)
    assert dialog.kinds.choice() == "MP4"
    dialog.close()


def test_format_and_size_are_offered_again(screen, mesh_file, tmp_path):
    s = screen()
    context, page = s.window.context, s.window.context.page
    s.open(mesh_file(bumpy(100)), 5)

    def offered():
        dialog = export_figure(context)
        found = dialog.kinds.choice(), dialog.size.text()
        dialog.close()
        return found

    def export(path, size):
        dialog = export_figure(context)
        dialog.kinds.choose(path.suffix[1:].upper())
        dialog.size.write(size)
        dialog.export(str(path))
        s.until(lambda: not parts(s.window).exports.running)

    assert offered() == ("PNG", "")
    export(tmp_path / "f.svg", "column")
    assert s.window.status.message.text == "Saved f.svg, and beside it its recipe f.json"
    assert offered() == ("SVG", "column")
    assert (context.preferences.figure_format, context.preferences.figure_size) == ("SVG", "column")
    # A figure's recipe that is opened has a size and a format of its own.
    context.take_page(replace(page, format="pdf", size="300x200"))
    assert offered() == ("PDF", "300x200")
    export(tmp_path / "g.png", "400x200")
    assert offered() == ("PNG", "400x200")
    context.take_page(page)
    assert offered() == ("SVG", "column")


def test_a_movie_is_made_and_announced(shared_screen, tmp_path):
    from PIL import Image

    s = shared_screen(bumpy(200))
    dialog = export_movie(s.window.context)
    dialog.size.write("300x120")
    dialog.path_text.setText("5,90")
    dialog.turn.setValue(0)
    dialog.frames.setValue(2)
    ended, said = [], []
    parts(s.window).exports.saved.connect(ended.append)
    s.window.context.tell = said.append
    out = tmp_path / "m.gif"
    dialog.export(str(out))
    s.until(lambda: ended)
    assert said[-1] == "Saved m.gif"
    with Image.open(out) as film:
        assert film.n_frames == 2


def test_a_recipe_opens_in_the_window(shared_screen, mesh_file, tmp_path):
    mesh = mesh_file(bumpy(300))
    words = ["--distance", "diffusion,commute-time,geodesic", "--t", "0.25"]
    out = tmp_path / "f.png"
    camera = "--camera=3,1,2,0,0,0,0,1,0,0.4,0.3"
    assert (
        main(["figure", mesh, *words, "--sources", "7", camera, "--isolines", "12", "--style", "dark", "-o", str(out)])
        == 0
    )
    s = shared_screen()
    parts(s.window).session_file.open(str(tmp_path / "f.json"))
    s.until(lambda: s.document.mesh().path == mesh and s.session.is_complete)
    assert [p.answer.label for p in s.panels] == ["diffusion, t = 0.25", "commute-time, exact", "geodesic, exact"]
    assert s.source == 7
    assert s.document.isolines.count == 12
    assert np.allclose(s.window.grid.camera_controller.camera.GetPosition(), (3, 1, 2))
    exported(s, tmp_path / "again.png")
    again = read_recipe(tmp_path / "again.json")
    assert again.page.style == "dark"
    assert np.allclose(again.document.camera.position, (3, 1, 2))
    assert np.all(np.array(again.document.camera.extent) >= np.array([0.4, 0.3]) - 1e-9)
    parts(s.window).session_file.open(str(tmp_path / "none.json"))
    assert "cannot be read" in s.refusals[-1]


def test_a_recipe_whose_mesh_does_not_open_changes_nothing(shared_screen, mesh_file, tmp_path):
    s = shared_screen(bumpy(200))
    before = s.document
    (tmp_path / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    document = comparison("bad.off", (Spec.of("commute-time"),), (0,), "barycentric")
    (tmp_path / "bad.json").write_text(recipe_text(Recipe(replace(document, isolines=7, camera="top")), "0"))
    parts(s.window).session_file.open(str(tmp_path / "bad.json"))
    s.until(lambda: any("bad.off" in words for words in s.refusals))
    s.settle()
    assert s.document == before
    assert s.window.context.page == Page()
    assert s.panels[0].head.shows == before.panels[0].shows
    s.open(mesh_file(grid(3, 3), "other.off"))
    assert s.document.panels == before.panels


def opened_recipe(s, tmp_path, document, **page):
    (tmp_path / "r.json").write_text(recipe_text(Recipe(document, Page(**page)), "0"))
    parts(s.window).session_file.open(str(tmp_path / "r.json"))


def test_a_recipe_s_mesh_may_have_any_name_and_its_source_be_in_a_face(screen, mesh_file, tmp_path):
    s = screen()
    surface = bumpy(300)
    document = comparison(mesh_file(surface), (Spec.of("biharmonic"),), (7,))
    document = replace(
        document,
        surfaces=(replace(document.mesh(), name="M"),),
        points=(Point("source", SurfacePoint(3, (0.2, 0.2, 0.6)), "M"),),
        panels=(replace(document.panels[0], surface="M"),),
    )
    opened_recipe(s, tmp_path, document)
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert parts(s.window).typed_source.box.value() == SurfacePoint(3, (0.2, 0.2, 0.6))
    assert s.pictures()[0].std() > 20
    s.window.grid.pointing.show(s.panels[0].id, 5)
    assert s.panels[0].bar.accessibleDescription()
    s.open(mesh_file(grid(4, 4), "other.off"))
    assert [mesh.name for mesh in s.document.surfaces] == ["M"]


def test_recipes_that_the_window_cannot_show_say_so(shared_screen, tmp_path):
    s = shared_screen()
    before = s.document
    mesh = before.mesh()
    three = replace(before, surfaces=(mesh, replace(mesh, name="B"), replace(mesh, name="C")))
    opened_recipe(s, tmp_path, three)
    assert "shows up to 2 meshes" in s.refusals[-1]
    opened_recipe(s, tmp_path, before, style="pink")
    assert "no style 'pink'" in s.refusals[-1]
    opened_recipe(s, tmp_path, replace(before, points=(Point("source", 10**6),)))
    assert "no vertex 1000000" in s.refusals[-1]
    assert s.document == before


def test_a_recipe_without_panels_leaves_an_empty_window_that_works(shared_screen, tmp_path):
    s = shared_screen()
    opened_recipe(s, tmp_path, replace(s.document, panels=(), isolines=500))
    s.settle()
    assert s.panels == []
    assert s.document.isolines.count == 500
    parts(s.window).views.reset("top")
    assert export_figure(s.window.context) is None
    assert "no panels" in s.refusals[-1]
    parts(s.window).choices.add_panel()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert s.pictures()[0].std() > 20
