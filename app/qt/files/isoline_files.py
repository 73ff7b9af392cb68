"""The isolines that a panel shows, saved as coordinates."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.isoline_output import ISOLINE_FORMATS, write_isolines
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.arrays import FloatArray
from bihdist_core.errors import ParameterError

from ...document.field_names import field_names
from ...document.file_names import file_name
from ..context import Context
from ..look.numbers import percent
from .writing import Writing


@dataclass(frozen=True, eq=False)
class Levels:
    """What can be saved of a panel: its surface, its field (n,), and the isolines' values.

    name: for files; maximum: what 100 % are.
    """

    surface: Surface
    field: FloatArray
    name: str
    label: str
    maximum: float
    values: FloatArray


def levels_of(context: Context, panel: int) -> Levels | None:
    """Those of a panel by its id; None where it has no field."""
    shown, loaded = context.session.shown.get(panel), context.session.loaded_in(panel)
    if shown is None or loaded is None or shown.answer.field is None:
        return None
    answer, field, document = shown.answer, shown.answer.field, context.document
    (name,) = field_names(document, [document.panel(panel)])
    values = np.array(context.grid.panel(panel).view.scene.isolines)
    maximum = 100.0 if percent(answer.unit) else answer.maximum
    return Levels(loaded.surface, field, name, answer.label, maximum, values)


def write_levels(path: str, levels: Levels) -> None:
    """The isolines that the panel shows; see `write_isolines`."""
    if not len(levels.values):
        raise ParameterError("This panel shows no isolines; choose some in the menu Isolines first.")
    write_isolines(path, isolines(levels.surface, levels.field, levels.values))


def save_isolines(context: Context, panel: int, path: str = "") -> None:
    """Those of a panel by its id; path: asks for one if it is empty."""
    levels = levels_of(context, panel)
    if levels is None:
        context.fail("This panel has no field yet.")
        return
    name = file_name([levels.surface.name], "isolines", levels.name)
    context[Writing].save("Save isolines", name, ISOLINE_FORMATS, partial(write_levels, levels=levels), path)
