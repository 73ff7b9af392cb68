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
    needs_faces=True,
    dock="dock:RegionsDock",
    commands={"samples": "samples_command", "regions": "command"},
    findings="findings:RegionFindings",
    panel_edits="part:PANEL_EDITS",
    parts=("part:DividedPanels",),
    options="options:ROWS",
    marks="marks:marks",
    items="part:items",
)
