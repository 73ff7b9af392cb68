"""The list of what is on the surface: sources, pins, selections, borders, anchors, extrema."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "surface",
    title="On the surface",
    text="On the su&rface",
    key="A",
    tip="Everything marked on the surface, to hide or remove",
    icon="eye",
    menu="View",
    synonyms="list layers marks objects hide show visibility delete remove clear selection borders pins anchors",
    dock="dock:SurfaceDock",
    parts=("..document.on_surface:Hidden",),
    options="options:ROWS",
)
