"""Maps between the meshes of a set, and how far they are from the truth."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core import Laplacian, read_surface
from bihdist_core.applications.map_errors import (
    LIMIT,
    error_curve,
    error_distance,
    map_errors,
    sampled_vertices,
)
from bihdist_core.arrays import FloatArray
from bihdist_core.errors import ParameterError
from bihdist_core.formats.vertex_maps import IDENTITY, MAP_FORMATS, read_map

from .jobs import BatchMesh, Computed

WITH_PARTNERS = "errors_with_partners"
"""The errors where the symmetric partner of what is right counts as right, too."""
BETWEEN = ("-", "__", "_to_", "_")
"""The separators between the names of two meshes in the name of a map."""


@dataclass(frozen=True)
class Map:
    """A map in a file from a mesh to another, at the path `other`.

    `truth` is a file or `identity`, `symmetry` a file with the partner of each vertex of the other mesh, or nothing.
    Errors are found at so many `samples`, at all vertices if 0.
    """

    name: str
    mesh: str
    other: str
    file: str
    truth: str
    symmetry: str = ""
    samples: int = 0

    @property
    def files(self) -> dict[str, str]:
        """The other files that the errors depend on, by what they are."""
        named = {"mapped_to": self.other, "map": self.file, "truth": self.truth, "symmetry": self.symmetry}
        return {what: path for what, path in named.items() if path and path != IDENTITY}


def found_maps(
    folder: str, meshes: dict[str, str], truth: str, symmetry: str, samples: int
) -> tuple[list[Map], dict[str, str]]:
    """Find the maps in a folder that are named by two meshes with -, _ or _to_ between them.

    Returns the maps, and why other files are none. `truth` is `identity` or a folder of files with the same names;
    `symmetry` is a path in which {name} stands for the mesh that is mapped to. Raises ParameterError without a map
    file.
    """
    place = Path(folder)
    files = sorted(f for f in place.iterdir() if f.suffix.lower() in MAP_FORMATS) if place.is_dir() else []
    if not files:
        raise ParameterError(f"There is no map in {folder}; maps are {' and '.join(MAP_FORMATS)} files in a folder.")
    found, reasons = [], {}
    endings = Counter(file.stem for file in files)
    for file in files:
        if endings[file.stem] > 1:
            same = " and ".join(str(each) for each in files if each.stem == file.stem)
            reasons[file.stem] = f"{same} have the same name; rename one."
            continue
        try:
            one, other = _named(file, meshes)
        except ParameterError as error:
            reasons[file.stem] = str(error)
            continue
        right = truth
        if truth != IDENTITY:
            beside = [Path(truth) / f"{file.stem}{ending}" for ending in (file.suffix, *MAP_FORMATS)]
            right = next((str(each.resolve()) for each in beside if each.is_file()), "")
            if not right:
                reasons[file.stem] = f"There is no truth for {file} in {truth}, under the same name."
                continue
        partner = symmetry.replace("{name}", other)
        found.append(Map(file.stem, meshes[one], meshes[other], str(file.resolve()), right, partner, samples))
    return found, reasons


def _named(file: Path, meshes: Iterable[str]) -> tuple[str, str]:
    """Return the names of the two meshes in that of a map."""
    names = set(meshes)
    ways = set()
    for between in BETWEEN:
        parts = file.stem.split(between)
        for k in range(1, len(parts)):
            one, other = between.join(parts[:k]), between.join(parts[k:])
            if one in names and other in names:
                ways.add((one, other))
    if len(ways) != 1:
        what = "does not name two of the meshes" if not ways else "can be read in two ways"
        raise ParameterError(f"{file} {what}; call the map of cat to dog cat-dog{file.suffix}.")
    return ways.pop()


def evaluate_map(mesh: BatchMesh, given: Map) -> Computed:
    """Compute the errors (m,) of a map over the root of the area, at all vertices or at samples."""
    other = Laplacian(read_surface(given.other), mesh.wanted.areas, mesh.wanted.operator)
    found, right = (read_map(each, mesh.surface, other.surface) for each in (given.file, given.truth))
    ids = sampled_vertices(len(found), given.samples or None)
    partners = read_map(given.symmetry, other.surface, other.surface) if given.symmetry else None
    distance = error_distance(other, len(np.unique(right[ids])))
    errors = map_errors(distance, found[ids], right[ids])
    metadata: dict[str, Any] = {**_numbers(errors)}
    arrays = {"errors": errors}
    if partners is not None:
        arrays[WITH_PARTNERS] = map_errors(distance, found[ids], right[ids], partners)
        metadata |= {f"{name}_with_partners": n for name, n in _numbers(arrays[WITH_PARTNERS]).items()}
    metadata |= {
        "distance": distance.identity or distance.label,
        "parameters": {"method": distance.method},
        "label": distance.label,
        "unit": "no unit",
        "normalisation": "over the root of the area of the mesh that is mapped to",
        "mapped_to": other.surface.name,
        "vertices_mapped": "all" if len(ids) == len(found) else ids.tolist(),
        "area_under_curve_to": LIMIT,
    }
    return Computed(arrays, metadata)


def _numbers(errors: FloatArray) -> dict[str, float | None]:
    """Return the numbers of an error curve, None for those that are infinite as a vertex has no image."""
    curve = error_curve(errors)
    numbers = {"mean": curve.mean, "median": curve.median, "area_under_curve": curve.area}
    return {name: number if np.isfinite(number) else None for name, number in numbers.items()}
