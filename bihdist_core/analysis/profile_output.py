"""Profiles written to files: fields along a path over arc length."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from ..errors import ParameterError
from ..formats.field_output import write_array
from ..formats.vtp_output import write_poly_data
from ..number_arrays import real_numbers
from ..whole_file import check_output, whole_file
from .surface_paths import SurfacePath

PROFILE_FORMATS = (".csv", ".npy", ".vtp", ".json")
"""The extensions `write_profile` knows."""


def write_profile(
    path: str | os.PathLike[str], along: SurfacePath, fields: Mapping[str, npt.ArrayLike] | None = None
) -> None:
    """Write a path and fields (n,) along it; the extension names the format.  Numbers read back exactly.

    .csv: a line `arc,x,y,z,face,b0,b1,b2,NAMES` for each point: its length along the path, position, place, and values.
    .npy: the columns of the .csv as a (k, c) array.
    .vtp: a polyline with the point data arrays `arc` and the fields.
    .json: {"points": [[face, b0, b1], ...], "method", "length", "arcs": [...], "fields": {name: [...]}}.
    Between the points the fields change linearly.  Raises OutputError if the file cannot be written; what was at `path`
    before then stays.

    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> path = bihdist.GeodesicPaths(plane).path([0, 24])
    >>> bihdist.write_profile("profile.csv", path, {"x": plane.points[:, 0]})
    >>> print(Path("profile.csv").read_text().split()[0])
    arc,x,y,z,face,b0,b1,b2,x
    """
    extension = check_output(path, PROFILE_FORMATS)
    values = {
        name: along.along(real_numbers(field, f"Values of the field {name!r}"))
        for name, field in (fields or {}).items()
    }
    for name, column in values.items():
        if column.ndim != 1:
            raise ParameterError(f"The field {name!r} has {column.shape[1:]} numbers at a vertex; a profile needs one.")
    places = along.places
    if extension in (".csv", ".npy"):
        table = np.column_stack([along.arcs, along.points, places.faces, places.weights, *values.values()])
        write_array(path, table, ["arc", "x", "y", "z", "face", "b0", "b1", "b2", *values])
        return
    with whole_file(path) as temporary, temporary.open("wb") as file:
        if extension == ".vtp":
            line = [np.arange(len(along.points))]
            write_poly_data(file, along.points, lines=line, point_data={"arc": along.arcs, **values})
        else:
            points = [
                [f, b0, b1] for f, (b0, b1, _) in zip(places.faces.tolist(), places.weights.tolist(), strict=True)
            ]
            record = {"points": points, "method": along.label, "length": along.length, "arcs": along.arcs.tolist()}
            record["fields"] = {name: column.tolist() for name, column in values.items()}
            file.write((json.dumps(record) + "\n").encode())
