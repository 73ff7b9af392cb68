"""The figure of a scatter, in a file of its own or beside the panels of a row."""

from collections.abc import Sequence

from bihdist_core import ParameterError, field_agreement, field_scatter
from bihdist_core.analysis.field_scatter import FieldScatter
from bihdist_core.analysis.field_statistics import Agreement

from ...document.document import Document
from ...document.page import Page
from ...document.runs import ids_of
from ...document.shared_parts.selections import Selections
from ...figures.arrangement import ChartRow
from ...figures.chart_look import ChartLook
from ...figures.scatter_figure import INCHES, ScatterFigure, axes_of
from ...scene.style import PINS, style_of
from .part import Scatter


def scatter_figure(
    document: Document,
    page: Page,
    scatter: FieldScatter,
    found: Agreement | None,
    names: tuple[str, str],
    units: tuple[str, str],
) -> ScatterFigure:
    """Return the figure of two fields with these names and units, in the style of the page."""
    in_shares = document[Scatter].shares
    is_common = in_shares or units[0] == units[1]
    chosen = document[Selections].selections
    return ScatterFigure(
        scatter,
        *axes_of(scatter, names, units, in_shares),
        in_shares=in_shares,
        is_common=is_common,
        selections=tuple((each.name, ids_of(each.runs), PINS[each.colour]) for each in chosen),
        correlation=None if found is None else found.spearman,
        largest=found.largest_at if found is not None and is_common else None,
        look=ChartLook.of(page, style_of(page.style, document.colours), INCHES),
    )


def charts(row: ChartRow) -> Sequence[ScatterFigure]:
    """Return the scatter of the first two panels of a row."""
    pair = row.document.panels[:2]
    if len(pair) < 2 or pair[0].surface != pair[1].surface:
        raise ParameterError("A scatter needs two panels of one mesh in each row, such as biharmonic and geodesic.")
    if not all(panel.id in row.answers for panel in pair):
        return ()
    one, other = (row.answers[panel.id] for panel in pair)
    if one.field is None or other.field is None:
        raise ParameterError(f"A scatter is of values; {(one if one.field is None else other).label} has colours only.")
    surface, shares = row.surfaces[pair[0].surface].surface, row.document[Scatter].shares
    scatter = field_scatter(surface, one.field, other.field, shares)
    found = field_agreement(surface, one.field, other.field, shares)
    return [
        scatter_figure(
            row.document, row.page, scatter, found, (row.label(pair[0]), row.label(pair[1])), (one.unit, other.unit)
        )
    ]
