"""The pages that explain: all are found from their index, formulas can be shown, and words agree with numbers."""

import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "assets/guide/explanation"
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("*.md"))}
PROSE = {
    name: re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))
    for name, text in PAGES.items()
}


def test_the_index_has_a_card_and_an_entry_for_each_page():
    index = PAGES["index"]
    entries = re.search(r"```{toctree}\n:hidden:\n\n(.*?)\n```", index, re.DOTALL)[1].split()
    assert sorted([*entries, "index"]) == sorted(PAGES)
    assert re.findall(r"^:link: (\S+)$", index, re.MULTILINE) == [entry for entry in entries if entry != "glossary"]


@pytest.mark.parametrize("name", PAGES)
def test_pages_named_are_there(name):
    for other in re.findall(r"{doc}`([\w-]+)`", PAGES[name]):
        assert other in PAGES, other


@pytest.mark.parametrize("name", PAGES)
def test_formulas_can_be_shown_as_mathml(name):
    mathml = pytest.importorskip("docutils.utils.math.latex2mathml")
    for block, inline in re.findall(r"\$\$(.+?)\$\$|\$([^$]+?)\$", PROSE[name], re.DOTALL):
        mathml.tex2mathml((block or inline).strip(), as_block=bool(block))


def test_the_glossary_is_sorted_and_short():
    entries = re.findall(r"^(\S.*)\n((?:  .+\n)+)", PAGES["glossary"].split("```{glossary}\n")[1], re.MULTILINE)
    terms = [term for term, _ in entries]
    assert len(terms) > 40
    assert terms == sorted(terms, key=str.lower)
    for term, meaning in entries:
        assert len(re.findall(r"[.:](?=\s|$)", meaning)) <= 3, term


SAID = {
    "boundaries-and-weights": [
        r"4 subdivisions: 2\.000 \(2\), 5\.99\d \(6\)",
        # A thin tube changes geodesic distances by half of the maximum, biharmonic ones by less than a tenth.
        r"BiharmonicDistance mean +\d\.\d+%, most +\d\.\d+%\nGeodesicDistance +mean +\d\.\d+%, most 5\d\.\d+%\njoined",
    ],
    "graphs": [
        r"binary tree +31 +30 +\de-1\d +– +1\.00.*\nbarbell +23 +94 +\de-1\d +0\.47 +1\.00",
        r"karate club +34 +78 .* 0\.37 .*\n.*\n.* +0\.36 +0\.83 +0\.94",
        r"groups, 2 % between +1\.00 +1\.00 +1\.00 +0\.[0-5]\d +1\.00 +1\.00 +1\.00\n",
        r"groups, 10 % between +0\.[0-6]\d +0\.[89]\d +(1\.00|0\.9\d) +0\.3\d +0\.3\d +0\.3\d +0\.[89]",
        r"binary tree +0 +.* never\n(.*\n)+.*Medici(.*\n)+Southern women .* never, never\n.*Valjean +0\.7[45]",
    ],
    "solver": [r"off by \de-1\d of the maximum\noff by \de-1\d of the maximum", r"less than the set-up: True"],
}
"""What the blocks of these pages print, where the words beside them say so; `test_pages` runs those of all pages."""


@pytest.mark.parametrize("name", SAID)
def test_what_is_computed_is_what_the_words_say(name, tmp_path):
    blocks = pytest.importorskip("assets.guide.building.blocks")
    printed = "".join(outcome.printed for outcome in blocks.run_page(FOLDER / f"{name}.md", tmp_path))
    for pattern in SAID[name]:
        assert re.search(pattern, printed), (pattern, printed)
