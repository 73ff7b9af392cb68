"""How good a distance is, and the triangles it is computed on."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "quality",
    title="Quality",
    text="&Quality",
    key="Q",
    tip="Extrema, isotropy, kinks and triangles of every panel's distance",
    icon="quality",
    synonyms="measure check triangles extrema isotropy",
    dock="dock:QualityDock",
    findings="findings:QualityFindings",
    marks="marks:marks",
)
