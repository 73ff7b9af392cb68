"""Distances before and after a change of the mesh."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "robustness",
    title="Robustness",
    text="Ro&bustness",
    key="E",
    tip="Distances before and after a change to the mesh: noise, holes, fewer vertices, another pose",
    icon="robustness",
    in_bar=True,
    synonyms="compare noise holes decimate perturb remesh difference",
    gesture="gestures:ChangeGestures",
    dock="dock:RobustnessDock",
    commands={"perturb": "command"},
    quantities=("quantity:ChangeOf",),
    options="options:ROWS",
    add_panel="comparison:add_row",
)
