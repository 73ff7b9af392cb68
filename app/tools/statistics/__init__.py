"""A field in numbers."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "statistics",
    title="Statistics",
    text="Stat&istics",
    key="H",
    tip="The active panel in numbers: mean, quantiles, histogram, isolines",
    icon="isolines",
    synonyms="measure mean quantiles histogram numbers average",
    needs_faces=True,
    dock="dock:StatisticsDock",
    commands={"statistics": "command"},
    charts={"histogram": "..figures.histogram_figure:charts"},
)
