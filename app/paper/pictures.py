"""The panels of an experiment as figures, drawn by the same code as everybody's figures."""

from collections.abc import Iterator

import numpy as np

from bihdist_core.experiments import Mark as ExperimentMark
from bihdist_core.experiments import Panel, Result

from ..figures.draw import Figure, FigurePanel, Mark, Zoom
from ..figures.size import Size

ACROSS = {1: 5, 2: 3}
"""Panels side by side at most, by how many views they have."""

RELIEF = 0.45
"""Height of a height field, as a share of the domain's extent."""

WIDTH = 460
"""Pixels of a panel with one view."""

WORDS = {"minimum": "min", "maximum": "max", "target": "target"}


def figures(result: Result, up: str = "y") -> Iterator[tuple[str, str, Figure]]:
    """(file name without extension, caption, figure) for each row of panels, in order of their first panels.

    up: the axis that is up in all of them.
    """
    rows: dict[str, list[Panel]] = {}
    for panel in result.panels:
        rows.setdefault(panel.row, []).append(panel)
    for row, panels in rows.items():
        shown = [_panel(result, panel, up) for panel in panels]
        views = max(len(panel.views) for panel in shown)
        lines = -(-len(shown) // ACROSS.get(views, 2))
        columns = -(-len(shown) // lines)
        width = columns * (WIDTH if views == 1 else 250 * views)
        name = "-".join(word for word in (result.id, _plain(row)) if word)
        yield name, row, Figure(tuple(shown), columns=columns, size=Size(width=width))


def _panel(result: Result, panel: Panel, up: str) -> FigurePanel:
    surface = result.surfaces[panel.surface]
    relief = panel.style == "height"
    views = tuple(view for view in panel.views if view != "zoom") or ("front",)
    zooms = ()
    if "zoom" in panel.views and panel.zoom_vertex is not None and panel.zoom_radius:
        extent = float(np.ptp(surface.vertices, axis=0).max())
        zooms = (Zoom(panel.zoom_vertex, float(np.clip(extent / (5 * panel.zoom_radius), 1.5, 20))),)
    field, label = panel.field, ""
    if field is not None and panel.exaggerate != 1:
        # Small values are spread out by the colours, so the bar's numbers are those of the power.
        field, label = np.asarray(field) ** panel.exaggerate, f"value to the power {panel.exaggerate:g}"
    return FigurePanel(
        surface,
        field,
        panel.heading,
        label=label,
        isolines=panel.isoline_count,
        views=("relief",) if relief and field is not None else views,
        marks=tuple(_mark(mark, field) for mark in panel.marks),
        zooms=zooms,
        height=RELIEF if relief and field is not None else 0.0,
        failure=panel.failure,
        up=up,
    )


def _mark(mark: ExperimentMark, field: np.ndarray | None) -> Mark:
    """Extrema in the colour of their value, so that they are not taken for sources."""
    coloured = field is not None and mark.kind in ("minimum", "maximum")
    return Mark(mark.vertex, float(field[mark.vertex]) if coloured else None, WORDS.get(mark.kind, ""))


def _plain(text: str) -> str:
    return "".join(c if c.isalnum() else "-" for c in text.lower()).strip("-")
