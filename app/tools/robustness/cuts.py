"""What a brush cuts out of a mesh."""

import numpy as np

from bihdist_core.applications.changes import Runs
from bihdist_core.arrays import IntArray

from ...document.runs import ids_of, runs_of


def cut_by(cut: Runs, faces: IntArray, is_restored: bool = False) -> Runs:
    """What is cut out of a surface, with more faces (k,) or, if they are restored, without these."""
    known = ids_of(cut) if cut else np.empty(0, np.int64)
    return runs_of(np.setdiff1d(known, faces) if is_restored else np.union1d(known, faces))
