"""The room that marks which stand above their places need around the views of a page."""

import numpy as np

from .description import Figure
from .framing import Framed, shown_surface, shown_surfaces
from .page_layout import PageLayout

EDGE = 1.3
"""Reaches of a glyph from its middle to the outside of its rims."""


def overhang(figure: Figure, layout: PageLayout) -> tuple[float, float]:
    """Return the lengths by which marks at most stand out above the views of a page, and beside them.

    In a movie they may be anywhere.
    """
    above = beside = 0.0
    for panel, top, cell in zip(figure.panels, figure.upper_limits(), layout.cells, strict=True):
        marks = [mark for mark in panel.marks if mark.glyph.rise]
        if not marks:
            continue
        surface = shown_surface(panel, top)
        at = np.array([mark.on(surface.vertices) for mark in marks])
        reach = np.array([mark.glyph.reach_of(layout.mark, layout.label) for mark in marks])
        rise = reach * [mark.glyph.rise for mark in marks]
        shown = shown_surfaces(panel, top)
        for view, box, part, surface in zip(panel.views, cell.views, cell.parts, shown, strict=True):
            x, y = Framed(view, panel, surface, box, part).places(at).T
            is_there = (x >= box.x) & (x <= box.right) & (y >= box.y) & (y <= box.bottom)
            tips = np.full(len(y), box.y) if figure.is_moving else y
            over = box.y - tips + rise + EDGE * reach
            above = max(above, float((over if figure.is_moving else over[is_there]).max(initial=0.0)))
            sides = np.maximum(box.x - x, x - box.right) + EDGE * reach
            beside = max(beside, float(sides[is_there].max(initial=0.0)))
    return above, beside
