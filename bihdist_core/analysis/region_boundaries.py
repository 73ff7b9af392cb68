"""The boundaries of regions as curves, and files of them."""

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..formats.curve_output import Curve, write_curves
from ..surface import Surface
from .chains import chains
from .regions import Regions


@dataclass(frozen=True, eq=False)
class Boundary:
    """A curve between two regions: points (k, 3), in order along it; a closed one does not repeat its first point.

    between: the numbers of the regions, the smaller first.  Open curves end where three regions meet, or at the
    boundary of the surface.  corners, weights: (k, 3) each point as a place among the vertices of a face that holds it.
    """

    between: tuple[int, int]
    points: np.ndarray
    closed: bool
    corners: np.ndarray
    weights: np.ndarray

    @property
    def length(self) -> float:
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def region_boundaries(surface: Surface, regions: Regions) -> list[Boundary]:
    """The boundary segments of regions put end to end, in the order of the regions between."""
    ends = _named_ends(surface, regions)
    points, weights = regions.segments.reshape(-1, 3), regions.weights.reshape(-1, 3)
    corners = np.repeat(surface.faces[regions.faces], 2, axis=0)
    found = []
    pairs, of_segment = np.unique(regions.between, axis=0, return_inverse=True)
    for number, pair in enumerate(pairs.tolist()):
        mine = np.flatnonzero(of_segment.reshape(-1) == number)
        named = ends[mine]
        where = {
            int(end): 2 * int(s) + k
            for s, pair_ends in zip(mine, named, strict=True)
            for k, end in enumerate(pair_ends)
        }
        for chain, closed in chains(named):
            at = [where[int(end)] for end in chain]
            found.append(Boundary((pair[0], pair[1]), points[at], closed, corners[at], weights[at]))
    return found


def write_boundaries(path: str | os.PathLike[str], curves: Sequence[Boundary], labels: Sequence[int] = ()) -> None:
    """Write boundaries as .csv, .obj, .vtp or .json (see `write_curves`), with the numbers `region` and `other`.

    labels: (k,) what to write for region i, such as the id of its pin; i by default.  Raises OutputError as there.
    """
    written = []
    for curve in curves:
        region, other = (int(labels[i]) if len(labels) else i for i in curve.between)
        written.append(Curve(curve.points, curve.closed, {"region": region, "other": other}))
    write_curves(path, written, ["region", "other"], "boundaries")


def _named_ends(surface: Surface, regions: Regions) -> np.ndarray:
    """(s, 2) numbers of the segments' ends: the same for ends in the same place, as rounding does not tell."""
    corners = surface.faces[regions.faces]
    names: dict[tuple, int] = {}
    numbers = np.empty((len(corners), 2), np.int64)
    for s in range(len(corners)):
        face, pair = int(regions.faces[s]), regions.between[s].tolist()
        before = None
        for end in range(2):
            third = int(regions.cut_by[s, end])
            on = corners[s][regions.weights[s, end] > 0].tolist()
            # A meeting is known by its face and regions, a crossing by its edge and regions.
            key: tuple = ("meeting", face, *sorted([*pair, third])) if third >= 0 else ("on", *sorted(on), *pair)
            if len(on) == 1:
                key = ("vertex", *on)
            if key == before:
                key = (*key, "too")
            numbers[s, end], before = names.setdefault(key, len(names)), key
    return numbers
