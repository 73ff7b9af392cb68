"""A tool of somebody else: it marks the vertex that is farthest from where a field starts, in a shape of its own."""

from dataclasses import replace

import numpy as np

from app.document.tools import Tool
from app.drawing.glyphs import DIAMOND, Layer, LineLook, Stroke
from app.marks.marked_panel import MarkedPanel
from app.marks.primitives import AreaMark, LineMark, PointMark, Remark, SurfaceMark

MAGENTA, LIME, CYAN = "#FF00FF", "#00FF00", "#00FFFF"
FLAG = replace(DIAMOND, name="flag", layers=(Layer(fill="own"),), reach=1.0)
EDGE = LineLook("edge", (Stroke("white", 6.0), Stroke(LIME, 4.0)))

TOOL = Tool("tests.figures", "farthest", marks="marked_tool:marks")


def marks(marked: MarkedPanel) -> list[SurfaceMark]:
    """The farthest vertex, the edges of the faces at it, and the vertices of these; none where there is no field."""
    if marked.answer.field is None:
        return [Remark("There is nothing that is farthest.")]
    vertex = int(np.nanargmax(marked.answer.field))
    faces = marked.loaded.surface.faces
    near = faces[(faces == vertex).any(axis=1)]
    return [
        PointMark(vertex, FLAG, MAGENTA, "farthest"),
        *(LineMark(np.repeat(face[None], 3, axis=0), np.eye(3), True, EDGE) for face in near),
        AreaMark(np.unique(near), CYAN),
    ]
