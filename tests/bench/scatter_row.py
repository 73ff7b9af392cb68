"""Row 18: the scatter of two fields of a large surface, drawn anew, with a selection in it."""

from collections.abc import Iterator

import numpy as np

from bihdist_core import Surface, field_scatter

from .child import in_window_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line
from .timing import alternate
from .window_rows import application, has_display

SCATTER_BOUND = 0.5
SIDES = 1200, 400


def scatter(size: Size) -> Iterator[Line]:
    if not has_display():
        yield Line(18, "scatter drawn", bound=SCATTER_BOUND, note="skipped: there is no display")
        return
    ours, peer, ratio, error, points = in_window_child(size, _scatter, size)
    yield Line(
        18,
        f"scatter drawn, {points:,} points",
        ours,
        peer,
        ratio,
        bound=SCATTER_BOUND,
        error=error,
        tolerance=0.0,
        note="a selection of half of them in it; peer: numpy.histogram2d of as many cells; error: of the counts",
    )


def _scatter(size: Size) -> tuple[float, float, float, float, int]:
    """Seconds of a picture, of the peer, their ratio; by how much a count differs at most; points."""
    qt = application()
    from app.drawing.chart import Axis
    from app.tools.scatter.chart import ScatterChart

    vertices, faces = bumpy_sphere(size.scatter)
    fields = (np.linalg.norm(vertices - vertices[k], axis=1) for k in (0, 5))
    found = field_scatter(Surface(vertices, faces), *fields, normalised=True)
    chart = ScatterChart()
    chart.resize(*SIDES)
    chart.show()
    chart.show_scatter(found, (("one", "#000000"), ("other", "#000000")), (Axis(), Axis()), True)
    chart.show_selections([(found.ids[::2], 0)])
    qt.processEvents()

    def draw() -> None:
        chart.redraw()
        chart.repaint()

    columns, rows = (round(side) for side in (chart.plot.width(), chart.plot.height()))

    def peer() -> np.ndarray:
        return np.histogram2d(found.y, found.x, (rows, columns), ((0, 1), (0, 1)))[0]

    result = alternate(draw, peer, size.rounds, size.repeat)
    error = float(np.abs(found.density(columns, rows, (0, 1), (0, 1)) - peer()).max())
    chart.close()
    return result.our_time, result.peer_time, result.ratio, error, len(found.ids)
