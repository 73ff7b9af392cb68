"""What of a document was made by hand, and is lost with it."""

from bihdist_core.sources.source import Curve

from .document import Document
from .sourcing import members_of


def work_in(document: Document) -> dict[str, frozenset[object]]:
    """Pins, pairs and whatever else takes effort to make again, by what it is called; moved, it is other work."""
    at = {point.name: point for point in document.points}
    return {
        "pins": frozenset((pin, at[pin.point]) for pin in document.pins),
        "pairs": frozenset((pair, at.get(pair.first), at.get(pair.second)) for pair in document.pairs),
        "anchors": frozenset((anchor, at[anchor.point]) for anchor in document.anchors),
        "selections": frozenset(document.selections),
        "drawn sources": frozenset(
            member for point in document.points for member in members_of(point.at) if isinstance(member, Curve)
        ),
        "changes to the mesh": frozenset(
            mesh.change for mesh in document.surfaces if mesh.change is not None and not mesh.change.changes_nothing
        ),
    }
