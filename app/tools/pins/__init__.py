"""Points with a number, measured."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "pins",
    title="Pins",
    text="&Pins",
    key="P",
    tip="Numbered points, their values in every panel, and the distances among them",
    icon="pin",
    synonyms="measure ruler distance between points markers landmarks matrix table",
    dock="dock:PinsDock",
    gesture="gestures:PinGestures",
    parts=("..document.shared_parts.pins:Pins", "part:PinsListing"),
    options="options:ROWS",
    marks="marks:marks",
    items="part:items",
)
