"""`python -m tests.qt.contact_sheet OUT [--meshes FOLDER] [--beside FOLDER]`: the real window, all there is to see.

It is driven with a pointer and keys, light and dark, in three sizes; the pictures come on one page, OUT/index.html.

Each look runs on a screen of its own (Xvfb).  --meshes: a folder with meshes to be shown besides the samples; --beside:
pictures (mock-ups, the window of before) to be put at the top of the page.
"""

import argparse
import html
import os
import shutil
import sys
import tempfile
from pathlib import Path

from app.document.settings import BANDS, BOLD_ISOLINES, FLIP_SCALARS, RANGE, SHADING
from tests.qt.parts import parts

from .driver import ROOT, Driver, Look, drive_elsewhere
from .instrument_scenes import instruments
from .map_scenes import full_maps
from .pair_scenes import correspondence

LOOKS = [Look(theme, *size) for theme in ("light", "dark") for size in ((1600, 1000), (900, 600), (900, 600, 2))]


# ---------------------------------------------------------------------- the page
def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.qt.contact_sheet")
    parser.add_argument("out", type=Path)
    parser.add_argument("--meshes", type=Path)
    parser.add_argument("--beside", type=Path)
    parser.add_argument("--only", default="", help="looks whose names hold this")
    parser.add_argument("--scenes", default="", help="scenes whose names hold this, such as instruments")
    parser.add_argument("--closed", default="beast", help="mesh with limbs that instruments are shown on")
    parser.add_argument("--bounded", default="scan", help="mesh with a boundary that they are shown on")
    parser.add_argument("--drive", help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.drive:
        drive(next(look for look in LOOKS if look.word == options.drive), options)
        return
    for look in LOOKS:
        if options.only in look.word:
            print(look.word, flush=True)
            _on_a_screen_of_its_own(look, options)
    _write_page(options.out, options.beside)
    print(options.out / "index.html")


def _on_a_screen_of_its_own(look: Look, options: argparse.Namespace) -> None:
    words = [options.out, "--drive", look.word, "--scenes", options.scenes]
    words += ["--closed", options.closed, "--bounded", options.bounded]
    words += ["--meshes", options.meshes] if options.meshes else []
    drive_elsewhere(look, "tests.qt.contact_sheet", words)


def _write_page(out: Path, beside: Path | None) -> None:
    """All pictures there are, a row for each scene."""
    parts = ["<!doctype html><meta charset=utf-8><title>The window</title>", "<style>body{font:14px sans-serif}"]
    parts.append("img{width:32%;margin:2px;border:1px solid #ccc}h2{margin:24px 0 4px}</style>")
    if beside is not None:
        (out / "beside").mkdir(exist_ok=True)
        parts.append("<h2>Beside</h2>")
        for path in sorted(beside.glob("*.png")):
            shutil.copy(path, out / "beside" / path.name)
            parts.append(f'<a href="beside/{path.name}"><img src="beside/{path.name}" title="{path.name}"></a>')
    scenes = {path.name for path in out.glob("*/*.png") if path.parent.name != "beside"}
    for scene in sorted(scenes):
        parts.append(f"<h2>{html.escape(scene.removesuffix('.png').replace('_', ' '))}</h2>")
        for look in LOOKS:
            place = f"{look.word}/{scene}"
            if (out / place).exists():
                parts.append(f'<a href="{place}"><img loading=lazy src="{place}" title="{look.word}"></a>')
    (out / "index.html").write_text("\n".join(parts), encoding="utf-8")


# ---------------------------------------------------------------------- one look
def drive(look: Look, options: argparse.Namespace) -> None:
    """Through all there is to see."""
    driver, meshes = Driver(look, options.out / look.word, options.closed, options.bounded), options.meshes
    for scene in (
        _beginning, _pointing, _heads, _bars_and_menus, _looks, _panels, _waiting, _dialogs, _help, _talk, instruments,
        correspondence, full_maps,
    ):  # fmt: skip
        if options.scenes in scene.__name__:
            scene(driver)
    for path in sorted(meshes.glob("*.o[bf][jf]")) if meshes else ():
        driver.open(path)
        driver.point_at_surface(1)
        driver.shot(f"mesh {path.stem}")
    driver.window.context.quiet = True
    driver.window.close()
    sys.stdout.flush()
    os._exit(0)


def _beginning(d: Driver) -> None:
    from app.samples import mesh_path

    d.shot("empty")
    d.window.context.open(str(ROOT / "README.md"))
    d.spin(0.6)
    d.shot("a file that is no mesh")
    d.pointer("key", "Tab")
    d.pointer("key", "Tab")
    d.shot("keys in the empty window")
    d.open(mesh_path("figure"))
    d.shot("opened")


def _pointing(d: Driver) -> None:
    d.point_at_surface(0)
    d.shot("hover")
    d.pointer("click", 4)
    d.pointer("click", 4)
    d.shot("wheel")
    d.pointer("click", 1)
    d.complete()
    d.shot("click")
    d.pointer("click", 3)
    d.shot("context menu")
    d.pointer("key", "Escape")
    d.pointer("key", "c")
    d.shot("centred")
    for key in ("Right", "shift+Up", "minus", "Tab", "ctrl+Left"):
        d.pointer("key", key)
    d.complete()
    d.shot("after keys")
    d.pointer("key", "r")


def _heads(d: Driver) -> None:
    panel = d.window.grid.panels[2]
    d.shot_while(panel.head.name.click, "menu of quantities")
    d.pointer("key", "g")
    for key in ("9", "9", "9", "9", "9", "9", "Return"):
        d.pointer("key", key)
    d.shot("no such vertex")
    d.pointer("key", "Escape")


def _bars_and_menus(d: Driver) -> None:
    for button in ("open", "isolines", "colours", "range", "views", "tools"):
        d.with_menu(button, f"menu of {button}")
    bar = d.window.menuBar()
    for action in bar.actions():
        action.menu().popup(bar.mapToGlobal(bar.actionGeometry(action).bottomLeft()))
        d.shot(f"menu {action.text().strip('&')}")
        action.menu().hide()
    for style in ("lines", "dark", "paper"):
        parts(d.window).choices.style(style)
        d.shot(f"style {style}")


def _looks(d: Driver) -> None:
    """Colours, ranges, isolines, shading and cameras."""
    window, before = d.window, d.window.session.document
    choices, first = parts(window).choices, before.panels[0].id
    choices.colour_map("safe")
    choices.set(BANDS, True)
    d.shot("safe colours in bands")
    choices.colour_map("ember")
    choices.set(FLIP_SCALARS, True)
    choices.set(RANGE, "fraction")
    d.shot("ember reversed in shares")
    window.session.show(before)
    choices.end_at(first, 0.4 * window.session.shown[first].answer.maximum)
    choices.set(BOLD_ISOLINES, 5)
    parts(window).isolines.pass_through(first, 4000)
    d.complete()
    d.shot("a typed end and an isoline through a place")
    window.grid.panel(first).ask_end()
    d.shot("the end of a bar is typed")
    d.pointer("key", "Escape")
    window.session.show(before)
    for key in ("w", "x", "o"):
        d.pointer("key", key)
    choices.set(SHADING, "flat")
    d.complete()
    d.shot("wireframe flat axes orthographic")
    for key in ("u", "7"):
        d.pointer("key", key)
    d.complete()
    d.shot("another axis up from the source")
    window.session.show(before)
    d.complete()


def _panels(d: Driver) -> None:
    from app.document.edits import add_panel
    from app.document.quantities import quantity

    document = d.window.session.document
    d.window.session.show(add_panel(document, quantity("biharmonic - geodesic")))
    d.complete()
    d.point_at_surface(3)
    d.shot("four panels")
    document = d.window.session.document
    for text in ("truncated(k=30)", "commute-time"):
        document = add_panel(document, quantity(text))
    d.window.session.show(document)
    d.complete()
    d.shot("six panels")
    parts(d.window).choices.set(RANGE, "shared")
    d.shot("shared range")
    parts(d.window).choices.set(RANGE, "own")
    while len(d.window.session.document.panels) > 3:
        d.window.session.undo()
    d.complete()


def _waiting(d: Driver) -> None:
    """A mesh that takes a while, with edges that have to be repaired."""
    from app.document.quantities import quantity
    from tests.bench.meshes import bumpy_sphere
    from tests.qt.broken import with_fins

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "a large mesh.off")
        with_fins(*bumpy_sphere(100_000), count=2500, path=path)
        d.window.context.open(str(path))
        d.until(lambda: bool(d.window.session.progress) and d.window.session.loaded() is not None)
        d.spin(0.5)
        d.shot("waiting for a large mesh")
        d.complete()
        d.point_at_surface(2)
        d.shot("a hundred thousand vertices")
        first = d.window.session.document.panels[0].id
        parts(d.window).choices.choose(first, quantity("truncated(k=300)"))
        d.spin(0.6)
        d.shot("computing")
        d.window.context.actions["stop"].trigger()
        d.spin(0.5)
        d.shot("stopped")
        d.window.status.notes.click()
        d.shot("notes")
        d.close_dialogs()
        d.window.session.undo()
        d.complete()


def _dialogs(d: Driver) -> None:
    from app.qt.files.export_dialog import ExportDialog
    from app.qt.pages.messages import WhichFile, tell

    d.window.context.actions["figure"].trigger()
    (dialog,) = (each for each in d.application.topLevelWidgets() if isinstance(each, ExportDialog))
    d.until(lambda: dialog.pane.is_true)
    d.shot("export figure")
    dialog.size.rows.button(1).click()
    dialog.kinds.choose("EPS")
    d.until(lambda: dialog.pane.is_true)
    d.shot("export one column")
    dialog.size.rows.button(5).click()
    dialog.size.width_box.setText("wide")
    dialog.choose_path()
    d.shot("a width that is none")
    d.close_dialogs()
    d.window.context.actions["movie"].trigger()
    d.shot("export movie")
    d.close_dialogs()
    d.window.context.actions["page"].trigger()
    d.shot("export web page")
    d.close_dialogs()
    parts(d.window).choices.ask_preferences()
    d.shot("preferences")
    d.close_dialogs()
    tell(d.window, "The mesh hand.off cannot be read: face 12 has the corner 99, and there are 50 vertices.")
    d.shot("message")
    d.close_dialogs()
    WhichFile(["/home/a/meshes/one.off", "/home/a/meshes/two.ply", "/home/b/session.json"], d.window).open()
    d.shot("which file")
    d.close_dialogs()
    d.window.notice.show_text("The session was saved without the arrays of two panels.", "warning")
    d.shot("notice")
    d.window.notice.clear()


def _help(d: Driver) -> None:
    d.pointer("key", "F1")
    d.shot("commands")
    d.tool("type", "difference")
    d.shot("commands with a word")
    d.close_dialogs()


def _talk(d: Driver) -> None:
    parts(d.window).choices.toggle_full_screen()
    d.spin(0.6)
    d.shot("full screen")
    parts(d.window).choices.toggle_full_screen()
    d.spin(0.6)
    d.shot("after the full screen")


if __name__ == "__main__":
    main()
