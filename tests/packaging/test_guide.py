"""The README is short, and it and the pages of the guide find each other and their own headings."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "assets/guide"
PAGES = sorted(GUIDE.rglob("*.md"))
README = ROOT / "README.md"
PARTS = ("start", "how-to", "gallery", "explanation", "reference")
MADE = re.compile(r"/gallery/auto/|/reference/(api/[\w-]+|options|keys|records)\.md$|/search\.html$")
"""Pages that only the build makes, and tests/guide/test_made_pages.py."""


def text_of(page):
    """The page without blocks of code, in which `#` begins a comment."""
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def headings(page):
    """Each heading as its words."""
    return re.findall(r"^#+ (.+)$", text_of(page), flags=re.MULTILINE)


def anchor(words):
    return re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")


def test_the_readme_is_short():
    assert len(README.read_text(encoding="utf-8").split()) <= 900


def test_the_readme_links_to_every_part_and_so_does_the_first_page():
    readme, first = README.read_text(encoding="utf-8"), (GUIDE / "index.md").read_text(encoding="utf-8")
    for part in PARTS:
        assert f"](assets/guide/{part}" in readme, part
        assert re.search(rf"^{part}/(auto/)?index$", first, flags=re.MULTILINE), part


def test_every_page_has_one_title():
    assert PAGES
    assert {page.name for page in PAGES if len(re.findall(r"^# ", text_of(page), flags=re.MULTILINE)) != 1} == set()


@pytest.mark.parametrize("page", [README, *PAGES], ids=lambda page: page.relative_to(ROOT).with_suffix("").as_posix())
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\((?!https?:)([^)]+)\)", text_of(page)):
        path, _, place = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if MADE.search(file.as_posix()):
            continue
        assert file.exists(), target
        if place:
            assert place in map(anchor, headings(file)), target
