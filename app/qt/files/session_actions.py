"""Sessions: saving and opening them, what is asked on closing, and after a crash.

A session is a recipe of what the window shows, so that `bihdist figure --recipe` draws it.
"""

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, ParameterError

from ...document.beside_edits import MOST_SHOWN
from ...document.docks import DockPlaces
from ...document.document import Document, MeshFile, content
from ...document.file import checksum, read_recipe, with_paths
from ...document.file_names import file_name
from ...document.page import Page, Recipe
from ...document.work import work_in
from ...samples import mesh_path
from ...scene.style import style_of
from ...session.array_store import ArrayStore
from ...session.recipe_file import recipe_written
from ...version import version
from .. import remembered
from ..context import Context
from .curve_files import CurveFiles
from .saving import MESH_FILES, MESH_PATTERNS, ask_path

FILES = (
    f"Meshes, sessions and recipes ({MESH_PATTERNS} *.json);;"
    f"Meshes ({MESH_PATTERNS});;Sessions and recipes (*.json);;All files (*)"
)
KEEP_MS = 2000
"""What the window shows is kept so long after a change, in case of a crash."""

IN_NO_FILE = Recipe(Document())
"""As what a recovered session was saved: nothing of it was."""


class SessionFile(QtCore.QObject):
    """The file that a window's session is saved in, if any, and whether it is as it was saved.

    dock_places: says where the open docks are.
    """

    docks_placed = QtCore.Signal(object)  # where docks are to be, a `DockPlaces` or None

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.dock_places: Callable[[], DockPlaces | None] = lambda: None
        self.path: str | None = None
        self._saved: Recipe | None = None
        self._given = work_in(Document())  # what came from the command line or from Python
        self._keep_soon = QtCore.QTimer(self, singleShot=True, interval=KEEP_MS, timeout=self.keep)
        context[CurveFiles].saved.connect(self.show_title)

    # ------------------------------------------------------------------ saving
    def recipe(self) -> Recipe:
        """What the window shows, on the page of the recipe that was opened last."""
        context, document = self._context, self._context.document
        if context.is_built:
            document = replace(document, dock_places=self.dock_places())
        return Recipe(document, context.page)

    @property
    def is_changed(self) -> bool:
        """Whether closing would lose something: a change since the session was saved or opened, or unsaved work.

        The camera does not count, nor do the places of docks.
        """
        if self._saved is None:
            return bool(self._unsaved_work)
        context = self._context
        seen, saved = (
            replace(document, camera="home", beside=content(document).beside, dock_places=None)
            for document in (context.document, self._saved.document)
        )
        return (seen, context.page) != (saved, self._saved.page)

    @property
    def _unsaved_work(self) -> list[str]:
        """What is in no file, by what it is called: of a session that was never saved."""
        kept = {**self._given}
        kept["drawn sources"] |= self._context[CurveFiles].paths.keys()
        return [word for word, work in work_in(self._context.document).items() if work - kept[word]]

    def take_as_given(self) -> None:
        """What is shown comes from somewhere, and can be had from there again."""
        self._given = work_in(self._context.document)
        self.show_title()

    def _belongs_to(self, path: str | None, saved: Recipe) -> None:
        """The session is that of a file, None for none yet, in which it was saved so."""
        self.path, self._saved = path, saved
        self.show_title()

    def show_title(self) -> None:
        """The session's file, if any, the meshes once they are seen, and whether closing would lose something."""
        self._context.widget.setWindowModified(self.is_changed)
        if self._context.is_built:
            self._context.grid.once_painted(self._write_title)

    def _write_title(self) -> None:
        session = self._context.session
        loaded = [session.loaded(mesh.name) for mesh in session.document.surfaces]
        meshes = ", ".join(dict.fromkeys(each.surface.name for each in loaded if each is not None))
        parts = [part for part in (os.path.basename(self.path or ""), meshes, "Biharmonic distance") if part]
        # Doubled, Qt's word for the sign of change is a part of the name.
        first, *others = (part.replace("[*]", "[*][*]") for part in parts)
        self._context.widget.setWindowTitle(" - ".join([f"{first}[*]", *others]))

    def save(self, path: str | None = None) -> None:
        """Into a file, the one it was saved in or opened from if none is given; OutputError if that cannot be."""
        path = path or self.path
        assert path is not None
        if self._context.session.surface is None:
            raise ParameterError("There is nothing to save before a mesh is open.")
        recipe = self.recipe()
        self._write(recipe, path)
        self._belongs_to(path, recipe)
        self._remember(path)
        if self._context.remembers:
            self.keep()
        self._context.tell(f"Saved {os.path.basename(path)}")

    def _write(self, recipe: Recipe, path: str | os.PathLike[str], stays: bool = False) -> None:
        with recipe_written(recipe, self._context.session.given, path, version(), stays):
            pass

    def choose_and_save(self) -> bool:
        """Ask for a file; whether it was saved."""
        surface = self._context.session.surface
        name = file_name([] if surface is None else [surface.name], "session")
        path = ask_path(self._context, "Save the session", name, (".json",))
        return bool(path) and self.save_or_say(path)

    def save_or_say(self, path: str | None = None) -> bool:
        """Save, or tell the user why not; whether it was saved."""
        if path is None and self.path is None:
            return self.choose_and_save()
        try:
            self.save(path)
        except BihdistError as error:
            self._context.fail(error)
            return False
        return True

    def may_close(self, ask: Callable[[str], str]) -> bool:
        """Whether the window may close: where it would lose something, `ask(question)` says "save", "discard" or
        "cancel"."""
        if not self.is_changed:
            return True
        answer = ask(self._question)
        return answer == "discard" or (answer == "save" and self.save_or_say())

    @property
    def _question(self) -> str:
        if self.path is not None:
            return f"The session {os.path.basename(self.path)} has unsaved changes."
        if self._saved is not None:
            return "What was recovered has not been saved."
        *others, last = self._unsaved_work
        return f"The {' and '.join([', '.join(others), last] if others else [last])} have not been saved."

    # ------------------------------------------------------------------ opening
    def open(self, path: str) -> None:
        """Show a session or recipe; a sentence where that cannot be, and a way to point at a mesh that is gone.

        From then on it is the session's file, to be saved in again.
        """

        def arrived() -> None:
            self._belongs_to(path, self.recipe())
            self._remember(path)

        self._show(path, arrived)

    def recover(self, lost: Path) -> None:
        """Show what was kept of a window that did not end as it should: unsaved, under the name that it had."""

        def arrived() -> None:
            self._belongs_to(remembered.session_of(lost), IN_NO_FILE)
            if self.keep():  # before what holds it now is gone
                remembered.remove_state(lost)

        self._show(str(lost), arrived)

    def _show(self, path: str, arrived: Callable[[], None]) -> None:
        try:
            recipe = read_recipe(path)
            count = len(recipe.document.surfaces)
            if count > MOST_SHOWN:
                raise ParameterError(f"The window shows up to {MOST_SHOWN} meshes, and {path} has {count}.")
            style_of(recipe.page.style, recipe.document.colours)
            self._context.session.given.update(ArrayStore.read(recipe))
            found = self._with_meshes(recipe)
        except Exception as error:  # files from anybody may hold what nobody foresaw
            self._context.fail(error)
            return
        if found is not None:
            # Nothing changes before the mesh is there: it may not open.
            self.show_document(found.document, found.page, arrived)

    def show_document(
        self, document: Document, page: Page | None = None, arrived: Callable[[], None] = lambda: None
    ) -> None:
        """Show a document from elsewhere, also before there are panels.

        page: in whose style, the present one's if None; arrived: called when it is there.
        """
        context = self._context

        def arriving() -> None:
            if page is not None:
                context.take_page(page)

        def restoring() -> None:
            context.once_built(lambda: self.docks_placed.emit(document.dock_places))
            self.take_as_given()
            arrived()

        context.session.show_instead(document, arriving, restoring)

    def _with_meshes(self, recipe: Recipe) -> Recipe | None:
        """The recipe of meshes that are there: those it names, or those the user points at; None if neither."""
        found: list[MeshFile] = []
        known: dict[tuple[str, str], MeshFile] = {}  # what stands for a file, which several are made from
        for mesh in recipe.document.surfaces:
            there = known.get((mesh.path, mesh.sha256)) or self._there(replace(mesh, change=None))
            if there is None:
                return None
            known[mesh.path, mesh.sha256] = there
            change = mesh.change
            if change is not None and change.pose:
                pose = self._there(MeshFile("", change.pose, change.pose_sha256))
                if pose is None:
                    return None
                change = replace(change, pose=pose.path, pose_sha256=pose.sha256)
            found.append(replace(mesh, path=there.path, sha256=there.sha256, change=change))
        return replace(recipe, document=replace(recipe.document, surfaces=tuple(found)))

    def _there(self, mesh: MeshFile) -> MeshFile | None:
        if not mesh.path:
            return mesh
        known = mesh_path(mesh.path)
        if not os.path.exists(known):
            message, path = f"The mesh {mesh.path[:200]} is not there.", ""
        elif mesh.sha256 and checksum(known) != mesh.sha256:
            message, path = f"The mesh {mesh.path} is not what it was when this was written.", mesh.path
        else:
            return mesh
        chosen = _mesh_instead(self._context, message, path)
        return replace(mesh, path=chosen, sha256="") if chosen else None

    def _remember(self, path: str) -> None:
        if self._context.remembers:
            remembered.remember(path)

    # ------------------------------------------------------------------ crashes
    def document_changed(self) -> None:
        """Keep it, soon; a window that a script looks at leaves nothing behind."""
        self.show_title()
        if self._context.remembers:
            self._keep_soon.start()

    def keep(self) -> bool:
        """Keep what is shown now, in case of a crash, if that would lose something; whether it is kept."""
        session = self._context.session
        if session.surface is None:
            return False
        if not self.is_changed and (self._saved is not None or not session.can_undo):
            remembered.forget_state()  # it can be opened again from where it came
            return False
        recipe = self.recipe()
        meshes = tuple(with_paths(mesh, _absolute) for mesh in recipe.document.surfaces)
        recipe = replace(recipe, document=replace(recipe.document, surfaces=meshes))
        return remembered.keep_state(lambda path: self._write(recipe, path, stays=True), self.path)

    def forget(self) -> None:
        """The window closes as it should."""
        self._keep_soon.stop()
        remembered.forget_state()


def _mesh_instead(context: Context, message: str, path: str) -> str:
    """Ask for the mesh of a session whose own is gone, or has changed and is still at `path`; empty if none."""
    context.refused.emit(message)
    if context.quiet:
        return path
    box = QtWidgets.QMessageBox(
        QtWidgets.QMessageBox.Icon.Warning, "Biharmonic distance", message, parent=context.widget
    )
    choose = box.addButton("Choose the mesh…", QtWidgets.QMessageBox.ButtonRole.ActionRole)
    as_it_is = box.addButton("Show it as it is", QtWidgets.QMessageBox.ButtonRole.AcceptRole) if path else None
    box.addButton(QtWidgets.QMessageBox.StandardButton.Cancel)
    box.exec()
    if as_it_is is not None and box.clickedButton() is as_it_is:
        return path
    if box.clickedButton() is choose:
        return str(QtWidgets.QFileDialog.getOpenFileName(context.widget, "The mesh of this session", "", MESH_FILES)[0])
    return ""


def _absolute(path: str) -> str:
    return os.path.abspath(path) if path and os.path.exists(path) else path


def offer_lost_state(context: Context) -> None:
    """After a crash: ask whether what was shown then should be shown again; of several windows, one at each start."""
    lost = remembered.lost_states()
    if not lost:
        return
    box = QtWidgets.QMessageBox(
        QtWidgets.QMessageBox.Icon.Question,
        "Biharmonic distance",
        "The program did not end as it should the last time. Show what was shown then?",
        QtWidgets.QMessageBox.StandardButton.Yes | QtWidgets.QMessageBox.StandardButton.No,
        context.widget,
    )

    def answered(button: object) -> None:
        if box.standardButton(button) == QtWidgets.QMessageBox.StandardButton.Yes:
            context[SessionFile].recover(lost[0])
        else:
            remembered.remove_state(lost[0])

    box.buttonClicked.connect(answered)
    box.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
    box.open()
