"""The directives {shell}, {python} and {file}: the code, and what running it has printed and drawn."""

from os.path import relpath
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.directives.code import container_wrapper
from sphinx.util.docutils import SphinxDirective

from .blocks import Outcome
from .page_runs import folder_of, outcomes_of

LANGUAGES = {"shell": "sh", "python": "python", "file": "text"}
LIVE_PAGE = """<iframe src="{src}" title="{title}" loading="lazy" allow="clipboard-write"></iframe>
<script>
  (frame => {{
    const root = document.documentElement, page = frame.getAttribute("src");
    new MutationObserver(() => {{
      const themed = `${{page}}?theme=${{root.dataset.theme}}`;
      if (frame.getAttribute("src") !== themed) frame.src = themed;
    }}).observe(root, {{ attributeFilter: ["data-theme"] }});
    addEventListener("message", ({{ source, data }}) => {{
      const isReady = source === frame.contentWindow && data?.bihdist?.event === "ready";
      if (isReady) frame.parentElement.classList.add("is-live");
    }});
  }})(document.currentScript.previousElementSibling);
</script>"""
"""A page that computes, after its still picture, which is seen until the page reports that it is ready."""


class ShownBlock(SphinxDirective):
    """A block of its page, with its outcome under it."""

    has_content = True
    optional_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar[dict[str, Any]] = {
        "hide-output": directives.flag,
        "hide-text": directives.flag,  # what is printed, not the pictures
        "hide-code": directives.flag,
        "alt": directives.unchanged,
        "caption": directives.unchanged,  # under the pictures, and left out with them where no block runs
        "live": directives.unchanged,  # pages/NAME.html, which the block wrote: embedded over its picture
        "status": directives.nonnegative_int,
    }

    def run(self) -> list[nodes.Node]:
        """The code, unless it is hidden, then what it printed, then its pictures."""
        code = "\n".join(self.content).strip("\n")
        shown: list[nodes.Node] = [] if "hide-code" in self.options else [self._code(code)]
        outcome = self._outcome()
        if "hide-output" in self.options:
            return shown
        if outcome.printed.strip() and "hide-text" not in self.options:
            printed = outcome.printed.strip("\n").expandtabs()
            shown.append(nodes.literal_block(printed, printed, language="text", classes=["printed"]))
        source = Path(self.env.srcdir)
        folder = folder_of(Path(self.env.doc2path(self.env.docname)), source).relative_to(source)
        title = self.state.document.next_node(nodes.title)
        alt = self.options.get("alt") or (title.astext() if title else "")
        pictures = [nodes.image(uri=f"/{(folder / name).as_posix()}", alt=alt) for name in outcome.pictures]
        if page := self.options.get("live"):
            src = relpath(source / folder / page, Path(self.env.doc2path(self.env.docname)).parent)
            live = nodes.raw("", LIVE_PAGE.format(src=Path(src).as_posix(), title=alt), format="html")
            pictures = [nodes.container("", *pictures, live, classes=["live-page"])]
        caption, _ = self.state.inline_text(self.options.get("caption", ""), self.lineno)
        below = [nodes.paragraph("", "", nodes.emphasis("", "", *caption))] if caption else []
        return self._placed([*shown, *pictures, *below])

    def _code(self, code: str) -> nodes.Node:
        is_script = self.arguments[:1] and self.arguments[0].endswith(".py")
        literal = nodes.literal_block(code, code, language="python" if is_script else LANGUAGES[self.name])
        self.set_source_info(literal)
        return container_wrapper(self, literal, self.arguments[0]) if self.name == "file" else literal

    def _outcome(self) -> Outcome:
        """That of the next block of the page."""
        data = self.env.current_document if hasattr(self.env, "current_document") else self.env.temp_data
        number = data["guide_block"] = data.get("guide_block", -1) + 1
        return outcomes_of(Path(self.env.doc2path(self.env.docname)), Path(self.env.srcdir))[number]

    def _placed(self, shown: list[nodes.Node]) -> list[nodes.Node]:
        """Images are read as any others: Sphinx copies their files."""
        for node in shown:
            for image in node.findall(nodes.image):
                self.set_source_info(image)
        return shown


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the directives to Sphinx."""
    for name in LANGUAGES:
        app.add_directive(name, ShownBlock)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
