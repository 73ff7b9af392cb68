"""The fields that panels show, saved as values at vertices."""

from collections.abc import Sequence
from functools import partial

from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields

from ...document.beside_edits import letter_of
from ...document.document import Panel
from ...document.field_names import field_names
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ..context import Context
from .writing import Writing


class FieldFiles:
    """Asks where fields go, and lets them be written in the background, as `bihdist field` writes them."""

    def __init__(self, context: Context) -> None:
        self._context = context

    def save(self, id: int, path: str = "") -> None:
        """The field of a panel by its id; path: asks for one if it is empty."""
        panel = self._context.document.panel(id)
        fields = self._fields([panel])
        if fields:
            (name,) = fields
            self._write("Save the field", panel, f"field-{name}", fields, path, "")
        else:
            self._context.fail(self._why_not(panel))

    def save_all(self, path: str = "") -> None:
        """Those of all panels, of each mesh into a file of its own."""
        document = self._context.document
        for mesh in document.surfaces:
            panels = document.panels_of(mesh.name)
            fields = self._fields(panels)
            if fields:
                left_out = [panel for panel in panels if not self._has_field(panel)]
                remark = "".join(f"; {self._why_not(panel)}" for panel in left_out)
                self._write("Save all fields", panels[0], "fields", fields, path, remark)
            elif panels:
                self._context.fail(" ".join(self._why_not(panel) for panel in panels))

    def _write(self, title: str, panel: Panel, name: str, fields: dict[str, AnyArray], path: str, remark: str) -> None:
        session = self._context.session
        surface, letter = session.surface_in(panel.id), letter_of(session.document, panel)
        write = partial(write_fields, surface=surface, fields=fields)
        title = f"{title} of {letter}: {surface.name}" if letter else title
        name = file_name([surface.name], *letter, name)
        self._context[Writing].save(title, name, FIELD_FORMATS, write, path, remark)

    def _fields(self, panels: Sequence[Panel]) -> dict[str, FloatArray]:
        """(n,) each, of the panels that have one, by name."""
        session = self._context.session
        there = [panel for panel in panels if self._has_field(panel)]
        names = field_names(session.document, there)
        answers = {name: session.shown[panel.id].answer for name, panel in zip(names, there, strict=True)}
        return {name: answer.field for name, answer in answers.items() if answer.field is not None}

    def _has_field(self, panel: Panel) -> bool:
        """Whether it shows one that answers what it is asked: nothing of before, and no stand-in."""
        session = self._context.session
        return session.is_answered(panel.id) and session.shown[panel.id].answer.field is not None

    def _why_not(self, panel: Panel) -> str:
        session, name = self._context.session, quantity_name(panel.shows)
        if not session.is_answered(panel.id):
            return f"{name} has no field yet."
        answer = session.shown[panel.id].answer
        return f"{name} is shown in colours, and has no field." if answer.colours is not None else answer.failure
