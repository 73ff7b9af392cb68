"""Farthest points, and the regions of pins."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "regions",
    title="Regions",
    text="Farthest points and re&gions",
    key="N",
    tip="Points spread over the surface, and which part of it is nearest to each pin",
    icon="regions",
    synonyms="sampling voronoi segmentation clusters",
    dock="dock:RegionsDock",
    commands={"samples": "samples_command", "regions": "command"},
    parts=("..document.regions:DividedPanels",),
    options="options:ROWS",
    marks="marks:marks",
)
