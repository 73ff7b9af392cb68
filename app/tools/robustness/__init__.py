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
    synonyms="compare noise holes decimate simplify perturb remesh difference",
    gesture="gestures:CutGestures",
    needs_faces=True,
    dock="dock:RobustnessDock",
    commands={"perturb": "command"},
    quantities=("quantity:DistanceChange",),
    questions=("answers",),
    options="options:ROWS",
    add_panel="perturbed_documents:add_row",
)
