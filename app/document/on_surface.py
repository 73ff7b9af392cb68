"""The list of what is marked on the surfaces, the source and what each tool adds, and which of it is hidden."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from bihdist_core.sources.source import Member, Source
from bihdist_core.sources.words import short_words_of

from .document import Document, starting_points
from .edits import pass_through_none, put_point
from .part import Part
from .source_edits import members_of, source_from
from .tools import tools

SOURCE, ISOLINES = "source", "isolines"
"""The words of what is on the surface without a tool."""


@dataclass(frozen=True)
class SurfaceItem:
    """A thing on the surface, or a group of them.

    Attributes
    ----------
    word : str
        By which it is hidden: "pins", or "pins:pin 2" for a member of that group; empty for a member that is hidden
        with its group alone.
    name, detail : str
        For the user.
    symbol : str
        Its picture in a list: "disc", "pin", "dot", "hatching", "line", "ring" or "triangle".
    remove : callable, optional
        An edit that takes it away; None where it has to stay.
    colour : int, optional
        The number of a mark's colour.
    members : tuple of SurfaceItem
        Of a group.
    count : int
        How many things it stands for.
    dock : str
        The word of the dock of its tool.
    is_by_product : bool
        Whether it is of little use without that dock, so that Esc clears it.
    """

    word: str
    name: str
    detail: str
    symbol: str
    remove: Callable[[Document], Document] | None = None
    colour: int | None = None
    members: tuple["SurfaceItem", ...] = ()
    count: int = 1
    dock: str = ""
    is_by_product: bool = False

    @property
    def leaves(self) -> tuple["SurfaceItem", ...]:
        """The members that can be hidden one by one; the item itself where there are none."""
        return tuple(member for member in self.members if member.word) or (self,)


def surface_items(document: Document) -> tuple[SurfaceItem, ...]:
    """List what is on the surfaces of a document: the source, isolines through points, then what tools mark."""
    of_tools = (item for tool in tools() if tool.items for item in tool.load(tool.items)(document))
    return (*_sources(document), *_isolines(document), *of_tools)


def _sources(document: Document) -> Iterator[SurfaceItem]:
    points = starting_points(document)
    placed = [(point.name, member) for point in points for member in members_of(point.at)]
    if len(placed) < 2:
        if points:  # one that is nowhere yet will be
            yield SurfaceItem(SOURCE, "Source", place_words(points[0].at), "disc")
        return
    members = (
        SurfaceItem("", place_words(member), "", "disc", _without_member(document, name, member))
        for name, member in placed
    )
    yield SurfaceItem(SOURCE, "Sources", f"{len(placed):,}", "disc", members=tuple(members))


def _without_member(document: Document, name: str, member: Member) -> Callable[[Document], Document] | None:
    """Return an edit that takes a member from the source of a name; None for the last one."""
    point = document.point(name)
    left = [each for each in members_of(point.at) if each != member]
    return (lambda document: put_point(document, name, source_from(left), point.surface)) if left else None


def _isolines(document: Document) -> Iterator[SurfaceItem]:
    through = document.isolines.through
    if through:
        yield SurfaceItem(
            ISOLINES, "Isolines through points", f"{len(through):,}", "line", pass_through_none, count=len(through)
        )


def place_words(at: Source | None) -> str:
    """Say where a point is: "vertex 12", or the words of another source."""
    return "" if at is None else f"vertex {at}" if isinstance(at, int) else short_words_of(at)


# ---------------------------------------------------------------------- what is hidden
@dataclass(frozen=True)
class Hidden(Part):
    """The items on the surface that are not drawn, in the window and in figures.

    Attributes
    ----------
    hidden
        The words of the items that are not drawn (`SurfaceItem`), or of one member of an item, such as "pins:2".
    """

    hidden: tuple[str, ...] = ()

    def hides(self, words: Iterable[str], name: str = "") -> bool:
        """Return whether items of these words are hidden, or their member of a name."""
        return any(word in self.hidden or f"{word}:{name}" in self.hidden for word in words)

    def fitted(self, document: Document) -> "Hidden":
        """Return the part without items that are gone, so that a later one of the same name is drawn."""
        there = {leaf.word for item in surface_items(document) for leaf in item.leaves}
        return Hidden(tuple(word for word in self.hidden if word in there))


def is_hidden(document: Document, item: SurfaceItem) -> bool:
    """Return whether an item is not drawn; a group is not if none of its members is."""
    return all(leaf.word in document[Hidden].hidden for leaf in item.leaves)


def hide(document: Document, item: SurfaceItem, is_hidden: bool = True) -> Document:
    """Hide an item, or show it again."""
    words = [leaf.word for leaf in item.leaves]
    others = tuple(word for word in document[Hidden].hidden if word not in words)
    return document.with_part(Hidden((*others, *words) if is_hidden else others))


# ---------------------------------------------------------------------- what is removed
def remove_items(document: Document, items: Iterable[SurfaceItem]) -> Document:
    """Take things away, except those that have to stay."""
    for item in items:
        document = document if item.remove is None else item.remove(document)
    return document


def clear_surface(document: Document) -> Document:
    """Take everything away except the source."""
    return remove_items(document, (item for item in surface_items(document) if item.word != SOURCE))


def by_products(document: Document, of_closed: bool = False) -> tuple[SurfaceItem, ...]:
    """List the selections and borders; with `of_closed` only those whose tool is closed."""
    found = (item for item in surface_items(document) if item.is_by_product)
    return tuple(item for item in found if not (of_closed and item.dock in document.docks))


def item_counts(document: Document) -> tuple[int, int]:
    """Count what is drawn on the surface besides the source, and what is hidden, the source included."""
    leaves = [leaf for item in surface_items(document) for leaf in item.leaves]
    shown = sum(leaf.count for leaf in leaves if leaf.word != SOURCE and not is_hidden(document, leaf))
    return shown, sum(leaf.count for leaf in leaves if is_hidden(document, leaf))
