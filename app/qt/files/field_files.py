"""Fields in files: those of other programs are shown, and those of panels are saved, as are their isolines."""

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.isoline_tracing import ISOLINE_FORMATS, isolines, write_isolines
from bihdist_core.arrays import ByteArray, FloatArray
from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
from bihdist_core.formats.mesh_names import GZIP, holds_points
from bihdist_core.formats.surface_output import COLOURED_FORMATS, write_coloured
from bihdist_core.progress import Progress

from ...document.document import FieldArray, Panel, free_field_name
from ...document.edits import show_field
from ...document.file_names import field_names, file_name
from ...document.quantities import quantity_name
from ...document.second_mesh_edits import letter_of
from ...drawing.numbers import number, percent
from ...scene.style import style_of
from ...session.bar_ends import bar_end
from ..context import Context
from ..pages.messages import Which
from .saving import Writing, ask_file, file_filter

if TYPE_CHECKING:
    from bihdist_core.formats.vertex_arrays import VertexArray


def _write_one(path: str, surface: Surface, colours: ByteArray, fields: dict[str, FloatArray]) -> None:
    """Write a field, with colours where the format has them."""
    if os.path.splitext(path)[1].lower() in COLOURED_FORMATS:
        write_coloured(path, surface, colours, fields)
    else:
        write_fields(path, surface, fields)


def _read(path: str, progress: Progress) -> Iterator[object]:
    """Read the arrays in a file; for the background."""
    from bihdist_core.formats.vertex_arrays import read_vertex_arrays  # with the readers of all formats

    yield read_vertex_arrays(path)


def _about(array: "VertexArray") -> str:
    """Return what an array holds, in words."""
    count = int(np.isfinite(array.values).sum())
    if array.names:
        return f"{counted(int((array.counts > 0).sum()), 'label')} at {counted(count, 'vertex', 'vertices')}"
    if not count:
        return "no values"
    return f"{number(float(np.nanmin(array.values)))} to {number(float(np.nanmax(array.values)))}"


class FieldFiles:
    """Reads fields of files, and writes those of panels in the background, as `bihdist field` does."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._reading = context.background("field", _read, self._take, lambda path, sentence: context.fail(sentence))

    # ------------------------------------------------------------------ reading
    def choose(self) -> None:
        """Ask for a file with values at vertices, and show them."""
        from bihdist_core.formats.vertex_arrays import ARRAY_FORMATS

        ask_file(self._context, "Add field", file_filter("Fields", (*ARRAY_FORMATS, GZIP, "lh.*", "rh.*")), self.add)

    def add(self, path: str) -> None:
        """Show an array of a file, which the user chooses if there are several; or tell why that is not possible.

        An array (n, 3) without a mesh that has n vertices is opened as points.
        """
        if self._context.session.loaded() is None and holds_points(path):
            self._context.open(path)
        elif self._context.session.loaded() is None:
            self._context.fail(f"{os.path.basename(path)} has values at vertices; open its mesh first.")
        else:
            self._reading.ask(path)

    def _take(self, path: str, arrays: "list[VertexArray]") -> None:
        session, active = self._context.session, self._context.grid.active
        if session.loaded() is None:
            return
        first = [panel.surface for panel in session.document.panels if panel.id == active]
        names = dict.fromkeys([*first, *(mesh.name for mesh in session.document.surfaces)])
        counts = {name: len(session.mesh(name).surface.vertices) for name in names if session.loaded(name)}
        fitting = [(each, name) for each in arrays for name, n in counts.items() if n == len(each.values)]
        fitting = list({each.name: (each, name) for each, name in reversed(fitting)}.values())[::-1]
        if not fitting and len(arrays) == 3 and holds_points(path):
            self._context.open(path)
            return
        if not fitting:
            values = " or ".join(dict.fromkeys(f"{len(each.values):,}" for each in arrays[:3]))
            there = " and ".join(f"{session.mesh(name).surface.name} has {n:,} vertices" for name, n in counts.items())
            self._context.fail(f"{os.path.basename(path)} has {values} values, and {there}.")
            return
        chosen: int | None = 0
        if len(fitting) > 1:
            question = f"{os.path.basename(path)} has {len(fitting)} arrays. &Which one?"
            rows = [(each.name, about, about) for each, _ in fitting for about in (_about(each),)]
            chosen = Which(question, rows, "an array", "Add", self._context.widget).ask()
        if chosen is None:
            return
        array, surface = fitting[chosen]
        name = array.name if len(arrays) > 1 else ""
        with self._context.errors_shown():
            from bihdist_core.formats.vertex_arrays import array_name

            wanted = FieldArray(free_field_name(array_name(path, name), []), "", surface, os.path.abspath(path), name)
            added = session.given.add_array(wanted, array)
            session.show(show_field(session.document, added, active))
            self._context.tell(f"Added {added.name} from {os.path.basename(path)}")

    # ------------------------------------------------------------------ writing

    def save(self, id: int, path: str = "") -> None:
        """Save the field of a panel; asks for a path if none is given."""
        panel = self._context.document.panel(id)
        fields = self._fields([panel])
        if fields:
            (name,) = fields
            self._write("Save the field", [panel], f"field-{name}", fields, path, "")
        else:
            self._context.fail(self._why_not(panel))

    def save_all(self, path: str = "") -> None:
        """Save the fields of all panels, a file for each mesh."""
        document = self._context.document
        for mesh in document.surfaces:
            panels = document.panels_of(mesh.name)
            fields = self._fields(panels)
            if fields:
                left_out = [panel for panel in panels if not self._has_field(panel)]
                remark = "".join(f"; {self._why_not(panel)}" for panel in left_out)
                there = [panel for panel in panels if panel not in left_out]
                self._write("Save all fields", there, "fields", fields, path, remark)
            elif panels:
                self._context.fail(" ".join(self._why_not(panel) for panel in panels))

    def _write(
        self, title: str, panels: Sequence[Panel], name: str, fields: dict[str, FloatArray], path: str, remark: str
    ) -> None:
        """Save the fields of panels of one mesh; a single one is saved with the panel's colours."""
        session, panel = self._context.session, panels[0]
        surface, letter = session.mesh(panel.id).surface, letter_of(session.document, panel)
        write: Callable[[str], None] = partial(write_fields, surface=surface, fields=fields)
        formats = FIELD_FORMATS
        if len(panels) == 1:
            (field,) = fields.values()
            write = partial(_write_one, surface=surface, colours=self._colours(panel, field), fields=fields)
            formats = tuple(dict.fromkeys((*FIELD_FORMATS, *COLOURED_FORMATS)))
        title = f"{title} of {letter}: {surface.name}" if letter else title
        name = file_name([surface.name], *letter, name)
        self._context[Writing].save(title, name, formats, write, path, remark)

    def _colours(self, panel: Panel, field: FloatArray) -> ByteArray:
        """Return the colours (n, 3) of a panel's field (n,), which end where its colour bar ends."""
        session = self._context.session
        answer = session.shown[panel.id].answer
        top = bar_end(session.document, session.shown, panel.id, session.loaded) or answer.maximum
        style = style_of(self._context.page.style, session.document.colours)
        return style.vertex_colours(field, top, answer.is_signed)

    def _fields(self, panels: Sequence[Panel]) -> dict[str, FloatArray]:
        """Return the fields (n,) of the panels that have one, by name."""
        session = self._context.session
        there = [panel for panel in panels if self._has_field(panel)]
        names = field_names(session.document, there)
        answers = {name: session.shown[panel.id].answer for name, panel in zip(names, there, strict=True)}
        return {name: answer.field for name, answer in answers.items() if answer.field is not None}

    def _has_field(self, panel: Panel) -> bool:
        """Return whether a panel shows the field it was asked for, neither an old one nor a preview."""
        session = self._context.session
        return session.is_answered(panel.id) and session.shown[panel.id].answer.field is not None

    def _why_not(self, panel: Panel) -> str:
        session, name = self._context.session, quantity_name(panel.shows)
        if not session.is_answered(panel.id):
            return f"{name} has no field yet."
        answer = session.shown[panel.id].answer
        return f"{name} shows colours, and has no field." if answer.colours is not None else answer.failure


@dataclass(frozen=True, eq=False)
class Levels:
    """The isolines of a panel as they are saved.

    Attributes
    ----------
    surface, field
        The surface, and the field (n,) on it.
    name
        The beginning of the file's name.
    label
        The label of the field.
    maximum
        The value that 100 % stands for.
    values
        The values of the isolines.
    """

    surface: Surface
    field: FloatArray
    name: str
    label: str
    maximum: float
    values: FloatArray


def levels_of(context: Context, panel: int) -> Levels | None:
    """Return the isolines of a panel; None where it has no field."""
    shown, loaded = context.session.shown.get(panel), context.session.loaded(panel)
    if shown is None or loaded is None or shown.answer.field is None:
        return None
    answer, field, document = shown.answer, shown.answer.field, context.document
    (name,) = field_names(document, [document.panel(panel)])
    values = np.array(context.grid.panel(panel).view.scene.field_actor.levels.values)
    maximum = 100.0 if percent(answer.unit) else answer.maximum
    return Levels(loaded.surface, field, name, answer.label, maximum, values)


def write_levels(path: str, levels: Levels) -> None:
    """Write the isolines that the panel shows; see `write_isolines`."""
    if not len(levels.values):
        raise ParameterError("This panel shows no isolines; choose some in the Isolines menu first.")
    write_isolines(path, isolines(levels.surface, levels.field, levels.values))


def save_isolines(context: Context, panel: int, path: str = "") -> None:
    """Save the isolines of a panel; asks for a path if none is given."""
    levels = levels_of(context, panel)
    if levels is None:
        context.fail("This panel has no field yet.")
        return
    name = file_name([levels.surface.name], "isolines", levels.name)
    context[Writing].save("Save isolines", name, ISOLINE_FORMATS, partial(write_levels, levels=levels), path)
