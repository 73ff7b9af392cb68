"""The inside of surfaces: a clip plane, and translucency."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "inside",
    title="See inside",
    text="See insi&de",
    key="T",
    tip="Cut surfaces by a plane, or let them be translucent, to see what they hide",
    icon="inside",
    menu="View",
    synonyms="opacity transparent translucent x-ray glass alpha clip clipping plane cut section slice half interior",
    dock="dock:InsideDock",
)
