"""The profile of a document: its fields along the path as a figure, and by their names for files."""

from collections.abc import Mapping

import numpy as np

from bihdist_core.analysis.surface_paths import SurfacePath
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ...document.document import Document
from ...document.page import Page
from ...document.shared_parts.pins import Pins
from ...figures.chart_page import ChartLook
from ...scene.style import PINS, Style, curve_colours, style_of
from .curves import profile_curve
from .figure import ProfileFigure, ProfileKnot
from .part import Profile, points_along


def profile_figure(document: Document, page: Page, path: SurfacePath, answers: Mapping[int, Answer]) -> ProfileFigure:
    """What the chart shows, in the style of the page and the colours that go with its ground.

    answers: those that there are of panels on the path's surface, by the panels' ids.
    """
    style = style_of(page.style, document.colours)
    fields = {id: answer.field for id, answer in answers.items() if answer.field is not None}
    along = {panel.id: path.along(fields[panel.id]) for panel in document.panels if panel.id in fields}
    curves = tuple(
        profile_curve(document, id, answers[id], values, curve_colours(style))
        for id, values in along.items()
        if np.isfinite(values).any()
    )
    names = points_along(document)
    names = (*names, *names[:1])  # a whole section may come back to the first
    knots = [_knot(document, name, float(path.arcs[at]), style) for at, name in zip(path.knots, names, strict=False)]
    return ProfileFigure(
        path.arcs, curves, document[Profile].shares, "mesh units", tuple(knots), ChartLook.of(page, style)
    )


def profile_fields(document: Document, answers: Mapping[int, Answer]) -> dict[str, FloatArray]:
    """The fields (n,) of the panels that have one, by names that differ."""
    found: dict[str, FloatArray] = {}
    for panel in document.panels:
        answer = answers.get(panel.id)
        if answer is None or answer.field is None:
            continue
        base = str(panel.shows)
        if (point := (*panel.shows.points, "source")[0]) != "source":
            base = f"{base} from {point}"
        name, count = base, 1
        while name in found:
            count += 1
            name = f"{base} {count}"
        found[name] = answer.field
    return found


def _knot(document: Document, name: str, arc: float, style: Style) -> ProfileKnot:
    """A pin by its number; what is neither pin nor source has no disc."""
    for number, pin in enumerate(document[Pins].pins, 1):
        if pin.point == name:
            return ProfileKnot(arc, str(number), PINS[pin.colour])
    is_source = any(name in panel.shows.points for panel in document.panels)
    colour = "#" + "".join(f"{round(255 * x):02X}" for x in style.source)
    return ProfileKnot(arc, "", colour if is_source else "")
