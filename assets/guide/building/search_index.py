"""What the guide's search knows: the title, the headings and the text of each built page."""

import json
from html.parser import HTMLParser
from pathlib import Path

LEFT_OUT = {"genindex.html", "search.html"}
BLOCKS = {"br", "p", "li", "td", "th", "dt", "dd", "pre", "h1", "h2", "h3", "h4", "div", "section", "tr"}


def write_search_index(pages: Path) -> None:
    """Write `search-index.js`, which the page of the search loads as a script: so it works without a server."""
    found = []
    for path in sorted(pages.rglob("*.html")):
        name = path.relative_to(pages).as_posix()
        if name not in LEFT_OUT and not name.startswith("_"):
            sections = sections_of(path.read_text(encoding="utf-8"))
            found.append({"page": name, "sections": [list(section) for section in sections]})
    text = json.dumps(found, ensure_ascii=False, separators=(",", ":"))
    (pages / "search-index.js").write_text(f"window.GUIDE = {text};\n", encoding="utf-8")


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
        self._tags: list[tuple[str, bool]] = []  # those that are open, and whether their text is left out
        self._is_inside = False

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Begin a section at each heading."""
        named = dict(attributes)
        self._is_inside |= tag == "article"
        if tag in BLOCKS:
            self.handle_data(" ")
        if tag in ("img", "br", "input", "hr", "meta", "link", "path", "wbr"):
            return
        classes = (named.get("class") or "").split()
        self._tags.append((tag, bool({"headerlink", "sphx-glr-footer", "sphx-glr-timing"} & {*classes})))
        if tag == "section":
            self._anchors.append(named.get("id") or "")
        if self._is_inside and tag in ("h1", "h2", "h3"):
            self.sections.append([self._anchors[-1] if tag != "h1" and self._anchors else "", "", ""])

    def handle_endtag(self, tag: str) -> None:
        """Forget the tag, and the section that ends with it."""
        while self._tags and self._tags.pop()[0] != tag:
            pass
        if tag == "section" and self._anchors:
            self._anchors.pop()
        self._is_inside &= tag != "article"

    def handle_data(self, data: str) -> None:
        """To the heading, or to the text under it."""
        if self._is_inside and self.sections and not any(is_left_out for _, is_left_out in self._tags):
            is_heading = any(tag in ("h1", "h2", "h3") for tag, _ in self._tags)
            self.sections[-1][1 if is_heading else 2] += data
