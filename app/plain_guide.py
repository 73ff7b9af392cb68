"""The guide's Markdown as plain web pages, for installations in which the full guide has not been built."""

import html
import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from bihdist_core.file_output import atomic_write

from .samples import SAMPLES
from .version import version

SOURCES = SAMPLES / "guide"

_SECTIONS = {
    "Guide": "index",
    "Getting started": "start/index",
    "How-to": "how-to/index",
    "Explanation": "explanation/index",
    "Reference": "reference/index",
    "Questions": "questions/index",
    "Development": "development/index",
}

_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title}</title>
<style>
:root {{ color-scheme: light dark; font: 16px/1.6 system-ui, sans-serif }}
body {{ max-width: 46rem; margin: 0 auto; padding: 1rem }}
h1, h2, h3 {{ line-height: 1.25 }}
nav {{ display: flex; flex-wrap: wrap; gap: 0 1.25rem }}
pre, code, kbd {{ font: 0.875rem/1.5 ui-monospace, monospace; background: #8881; border-radius: 3px }}
pre {{ padding: 0.75rem; overflow-x: auto }} pre code {{ background: none }}
kbd {{ border: 1px solid #8886; padding: 0 0.3em }}
img {{ max-width: 100% }}
table {{ border-collapse: collapse; display: block; overflow-x: auto }}
th, td {{ border-bottom: 1px solid #8884; padding: 0.25rem 0.75rem 0.25rem 0; text-align: left; vertical-align: top }}
footer {{ border-top: 1px solid #8884; margin-top: 3rem; font-size: 0.875rem }}
</style>
<nav>{links}</nav>
{body}
<footer><p>bihdist {version}. This is the text of the guide. <code>make guide</code> in a checkout of the project builds
all of it: search, the gallery, what the examples print and draw, and the pages of all options and names.</footer>
</html>
"""

_OPTION = re.compile(r"^:([\w-]+):[ \t]*(.*)\n?", re.MULTILINE)


def write_plain_guide(folder: Path) -> Path:
    """Write the pages of the guide into a folder.

    Parameters
    ----------
    folder : Path
        Made if it does not exist; pages of the same names are replaced.

    Returns
    -------
    Path
        The first page.

    Raises
    ------
    OutputError
        If a page cannot be written.
    """
    for source in SOURCES.rglob("*.md"):
        page = folder / source.relative_to(SOURCES).with_suffix(".html")
        page.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(page, removes_stale=False) as temporary:
            temporary.write_text(_page(source), encoding="utf-8")
    return folder / "index.html"


def _page(source: Path) -> str:
    up = "../" * (len(source.relative_to(SOURCES).parts) - 1)
    return _PAGE.format(
        title=html.escape(_title(source)),
        links="".join(f'<a href="{up}{page}.html">{words}</a>' for words, page in _SECTIONS.items()),
        body=_Renderer(source).render(source.read_text(encoding="utf-8")),
        version=version(),
    )


def _title(source: Path) -> str:
    _, _, title = source.read_text(encoding="utf-8").partition("# ")
    return title.partition("\n")[0]


class _Renderer:
    """Turns the MyST of one page into HTML; its blocks are shown and not run."""

    def __init__(self, source: Path) -> None:
        from markdown_it import MarkdownIt
        from markdown_it.renderer import RendererHTML
        from mdit_py_plugins.anchors import anchors_plugin
        from mdit_py_plugins.colon_fence import colon_fence_plugin
        from mdit_py_plugins.deflist import deflist_plugin
        from mdit_py_plugins.dollarmath import dollarmath_plugin
        from mdit_py_plugins.front_matter import front_matter_plugin
        from mdit_py_plugins.myst_role import myst_role_plugin

        self._source = source
        self._markdown = MarkdownIt().enable("table").use(anchors_plugin, max_level=4).use(deflist_plugin)
        self._markdown.use(front_matter_plugin).use(colon_fence_plugin).use(dollarmath_plugin).use(myst_role_plugin)
        self._html = cast(RendererHTML, self._markdown.renderer)
        for name in ("fence", "colon_fence", "myst_role", "math_inline", "math_block", "link_open", "image"):
            self._html.rules[name] = getattr(self, f"_{name}")

    def render(self, text: str) -> str:
        """Return Markdown as HTML."""
        return cast(str, self._markdown.render(text))

    def _fence(self, tokens: Sequence[Any], index: int, *_: Any) -> str:
        directive, argument = _directive(tokens[index].info)
        options, content = _options(tokens[index].content)
        if directive == "toctree" and "hidden" not in options:
            return f"<ul>{''.join(f'<li>{self._link(name)}</li>' for name in content.split())}</ul>"
        if directive == "glossary":
            return self.render(re.sub(r"^  (.*(?:\n  .*)*)", r": \1", content, flags=re.MULTILINE))
        if options.keys() & {"hide-code", "hidden"}:
            return ""
        caption = f"<p><code>{html.escape(argument)}</code></p>" if argument else ""
        return f"{caption}<pre><code>{html.escape(content)}</code></pre>" if content else caption

    def _colon_fence(self, tokens: Sequence[Any], index: int, *_: Any) -> str:
        directive, title = _directive(tokens[index].info)
        options, content = _options(tokens[index].content)
        if directive == "grid-item-card":
            link = self._link(options["link"], title)
            return f"<h3>{link}</h3>{self.render(content)}" if link.startswith("<a") else ""
        if directive == "tab-item":
            return f"<h3>{html.escape(title)}</h3>{self.render(content)}"
        return self.render(content)

    def _myst_role(self, tokens: Sequence[Any], index: int, *_: Any) -> str:
        role, content = tokens[index].meta["name"], tokens[index].content
        if role == "doc":
            return self._link(content)
        tag = {"kbd": "kbd", "term": "em", "menuselection": "em"}.get(role, "code")
        return f"<{tag}>{html.escape(content)}</{tag}>"

    def _math_inline(self, tokens: Sequence[Any], index: int, *_: Any) -> str:
        return f"<code>{html.escape(tokens[index].content.strip())}</code>"

    def _math_block(self, tokens: Sequence[Any], index: int, *_: Any) -> str:
        return f"<pre>{self._math_inline(tokens, index)}</pre>"

    def _link_open(self, tokens: Sequence[Any], index: int, *rest: Any) -> str:
        tokens[index].attrs["href"] = self._address(tokens[index].attrs["href"])
        return self._html.renderToken(tokens, index, *rest)

    def _image(self, tokens: Sequence[Any], index: int, *rest: Any) -> str:
        tokens[index].attrs["src"] = (self._source.parent / tokens[index].attrs["src"]).resolve().as_uri()
        return self._html.image(tokens, index, *rest)

    def _link(self, name: str, words: str = "") -> str:
        """Link to a page by its name; without words, by its title."""
        page = self._source.parent / f"{name}.md"
        words = html.escape(words or (_title(page) if page.exists() else name))
        return f'<a href="{html.escape(name)}.html">{words}</a>' if page.exists() else words

    def _address(self, target: str) -> str:
        """Turn the target of a link into that of its page; pages that only the full guide has lead to the first."""
        path, mark, place = target.partition("#")
        if "://" in target or not path:
            return target
        source = self._source.parent / path
        if not source.exists():
            return os.path.relpath(SOURCES / "index.html", self._source.parent)
        return f"{path[:-3]}.html{mark}{place}" if source.suffix == ".md" else source.resolve().as_uri()


def _directive(info: str) -> tuple[str, str]:
    """Split what follows the fence, "{file} ids.txt", into the directive and its argument."""
    found = re.fullmatch(r"\{([\w-]+)\}\s*(.*)", info.strip())
    return (found[1], found[2]) if found else ("", "")


def _options(content: str) -> tuple[dict[str, str], str]:
    """Split a directive's content into its options and the rest."""
    options: dict[str, str] = {}
    while found := _OPTION.match(content):
        options[found[1]] = found[2].strip()
        content = content[found.end() :]
    return options, content.strip("\n")
