"""What is to be seen of the circle."""

import numpy as np
from bihdist.drawing.glyphs import PATH, PIN
from bihdist.marks.marked_panel import MarkedPanel
from bihdist.marks.primitives import LineMark, PointMark, SurfaceMark

from .measures import measured, vertex_in


def marks(marked: MarkedPanel) -> list[SurfaceMark]:
    vertex = vertex_in(marked.document, marked.panel)
    if vertex is None or marked.answer.field is None:
        return []
    circle = measured(marked.loaded.surface, marked.answer.field, vertex)
    lines = [
        LineMark(
            curve.edges[:, [0, 1, 1]],
            np.stack([1 - curve.parameters, curve.parameters, 0 * curve.parameters], axis=1),
            curve.closed,
            PATH,
        )
        for curve in circle.curves
    ]
    return [*lines, PointMark(vertex, PIN, number=1, text=f"{circle.length:.3g}, {circle.area:.3g}")]
