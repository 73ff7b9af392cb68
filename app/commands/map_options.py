"""The options for a second mesh in a figure, and for maps to it."""

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..document.document import Document

PAIRS = "pairs"
"""In the place of a map's file: the map that pairs make."""


def add_maps(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("beside", nargs="?", help="a second mesh B, to stand beside the first, A")
    parser.add_argument(
        "--map",
        metavar="MAP",
        action="append",
        help="instead of distances where each vertex of A is on B, in colours: a .npy or .txt file with one of B for "
        f"each of A; or `{PAIRS}`, for the maps by each --distance from --pairs; repeat",
    )
    parser.add_argument(
        "--predict",
        metavar="V",
        type=int,
        help="instead of distances how badly each vertex of B fits vertex V of A, by each --distance from --pairs, and "
        "which fits best",
    )
    parser.add_argument("--pairs", metavar="FILE", help="known pairs, a line `i,j` for each: vertex i of A is j of B")


def with_maps(document: "Document", options: argparse.Namespace) -> "Document":
    """The document with the second mesh, the pairs and the maps that are named, if any are."""
    from bihdist_core import ParameterError
    from bihdist_core.formats.vertex_maps import read_pairs

    from ..document import between
    from ..document.beside_edits import open_beside
    from ..document.document import MeshFile
    from .mesh import check_mesh

    if options.beside is not None:
        check_mesh(options.beside)
        document = open_beside(document, MeshFile("", options.beside))
    if options.pairs is not None:
        document = between.with_pairs(document, [(int(i), int(j)) for i, j in read_pairs(options.pairs)])
    if options.predict is not None:
        if options.map is not None:
            raise ParameterError("--predict and --map are figures of their own; leave one of them out.")
        return between.with_prediction(document, options.predict)
    return document if options.map is None else between.with_maps(document, options.map)
