"""Where the distances of a panel start: what clicks, drags and arrow keys mean where no other tool is on."""

from ...document.tools import Tool

TOOL = Tool(__name__, "source", gesture="gestures:SourceGestures", actions="actions:ACTIONS")
