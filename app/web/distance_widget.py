"""The notebook widget; imports anywidget, which may not be installed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import anywidget
import traitlets

from .export import Page
from .html_file import packed_contents, style, whole_scene
from .modules import joined


class DistanceWidget(anywidget.AnyWidget):
    """Linked panels in which a click computes in the browser, without Python or a network.

    Attributes
    ----------
    source : int
        The vertex from which distances are shown.
    pins : list of dict
        With the `id` of a vertex and a `name` each.

    Notes
    -----
    Both traits follow the panels, and the panels follow them: ``traitlets.link((a, "source"), (b, "source"))`` lets two
    widgets share their source.
    """

    _esm = joined("widget.js") + "\nexport default { render };\n"
    _css = style()

    contents = traitlets.Dict().tag(sync=True)
    scene = traitlets.Dict().tag(sync=True)
    source = traitlets.Int().tag(sync=True)
    pins: traitlets.List[Any] = traitlets.List().tag(sync=True)

    @classmethod
    def of(cls, page: Page) -> DistanceWidget:
        """Make a widget that shows a page.

        Parameters
        ----------
        page : Page
            Its content.

        Returns
        -------
        DistanceWidget
            The widget.
        """
        return cls(
            frozenset(page.mesh.ids.tolist()),
            contents=packed_contents(page.mesh, page.points, page.given),
            scene=whole_scene(page.scene, page.mesh, page.given),
            source=page.scene["source"],
            pins=page.scene["pins"],
        )

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
            raise traitlets.TraitError(f"{what} is {vertex!r}, which is not the vertex of a face.")
        return int(vertex)

    def on_pick(self, act: Callable[[int], object]) -> None:
        """Call a function with the vertex of each click in a panel, but not when Python sets the source.

        Parameters
        ----------
        act : callable
            Called as ``act(vertex)``.
        """

        def told(_: object, content: Any, __: object) -> None:
            if "picked" in content:
                act(self._held(content["picked"], "What was clicked"))

        self.on_msg(told)
