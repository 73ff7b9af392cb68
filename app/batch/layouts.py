"""Folders of .mat files with all distances of a shape, as benchmarks of shape matching read them.

dist: `dist`, as ULRSSM and what follows it read it.  Their metrics divide by nothing: they want √area = 1.
geodist: the distances as `Gamma` (GeomFmaps, DUO-FM) and `geodist` (AttentiveFMaps), and the root of the area as
`SQRarea` and, sparse as MATLAB has it, `sqrt_area`: what each of them divides by.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .results import Array

NORMALISED = "metrics that divide by nothing, such as ULRSSM's, want √area = 1: --normalise area"


def laid_out(layout: str, distances: Array, root: float) -> Mapping[str, Any]:
    """The arrays of a file, by name; root: of the area."""
    if layout == "dist":
        return {"dist": distances}
    from scipy.sparse import csc_matrix

    one = np.array([[root]])
    # Each reader has a name of its own for the distances, and takes no other.
    return {"geodist": distances, "Gamma": distances, "sqrt_area": csc_matrix(one), "SQRarea": one}
