"""What of two surfaces is shown instead of distances: maps between them, or where a point is on the other."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from bihdist_core.errors import ParameterError

from .document import Document
from .file import checksum
from .maps import SAME_IDS, MapFile, Maps, show_maps
from .pairs import Pairs, drop_half, pair_instead, place_point
from .prediction import predict

PAIRS = "pairs"
"""In the place of a map's file: the maps that pairs make, by each distance that is shown."""


def with_pairs(document: Document, places: Iterable[tuple[int, int]]) -> Document:
    """Known pairs of vertices of the two surfaces, instead of others; ParameterError where there are not two."""
    _check_two(document, "--pairs", "pairs=")
    return pair_instead(document, places)


def with_prediction(document: Document, vertex: int) -> Document:
    """Where a vertex of the first surface is on the second, by each distance that is shown.

    ParameterError without pairs, or a second surface.
    """
    _check_two(document, "--predict", "predict=")
    if not any(not pair.is_half for pair in document[Pairs].pairs):
        raise ParameterError("--predict goes by pairs; name their file with --pairs (in Python, give pairs=).")
    return place_point(drop_half(predict(document)), document.surfaces[0].name, vertex)


def with_maps(document: Document, names: Sequence[str]) -> Document:
    """Maps from the first surface to the second, in colours: files, "identity", or PAIRS.

    ParameterError without a second surface, without pairs for PAIRS, and for a file that cannot be read.
    """
    _check_two(document, "--map", "maps=")
    if PAIRS in names and not document[Pairs].pairs:
        raise ParameterError(f"--map {PAIRS} is made by pairs; name their file with --pairs (in Python, give pairs=).")
    files = [name for name in dict.fromkeys(names) if name != PAIRS]
    maps = tuple(MapFile(path, "" if path == SAME_IDS else checksum(path)) for path in files)
    specs = dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs)
    by = [each for name in dict.fromkeys(names) for each in (specs if name == PAIRS else [name])]
    return show_maps(document.with_part(replace(document[Maps], maps=maps)), by)


def _check_two(document: Document, option: str, argument: str) -> None:
    if len(document.surfaces) < 2:
        raise ParameterError(
            f"{option} goes from one mesh to another; name a second one after the first (in Python, beside= with "
            f"{argument})."
        )
