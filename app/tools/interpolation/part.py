"""Anchors: marked points with values, which interpolants have there; pure edits of them."""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, replace
from functools import partial

from bihdist_core.applications.weights import INVERSE_DISTANCES, Weights
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from ...document.document import Document, with_new_point
from ...document.looks import LARGEST
from ...document.on_surface import SurfaceItem
from ...document.part import Part, check_name
from ...document.removal import without_orphans

MOST_ANCHORS = 500
"""Each has a column of distances for each panel."""


@dataclass(frozen=True)
class Anchor:
    """A marked point, filled with the colour of a value, or of the field there if the value is None.

    Interpolants have the values of all anchors that have one and are not left out. Without a name, the user sees
    that of the point.
    """

    point: str
    value: float | None = None
    left_out: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        check_name(self.name, "anchor")
        if self.value is not None:
            object.__setattr__(self, "value", float(self.value))
        if self.value is not None and not abs(self.value) <= LARGEST:
            raise ParameterError(f"The value of an anchor is a number up to {LARGEST:g}, not {self.value:g}.")


@dataclass(frozen=True)
class Anchors(Part):
    """The anchors of a document, and how interpolants weigh them.

    Attributes
    ----------
    anchors
        The anchors, in their order.
    weights
        The weights of the anchors in interpolants.
    """

    anchors: tuple[Anchor, ...] = ()
    weights: Weights = INVERSE_DISTANCES

    @property
    def points(self) -> tuple[str, ...]:
        return tuple(anchor.point for anchor in self.anchors)

    @property
    def has_values(self) -> bool:
        return any(anchor.value is not None for anchor in self.anchors)

    def without_points(self, points: Set[str]) -> "Anchors":
        return replace(self, anchors=tuple(anchor for anchor in self.anchors if anchor.point not in points))

    def work(self, document: Document) -> Mapping[str, Iterable[object]]:
        return {"anchors": [(anchor, document.point(anchor.point)) for anchor in self.anchors]}


def with_anchors(document: Document, anchors: Iterable[Anchor]) -> Document:
    """Return the document with these anchors and no others; their points are there."""
    return document.with_changed(Anchors, anchors=tuple(anchors))


def add_anchor(
    document: Document, at: Source, value: float | None, surface: str = "A", name: str = ""
) -> tuple[Document, str]:
    """Return the document with an anchor there, and the name of its point; an anchor that is there gets the value.

    Raises ParameterError beyond MOST_ANCHORS.
    """
    anchors = document[Anchors].anchors
    for anchor in anchors:
        point = document.point(anchor.point)
        if (point.at, point.surface) == (at, surface):
            return change_anchor(document, replace(anchor, value=value, left_out=False)), anchor.point
    if len(anchors) >= MOST_ANCHORS:
        raise ParameterError(f"There are at most {MOST_ANCHORS} anchors.")
    document, point_name = with_new_point(document, "anchor", at, surface)
    return with_anchors(document, (*anchors, Anchor(point_name, value, name=name))), point_name


def change_anchor(document: Document, anchor: Anchor) -> Document:
    """Change the value or the name of the anchor at a point."""
    return with_anchors(document, (anchor if old.point == anchor.point else old for old in document[Anchors].anchors))


def remove_anchors(document: Document, points: Iterable[str]) -> Document:
    """Return the document without the anchors at these points."""
    return without_orphans(document, document.with_part(document[Anchors].without_points(set(points))))


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the anchors, all in one row."""
    points = document[Anchors].points
    if points:
        detail, remove_all = f"{len(points):,} of Interpolation", partial(remove_anchors, points=points)
        yield SurfaceItem("anchors", "Anchors", detail, "ring", remove_all, count=len(points), dock="anchors")
