"""Names of files until the user types another."""

import os
import re
from collections.abc import Sequence

from bihdist_core.formats.mesh_names import mesh_format, mesh_name
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of

from .document import Document, Panel
from .quantities import Quantity


def file_name(meshes: Sequence[str], what: str, *of: str) -> str:
    """Return a name such as "spot-field-biharmonic", of the meshes and what the file holds of them.

    The meshes are given by files or names; `of` has the distance or the selection that the file is about. The result
    has no extension, and no character that a shell or another operating system stumbles over.
    """
    stems = dict.fromkeys(
        mesh_name(mesh) if mesh_format(mesh) else re.sub(r"\.[A-Za-z]\w*$", "", os.path.basename(mesh))
        for mesh in meshes
    )
    words = (re.sub(r"[^\w.]+|_", "-", word).strip("-.") for word in (*stems, what, *of))
    return "-".join(word for word in words if word)


def field_name(shows: Quantity, sources: Sequence[Source]) -> str:
    """ "biharmonic_from_12", "biharmonic_minus_geodesic_percent_from_12": parameters are not named."""
    word = "_minus_".join(part.word.replace(" ", "_") for part in shows.parts)
    return _from(f"{word}_percent" if shows.in_percent else word, sources)


def field_names(document: Document, panels: Sequence[Panel]) -> list[str]:
    """Return the names of what panels of a document show; where several are alike, with their parameters."""
    points = [[document.point(name).at for name in panel.shows.points] for panel in panels]
    sources = [[at for at in each if at is not None] for each in points]
    shows = [panel.shows for panel in panels]
    names = [field_name(each, starts) for each, starts in zip(shows, sources, strict=True)]
    whole = [_from(_plain(str(each)), starts) for each, starts in zip(shows, sources, strict=True)]
    return distinct([name if names.count(name) == 1 else more for name, more in zip(names, whole, strict=True)])


def distinct(names: Sequence[str]) -> list[str]:
    """No two alike: one that was there before has its place behind it."""
    found: list[str] = []
    for name in names:
        found.append(name if name not in found else f"{name}_{len(found) + 1}")
    return found


def _from(word: str, sources: Sequence[Source]) -> str:
    """Append a word of letters, digits and `_` for each source."""
    starts = "_and_".join(_plain(short_words_of(each)) for each in sources)
    return f"{word}_from_{starts}" if starts else word


def _plain(words: str) -> str:
    return re.sub("[^0-9A-Za-z.]+", "_", words).strip("_")
