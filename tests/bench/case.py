"""The meshes that are measured, each with what several rows need of it, and how errors are told."""

from functools import cache, cached_property

import numpy as np

from bihdist_core import BiharmonicDistance, Surface
from bihdist_core.laplacian import Component

from . import peers
from .size import Size
from .timing import Comparison, alternate

EXACT = 1e-7
"""A single distance may be off by this share: next to the source digits cancel."""


class Case:
    """One mesh, and what several rows need of it, made once."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray, size: Size) -> None:
        self.arrays, self.size = (vertices, faces), size
        random = np.random.default_rng(1)
        self.sources = random.choice(len(vertices), min(size.sources, len(vertices)), replace=False)
        near = faces[(faces == self.sources[0]).any(axis=1)][0]
        self.targets = np.array([v for v in [*near, *random.choice(len(vertices), 20)] if v != self.sources[0]])

    @property
    def source(self) -> int:
        return int(self.sources[0])

    @property
    def count(self) -> str:
        """Its vertices, in words."""
        return f"{len(self.arrays[0]):,}"

    def set_up(self) -> BiharmonicDistance:
        """From arrays to a distance that has answered once."""
        distance = BiharmonicDistance(Surface(*self.arrays))
        distance.from_source(self.source)
        return distance

    @cached_property
    def distance(self) -> BiharmonicDistance:
        return self.set_up()

    @property
    def component(self) -> Component:
        return self.distance.laplacian.components[0]

    @cached_property
    def heat_peer(self):
        solver = peers.heat_solver(*self.arrays)
        solver.compute_distance(self.source)
        return solver

    @cached_property
    def reference(self) -> peers.Reference:
        return peers.Reference(self.component)

    def error(self, values: np.ndarray) -> float:
        """Largest relative difference of distances from the source to the targets."""
        return difference(values, self.reference.biharmonic(self.source, self.targets))

    @cached_property
    def one_field(self) -> Comparison:
        """Row 2's times, which other rows are measured by."""
        distance, peer = self.distance, self.heat_peer
        next_ours, next_peer = iter(np.tile(self.sources, 100)), iter(np.tile(self.sources, 100))
        return alternate(
            lambda: distance.from_source(int(next(next_ours))),
            lambda: peer.compute_distance(int(next(next_peer))),
            3 * self.size.rounds,
            self.size.repeat,
        )


@cache
def main_case(size: Size) -> Case:
    return Case(*size.main_mesh(), size)


def difference(values: np.ndarray, reference: np.ndarray, over: float | None = None) -> float:
    """Largest relative difference; of values that are 0 in both, none."""
    size = np.maximum(np.abs(reference), 1e-300) if over is None else over
    return float((np.abs(np.asarray(values, float) - reference) / size).max())
