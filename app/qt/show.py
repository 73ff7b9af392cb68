"""`bihdist.show`: the window from Python, in a script, in IPython and in notebooks.

The process is left as it was: no hook for exceptions, no frozen garbage collector, no environment variable or locale of
ours, and nothing in the user's list of recent files.
"""

from __future__ import annotations

import atexit
import os
import sys
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy.typing as npt
import qtpy
from qtpy import QtCore

from bihdist_core import BihdistError, ParameterError
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.sources.source import Source, checked_source

from ..document.document import Document, Point
from ..document.edits import move_source
from ..document.quantities import Quantity
from ..document.repairs import with_repairs
from ..document.second_mesh_edits import MOST_SHOWN
from ..scene.style import map_of
from ..session.array_store import Mesh, comparison_of_arrays, with_second_mesh
from ..session.loaded_mesh import checked_path
from ..session.questions import source_at
from .application import application, check_screen, interrupts_noted, run_until
from .files.files import Files
from .look.look import LOOK
from .main_window import MainWindow
from .preferences import load

if TYPE_CHECKING:
    import pyvista
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    from ..scene.panel_plotter import PanelPlotter
    from ..scene.picking import Hit

WAKE_MS = 100
"""How often a notebook's kernel is woken once it has Qt's event loop."""


@dataclass(frozen=True, eq=False)
class Pick:
    """A click on the surface.

    Attributes
    ----------
    panel
        The id of the panel that was clicked.
    vertex
        The nearest corner of the face.
    position
        Where the face was met, (3,), in mesh units; on a height field, on the raised surface.
    face
        The face.
    weights
        The weights (3,) of its corners there.
    values
        What each panel of that surface showed at the vertex when it was clicked, before the source went there, by
        panel; NaN where that is nothing.
    """

    panel: int
    vertex: int
    position: FloatArray
    face: int
    weights: AnyArray
    values: dict[int, float]


@dataclass(frozen=True, eq=False)
class ShownPanel:
    """The content of a panel.

    Attributes
    ----------
    id
        The panel's id.
    quantity, label
        The quantity in words, and its label.
    unit
        The unit of the field.
    field
        The field (n,), NaN where undefined; None where it failed.
    failure
        Why it failed, in words.
    plotter
        The panel as a `pyvista.BasePlotter`. What is put there by `add_mesh`, `add_points`, `add_lines` or `add_arrows`
        turns with the surface and is in pictures of the window, until `remove_actor` takes it away or the panel shows
        another surface; after other changes of it, such as of its points, call `render`. Clicks go through it. Figures
        are made from the document alone, and do not show it.
    """

    id: int
    quantity: str
    label: str
    unit: str
    field: FloatArray | None
    failure: str
    plotter: PanelPlotter
    _drawn: vtkPolyData

    @cached_property
    def mesh(self) -> pyvista.PolyData:
        """The surface as it is drawn, with the field as an array (n,) under the panel's quantity; vertex k is point k.

        A copy: what is written into it changes neither the panel nor the field.
        """
        from ..scene.panel_plotter import mesh_of  # PyVista comes with the first panel

        return mesh_of(self._drawn, {} if self.field is None else {self.quantity: self.field})


class Viewer:
    """A window that `show` has opened; BihdistError for what needs it after it is closed."""

    def __init__(self, window: MainWindow, on_pick: Callable[[Pick], object] | None) -> None:
        self._window: MainWindow | None = window
        self._on_pick = on_pick
        window.context.picked.connect(self._picked)
        window.closed.connect(self._closed)
        _open.add(self)

    # ------------------------------------------------------------------ what is shown
    @property
    def document(self) -> Document:
        """All that is shown, as a value; set, it is shown, as a step that the user can undo.

        BihdistError for one that cannot be shown.
        """
        document: Document = self._session.document
        return document

    @document.setter
    def document(self, document: Document) -> None:
        self._show(document)

    @property
    def source(self) -> Source | None:
        """The source of the first panel's field; None if it starts nowhere.  Setting it moves the source.

        A vertex, or a `SurfacePoint`, `BoundaryLoop`, `Curve` or `SourceSet`; words such as "12+40" do, too.
        VertexError or ParameterError for one that there is not.
        """
        started = self._started
        return None if started is None else source_at(started.at, self._session.loaded(started.surface).surface)

    @source.setter
    def source(self, source: Source | str) -> None:
        started = self._started
        with_source = [panel.id for panel in self.document.panels if panel.shows.points]
        if started is None or not with_source:
            raise BihdistError("No panel shows a field with a source.")
        source = source_at(checked_source(source), self._session.loaded(started.surface).surface)
        self.document = move_source(self.document, with_source[0], source)

    @property
    def _started(self) -> Point | None:
        """The point that the first panel starts from that starts anywhere."""
        document = self.document
        names = (name for panel in document.panels for name in panel.shows.points)
        return next((document.point(name) for name in names), None)

    @property
    def panels(self) -> tuple[ShownPanel, ...]:
        """The contents of the panels; waits until all of it has been computed."""
        self._complete()
        found = []
        for panel in self.document.panels:
            shown, name = self._session.shown.get(panel.id), str(panel.shows)
            if shown is None or shown.is_preview:
                result = name, "", None, "The computation was cancelled."
            else:
                answer = shown.answer
                result = answer.label, answer.unit, answer.field, answer.failure
            view = self._there.grid.panel(panel.id).view
            found.append(ShownPanel(panel.id, name, *result, view.plotter, view.scene.field_actor.mesh))
        return tuple(found)

    def screenshot(self, path: str | os.PathLike[str]) -> Path:
        """The window as a PNG, once everything has been computed; OutputError if it cannot be written."""
        self._complete()
        self._there.context[Files].save_screenshot(os.fspath(path))
        return Path(path)

    def plotter(self) -> Any:
        """A PyVista window with the mesh and all that is shown on it, to go on with there.

        A `pyvistaqt.BackgroundPlotter`; its mesh has each panel's field as an array (n,) under the panel's quantity,
        and the first is drawn.  Waits until all has been computed.
        """
        from .plotter import background_plotter

        first = {panel.id for panel in self.document.panels_of()}
        shown = [panel for panel in self.panels if panel.id in first]
        fields = {panel.quantity: panel.field for panel in shown if panel.field is not None}
        return background_plotter(self._session.mesh().surface, fields)

    def close(self) -> None:
        """Close the window, without questions; nothing happens if it is closed already."""
        if self._window is not None:
            self._window.context.quiet = True
            self._window.close()

    @property
    def is_open(self) -> bool:
        """Whether the window is still there."""
        return self._window is not None

    def __repr__(self) -> str:
        loaded = None if self._window is None else self._session.loaded()
        if loaded is None:
            return "Viewer(closed)" if self._window is None else "Viewer(empty)"
        shown = ", ".join(str(panel.shows) for panel in self.document.panels)
        return f"Viewer({shown}, of {loaded.surface.name})"

    # ------------------------------------------------------------------ how
    @property
    def _there(self) -> MainWindow:
        if self._window is None:
            raise BihdistError("The window is closed.")
        return self._window

    @property
    def _session(self) -> Any:
        return self._there.session

    def _complete(self) -> None:
        """Wait until everything has been computed, or the user stops it."""

        def is_done() -> bool:
            window = self._there
            session = window.session
            is_empty = session.loaded() is None and not session.is_opening
            return not session.progress and (session.is_complete or session.is_stopped or is_empty)

        run_until(is_done)

    def _show(self, document: Document) -> None:
        """Show a document and wait for it; BihdistError with what the user would be told, or if it was stopped."""
        if not isinstance(document, Document) or not 1 <= len(document.surfaces) <= MOST_SHOWN:
            raise ParameterError("The window shows a Document with one mesh or two.")
        map_of(document.colours)
        window = self._there
        refusals: list[str] = []
        shown: list[bool] = []
        was_quiet, window.context.quiet = window.context.quiet, True
        window.refused.connect(refusals.append)
        try:
            window.show_document(document, on_done=lambda: shown.append(True))
            run_until(lambda: bool(shown or refusals) or self._window is None or not window.session.is_opening)
        finally:
            if self._window is not None:
                window.refused.disconnect(refusals.append)
                window.context.quiet = was_quiet
        if self._window is None:
            raise BihdistError("The window was closed.")
        if refusals:
            raise BihdistError(refusals[0])
        if not shown:
            raise BihdistError("Opening was cancelled, or something else was opened meanwhile.")

    def _picked(self, panel: int, hit: Hit) -> None:
        if self._on_pick is None:
            return
        fields = {id: shown.answer.field for id, shown in self._session.shown.items()}
        of_surface = self.document.panels_of(self.document.panel(panel).surface)
        shown = [fields.get(each.id) for each in of_surface]
        values = [float("nan") if field is None else float(field[hit.vertex]) for field in shown]
        ids = [each.id for each in of_surface]
        pick = Pick(panel, hit.vertex, hit.position, hit.face, hit.weights, dict(zip(ids, values, strict=True)))
        # After the click has been dealt with: it may close the window, or show something else.
        QtCore.QTimer.singleShot(0, lambda: self._tell(pick))

    def _tell(self, pick: Pick) -> None:
        try:
            if self._on_pick is not None:
                self._on_pick(pick)
        except (Exception, KeyboardInterrupt):
            # Out of a slot it would end the process.
            traceback.print_exc()

    def _closed(self) -> None:
        window, self._window = self._window, None
        _open.discard(self)
        if window is not None:
            window.deleteLater()


_open: set[Viewer] = set()
"""Windows stay open whether or not anybody keeps what `show` has returned."""


def show(
    mesh: Mesh,
    distances: Sequence[str | Quantity] | None = None,
    fields: Mapping[str, npt.ArrayLike | os.PathLike[str]] | None = None,
    source: Source | str | None = None,
    *,
    areas: str = "voronoi",
    cut: str | os.PathLike[str] = "",
    merge: float | None = None,
    largest_component: bool = False,
    operator: str = "cotan",
    viewup: str = "auto",
    second_mesh: Mesh | None = None,
    on_pick: Callable[[Pick], object] | None = None,
    block: bool | None = None,
) -> Viewer:
    """Open the window.

    Parameters
    ----------
    mesh : str or MeshLike
        A file, the name of a sample, or the mesh itself.
    distances : sequence of str, optional
        The distances, a panel each, such as ``"diffusion(t=1/4)"`` or ``"biharmonic - geodesic"``; by default
        biharmonic, geodesic, or commute-time where there are no faces, and diffusion.
    fields : mapping of str to (n,) array_like or file, optional
        Your own fields by name, NaN where undefined, or files of them: ``"lh.thickness"``, ``"all.npz:curv"``.  Each
        has a panel, coloured from 0 (if it has negative values, from minus its largest absolute value), or is used in
        `distances` like a distance: ``"biharmonic - mine"``.
    source : int, str or Source, optional
        The vertex where distances start, by default the highest, or another source (``"12+40"``).
    areas : {"voronoi", "barycentric"}
        Vertex areas.
    cut : str or path
        File with 1 for each vertex that stays and 0 for each that is cut out; ``{name}`` in it is the mesh's name.
    merge : float, optional
        Merge vertices that are no farther apart, after `cut`.
    largest_component : bool
        Keep only the connected component with most vertices.
    operator : {"cotan", "intrinsic-delaunay", "tufted"}
        The operator, see `Laplacian`.
    viewup : str
        Axis that points up, ``"z"`` or ``"-z"``; ``"auto"`` for what was chosen for the mesh before, or a guess.
    second_mesh : str or MeshLike, optional
        Another mesh, with panels of the same distances from its highest vertex, and a camera of its own.
    on_pick : callable, optional
        Called with a `Pick` for each click on a surface, once the source is there.
    block : bool, optional
        Wait until the window is closed.  By default, scripts wait; IPython, notebooks and Python's own prompt do not.

    Returns
    -------
    Viewer
        The open window.

    Raises
    ------
    ParameterError
        If an argument makes no sense.
    BihdistError
        If something cannot be read or shown, or if there is no display: there `bihdist.widget` shows it in a notebook,
        and `bihdist.figure` draws.

    Examples
    --------
    >>> import bihdist
    >>> viewer = bihdist.show("hand", ["biharmonic", "geodesic"], source=12, block=False)
    >>> viewer
    Viewer(biharmonic, geodesic, of hand.ply)
    >>> viewer.source = 900
    >>> biharmonic, geodesic = viewer.panels
    >>> float(biharmonic.field[900]), biharmonic.label
    (0.0, 'biharmonic, exact')
    >>> viewer.close()
    """
    if on_pick is not None and not callable(on_pick):
        raise ParameterError(f"on_pick must be a function, not {on_pick!r}.")
    document, given = comparison_of_arrays(mesh, distances, {} if fields is None else fields, (source,), areas)
    document = replace(document, up=viewup)
    if second_mesh is not None:
        document = with_second_mesh(document, given, second_mesh)
    document = with_repairs(
        document, cut=os.fspath(cut), merge=merge, largest_component=largest_component, operator=operator
    )
    for each in document.surfaces:
        checked_path(each)
    check_screen()
    shell = _ipython()
    progress_display = block if block is not None else shell is None and not hasattr(sys, "ps1")
    app = application()
    viewer = None
    try:
        with interrupts_noted():
            preferences = load()
            LOOK.choose(preferences.theme)
            window = MainWindow(document, preferences)
            window.context.remembers = False
            window.setAttribute(QtCore.Qt.WidgetAttribute.WA_QuitOnClose, False)
            viewer = Viewer(window, on_pick)
            window.session.given.update(given)
            window.show()
            # It is painted before the imports, which take a moment.
            app.processEvents()
            window.build_panels()
            if shell is not None and not progress_display:
                _share_event_loop(shell)
            viewer._show(document)
    except BaseException:
        if viewer is not None:
            viewer.close()
        raise
    if progress_display:
        try:
            run_until(lambda: not viewer.is_open)
        except KeyboardInterrupt:
            viewer.close()
            raise
    return viewer


def _ipython() -> Any:
    """The IPython that runs this, or None."""
    module = sys.modules.get("IPython")
    return None if module is None else module.get_ipython()


def _share_event_loop(shell: Any) -> None:
    """Let Qt work while IPython waits for input; BihdistError if another toolkit does."""
    active = getattr(shell, "active_eventloop", None)
    if active is None:
        shell.enable_gui("qt5" if qtpy.QT5 else "qt6")
    elif not str(active).startswith("qt"):
        raise BihdistError(f"IPython runs the event loop of {active} already; use block=True, or a session without it.")
    kernel_application = getattr(getattr(shell, "kernel", None), "app", None)
    if kernel_application is not None and not _wakers:
        # A notebook's kernel now and then misses, in Qt's loop, that it has been sent something, and would wait for
        # ever; left and entered again, it looks.  The loop stays when the windows are closed, so this does, too.
        _wakers.append(QtCore.QTimer(kernel_application, interval=WAKE_MS))
        _wakers[0].timeout.connect(kernel_application.qt_event_loop.quit)
        _wakers[0].start()


_wakers: list[QtCore.QTimer] = []


@atexit.register
def _close_all() -> None:
    """Before the interpreter takes Qt and VTK apart."""
    for viewer in tuple(_open):
        viewer.close()
