"""What the guide's search knows: keywords, the title, the headings and the text of each built page, and synonyms."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

from app.document.synonyms import COLOUR_MAPS, OPTION_ALIASES, OPTION_HINTS

BLOCKS = {"br", "p", "li", "td", "th", "dt", "dd", "pre", "h1", "h2", "h3", "h4", "div", "label", "section", "tr"}
KEYWORDS = re.compile(r'<meta content="([^"]*)" name="keywords"')
SYNONYMS = {
    "animation": "movie",
    "bibtex": "cite",
    "cluster": "SLURM",
    "colourmap": "colour map",
    "contour": "isoline",
    "crash": "troubleshooting",
    "cuda": "GPU",
    "disconnected": "components",
    "docker": "container",
    "faq": "questions",
    "headless": "display",
    "jet": "colour map",
    "mac": "macOS",
    "quad": "polygons",
    "rainbow": "colour map",
    "ram": "memory",
    "screenshot": "figure",
    "tetrahedral": "tetrahedra",
    "torch": "PyTorch",
    "video": "movie",
    "website": "page",
}
"""The guide's words for those of other fields; names of other programs' options and colour maps are the program's."""


def write_search_index(pages: Path) -> None:
    """Write `search-index.js`, which pages load as a script, so that the search works without a server."""
    found = []
    for path in sorted(pages.rglob("*.html")):
        name = path.relative_to(pages).as_posix()
        if name != "search.html" and not name.startswith("_"):
            html = path.read_text(encoding="utf-8")
            keywords = " ".join(KEYWORDS.findall(html))
            found.append({"page": name, "keywords": keywords, "sections": sections_of(html)})
    data = {"GUIDE": found, "SYNONYMS": synonyms()}
    lines = [f"window.{name} = {json.dumps(each, ensure_ascii=False)};\n" for name, each in data.items()]
    (pages / "search-index.js").write_text("".join(lines), encoding="utf-8")


def synonyms() -> dict[str, str]:
    """Return the guide's words for those of others; an option's hint may end with a value."""
    options = {word: hint.partition(" ")[0] for word, hint in (OPTION_ALIASES | OPTION_HINTS).items()}
    words = {word: hint for word, hint in options.items() if "-" not in word and len(hint) > 1}
    return words | dict.fromkeys(COLOUR_MAPS, "colour map") | SYNONYMS


def sections_of(html: str) -> list[tuple[str, str, str]]:
    """The sections of a page's article, each as its anchor, its heading and its text; the first is the page's own."""
    reader = _Article()
    reader.feed(html)
    return [(anchor, " ".join(heading.split()), " ".join(text.split())) for anchor, heading, text in reader.sections]


class _Article(HTMLParser):
    """Reads what is inside <article>, without the marks that headings end with."""

    def __init__(self) -> None:
        super().__init__()
        self.sections: list[list[str]] = []
        self._anchors: list[str] = []
        self._tags: list[tuple[str, bool, bool]] = []  # those that are open: are they headings, or left out
        self._is_inside = False

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Begin a section at each heading, and at each option of a command."""
        named = dict(attributes)
        self._is_inside |= tag == "article"
        if tag in BLOCKS:
            self.handle_data(" ")
        if tag in ("img", "br", "input", "hr", "meta", "link", "path", "wbr"):
            return
        classes = (named.get("class") or "").split()
        is_option = tag == "dt" and "std" in classes
        is_heading = tag in ("h1", "h2", "h3") or is_option
        self._tags.append((tag, is_heading, bool({"headerlink", "sphx-glr-footer", "sphx-glr-timing"} & {*classes})))
        if tag == "section":
            self._anchors.append(named.get("id") or "")
        if self._is_inside and is_heading:
            anchor = self._anchors[-1] if tag != "h1" and self._anchors else ""
            self.sections.append([named.get("id") or "" if is_option else anchor, "", ""])

    def handle_endtag(self, tag: str) -> None:
        """Forget the tag, and the section that ends with it."""
        while self._tags and self._tags.pop()[0] != tag:
            pass
        if tag == "section" and self._anchors:
            self._anchors.pop()
        self._is_inside &= tag != "article"

    def handle_data(self, data: str) -> None:
        """To the heading, or to the text under it."""
        if self._is_inside and self.sections and not any(is_left_out for *_, is_left_out in self._tags):
            is_heading = any(is_heading for _, is_heading, _ in self._tags)
            self.sections[-1][1 if is_heading else 2] += data
