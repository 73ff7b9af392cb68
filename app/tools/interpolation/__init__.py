"""Values at anchors, interpolated."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "anchors",
    title="Anchors",
    text="Interpolation",
    key="I",
    tip="Values at anchors, interpolated by every panel's distance",
    icon="anchor",
    synonyms="interpolate values blend weights",
    gesture="gestures:AnchorGestures",
    dock="dock:AnchorsDock",
    commands={"interpolate": "command"},
    quantities=("quantity:Interpolant",),
    questions=("answers",),
    parts=("part:Anchors",),
    options="options:ROWS",
    marks="marks:marks",
    items="part:items",
)
