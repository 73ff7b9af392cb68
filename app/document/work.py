"""What of a document was made by hand, and is lost with it."""

from bihdist_core.sources.source import Curve

from .document import Document
from .source_edits import members_of
from .tools import part_types


def work_in(document: Document) -> dict[str, frozenset[object]]:
    """What takes effort to make again, by what it is called; moved, it is other work."""
    of_parts: dict[str, frozenset[object]] = {}
    for kind in part_types():
        of_parts |= {name: frozenset(each) for name, each in document[kind].work(document).items()}
    return {
        **of_parts,
        "drawn sources": frozenset(
            member for point in document.points for member in members_of(point.at) if isinstance(member, Curve)
        ),
        "changes to the mesh": frozenset(
            mesh.change for mesh in document.surfaces if mesh.change is not None and not mesh.change.changes_nothing
        ),
    }
