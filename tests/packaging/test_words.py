"""What users read has one name for one thing: words that stand for another, or are written in another way elsewhere."""

import ast
import re
from functools import cache
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


@cache
def nodes() -> tuple[tuple[str, ast.AST], ...]:
    """All of the code, each with its place; docstrings are left out."""
    found = []
    for folder in ("app", "bihdist_core"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            inside = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
            docstrings = {id(node.value) for node in inside if isinstance(node, ast.Expr)}
            place = str(path.relative_to(ROOT))
            found += [
                (f"{place}:{node.lineno}", node)
                for node in inside
                if isinstance(node, ast.Constant | ast.JoinedStr) and id(node) not in docstrings
            ]
    return tuple(found)


@pytest.mark.parametrize("wrong", INSTEAD)
def test_one_name_for_one_thing(wrong):
    texts = [(place, node.value) for place, node in nodes() if isinstance(getattr(node, "value", None), str)]
    assert len(texts) > 5000
    assert [(place, text) for place, text in texts if re.search(wrong, text)] == [], INSTEAD[wrong]


COUNTED = re.compile(r"^ (vertices|faces|eigenpairs|triangles|points)\b")
IDS = re.compile(r"\bvertex $|here: 0 to $|\bids run from \d+ to $")


def is_wrong(before: ast.AST, value: ast.AST, after: ast.AST) -> bool:
    """Whether a value in a text is a count without separators or an id with them."""
    if not isinstance(value, ast.FormattedValue):
        return False
    form = "" if value.format_spec is None else ast.unparse(value.format_spec)
    is_id = isinstance(before, ast.Constant) and IDS.search(before.value)
    is_count = isinstance(after, ast.Constant) and COUNTED.match(after.value)
    return bool((is_id and "," in form) or (is_count and not form))


def test_counts_are_written_with_separators_and_ids_without():
    nothing = ast.Constant("")
    wrong = [
        f"{place} {ast.unparse(node)}"
        for place, node in nodes()
        # What is reported of the paper's figures has names of its own.
        if isinstance(node, ast.JoinedStr) and "/experiments/" not in place
        for each in zip([nothing, *node.values], node.values, [*node.values[1:], nothing], strict=False)
        if is_wrong(*each)
    ]
    assert wrong == []


def test_names_are_those_of_the_table():
    """The names in the first column of the words of CONTRIBUTING.md are not those of a module, class or function."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (.+?) \| .+ \|$", text.partition("## Words")[2].partition("\n## ")[0], flags=re.MULTILINE)
    gone = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    assert len(gone) > 15
    named = set()
    for folder in ("app", "bihdist_core"):
        for path in (ROOT / folder).rglob("*.py"):
            named.add(path.stem)
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ClassDef | ast.FunctionDef):
                    named.add(node.name)
    assert gone & named == set()
