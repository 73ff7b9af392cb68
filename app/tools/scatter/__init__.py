"""One field against another."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "scatter",
    title="Scatter",
    text="S&catter",
    key="S",
    tip="One panel's field against another's over all vertices; select in it",
    icon="scatter",
    synonyms="compare plot correlation difference select lasso",
    dock="dock:ScatterDock",
    parts=(
        "part:Scatter",
        "..document.shared_parts.selections:Selections",
    ),
    options="options:ROWS",
    marks="marks:marks",
    items="part:items",
    charts={"scatter": "figure:charts"},
)
