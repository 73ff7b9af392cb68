"""The README is short, and it and the pages of the guide find each other and their own headings."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "assets/guide").glob("*.md"))
README = ROOT / "README.md"


def text_of(page):
    """The page without blocks of code, in which `#` begins a comment."""
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def headings(page):
    """Each heading below the title as its level and words."""
    return [(len(marks), words) for marks, words in re.findall(r"^(##+) (.+)$", text_of(page), flags=re.MULTILINE)]


def anchor(words):
    return re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")


def test_the_readme_is_short():
    assert len(README.read_text(encoding="utf-8").split()) <= 900


def test_the_readme_lists_every_page():
    linked = set(re.findall(r"\]\((assets/guide/[\w-]+\.md)\)", README.read_text(encoding="utf-8")))
    assert PAGES
    assert linked == {page.relative_to(ROOT).as_posix() for page in PAGES}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_begins_with_its_table_of_contents(page):
    contents = "\n".join(f"{'  ' * (level - 2)}- [{words}](#{anchor(words)})" for level, words in headings(page))
    assert f"\n\n{contents}\n\n## " in page.read_text(encoding="utf-8")


@pytest.mark.parametrize("page", [README, *PAGES], ids=lambda page: page.stem)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\((?!https?:)([^)]+)\)", text_of(page)):
        path, _, place = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), target
        if place:
            assert place in [anchor(words) for _, words in headings(file)], target
