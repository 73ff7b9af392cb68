"""Which parts of curves on a surface are seen: hidden lines removed exactly, not by the pixels of a picture.

What is seen of a curve changes only where it crosses, in the picture, a fold of the surface that is nearer: an edge
whose faces lie to the same side of it, or that has not two faces.  Between such crossings a curve is seen as a whole or
not at all, which rays from the camera decide, several for each piece.  Only where a surface passes through itself does
this fail; there the rays of a piece disagree, and the place where they change is found by halving.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator

from bihdist_core import Surface
from bihdist_core.analysis.chains import chains

from ..drawing.camera import Projection
from .crossings import crossings

RAY_EVERY = 5.0
"""Pixels between the rays that decide about a piece."""

SHORTEST = 0.25
"""Pixels: shorter pieces are as their neighbours are."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve on the surface: points (k, 3) whose neighbours share a face, and the mesh edge (k, 2) each lies on."""

    points: np.ndarray
    edges: np.ndarray
    closed: bool = False


class Sight:
    """A surface as a camera sees it in a picture of `size` pixels; pixels are real numbers, y down."""

    def __init__(self, surface: Surface, mesh: vtkPolyData, projection: Projection, size: tuple[float, float]) -> None:
        self.surface = surface
        self._projection = projection
        self._size = size
        # A ray takes this locator 0.02 ms where the picker's blocks take 0.5 (112,000 vertices), and a figure has
        # thousands of rays; while it is built it holds the interpreter lock, which the window cannot afford.
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(mesh)
        self._locator.BuildLocator()
        extent = np.ptp(surface.vertices[np.unique(surface.faces)], axis=0)
        self._tolerance = 1e-7 * float(np.linalg.norm(extent))
        self._at = self.pixels(surface.vertices)
        self.folds = self._folds()
        a, b = self._at[self.folds[:, 0]], self._at[self.folds[:, 1]]
        self._fold_ends = np.stack([a, b], 1)
        count = len(surface.vertices)
        self._fold_keys = np.sort(self.folds.min(axis=1) * count + self.folds.max(axis=1))

    def pixels(self, points: np.ndarray) -> np.ndarray:
        """(n, 3): x and y in pixels, and the distance along the line of sight."""
        x, y, depth = self._projection(points).T
        width, height = self._size
        return np.column_stack([(x + 1) / 2 * width, (1 - y) / 2 * height, depth])

    def sees(self, point: np.ndarray, slack: float = 0.0) -> bool:
        """Whether nothing stands more than `slack` before a point (3,) of the surface."""
        eye = self._projection.position
        way = point - eye
        t, where, cell = mutable(0.0), [0.0] * 3, mutable(0)
        # A little beyond: the ray meets the point's own face at t = 1, give or take the rounding.
        if not self._locator.IntersectWithLine(eye, eye + 1.001 * way, 0.0, t, where, [0.0] * 3, mutable(0), cell):
            return True
        return float(np.linalg.norm(np.array(where) - eye)) >= float(np.linalg.norm(way)) - self._tolerance - slack

    def visible(self, curves: Iterable[Curve], slack: float = 0.0) -> list[list[tuple[np.ndarray, bool]]]:
        """For each curve its visible parts: points (k, 2) in pixels, and whether the part is closed.

        slack: what stands before a point by less does not hide it.
        """
        whole = list(curves)
        kept = [(k, part) for k, curve in enumerate(whole) for part in self._before_the_camera(curve)]
        result: list[list[tuple[np.ndarray, bool]]] = [[] for _ in whole]
        if not kept:
            return result
        curves = [part for _, part in kept]
        rings = [np.append(np.arange(len(c.points)), [0] if c.closed else []).astype(int) for c in curves]
        points = np.concatenate([c.points[r] for c, r in zip(curves, rings, strict=True)])
        edges = np.concatenate([c.edges[r] for c, r in zip(curves, rings, strict=True)])
        at = self.pixels(points)
        stops = np.cumsum([len(r) for r in rings])
        segments = np.setdiff1d(np.arange(len(points) - 1), stops - 1)
        segment, share = self._hidden_from(at, segments)
        keys = edges.min(axis=1) * len(self.surface.vertices) + edges.max(axis=1)
        place = np.searchsorted(self._fold_keys, keys).clip(max=max(len(self._fold_keys) - 1, 0))
        on_fold = np.flatnonzero(self._fold_keys[place] == keys) if len(self._fold_keys) else np.empty(0, int)
        splits = np.sort(np.concatenate([segment + share, on_fold]))
        for (k, curve), stop in zip(kept, stops, strict=True):
            start = stop - len(curve.points) - curve.closed
            inside = splits[np.searchsorted(splits, start, "right") : np.searchsorted(splits, stop - 1)]
            line = _Line(points[start:stop], at[start:stop], self, slack)
            result[k] += line.visible(inside - start, curve.closed)
        return result

    def outlines(self) -> list[tuple[np.ndarray, bool]]:
        """The visible parts of all folds: points (k, 2) in pixels, and whether the part is closed."""
        curves = []
        for chain, closed in chains(self.folds):
            # Where an outline turns behind the surface is found by rays: as places on no edge of the mesh.
            curves.append(Curve(self.surface.vertices[chain], np.stack([chain, chain], 1), closed))
        # The folds of a mesh go zigzag, a hair before and behind its faces.
        return [part for parts in self.visible(curves, 3e4 * self._tolerance) for part in parts]

    # ------------------------------------------------------------------ where visibility may change
    def _folds(self) -> np.ndarray:
        """(k, 2) edges at which the surface turns away, ends, or meets more than one other face."""
        f = self.surface.faces
        half = np.stack([f, np.roll(f, -1, axis=1)], -1).reshape(-1, 2)
        opposite = np.roll(f, -2, axis=1).ravel()
        half.sort(axis=1)
        key = half[:, 0] * len(self.surface.vertices) + half[:, 1]
        order = np.argsort(key, kind="stable")
        first = np.flatnonzero(np.append(True, np.diff(key[order]) != 0))
        count = np.diff(np.append(first, len(order)))
        edges = half[order[first]]
        two = count == 2
        a, b = (self._at[edges[two, k], :2] for k in range(2))
        one, other = (self._at[opposite[order[first[two] + k]], :2] for k in range(2))
        turns = _cross(b - a, one - a) * _cross(b - a, other - a) >= 0
        fold = ~two
        fold[two] = turns
        return edges[fold]

    def _before_the_camera(self, curve: Curve) -> list[Curve]:
        """The curve, or what is left of it without the points behind the camera."""
        before = self.pixels(curve.points)[:, 2] > 0
        if before.all():
            return [curve]
        ends = np.flatnonzero(np.diff(np.concatenate([[0], before.astype(int), [0]])))
        return [Curve(curve.points[a:b], curve.edges[a:b]) for a, b in ends.reshape(-1, 2) if b - a >= 2]

    def _hidden_from(self, at: np.ndarray, segments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(k,) segments that pass behind a fold, and the share (k,) of the segment in space at which they do."""
        ends = np.stack([at[segments], at[segments + 1]], 1)
        i, j, s, r = crossings(ends[..., :2], self._fold_ends[..., :2])
        z0, z1 = ends[i, 0, 2], ends[i, 1, 2]
        e0, e1 = self._fold_ends[j, 0, 2], self._fold_ends[j, 1, 2]
        # Seen in perspective, it is 1 / depth that is linear in the picture.
        behind = 1 / ((1 - s) / z0 + s / z1) > 1 / ((1 - r) / e0 + r / e1) + self._tolerance
        i, s, z0, z1 = i[behind], s[behind], z0[behind], z1[behind]
        return segments[i], s * z0 / (z1 + s * (z0 - z1))


class _Line:
    """One curve; places on it are numbers: 2.25 is a quarter of the way from point 2 to point 3."""

    def __init__(self, points: np.ndarray, at: np.ndarray, sight: Sight, slack: float) -> None:
        self._points, self._sight, self._slack = points, sight, slack
        steps = np.linalg.norm(np.diff(at[:, :2], axis=0), axis=1)
        self._length = np.append(0.0, np.cumsum(steps))

    def visible(self, splits: np.ndarray, closed: bool) -> list[tuple[np.ndarray, bool]]:
        last = len(self._points) - 1
        bounds = np.unique(np.concatenate([[0.0], splits, [last]]))
        pieces: list[list] = []
        for start, stop in pairwise(bounds):
            for piece in self._decided(start, stop):
                if pieces and pieces[-1][2] == piece[2]:
                    pieces[-1][1] = piece[1]
                else:
                    pieces.append(list(piece))
        pieces = self._without_specks(pieces)
        runs = [(start, stop) for start, stop, seen in pieces if seen]
        if not runs:
            return []
        if runs == [(0.0, float(last))]:
            part = self._cut(0.0, last)
            return [(part[:-1], True)] if closed else [(part, False)]
        parts = [self._cut(start, stop) for start, stop in runs]
        if closed and runs[0][0] == 0 and runs[-1][1] == last and len(runs) > 1:
            parts[0] = np.concatenate([parts.pop(), parts[0][1:]])
        return [(part, False) for part in parts]

    def _decided(self, start: float, stop: float) -> list[tuple[float, float, bool]]:
        """A piece as one or, if the surface passes through itself there, several."""
        low, high = np.interp([start, stop], np.arange(len(self._length)), self._length)
        if high - low < SHORTEST:
            return [(start, stop, self._sees((start + stop) / 2))]
        count = int(np.clip(np.ceil((high - low) / RAY_EVERY), 3, 400))
        lengths = low + (high - low) * (np.arange(count) + 0.5) / count
        places = np.clip(np.interp(lengths, self._length, np.arange(len(self._length))), start, stop)
        seen = np.array([self._sees(place) for place in places])
        if count <= 4 or seen.mean() > 0.95 or seen.mean() < 0.05:
            return [(start, stop, bool(seen.mean() > 0.5))]
        changes = np.flatnonzero(seen[1:] != seen[:-1])
        cuts = [start, *(self._change(places[k], places[k + 1], bool(seen[k])) for k in changes), stop]
        first = bool(seen[0])
        return [(a, b, first ^ bool(k % 2)) for k, (a, b) in enumerate(pairwise(cuts))]

    def _change(self, start: float, stop: float, seen: bool) -> float:
        """Where between two places that differ the curve is no longer as it was at the first."""
        for _ in range(14):
            middle = (start + stop) / 2
            if self._sees(middle) == seen:
                start = middle
            else:
                stop = middle
        return (start + stop) / 2

    def _without_specks(self, pieces: list[list]) -> list[list]:
        """Pieces too short to be seen join their neighbours."""
        kept: list[list] = []
        for start, stop, seen in pieces:
            low, high = np.interp([start, stop], np.arange(len(self._length)), self._length)
            speck = high - low < SHORTEST and len(pieces) > 1
            if kept and (speck or kept[-1][2] == seen):
                kept[-1][1] = stop
            elif speck:
                kept.append([start, stop, not seen])
            else:
                kept.append([start, stop, seen])
        return kept

    def _sees(self, place: float) -> bool:
        k = min(int(place), len(self._points) - 2)
        return self._sight.sees(self._points[k] + (place - k) * (self._points[k + 1] - self._points[k]), self._slack)

    def _cut(self, start: float, stop: float) -> np.ndarray:
        """(k, 2) pixels from one place to another."""
        places = np.concatenate([[start], np.arange(np.floor(start) + 1, np.ceil(stop)), [stop]])
        k = np.minimum(places.astype(int), len(self._points) - 2)
        share = (places - k)[:, None]
        points = (1 - share) * self._points[k] + share * self._points[k + 1]
        return self._sight.pixels(points)[:, :2]


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
