"""`bihdist.widget`: the page that computes, in a notebook."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bihdist_core import ParameterError
from bihdist_core.progress import Progress

from ..document.page import Recipe
from ..document.quantities import Quantity
from ..session.array_store import Mesh, comparison_of_arrays
from .export import page_of
from .html_file import kernel, style, whole_scene
from .modules import joined
from .stored_mesh import deflated

try:
    import anywidget
    import traitlets
except ImportError:
    raise ParameterError("Widgets need the package anywidget: pip install 'bihdist[widget]'.") from None


class DistanceWidget(anywidget.AnyWidget):
    """Linked panels in which a click computes; nothing is asked of Python, nor of a network.

    source: the vertex from which distances are shown.  pins: a dict with the `id` of a vertex and a `name` for each.
    Both change with what is done in a panel, and the panels with them: `traitlets.link((a, "source"), (b, "source"))`
    lets two widgets go together.
    """

    _esm = joined("widget.js") + "\nexport default { render };\n"
    _css = style()

    contents = traitlets.Dict().tag(sync=True)
    scene = traitlets.Dict().tag(sync=True)
    source = traitlets.Int().tag(sync=True)
    pins: traitlets.List[Any] = traitlets.List().tag(sync=True)

    def __init__(self, ids: frozenset[int], **traits: Any) -> None:
        self._ids = ids
        super().__init__(**traits)

    @traitlets.validate("source")
    def _check_source(self, proposal: Any) -> int:
        return self._held(proposal["value"], "The source")

    @traitlets.validate("pins")
    def _check_pins(self, proposal: Any) -> list[dict[str, object]]:
        return [self._pin(number, pin) for number, pin in enumerate(proposal["value"], 1)]

    def _pin(self, number: int, pin: Any) -> dict[str, object]:
        pin = pin if isinstance(pin, Mapping) else {"id": pin}
        return {"id": self._held(pin.get("id"), f"Pin {number}"), "name": str(pin.get("name", ""))}

    def _held(self, vertex: Any, what: str) -> int:
        if isinstance(vertex, bool) or not hasattr(vertex, "__index__") or int(vertex) not in self._ids:
            raise traitlets.TraitError(f"{what} is {vertex!r}, which is no vertex that a face has.")
        return int(vertex)

    def on_pick(self, act: Callable[[int], object]) -> None:
        """Call with the vertex whenever one is clicked in a panel; not where Python sets the source."""

        def told(_: object, content: Any, __: object) -> None:
            act(self._held(content.get("picked"), "What was clicked"))

        self.on_msg(told)


def widget(
    mesh: Mesh,
    distances: Sequence[str | Quantity] = ("biharmonic", "geodesic"),
    source: int | None = None,
    *,
    pins: Sequence[int | Mapping[str, object]] = (),
    on_pick: Callable[[int], object] | None = None,
    areas: str = "voronoi",
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
) -> DistanceWidget:
    """Linked panels of distances in a notebook: Jupyter, VS Code, marimo.

    mesh: a file, a sample, a Surface, or vertices (n, 3) and faces (m, 3).  distances: a panel each, in words; what a
    page has (`bihdist.page`).  source: a vertex, the highest if None.  pins: vertices, or dicts of `id` and `name`.
    on_pick: called with the vertex of each click.  precision: of coordinates, "24" bits or "float32".  eigenpairs: how
    many may be sent for each distance that needs them.  Raises BihdistError, also where anywidget is not installed.
    """
    document, given = comparison_of_arrays(mesh, distances, {}, (source,), areas)
    page = page_of(Recipe(document), given, precision, eigenpairs, progress)
    made = DistanceWidget(
        frozenset(page.mesh.ids.tolist()),
        contents={
            "kernel": kernel(),
            "mesh": deflated(page.mesh.packed),
            "points": {name: deflated(each.packed) for name, each in page.points.items()},
        },
        scene=whole_scene(page.scene, page.mesh),
        source=page.scene["source"],
        pins=list(pins),
    )
    if on_pick is not None:
        made.on_pick(on_pick)
    return made
