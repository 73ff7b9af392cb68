"""Corresponding points of two surfaces, and maps between them."""

from ...document.tools import Tool

TOOL = Tool(
    __name__,
    "pairs",
    title="Pairs",
    text="Correspondence",
    key="M",
    tip="Pairs of points on two meshes, and where the next is predicted",
    icon="pairs",
    synonyms="match map landmarks shape second",
    gesture="gestures:PairGestures",
    dock="dock:PairsDock",
    commands={"correspond": "command", "evaluate": "evaluate_command"},
    quantities=("quantity:Prediction", "maps:MapColours"),
    questions=("answers",),
    parts=("pairs:Pairs", "maps:Maps"),
    options="options:ROWS",
    marks="marks:marks",
    items="pairs:items",
    charts={"errors": "map_errors:charts"},
)
