"""Isolines of panels, saved as coordinates."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.isoline_tracing import ISOLINE_FORMATS, isolines, write_isolines
from bihdist_core.arrays import FloatArray
from bihdist_core.errors import ParameterError

from ...document.file_names import field_names, file_name
from ...drawing.numbers import percent
from ..context import Context
from .writing import Writing


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
