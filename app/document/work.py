"""Work in a document that was done by hand, and is lost with it."""

import os

from bihdist_core.sentences import with_and
from bihdist_core.sources.source import Curve

from .document import Document
from .source_edits import members_of
from .tools import part_types

Work = dict[str, frozenset[object]]


def work_in(document: Document) -> Work:
    """Return the work in a document that takes effort to do again, by its name; after a move it is other work."""
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


def meshes_in_words(document: Document) -> str:
    """Return the files or names of a document's meshes, "beast.ply and cat.off"."""
    return with_and(dict.fromkeys(os.path.basename(mesh.path) or mesh.name for mesh in document.surfaces))
