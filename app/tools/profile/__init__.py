"""Fields along a path."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "profile",
    title="Profile",
    text="P&rofile",
    key="F",
    tip="Values along a path: the chart of all panels' fields",
    icon="profile",
    synonyms="measure plot graph along geodesic path curve section",
    needs_faces=True,
    dock="dock:ProfileDock",
    commands={"profile": "command"},
    parts=("part:Profile",),
    options="options:ROWS",
    marks="marks:marks",
    items="part:items",
    charts={"profile": "figure:charts"},
)
