"""Somebody else's tool: the geodesic circle around the source through a point, its length and the area inside it."""

from bihdist.document.tools import Tool

TOOL = Tool(
    __name__,
    "circle",
    title="Geodesic circle",
    text="Geodesic ci&rcle",
    key="Alt+C",
    tip="The circle through a point, its length and the area inside it",
    icon="isolines",
    synonyms="radius perimeter area",
    dock="dock:CircleDock",
    gesture="gesture:CircleGesture",
    parts=("part:Circle",),
    options="options:ROWS",
    marks="marks:marks",
)
