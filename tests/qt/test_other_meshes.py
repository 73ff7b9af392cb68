"""Coming to another mesh: what is asked about, what is kept, and which file the session then has."""

from dataclasses import replace

import pytest

from app.document.document import comparison
from app.document.edits import move_source
from app.document.file import read_recipe, recipe_text
from app.document.page import Page, Recipe
from app.document.shared_parts.pins import Pins, add_pins
from app.qt import remembered
from app.samples import sample_title
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

BIHARMONIC = [Spec.of("biharmonic")]


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def other(mesh_file, tmp_path):
    """Another mesh, and a session of it in the style "lines"."""
    path = mesh_file(grid(4, 4), "other.off")
    recipe = Recipe(comparison(path, tuple(BIHARMONIC), (3,)), Page(style="lines"))
    (tmp_path / "other.json").write_text(recipe_text(recipe, "9"))
    return path


def drop(s, path):
    from qtpy import QtCore, QtGui

    urls = QtCore.QMimeData()
    urls.setUrls([QtCore.QUrl.fromLocalFile(str(path))])
    buttons, keys = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.KeyboardModifier.NoModifier
    at, action = QtCore.QPointF(5, 5), QtCore.Qt.DropAction.CopyAction
    parts(s.window).files.eventFilter(s.window, QtGui.QDropEvent(at, action, urls, buttons, keys))


def choose_recent(s, path):
    remembered.remember(path)
    s.window.menus.recent.aboutToShow.emit()
    s.window.menus.recent.actions()[0].trigger()


def choose_sample(s, path):
    actions = s.window.menus.samples.actions()
    next(action for action in actions if action.text() == sample_title("figure")).trigger()


def recover(s, path):
    remembered.folder().mkdir(parents=True, exist_ok=True)
    lost = remembered.folder() / "open-999999.json"
    lost.write_text(recipe_text(Recipe(comparison(path, tuple(BIHARMONIC), (3,))), "9"))
    parts(s.window).session_file.recover(lost)


WAYS = {
    "open": lambda s, path: parts(s.window).files.open(path),
    "drop": drop,
    "recent file": choose_recent,
    "sample": choose_sample,
    "session": lambda s, path: parts(s.window).files.open(path.replace(".off", ".json")),
    "script": lambda s, path: s.window.show_document(comparison(path, tuple(BIHARMONIC), (3,))),
    "recovery": recover,
}

UNSAVED = {
    "source": (False, lambda document: move_source(document, 0, 9), None),
    "pins": (False, lambda document: add_pins(document, [7, 8]), "The pins of mesh.off have not been saved."),
    "saved pins": (True, None, None),
    "saved session": (
        True,
        lambda document: move_source(document, 0, 9),
        "The session s.json of mesh.off has unsaved changes.",
    ),
}


@pytest.mark.parametrize("unsaved", UNSAVED)
@pytest.mark.parametrize("way", WAYS)
def test_nothing_of_the_first_mesh_is_lost(shared_screen, tmp_path, monkeypatch, other, way, unsaved):
    s, session_file, asked, names = shared_screen(bumpy(120), BIHARMONIC), None, [], []
    monkeypatch.setattr("app.qt.files.session_actions.ask_path", lambda *words: names.append(words[2]) or "")
    session_file, history = parts(s.window).session_file, s.session.history
    is_saved, edit, sentence = UNSAVED[unsaved]
    saved = tmp_path / "s.json"
    if is_saved:
        s.session.show(add_pins(s.document, [7, 8]))
        session_file.save(str(saved))
    if edit is not None:
        s.session.show(edit(s.document))
    first, written = s.document, saved.read_bytes() if is_saved else b""

    def question():
        asked.clear()
        session_file.may_close(lambda text: asked.append(text) or "cancel")
        return asked

    def is_at(mesh):
        return s.session.is_complete and not s.session.is_opening and s.session.mesh().surface.name == mesh

    shown = "figure.ply" if way == "sample" else "other.off"
    WAYS[way](s, other)
    s.until(lambda: is_at(shown))
    own = {"session": str(tmp_path / "other.json")}.get(way)
    for _ in range(2):
        # The first mesh's session is left alone, and what is unsaved of it is asked about.
        assert session_file.path == own
        assert not s.document[Pins].pins
        assert s.window.context.page.style == ("lines" if way == "session" else "paper")
        if own is None:
            assert not session_file.save_or_say()
            assert names.pop().startswith(shown[:-4])
        assert (saved.read_bytes() if is_saved else b"") == written
        s.until(lambda: shown in s.window.windowTitle() and "s.json" not in s.window.windowTitle())
        recovered = ["The recovered session is not saved."] if way == "recovery" else []
        assert question() == (["\n".join([*recovered, sentence])] if sentence else recovered)
        # Undo comes back to it, with its file.
        s.session.undo()
        s.until(lambda: is_at("mesh.off"))
        assert replace(s.document, camera="home") == replace(first, camera="home")
        assert session_file.path == (str(saved) if is_saved else None)
        assert s.window.context.page.style == "paper"
        assert session_file.is_changed == (sentence is not None)
        assert question() == ([sentence.replace(" of mesh.off", "")] if sentence else [])
        assert history is s.session.history
        s.session.redo()
        s.until(lambda: is_at(shown))


def test_what_a_second_mesh_had_is_asked_about_once_another_takes_its_place(shared_screen, mesh_file, other):
    s, asked = shared_screen(bumpy(120), BIHARMONIC), []
    s.session.open_second_mesh(mesh_file(bumpy(100), "second.off"))
    s.until(lambda: s.session.is_complete and len(s.document.surfaces) == 2)
    s.session.show(add_pins(add_pins(s.document, [7]), [8], "B"))
    s.session.open_second_mesh(other)
    s.until(lambda: s.session.is_complete and s.document.surfaces[1].path == other)
    file = parts(s.window).session_file
    assert not file.may_close(lambda text: asked.append(text) or "cancel")
    lost = "The pins of mesh.off and second.off have not been saved."
    assert asked.pop() == f"The pins have not been saved.\n{lost}"
    s.session.close_second_mesh()
    assert not file.may_close(lambda text: asked.append(text) or "cancel")
    assert asked.pop() == f"The pins have not been saved.\n{lost}"
    s.session.undo()
    s.session.undo()
    assert not file.may_close(lambda text: asked.append(text) or "cancel")
    assert asked == ["The pins have not been saved."]


def test_all_that_is_unsaved_can_be_saved_on_closing(screen, mesh_file, tmp_path, monkeypatch, other):
    s, names = screen(BIHARMONIC), iter(["bunny.json", "beast.json", ""])
    monkeypatch.setattr(
        "app.qt.files.session_actions.ask_path", lambda *_: (name := next(names)) and str(tmp_path / name)
    )
    s.open(mesh_file(bumpy(120)), 5)
    s.session.show(add_pins(s.document, [7]))
    s.open(other)
    s.session.show(add_pins(s.document, [2]))
    s.open(mesh_file(grid(3, 3), "third.off"))
    s.session.show(add_pins(s.document, [1]))
    file = parts(s.window).session_file
    # The third is shown and asked about first: it goes to bunny.json, the second to beast.json, then there is no name.
    assert not file.may_close(lambda text: "save")
    shown = [read_recipe(tmp_path / name).document.surfaces[0].path for name in ("bunny.json", "beast.json")]
    assert [path.rpartition("/")[2] for path in shown] == ["third.off", "other.off"]
    asked = []
    assert file.may_close(lambda text: asked.append(text) or "discard")
    assert asked == ["The pins of mesh.off have not been saved."]


def test_a_file_that_another_window_has_written_is_not_overwritten(shared_screen, tmp_path, monkeypatch):
    s, titles = shared_screen(bumpy(120), BIHARMONIC), []
    monkeypatch.setattr("app.qt.files.session_actions.ask_path", lambda *words: titles.append(words[1]) or "")
    file, path = parts(s.window).session_file, tmp_path / "s.json"
    file.save(str(path))
    assert file.save_or_say()
    path.write_text("{}")
    assert not file.save_or_say()
    assert path.read_text() == "{}"
    assert titles == ["s.json has been changed by another window or program"]
    path.unlink()
    assert file.save_or_say()


def test_opening_the_session_that_is_shown_leaves_nothing_unsaved(shared_screen, tmp_path):
    s, path = shared_screen(bumpy(120), BIHARMONIC), str(tmp_path / "s.json")
    file = parts(s.window).session_file
    file.save(path)
    s.session.show(move_source(s.document, 0, 9))
    file.save(path)
    parts(s.window).files.open(path)
    s.until(lambda: s.session.is_complete)
    asked = []
    assert file.may_close(lambda text: asked.append(text) or "cancel")
    assert not asked


def test_the_window_says_what_only_undo_still_has(shared_screen, other):
    s = shared_screen(bumpy(120), BIHARMONIC)
    s.window.context.quiet = False
    notice = s.window.notice
    s.session.show(move_source(s.document, 0, 9))
    s.open(other)
    assert notice.isHidden()
    s.session.undo()
    s.session.show(add_pins(s.document, [7]))
    s.open(other)
    assert (notice.isVisible(), notice.words.text()) == (True, "The pins of mesh.off have not been saved.")
    notice.button.click()
    s.until(lambda: s.session.mesh().surface.name == "mesh.off")
    assert s.document[Pins].pins
    s.open(other)
    assert notice.isVisible()
    s.session.show(move_source(s.document, 0, 2))
    assert notice.isHidden()
    s.window.context.quiet = True


def with_pins_in_undo(screen, mesh_file, other):
    """A window in which only undo still has pins, and its session's file."""
    s = screen(BIHARMONIC)
    s.window.context.remembers = True
    s.open(mesh_file(bumpy(120)), 5)
    s.session.show(add_pins(s.document, [7]))
    s.open(other)
    return s, parts(s.window).session_file


def test_what_only_undo_still_has_is_offered_after_a_crash(screen, mesh_file, other):

    s, file = with_pins_in_undo(screen, mesh_file, other)
    for mesh, step in (("other.off", s.session.undo), ("mesh.off", s.session.redo), ("other.off", lambda: None)):
        s.until(lambda mesh=mesh: s.session.mesh().surface.name == mesh)
        assert file.keep() == (mesh == "mesh.off")
        assert read_recipe(remembered.own_state()).document[Pins].pins
        step()
    s.session.show(add_pins(move_source(s.document, 0, 2), [3]))
    assert file.keep()
    assert read_recipe(remembered.own_state()).document.surfaces[0].path == other
    file.forget()
    assert list(remembered.folder().glob("open-*")) == []


def test_what_could_not_be_kept_for_a_crash_is_tried_again(screen, mesh_file, other, monkeypatch):
    from app.qt.files.session_actions import SessionFile
    from bihdist_core import OutputError

    def write(*_, **__):
        raise OutputError("The disk is full.")

    _, file = with_pins_in_undo(screen, mesh_file, other)
    with monkeypatch.context() as full:
        full.setattr(SessionFile, "_write", write)
        file.keep()
    file.keep()
    assert read_recipe(remembered.own_state()).document[Pins].pins
    file.forget()
    assert list(remembered.folder().glob("open-*")) == []


def test_what_a_script_changes_is_no_reason_to_forget_what_was_made_by_hand(shared_screen):
    s, asked = shared_screen(bumpy(120), BIHARMONIC), []
    s.session.show(add_pins(s.document, [7]))
    s.window.show_document(add_pins(move_source(s.document, 0, 9), [8]))
    assert not parts(s.window).session_file.may_close(lambda text: asked.append(text) or "cancel")
    assert asked == ["The pins have not been saved."]


def test_a_mesh_that_is_closed_leaves_the_first_page_and_comes_back_by_undo(screen, mesh_file, tmp_path, other):
    s, asked = screen(), []
    context, file = s.window.context, parts(s.window).session_file
    context.remembers = True
    s.open(mesh_file(bumpy(120)), 5)
    for word in ("statistics", "pins", "quality", "profile", "regions", "scatter", "anchors"):
        parts(s.window).docks.toggle(word)
    s.session.show(add_pins(s.document, [7]))
    file.save(str(tmp_path / "s.json"))
    s.session.show(add_pins(s.document, [8]))
    s.until(lambda: s.session.is_complete)
    s.settle()
    before, pictures = s.document, s.pictures()

    def is_closed():
        return s.window.show_start().isVisible() and s.window.windowTitle() == "Biharmonic distance[*]"

    for _ in range(2):
        context.actions["close mesh"].trigger()
        s.settle()
        assert is_closed()
        assert (s.session.loaded(), s.document.surfaces, s.document.panels, file.path) == (None, (), (), None)
        assert s.window.status.counts.text == "No mesh"
        assert parts(s.window).typed_source.box.text() == ""
        enabled = [word for word in ("save", "figure", "close mesh", "add panel") if context.actions[word].isEnabled()]
        assert enabled == []
        assert context.actions["undo"].isEnabled()
        file.keep()
        assert remembered.own_state().exists()
        assert not file.may_close(lambda text: asked.append(text) or "cancel")
        assert asked.pop() == "The session s.json of mesh.off has unsaved changes."
        s.session.undo()
        s.until(lambda: s.session.is_complete)
        s.settle()
        assert replace(s.document, camera="home") == replace(before, camera="home")
        assert file.path == str(tmp_path / "s.json")
        assert context.actions["figure"].isEnabled()
        assert all((a == b).all() for a, b in zip(s.pictures(), pictures, strict=True))
    s.session.redo()
    s.settle()
    assert is_closed()
    # From the first page on as from the start.
    s.open(other)
    assert [str(panel.shows) for panel in s.document.panels] == ["biharmonic", "geodesic", "diffusion"]
    assert (file.path, s.document[Pins].pins) == (None, ())
    assert not s.refusals
