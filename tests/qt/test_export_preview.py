"""The export dialog shows the figure itself, and what it says is true of the file; copies are the figure again."""

import shlex
import subprocess
import sys
from dataclasses import replace

import numpy as np
from PIL import Image

from app.document.document import Inset, Panel, Point
from app.document.page import Page
from app.document.quantities import DistanceFrom
from app.qt.files.figure_actions import export_figure
from app.tools.interpolation.part import Anchor, Anchors
from bihdist_core import SurfacePoint
from bihdist_core.distances.distance_types import Spec
from tests.qt.painting import pixels_of
from tests.qt.parts import parts
from tests.shapes import bumpy


def shown_dialog(s, **page):
    s.window.context.page = replace(s.window.context.page, **page)
    dialog = export_figure(s.window.context)
    s.until(lambda: dialog.pane.is_true)
    return dialog


def colours_of(image):
    return pixels_of(image)[..., :3].astype(int)


def pasted():
    from qtpy.QtWidgets import QApplication

    return QApplication.clipboard()


def test_the_preview_is_the_figure_and_the_window_does_not_wait(shared_screen, tmp_path):
    s = shared_screen()
    dialog = shown_dialog(s, size="85mm")
    assert dialog.pane.caption.startswith("One column, 85 × ")
    first = colours_of(dialog.pane.image)
    dialog.export(str(tmp_path / "f.png"))
    s.until(lambda: (tmp_path / "f.json").exists() and not parts(s.window).exports.running)
    with Image.open(tmp_path / "f.png") as file:
        small = np.asarray(file.convert("RGB").resize(first.shape[1::-1], Image.Resampling.BOX)).astype(int)
        assert abs(file.size[0] / 300 * 25.4 - 85) < 0.1
        assert f"85 × {file.size[1] / 300 * 25.4:.0f} mm" in dialog.pane.caption
    # The same picture drawn coarser: letters and thin lines differ at their edges.
    assert np.abs(first - small).mean() < 6


def test_each_change_is_seen_and_the_last_one_stays(shared_screen):
    s = shared_screen()
    dialog = shown_dialog(s)
    before = colours_of(dialog.pane.image)
    for width in range(300, 330):
        dialog.size.write(f"{width}x200")
    dialog.style_box.setCurrentIndex(dialog.style_box.findData("dark"))
    assert not dialog.pane.is_true  # what is shown is dimmed until the new one is there
    s.until(lambda: dialog.pane.is_true)
    assert dialog.pane.caption.startswith("Custom, 329 × 200 pixels")
    after = colours_of(dialog.pane.image)
    assert before[0, 0].tolist() == [255] * 3
    assert after[0, 0].max() < 40
    dialog.transparent.setChecked(True)
    s.until(lambda: dialog.pane.is_true)
    assert dialog.pane.image.hasAlphaChannel()
    dialog.size.write("8px")
    s.until(lambda: "16 to 32000 pixels" in dialog.pane.caption)
    assert dialog.pane.is_warning
    assert (dialog.pane.is_true, dialog.pane.is_waiting) == (False, False)
    dialog.size.write("400x300")
    assert dialog.pane.is_waiting
    s.until(lambda: dialog.pane.is_true)
    dialog.close()


def test_a_picture_that_comes_late_is_shown_dimmed_until_the_right_one_is_there(shared_screen):
    s = shared_screen()
    dialog = export_figure(s.window.context)
    s.until(lambda: dialog._number)
    s.until(lambda: not parts(s.window).exports.previews._asked)  # it is being drawn
    dialog.size.write("500x300")
    s.until(lambda: not dialog.pane.image.isNull())
    pane = dialog.pane
    assert (pane.is_true, pane.is_waiting, pane.caption) == (False, True, "")
    s.until(lambda: dialog.pane.is_true)
    assert dialog.pane.caption.startswith("Custom, 500 × 300 pixels")
    dialog.close()


def test_letters_too_small_to_read_are_said(shared_screen):
    s = shared_screen()
    dialog = shown_dialog(s, size="178mm")
    assert not dialog.pane.is_warning
    dialog.size.write("200x100")
    s.until(lambda: dialog.pane.is_true)
    assert dialog.pane.is_warning
    assert "hard to read" in dialog.pane.caption
    dialog.close()


def test_one_column_is_cropped_and_has_one_bar_as_it_is_chosen(shared_screen):
    s = shared_screen()
    dialog = shown_dialog(s)
    names = [dialog.size.rows.button(k).text() for k in range(5)]

    def choose(name):
        dialog.size.rows.button(names.index(name)).click()
        recipe = dialog.chosen()
        return recipe.page.size, recipe.page.crop, recipe.document.range

    assert choose("One column") == ("column", True, "fraction")
    s.until(lambda: "85 ×" in dialog.pane.caption)
    assert not dialog.pane.is_warning
    dialog.crop.click()
    assert not dialog.chosen().page.crop
    assert choose("Two columns") == ("double", False, "own")


def test_a_process_that_dies_is_said_and_the_next_change_starts_another(shared_screen):
    s = shared_screen()
    dialog = shown_dialog(s)
    parts(s.window).exports.previews._worker._child.process.kill()
    dialog.hints.click()
    s.until(lambda: "process ended unexpectedly" in dialog.pane.caption)
    assert not dialog.pane.is_true
    dialog.hints.click()
    s.until(lambda: dialog.pane.is_true)
    dialog.close()


def test_all_of_the_dialog_is_there_in_a_small_window(screen, mesh_file):
    s = screen()
    s.window.resize(900, 600)
    s.open(mesh_file(bumpy(400)), 5)
    dialog = shown_dialog(s)
    assert dialog.width() <= 900
    assert dialog.height() <= 600
    assert dialog.pane.width() >= 260
    for button in (dialog.save, dialog.cancel, dialog.copy_picture, dialog.copy_line):
        place = button.mapTo(dialog, button.rect().bottomRight())
        assert dialog.rect().contains(place)
    dialog.close()


def test_the_picture_on_the_clipboard_is_the_exported_one(shared_screen, tmp_path):
    s = shared_screen()
    s.window.context.page = replace(s.window.context.page, size="400x300")
    pasted().clear()
    s.window.actions_by_word["copy picture"].trigger()
    s.until(lambda: not pasted().image().isNull())
    dialog = shown_dialog(s)
    dialog.export(str(tmp_path / "f.png"))
    s.until(lambda: (tmp_path / "f.json").exists() and not parts(s.window).exports.running)
    with Image.open(tmp_path / "f.png") as file:
        assert np.array_equal(colours_of(pasted().image()), np.asarray(file.convert("RGB")).astype(int))
    assert s.refusals == []


def turned(s):
    s.window.grid.camera_controller.camera.Azimuth(40)
    s.panels[0].view.moved.emit()


def other_panels(s):
    document = s.document
    panels = (Panel(7, DistanceFrom(Spec.of("diffusion", t=1 / 15))), Panel(9, DistanceFrom(Spec.of("commute-time"))))
    s.session.show(replace(document, panels=panels, next_id=10, areas="barycentric", isolines=12))


def marked(s):
    points = (Point("source", SurfacePoint(3, (0.2, 0.2, 0.6))), Point("a", 40))
    document = replace(s.document, points=points, insets=(Inset(5, 2.5),)).with_part(
        Anchors(anchors=(Anchor("a", 0.1),))
    )
    s.session.show(replace(document, panels=document.panels[:1]))


STATES = [(turned, Page(size="300x200"), "png"), (other_panels, Page(size="85mm@100", style="dark"), "png")]
STATES += [(marked, Page(size="85mm", hints=True, columns=1), "pdf")]


def test_the_copied_lines_make_the_bytes_of_the_export(screen, mesh_file, tmp_path):
    s = screen()
    exported, lines = [], []
    for k, (change, page, format) in enumerate(STATES):
        out, command, python = copied(s, mesh_file, tmp_path / f"window-{k}.{format}", change, page)
        assert command[0] == "bihdist"
        for name, line in (("command", f"assert main({command[1:]!r}) == 0"), ("python", python.partition("; ")[2])):
            folder = tmp_path / f"{name}-{k}"
            folder.mkdir()
            exported.append((out, folder / f"a-mesh-figure.{format}"))
            lines += [f"os.chdir({str(folder)!r})", line]
    # All of them in one process, which knows nothing of this one.
    code = "\n".join(["import os", "import app as bihdist", "from app.main import main", *lines])
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)
    for out, made in exported:
        assert made.read_bytes() == out.read_bytes(), made


def copied(s, mesh_file, out, change, page):
    """A file that is exported, and the copied lines for it: (path, words of a command, line of Python)."""
    s.open(mesh_file(bumpy(400), "a mesh.off"), 5)
    change(s)
    s.until(lambda: s.session.is_complete)
    own = {f: getattr(page, f) for f in ("size", "style", "hints", "columns")}
    dialog = shown_dialog(s, **own, format=out.suffix[1:])
    dialog.copy_line.menu().actions()[0].trigger()
    command = shlex.split(pasted().text())
    dialog.copy_line.menu().actions()[1].trigger()
    python = pasted().text()
    dialog.export(str(out))
    s.until(lambda: out.with_suffix(".json").exists() and not parts(s.window).exports.running)
    return out, command, python


def test_what_no_line_can_say_is_kept_as_a_recipe(shared_screen, tmp_path, monkeypatch):
    from app.main import main
    from app.qt import remembered

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path / "kept")
    s = shared_screen()
    document = replace(s.document, points=(*s.document.points, Point("other", 40)))
    panels = (document.panels[0], replace(document.panels[1], shows=DistanceFrom(Spec.of("commute-time"), "other")))
    s.session.show(replace(document, panels=panels))
    s.until(lambda: s.session.is_complete)
    said = []
    s.window.context.tell = said.append
    s.window.context.actions["copy command"].trigger()
    words = shlex.split(pasted().text())
    assert words[:3] == ["bihdist", "figure", "--recipe"]
    assert "different points" in said[-1]
    out = tmp_path / "again.png"
    assert main([*words[1:4], "--size", "300x200", "-o", str(out)]) == 0
    assert out.exists()
    s.window.context.actions["copy python"].trigger()
    assert f"figure_again({words[3]!r})" in pasted().text()
