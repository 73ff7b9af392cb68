"""Pairs, and what is shown between two meshes instead of distances, as figures are told of them."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from bihdist_core.errors import LandmarkWarning, ParameterError

from ...document.document import Document
from ...document.file import checksum
from ...document.lists import pairs_from_words, pairs_text
from ...document.option import Option, Row, unsaid
from ...document.page import Recipe
from .maps import SAME_IDS, MapFile, Maps, show_maps
from .pairs import Pairs, drop_half, pair_instead, place_point
from .quantity import predict

PAIRS = "pairs"
"""The word that stands for the maps by pairs, in the place of a map's file."""

PAIRS_MEANING = (
    "known pairs, vertex I of A and J of B: 1:2,3:4; or a file with a line `i,j` for each, @FILE, or - for standard "
    "input; or landmarks on A and on B, @FILE,FILE"
)


def _put(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    import numpy as np

    from bihdist_core.formats.vertex_maps import are_landmarks, read_pairs

    from ...samples import mesh_path
    from ...session.repaired_surface import read_repaired

    document, pairs = recipe.document, values.get("pairs", ())
    if isinstance(pairs, str):
        surfaces = []
        if are_landmarks(pairs):
            _check_two(document, "--pairs", "pairs=")
            surfaces = [read_repaired(mesh_path(mesh.path), mesh.repairs) for mesh in document.surfaces[:2]]
        pairs = read_pairs(pairs, surfaces, lambda fact: warnings.warn(fact, LandmarkWarning, stacklevel=2))
    pairs = np.asarray(pairs)
    if pairs.size:
        if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
            raise ParameterError(f"Pairs are whole numbers of shape (k, 2), not {pairs.dtype} of {pairs.shape}.")
        _check_two(document, "--pairs", "pairs=")
        document = pair_instead(document, [(int(i), int(j)) for i, j in pairs])
    if "predict" in values and values.get("maps"):
        raise ParameterError("--predict and --map (in Python predict= and maps=) cannot be combined; leave one out.")
    if "predict" in values:
        document = _with_prediction(document, values["predict"])
    elif len(values.get("maps", ())):
        document = _with_maps(document, values["maps"])
    return replace(recipe, document=document)


def _with_prediction(document: Document, vertex: int) -> Document:
    """Predict a vertex of the first surface on the second, by each distance that is shown.

    Raises ParameterError without pairs or a second surface.
    """
    _check_two(document, "--predict", "predict=")
    if not any(not pair.is_half for pair in document[Pairs].pairs):
        raise ParameterError("--predict needs pairs; name them with --pairs (in Python, give pairs=).")
    return place_point(drop_half(predict(document)), document.surfaces[0].name, vertex)


def _with_maps(document: Document, names: Sequence[str]) -> Document:
    """Show maps from the first surface to the second: files, "identity", or PAIRS.

    Raises ParameterError without a second surface, without pairs for PAIRS, and for a file that cannot be read.
    """
    _check_two(document, "--map", "maps=")
    if PAIRS in names and not document[Pairs].pairs:
        raise ParameterError(f"--map {PAIRS} needs pairs; name them with --pairs (in Python, give pairs=).")
    files = [name for name in dict.fromkeys(names) if name != PAIRS]
    maps = tuple(MapFile(path, "" if path == SAME_IDS else checksum(path)) for path in files)
    specs = dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs)
    by = [each for name in dict.fromkeys(names) for each in (specs if name == PAIRS else [name])]
    return show_maps(document.with_changed(Maps, maps=maps), by)


def _check_two(document: Document, option: str, argument: str) -> None:
    if len(document.surfaces) < 2:
        raise ParameterError(
            f"{option} goes from one mesh to another; name a second one after the first (in Python, second_mesh= with "
            f"{argument})."
        )


ROWS = (
    Row(
        (
            Option(
                "maps",
                "instead of distances, show in colours where each vertex of A is on B: a .npy or .txt file with the "
                f"vertex of B for each of A; or `{PAIRS}`, for the maps by each --distance from --pairs; with commas "
                "for several",
                (),
                flag="map",
                group="",
                metavar="MAP,…",
                is_list=True,
                replaces_panels=True,
            ),
            Option(
                "predict",
                "instead of distances, show how badly each vertex of B fits vertex V of A, by each --distance from "
                "--pairs, and which fits best",
                group="",
                metavar="V",
                read=int,
                replaces_panels=True,
            ),
            Option(
                "pairs",
                PAIRS_MEANING,
                (),
                group="",
                metavar="I:J,…|@FILE",
                read=pairs_from_words,
                write=pairs_text,
            ),
        ),
        put=_put,
        is_of_two=True,
    ),
    unsaid("with one mesh there are none", "Pairs.pairs", "Maps.maps"),
    unsaid("what maps are measured by, which no picture shows", "Maps.truth"),
)
