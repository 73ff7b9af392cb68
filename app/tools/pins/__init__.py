"""Points with a number, measured."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "pins",
    title="Pins",
    text="&Pins",
    key="P",
    tip="Points with a number, what every panel has there, and how far apart they are",
    icon="pin",
    in_bar=True,
    synonyms="measure distance between points markers landmarks matrix table",
    dock="dock:PinsDock",
    gesture="gestures:PinGestures",
    parts=("..document.shared_parts.pins:Pins", "part:PinsListing"),
    options="options:ROWS",
    marks="marks:marks",
)
