"""What users read has one name for one thing: words that stand for another, or are written in another way elsewhere."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

INSTEAD = {
    r" \u2026$": "an ellipsis follows its word without a space: Open\u2026",
    r"(?i)\b(ctrl|shift|alt)-(click|drag)": "keys are joined to gestures by a plus: Shift+click",
    r"\b(Ctrl|Shift|Alt)\+(Click|Drag)": "gestures are written small after keys: Ctrl+click",
    r"(?i)\b(double|right|middle|left)-click": "gestures are words of their own: right click",
    r"(?i)\bshares? of (the|each|its|their|own) *(own )?max": "it is the fraction of the maximum",
    r"(?i)\bshares?:|\bshared:": "ranges are called by what they do: own maximum, one for all, fraction of the maximum",
    r"(?i)\bby chance\b": "it is random",
    r"(?i)\bletters\b": "it is text, or characters",
    r"(?i)\b(a|the|dashed) drops?\b": "it is a pin, or its marker",
    r"(?i)\b(a|the) relief\b": "it is a height field",
    r"Reset$|Reset the view": "the first view is Home",
}
"""What is not said to users, and why."""


def shown(folder: str) -> Iterator[tuple[str, str]]:
    """The texts in a folder's code, without docstrings, each with its place."""
    for path in sorted((ROOT / folder).rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        nodes = list(ast.walk(tree))
        docstrings = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
        for node in nodes:
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
                yield f"{path.relative_to(ROOT)}:{node.lineno}", node.value


@pytest.mark.parametrize("wrong", INSTEAD)
def test_one_name_for_one_thing(wrong):
    texts = [each for folder in ("app", "bihdist_core") for each in shown(folder)]
    assert len(texts) > 5000
    assert [(place, text) for place, text in texts if re.search(wrong, text)] == [], INSTEAD[wrong]
