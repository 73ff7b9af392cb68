"""The README and the guide: short, found from each other, of one version; their routes lead to functions."""

import importlib
import re

import pytest

from app.version import version
from tests.programs import ROOT

GUIDE = ROOT / "assets/guide"
PAGES = sorted(GUIDE.rglob("*.md"))
README = ROOT / "README.md"
PARTS = ("start", "how-to", "gallery", "explanation", "reference", "questions")
MADE = re.compile(r"/gallery/auto/|/reference/((api|commands)/[\w-]+|keys|records)\.md$|/search\.html$")
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
    assert len(README.read_text(encoding="utf-8").split()) <= 550


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


# ---------------------------------------------------------------------- version
PLACES = {
    "CITATION.cff": r"^version: (.+)$",
    ".ci/conda/recipe.yaml": r'^  version: "(.+)"$',
    "CHANGELOG.md": r"^## \[(\d[^\]]*)\]",
}
"""Where it is repeated: the first match."""


@pytest.mark.parametrize("name", PLACES)
def test_what_repeats_the_version_says_the_same(name):
    said = re.search(PLACES[name], (ROOT / name).read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert said, name
    assert said[1] == version()


# ---------------------------------------------------------------------- routes
STEP = re.compile(r"^\d+\. `([\w/]+)\.py`: (.*)$")


def routes() -> list[list[tuple[str, list[str]]]]:
    """Each list as its steps: the module, and the names in it."""
    found: list[list[tuple[str, list[str]]]] = []
    for line in (ROOT / "assets/guide/development/routes.md").read_text(encoding="utf-8").splitlines():
        if step := STEP.match(line):
            if line.startswith("1. "):
                found.append([])
            found[-1].append((step[1].replace("/", "."), re.findall(r"`(\w+(?:\.\w+)?)`", step[2])))
    return found


def test_there_is_a_way_down_a_way_up_a_figure_a_page_a_data_set_and_an_export():
    assert [len(route) for route in routes()] == [12, 7, 11, 6, 7, 7]


@pytest.mark.parametrize("route", routes())
def test_every_step_exists_and_no_module_comes_twice(route):
    modules = [module for module, _ in route]
    assert len(set(modules)) == len(modules)
    for module, names in route:
        if module.startswith("app.qt"):
            pytest.importorskip("qtpy")
        assert names
        for name in names:
            owner = importlib.import_module(module)
            for part in name.split("."):
                assert hasattr(owner, part), f"{module} has no {name}"
                owner = getattr(owner, part)
