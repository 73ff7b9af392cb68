"""Vertex ids in .mat files, which say from where they count: MATLAB counts its rows from 1."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .results import Array, Blocks

IDS = ("sources", "vertices", "indices")
"""Arrays whose entries are vertex ids."""
COUNT_FROM = "ids_count_from"
"""The variable of a .mat file with the id that a mesh's first vertex has in it."""


def for_matlab(arrays: Mapping[str, Array], one_based: bool) -> tuple[dict[str, Array], dict[str, Any]]:
    """The arrays of a file, with ids that count from 0 or from 1 and a variable that says so; what its JSON says of it.

    Where an id is -1, as there is none, one that counts from 1 is 0.
    """
    first = int(one_based)
    ids = {name: array + first for name, array in arrays.items() if name in IDS and not isinstance(array, Blocks)}
    if not ids:
        return dict(arrays), {}
    facts: dict[str, Any] = {f"mat_{COUNT_FROM}": first}
    if "indices" in ids:
        facts["indices"] = f"{first - 1} where there is none"
    return {**arrays, **ids, COUNT_FROM: np.array(first)}, facts
