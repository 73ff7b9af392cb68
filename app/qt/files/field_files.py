"""Panels' fields, saved as values at vertices."""

import os
from collections.abc import Callable, Sequence
from functools import partial

from bihdist_core import Surface
from bihdist_core.arrays import ByteArray, FloatArray
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
from bihdist_core.formats.surface_output import COLOURED_FORMATS, write_coloured

from ...document.document import Panel
from ...document.file_names import field_names, file_name
from ...document.quantities import quantity_name
from ...document.second_mesh_edits import letter_of
from ...scene.style import style_of
from ...session.bar_ends import bar_end
from ..context import Context
from .writing import Writing


def _write_one(path: str, surface: Surface, colours: ByteArray, fields: dict[str, FloatArray]) -> None:
    """Write a field, with colours where the format has them."""
    if os.path.splitext(path)[1].lower() in COLOURED_FORMATS:
        write_coloured(path, surface, colours, fields)
    else:
        write_fields(path, surface, fields)


class FieldFiles:
    """Asks where to save fields, and writes them in the background, as `bihdist field` does."""

    def __init__(self, context: Context) -> None:
        self._context = context

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
