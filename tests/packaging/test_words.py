"""What users read has one name for one thing, and the pages of the guide are in plain English and short paragraphs."""

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


IN_PAGES = {
    r"\b(is|are|was|were|be) said\b": "reported, shown",
    r"\bbesides?\b": "next to, with, in addition to",
    r"\bstands?\b(?![ -](alone|for|in|out)\b)": "is, appears",
    r"\bgo(es)? on\b": "continue, resume",
    r"\bone's own\b": "your own",
    r"\banew\b": "again",
    r"\bin words\b": "as text",
    r"\bmend(s|ed|ing)?\b": "fix, correct",
    r"\bthat of\b": "the noun again, or a possessive",
    r"\bsome \d": "about",
    r"\bgrown together\b": "joined, merged",
    r"\bwhat (the user|nobody|has no)\b": "a noun: user errors, unexpected errors, buttons that do not fit",
    r"\bin vain\b": "wasted",
}
"""What the pages of the guide do not say, and what they say instead."""

LONGEST_PARAGRAPH = 80
"""Words; what is longer is a list, a table or two paragraphs."""

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "assets/guide").rglob("*.md"))]


@cache
def paragraphs() -> tuple[tuple[str, str], ...]:
    """All paragraphs, items of lists and rows of tables, each with its page, without blocks of code and formulas."""
    found = []
    for page in PAGES:
        text = re.sub(r"^ *(```+|\$\$).*?\1$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
        pieces = re.split(r"\n\s*\n|\n(?=\s*(?:[-:#] |\d+\. |\||:::))", text)
        found += [(page.relative_to(ROOT).as_posix(), " ".join(piece.split())) for piece in pieces]
    return tuple(found)


@pytest.mark.parametrize("wrong", IN_PAGES)
def test_pages_are_in_plain_english(wrong):
    assert [each for each in paragraphs() if re.search(wrong, each[1], re.IGNORECASE)] == [], IN_PAGES[wrong]


def test_paragraphs_of_pages_are_short():
    assert len(paragraphs()) > 1000
    too_long = [(page, text) for page, text in paragraphs() if len(text.split()) > LONGEST_PARAGRAPH]
    assert [(page, text) for page, text in too_long if not text.startswith("|")] == []
