"""The sources of panels: clicks, drags and arrow keys where no other tool is on."""

from ...document.tools import Tool

TOOL = Tool(__name__, "source", gesture="gestures:SourceGestures", actions="actions:ACTIONS")
