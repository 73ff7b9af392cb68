"""Sessions: saving, opening, questions on closing, and recovery after a crash.

A session is a recipe of what the window shows, so that `bihdist figure --recipe` draws it.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import NamedTuple

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.formats.mesh_names import is_there
from bihdist_core.sentences import with_and

from ...document.document import DockPlaces, Document, MeshFile, content
from ...document.file import checksum, read_recipe, with_all_paths
from ...document.file_names import file_name
from ...document.page import Page, Recipe
from ...document.second_mesh_edits import MOST_SHOWN
from ...document.work import Work, meshes_in_words, work_in
from ...samples import mesh_path
from ...scene.style import style_of
from ...session.array_store import ArrayStore
from ...session.recipe_file import recipe_written
from ...version import version
from .. import remembered
from ..context import Context
from ..pages.messages import Question
from .curve_files import CurveFiles
from .saving import MESH_FILES, MESH_PATTERNS, ask_path

FILES = (
    f"Meshes, sessions and recipes ({MESH_PATTERNS} *.json);;"
    f"Meshes ({MESH_PATTERNS});;Sessions and recipes (*.json);;All files (*)"
)
KEEP_MS = 2000
"""Time after a change until unsaved work is kept in case of a crash."""

IN_NO_FILE = Recipe(Document())
"""The saved state of a recovered session, of which nothing is saved."""


@dataclass
class _Origin:
    """The place where the work that began with one opened mesh or file is kept.

    Attributes
    ----------
    given
        The work as it came from elsewhere, where it can be had again.
    path
        The session's file, if it has one.
    sha256
        The checksum of that file as this window read or wrote it.
    saved
        The recipe in that file; None before anything was saved.
    page
        The window's page when another mesh was opened.
    """

    given: Work
    path: str | None = None
    sha256: str = ""
    saved: Recipe | None = None
    page: Page = field(default_factory=Page)


class _Closed(NamedTuple):
    """A document on its page that only undo leads back to.

    Attributes
    ----------
    sentence
        A sentence on what of it is unsaved.
    is_latest
        Whether it is the last document of its origin, so that the session's file is meant for it.
    """

    recipe: Recipe
    origin: _Origin
    sentence: str
    is_latest: bool


class SessionFile(QtCore.QObject):
    """The file that a window's session is saved in, if any, and whether it is as it was saved.

    Opening another mesh begins another session, without a file; undo comes back to the one before and its file.
    `dock_places` returns the places of the open docks.
    """

    docks_placed = QtCore.Signal(object)  # where docks are to be, a `DockPlaces` or None
    left_unsaved = QtCore.Signal(str)  # another mesh was opened: what only undo still has, as a sentence

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.dock_places: Callable[[], DockPlaces | None] = lambda: None
        self._at = 0  # the origin of the document that is shown
        self._origins = {0: _Origin(work_in(Document()))}
        self._keep_soon = QtCore.QTimer(self, singleShot=True, interval=KEEP_MS, timeout=self.keep)
        context[CurveFiles].saved.connect(self.show_title)

    @property
    def path(self) -> str | None:
        """The path of the session's file; None as long as it has none."""
        return self._origins[self._at].path

    def follow_origin(self) -> None:
        """Take the file and the page of the mesh that is shown now."""
        context, at = self._context, self._context.session.history.origin
        if at == self._at:
            return
        left, self._at = self._origins[self._at], at
        left.page = context.page
        if at in self._origins:
            context.take_page(self._origins[at].page)
        else:
            self._origins[at] = _Origin(left.given)
            context.take_page(replace(context.page, views=()))  # which were of the other mesh

    # ------------------------------------------------------------------ saving
    def recipe(self) -> Recipe:
        """Return the recipe of the window, on the page of the one opened last."""
        context, document = self._context, self._context.document
        if context.is_built:
            document = replace(document, dock_places=self.dock_places())
        return Recipe(document, context.page)

    @property
    def is_changed(self) -> bool:
        """Whether closing would lose something: a change since the session was saved or opened, or unsaved work.

        The camera does not count, nor do the places of docks.
        """
        return self._differs(Recipe(self._context.document, self._context.page), self._origins[self._at])

    def _differs(self, shown: Recipe, origin: _Origin) -> bool:
        if origin.saved is None:
            return bool(self._unsaved_work(shown.document, origin.given))
        seen, saved = (
            replace(document, camera="home", second_views=content(document).second_views, dock_places=None)
            for document in (shown.document, origin.saved.document)
        )
        return (seen, shown.page) != (saved, origin.saved.page)

    def _unsaved_work(self, document: Document, *others: Work) -> list[str]:
        """Return the kinds of work in a document that are in no file and not in `others`."""
        kept = {word: frozenset[object]().union(*(each[word] for each in others)) for word in others[0]}
        kept["drawn sources"] |= self._context[CurveFiles].paths.keys()
        return [word for word, work in work_in(document).items() if work - kept[word]]

    @property
    def _closed(self) -> list[_Closed]:
        """List the unsaved documents that only undo leads back to, the last that was left first."""
        found, kept, seen = [], [work_in(self._context.document)], {self._at}
        for document, number in self._context.session.history.closed:
            origin, name = self._origins[number], meshes_in_words(document)
            recipe = Recipe(document, self._context.page if number == self._at else origin.page)
            saved = [] if origin.saved is None else [work_in(origin.saved.document)]
            work = self._unsaved_work(document, origin.given, *saved, *kept)
            is_latest = number not in seen
            if is_latest and origin.path is not None and self._differs(recipe, origin):
                session = os.path.basename(origin.path)
                sentence = f"The session {session} of {name} has unsaved changes."
                found.append(_Closed(recipe, origin, sentence, is_latest))
            elif work:
                sentence = f"The {with_and(work)} of {name} have not been saved."
                found.append(_Closed(recipe, origin, sentence, is_latest))
            kept.append(work_in(document))
            seen.add(number)
        return found

    def mark_reproducible(self, before: Work) -> None:
        """Note that what is shown, except the work before, can be opened again."""
        origin, now = self._origins[self._at], work_in(self._context.document)
        origin.given = {word: origin.given[word] | (work - before[word]) for word, work in now.items()}
        self.show_title()

    def _belongs_to(self, path: str | None, saved: Recipe) -> None:
        """Take a file as the session's, None for none yet, with what is saved in it."""
        _note_saved(self._origins[self._at], path, saved)
        self.show_title()

    def show_title(self) -> None:
        """Write the title: the session's file, the meshes once painted, and whether there are unsaved changes."""
        self._context.widget.setWindowModified(self.is_changed)
        if self._context.session.loaded() is not None and self._context.is_built:
            self._context.grid.once_painted(self._write_title)
        elif self._context.is_built:
            self._write_title()

    def _write_title(self) -> None:
        session = self._context.session
        loaded = [session.loaded(mesh.name) for mesh in session.document.surfaces]
        meshes = ", ".join(dict.fromkeys(each.surface.name for each in loaded if each is not None))
        parts = [part for part in (os.path.basename(self.path or ""), meshes, "Biharmonic distance") if part]
        # Doubled, Qt's word for the sign of change is a part of the name.
        first, *others = (part.replace("[*]", "[*][*]") for part in parts)
        self._context.widget.setWindowTitle(" - ".join([f"{first}[*]", *others]))

    def save(self, path: str | None = None) -> None:
        """Save the session in a file, its own if none is given; OutputError if it cannot be written."""
        path = path or self.path
        assert path is not None
        if self._context.session.loaded() is None:
            raise ParameterError("Open a mesh before saving a session.")
        self._save(self.recipe(), self._origins[self._at], path)
        self.show_title()
        if self._context.remembers:
            self.keep()

    def _save(self, recipe: Recipe, origin: _Origin, path: str) -> None:
        self._write(recipe, path)
        _note_saved(origin, path, recipe)
        self._remember(path)
        self._context.tell(f"Saved {os.path.basename(path)}")

    def _write(self, recipe: Recipe, path: str | os.PathLike[str], stays: bool = False) -> None:
        with recipe_written(recipe, self._context.session.given, path, version(), stays):
            pass

    def choose_and_save(self) -> bool:
        """Ask for a file, and return whether the session was saved."""
        path = self._ask_path(self._context.document, self._origins[self._at])
        return bool(path) and self.save_or_say(path)

    def _ask_path(self, document: Document, origin: _Origin) -> str:
        """Ask for the path of a session; empty if the user cancels."""
        meshes = [mesh.path or mesh.name for mesh in document.surfaces[:1]]
        name, title = file_name(meshes, "session"), "Save the session"
        if origin.path is not None and not _is_as_left(origin):
            file = os.path.basename(origin.path)
            name, title = file.removesuffix(".json"), f"{file} has been changed by another window or program"
        return ask_path(self._context, title, name, (".json",))

    def save_or_say(self, path: str | None = None) -> bool:
        """Save, or tell the user why not, and return whether it was saved.

        A path is asked for where there is none yet, and where the file is no longer as this window left it.
        """
        if path is None and not _is_as_left(self._origins[self._at]):
            return self.choose_and_save()
        return self._is_done(lambda: self.save(path))

    def _save_closed(self, closed: _Closed) -> bool:
        """Save a closed document, or tell the user why not, and return whether it was saved."""
        recipe, origin = closed.recipe, closed.origin
        # The file of an earlier document now belongs to a later one.
        kept_in = origin if closed.is_latest else _Origin(origin.given)
        path = origin.path if closed.is_latest and _is_as_left(origin) else self._ask_path(recipe.document, kept_in)
        if not path or not self._is_done(lambda: self._save(recipe, kept_in, path)):
            return False
        origin.given = {word: origin.given[word] | work for word, work in work_in(recipe.document).items()}
        return True

    def _is_done(self, save: Callable[[], None]) -> bool:
        with self._context.errors_shown():
            save()
            return True
        return False

    def may_close(self, ask: Callable[[str], str]) -> bool:
        """Whether the window may close: where it would lose something, `ask(question)` says "save", "discard" or
        "cancel"."""
        unsaved: list[tuple[str, Callable[[], bool]]] = [
            (closed.sentence, partial(self._save_closed, closed)) for closed in self._closed
        ]
        if self.is_changed:
            unsaved.insert(0, (self._question, self.save_or_say))
        if not unsaved:
            return True
        answer = ask("\n".join(sentence for sentence, _ in unsaved))
        return answer == "discard" or (answer == "save" and all(save() for _, save in unsaved))

    @property
    def _question(self) -> str:
        origin = self._origins[self._at]
        if origin.path is not None:
            return f"The session {os.path.basename(origin.path)} has unsaved changes."
        if origin.saved is not None:
            return "The recovered session is not saved."
        return f"The {with_and(self._unsaved_work(self._context.document, origin.given))} have not been saved."

    # ------------------------------------------------------------------ opening
    def open(self, path: str) -> None:
        """Show a session or recipe; a sentence where that cannot be, and a way to point at a mesh that is gone.

        From then on it is the session's file, to be saved in again.
        """

        def on_done() -> None:
            self._belongs_to(path, self.recipe())
            self._remember(path)

        self._show(path, on_done)

    def recover(self, lost: Path) -> None:
        """Show the work kept of a crashed window, as unsaved changes of its session."""

        def on_done() -> None:
            self._belongs_to(remembered.session_of(lost), IN_NO_FILE)
            if self.keep():  # before what holds it now is gone
                remembered.remove_state(lost)

        self._show(str(lost), on_done)

    def _show(self, path: str, on_done: Callable[[], None]) -> None:
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
            self.show_document(found.document, found.page, on_done)

    def show_document(
        self, document: Document, page: Page | None = None, on_done: Callable[[], None] = lambda: None
    ) -> None:
        """Show a document from elsewhere, also before there are panels.

        It is shown in the style of `page`, by default the present one. `on_done` is called once it is shown.
        """
        context = self._context
        before = work_in(context.document if context.session.loaded() is not None else Document())

        def take_page() -> None:
            self.follow_origin()
            if page is not None:
                context.take_page(page)

        def settle() -> None:
            context.once_built(lambda: self.docks_placed.emit(document.dock_places))
            self.mark_reproducible(before)
            on_done()

        context.session.show_instead(document, take_page, settle, is_opened=page is not None)

    def _with_meshes(self, recipe: Recipe) -> Recipe | None:
        """Return the recipe with meshes that exist, its own or those the user locates; None if neither."""
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
        if not is_there(known):
            message, path = f"The mesh {mesh.path[:200]} was not found.", ""
        elif mesh.sha256 and checksum(known) != mesh.sha256:
            message, path = f"{mesh.path} has changed since the session was saved.", mesh.path
        else:
            return mesh
        chosen = _mesh_instead(self._context, message, path)
        return replace(mesh, path=chosen, sha256="") if chosen else None

    def _remember(self, path: str) -> None:
        if self._context.remembers:
            remembered.remember(path)

    # ------------------------------------------------------------------ crashes
    def document_changed(self, before: Document) -> None:
        """Keep the document soon, unless a script looks at the window: that leaves nothing behind.

        `before` is the document shown before; where that was closed with unsaved work, a message says so.
        """
        self.show_title()
        session = self._context.session
        if before.surfaces != session.document.surfaces and not session.history.can_redo:
            for closed in self._closed[:1]:
                if closed.recipe.document == before:
                    self.left_unsaved.emit(closed.sentence)
        if self._context.remembers:
            self._keep_soon.start()

    def keep(self) -> bool:
        """Keep the newest unsaved work in case of a crash: what is shown, or else what only undo leads back to.

        Returns whether what is shown is kept.
        """
        session, origin, closed = self._context.session, self._origins[self._at], self._closed[:1]
        is_new = origin.saved is None and session.can_undo  # it cannot be opened again as it is
        if session.loaded() is not None and (self.is_changed or (is_new and not closed)):
            return self._keep(self.recipe(), origin)
        if closed:
            self._keep(closed[0].recipe, closed[0].origin if closed[0].is_latest else _Origin(closed[0].origin.given))
        else:
            remembered.forget_state()
        return False

    def _keep(self, recipe: Recipe, origin: _Origin) -> bool:
        recipe = replace(recipe, document=with_all_paths(recipe.document, _absolute))
        return remembered.keep_state(lambda path: self._write(recipe, path, stays=True), origin.path)

    def forget(self) -> None:
        """Drop what was kept in case of a crash, as the window closes."""
        self._keep_soon.stop()
        remembered.forget_state()


def _note_saved(origin: _Origin, path: str | None, saved: Recipe) -> None:
    origin.path, origin.saved, origin.sha256 = path, saved, ""
    with suppress(ParameterError):  # it may be gone
        origin.sha256 = checksum(path) if path else ""


def _is_as_left(origin: _Origin) -> bool:
    """Return whether the session's file, if any, is as this window read or wrote it."""
    if origin.path is None:
        return False
    try:
        return not os.path.exists(origin.path) or checksum(origin.path) == origin.sha256
    except ParameterError:
        return True  # saving says why it cannot be


def _mesh_instead(context: Context, message: str, path: str) -> str:
    """Ask for a mesh in place of one that is gone, or has changed at `path`; empty if none."""
    context.refused.emit(message)
    if context.quiet:
        return path
    role = QtWidgets.QMessageBox.ButtonRole
    anyway = {"Open anyway": role.AcceptRole} if path else {}
    buttons = {"Locate mesh…": role.ActionRole, **anyway, "Cancel": role.RejectRole}
    box = Question(message, buttons, context.widget, "warning")
    box.exec()
    if box.chosen.startswith("Open"):
        return path
    if box.chosen.startswith("Locate"):
        return str(QtWidgets.QFileDialog.getOpenFileName(context.widget, "Locate mesh", "", MESH_FILES)[0])
    return ""


def _absolute(path: str) -> str:
    return os.path.abspath(path) if path and is_there(path) else path


def offer_lost_state(context: Context) -> None:
    """Ask after a crash whether to restore the session; that of another window is offered at the next start."""
    lost = remembered.lost_states()
    if not lost:
        return
    role = QtWidgets.QMessageBox.ButtonRole
    text = f"bihdist closed unexpectedly. Restore the last session?\n\n{_lost_in_words(lost[0])}"
    # Without a reject role Esc does not throw the work away.
    box = Question(text, {"Restore": role.AcceptRole, "Start fresh": role.DestructiveRole}, context.widget, "undo")

    def answered(_: object) -> None:
        if box.chosen == "Restore":
            context[SessionFile].recover(lost[0])
        else:
            remembered.remove_state(lost[0])

    box.buttonClicked.connect(answered)
    box.finished.connect(box.deleteLater)
    box.open()


def _lost_in_words(lost: Path) -> str:
    """Return "cat.json (cat.off), today at 14:02", or with the day."""
    session, name = remembered.session_of(lost), ""
    with suppress(ParameterError):  # recovering it says what is wrong
        name = meshes_in_words(read_recipe(lost).document)
    if session:
        name = f"{os.path.basename(session)} ({name})" if name else os.path.basename(session)
    kept = datetime.fromtimestamp(lost.stat().st_mtime)
    day = "today" if kept.date() == datetime.now().date() else f"{kept.day} {kept:%B %Y}"
    return f"{name}, {day} at {kept:%H:%M}".removeprefix(", ")
