"""The sidebar of pages whose index has them under headings: the same headings."""

from typing import Any

from docutils import nodes
from sphinx.addnodes import toctree

GROUPED = "how-to/"


def setup(app: Any) -> dict[str, bool]:
    """Have pages know their groups; an extension of Sphinx."""
    app.connect("html-page-context", _add_groups)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _add_groups(app: Any, page: str, template: str, context: dict[str, Any], tree: object) -> None:
    if page.startswith(GROUPED):
        index = app.env.get_doctree(f"{GROUPED}index")
        context["page_groups"] = [
            (
                section.next_node(nodes.title).astext(),
                [(name, app.env.titles[name].astext()) for _, name in tree["entries"]],
            )
            for tree in index.findall(toctree)
            if (section := tree.parent.parent) is not None
        ]
