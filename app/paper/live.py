"""The pages that compute of a figure: beside index.html, one for each mesh in a row of panels."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from bihdist_core.experiments import Panel, Result

from ..document.document import Document, comparison
from ..document.looks import Isolines
from ..document.page import Recipe
from ..document.quantities import DistanceFrom
from ..scene.camera import directions
from ..session.array_store import ArrayStore
from ..web.export import page_of
from .pictures import is_seen, name_of, plain_name

MOST_EIGENPAIRS = 200
"""The eigenpairs in a page for each truncated distance."""

MARKED = {"minimum": "minima", "maximum": "maxima"}
"""The marks that pages do not have."""


@dataclass(frozen=True, eq=False)
class LivePage:
    """A page that computes, and how the index names it.

    It shows panels of a `row` on a `mesh`, in the `file` at this path from the index, with "/". `left_out` are the
    words for what the row shows and the page does not; `document` and `given` are the arguments of `page_of`.
    """

    row: str
    mesh: str
    file: str
    title: str
    left_out: tuple[str, ...]
    document: Document
    given: ArrayStore

    @property
    def notes(self) -> list[str]:
        """A sentence on the parts of the figure that the page leaves out, if any."""
        return [f"In the figure only: {', '.join(self.left_out)}."] if self.left_out else []


def live_pages(result: Result, row: str, panels: Sequence[Panel], up: str = "y") -> list[LivePage]:
    """Return the pages of a row of panels with the axis `up` in all of them."""
    meshes = list(dict.fromkeys(panel.surface for panel in panels))
    pages = []
    for mesh in meshes:
        of_mesh = [panel for panel in panels if panel.surface == mesh]
        shown = [panel for panel in of_mesh if _is_computed(panel)]
        if shown:
            name = "-".join([name_of(result, row), *([plain_name(mesh)] if len(meshes) > 1 else [])])
            title = f"{result.id}: {mesh}"
            document, given = _contents(result, shown, up)
            pages.append(LivePage(row, mesh, f"{name}.html", title, _left_out(of_mesh), document, given))
    return pages


def write_live(page: LivePage, path: Path) -> int:
    """Compute a page and write it; how many bytes it has.  BihdistError if it cannot be made, OutputError."""
    made = page_of(Recipe(page.document), page.given, eigenpairs=MOST_EIGENPAIRS)
    made.scene["title"] = page.title
    made.scene["notes"] += page.notes
    return made.write(path)


def _is_computed(panel: Panel) -> bool:
    """Return whether pages compute what a panel shows; their geodesic distance is the exact one."""
    spec = panel.distance
    if panel.field is None or spec is None or _source(panel) is None:
        return False
    return spec.word != "geodesic" or spec["method"] in ("auto", "exact")


def _left_out(panels: Sequence[Panel]) -> tuple[str, ...]:
    bare = [panel for panel in panels if panel.field is None and not panel.failure]
    words = ["the bare surface"] if bare else []
    words += [panel.heading for panel in panels if panel not in bare and not _is_computed(panel)]
    if any(panel.style == "height" for panel in panels):
        words.append("fields as heights")
    kinds = {mark.kind for panel in panels for mark in panel.marks}
    if marked := [name for kind, name in MARKED.items() if kind in kinds]:
        words.append(f"marks of local {' and '.join(marked)}")
    return tuple(words)


def _contents(result: Result, panels: Sequence[Panel], up: str) -> tuple[Document, ArrayStore]:
    """Return the document of panels of one mesh and one source, seen from where the figure shows it."""
    first, given = panels[0], ArrayStore()
    surface, source = result.surfaces[first.surface], _source(first)
    assert source is not None  # as _is_computed says
    views = [view for view in first.views if view not in ("zoom", "source")] or ["front"]
    seen = [view for view in views if is_seen(surface, source, directions(view, up)[0])]
    shows = tuple(DistanceFrom(panel.distance, "source") for panel in panels if panel.distance is not None)
    document = replace(
        comparison("", shows, (source,)),
        surfaces=(given.add_surface(surface),),
        isolines=Isolines(first.isoline_count, round=False),
        camera=(seen or views)[0],
        up=up,
    )
    return document, given


def _source(panel: Panel) -> int | None:
    return next((mark.vertex for mark in panel.marks if mark.kind == "source"), None)
