"""Whether built pages stand by themselves: links lead somewhere, and nothing is fetched from a network."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

FETCHED = {
    ("script", "src"),
    ("link", "href"),
    ("img", "src"),
    ("iframe", "src"),
    ("source", "src"),
    ("object", "data"),
}


def wrong_links(pages: Path) -> list[str]:
    """A sentence for each link of a page that leads nowhere, and each file that a browser would fetch elsewhere."""
    read = {path: _read(path) for path in sorted(pages.rglob("*.html"))}
    wrong = []
    for path, page in read.items():
        for tag, attribute, value in page.links:
            told = f"{path.relative_to(pages)}: <{tag} {attribute}={value!r}>"
            parts = urlsplit(value)
            if parts.scheme == "data" or (parts.scheme in ("http", "https", "mailto") and tag == "a"):
                continue
            if parts.scheme or parts.netloc:
                wrong.append(f"{told} is fetched from elsewhere")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                wrong.append(f"{told} leads to no file")
            elif parts.fragment and target in read and unquote(parts.fragment) not in read[target].anchors:
                wrong.append(f"{told} leads to no place on its page")
    return wrong


def _read(path: Path) -> "_Page":
    page = _Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


class _Page(HTMLParser):
    """The links of a page, and the places that links lead to."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[tuple[str, str, str]] = []
        self.anchors = {"", "top"}

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Keep what it links to or fetches, and its name."""
        for name, value in attributes:
            if name == "id" and value:
                self.anchors.add(value)
            if value is not None and ((tag, name) in FETCHED or (tag, name) == ("a", "href")):
                self.links.append((tag, name, value))
