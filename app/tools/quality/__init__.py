"""The quality of distances in numbers, and their extrema."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "quality",
    title="Quality",
    text="&Quality",
    key="Q",
    tip="Extrema, isotropy, kinks and triangles of every panel's distance",
    icon="quality",
    synonyms="measure accuracy error check triangles extrema isotropy",
    needs_faces=True,
    dock="dock:QualityDock",
    findings="findings:QualityFindings",
    marks="marks:marks",
    items="marks:items",
)
