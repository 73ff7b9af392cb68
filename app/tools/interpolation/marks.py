"""Anchors on surfaces."""

from ...drawing.glyphs import RING
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...session.questions import vertex_at
from .part import Anchor, Anchors
from .quantity import interpolants


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Rings with their values, in the order of the document; in the window interpolants let them be dragged."""
    document, surface = marked.document, marked.loaded.surface
    is_held = not marked.is_for_figure and bool(interpolants(marked.panel.shows))
    anchors = [(anchor, document.point(anchor.point)) for anchor in document[Anchors].anchors]
    return [
        _ring(anchor, vertex_at(point.at, surface), is_held)
        for anchor, point in anchors
        if point.surface == marked.panel.surface
    ]


def _ring(anchor: Anchor, vertex: int, is_held: bool) -> PointMark:
    value = "" if anchor.value is None else f"{anchor.value:.4g}"
    text = f"{float(value):.6g}" if value and is_held and not anchor.left_out else ""
    value, text = (words.replace("-", "−") for words in (value, text))
    return PointMark(vertex, RING, text=text, value=value, point=anchor.point, is_handle=is_held)
