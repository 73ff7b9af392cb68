"""The program's own tools, a folder each; what a row of this table does not name is not part of the program."""

TOOLS = (
    "source",
    "pins",
    "profile",
    "scatter",
    "statistics",
    "quality",
    "regions",
    "interpolation",
    "correspondence",
    "robustness",
    "inside",
    "surface_list",
)
"""The folders, in the order of their gestures and marks."""
