"""The inside of surfaces: a clip plane."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "inside",
    title="See inside",
    text="See insi&de",
    key="T",
    tip="Cut surfaces by a plane, to see what they hide",
    icon="inside",
    menu="View",
    synonyms="clip clipping plane cut section slice half open interior cross",
    dock="dock:InsideDock",
)
