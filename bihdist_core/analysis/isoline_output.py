"""Isolines written to files that other programs read."""

import os
from collections.abc import Sequence

from ..formats.curve_output import CURVE_FORMATS, Curve, write_curves
from .isoline_tracing import Isoline

ISOLINE_FORMATS = CURVE_FORMATS
"""The extensions `write_isolines` knows."""


def write_isolines(path: str | os.PathLike[str], lines: Sequence[Isoline]) -> None:
    """Write curves; the extension names the format.  Coordinates and values read back exactly.

    .csv: a line `line,value,closed,x,y,z` for each point; closed is 1 where the last point joins the first.
    .obj: vertices, and an `l` element for each curve under a group named by its value.
    .vtp: polylines with the cell data array `value`.
    .json: {"isolines": [...]}, a curve each {"value", "closed", "points": [[x, y, z], ...], "edges": [[a, b], ...],
           "parameters": [t, ...]}: its points are (1 - t) x_a + t x_b of the vertices a, b of the mesh.

    Raises OutputError if the file cannot be written; what was at `path` before then stays.

    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=1, j_resolution=1)
    >>> lines = bihdist.isolines(plane, plane.points[:, 0], [0.25])
    >>> bihdist.write_isolines("lines.csv", lines)
    >>> print(Path("lines.csv").read_text().strip())
    line,value,closed,x,y,z
    0,0.25,0,0.25,-0.5,0.0
    0,0.25,0,0.25,0.25,0.0
    0,0.25,0,0.25,0.5,0.0
    """
    curves = [
        Curve(line.points, line.closed, {"value": line.value}, {"edges": line.edges, "parameters": line.parameters})
        for line in lines
    ]
    write_curves(path, curves, ["value"], "isolines")
