"""Anchors on surfaces."""

from ...marks.glyphs import RING
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...session.anchors import anchors_on


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Rings with their values, in the order of the document."""
    found = anchors_on(marked.document, marked.panel.surface, marked.loaded)
    return [
        PointMark(vertex, RING, value="" if value is None else f"{value:.4g}".replace("-", "−"))
        for vertex, value in found
    ]
