"""The laws that distances on any surface obey, whatever is wrong with it."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from bihdist_core import BiharmonicDistance, BihdistError, CommuteTimeDistance, Laplacian, Surface
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic

from .outcome import OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

VERTICES = 5
"""Of the largest component, from which fields start; and one more of another component."""
ROUNDING = 1e-12
"""Of the largest geodesic distance: some thousand roundings along a path."""
LEAST = 1e-13
"""Of the largest distance: what numbers that were rounded in another order may differ by at least."""


@dataclass
class Found:
    """The first law that is broken, "" if none is; the worst error as a multiple of its estimate; what was refused."""

    broken: str = ""
    ratio: float = 0.0
    refusals: list[str] = field(default_factory=list)

    def expect(self, holds: bool, law: str) -> None:
        """Note a law that does not hold, unless another has been before."""
        if not holds and not self.broken:
            self.broken = law

    def differ(self, found: object, expected: object, allowed: float, law: str) -> None:
        """Note by how much of what is allowed two arrays differ."""
        error = float(np.max(np.abs(np.subtract(found, expected)), initial=0.0))
        ratio = error / allowed if allowed > 0 else (np.inf if error > 0 else 0.0)
        self.ratio = max(self.ratio, ratio)
        self.expect(ratio <= 1, f"{law}: by {error:.2g}, where {allowed:.2g} is allowed")


def checked(surface: Surface, rng: np.random.Generator) -> Outcome:
    """Whether distances on a surface obey the laws; refused where each of them is refused in a sentence."""
    found = Found()
    asked = 0
    for law in (_of_exact_distances, _of_geodesics):
        asked += 1
        try:
            law(surface, rng, found)
        except BihdistError as error:
            found.refusals.append(str(error))
    faults = [fault for message in found.refusals if (fault := fault_of(message))]
    if found.broken or faults:
        return Outcome(WRONG, f"{surface.name}: {found.broken or faults[0]}", found.ratio)
    return Outcome(REFUSED if len(found.refusals) == asked else OPENED, ratio=found.ratio)


def _starts(surface: Surface, rng: np.random.Generator) -> np.ndarray:
    component = surface.component_of_vertex
    largest = np.flatnonzero(component == 0)
    others = np.flatnonzero(component > 0)
    some = rng.choice(largest, min(VERTICES, len(largest)), replace=False)
    return np.concatenate([some, rng.choice(others, min(1, len(others)), replace=False)])


def _of_exact_distances(surface: Surface, rng: np.random.Generator, found: Found) -> None:
    laplacian, ids = Laplacian(surface), _starts(surface, rng)
    for distance in (BiharmonicDistance(laplacian), CommuteTimeDistance(laplacian)):
        fields = distance.from_sources(ids.tolist())
        name = type(distance).__name__
        for component, those in _of_components(surface, ids):
            try:
                share = distance.error_estimate([component]).share
            except BihdistError as error:
                # It says that its answers there should not be used.
                found.refusals.append(str(error))
                continue
            accuracy = max(share, LEAST)
            _metric(surface, fields[:, those], ids[those], accuracy, name, found)
            _pairs(distance, fields[:, those], ids[those], accuracy, name, found)


def _of_geodesics(surface: Surface, rng: np.random.Generator, found: Found) -> None:
    ids = _starts(surface, rng)
    solver = ExactGeodesic(surface)
    fields = solver.columns(ids)
    edges = EdgeGeodesic(surface).distances(ids).reshape(len(surface.vertices), -1)
    for _, those in _of_components(surface, ids):
        _metric(surface, fields[:, those], ids[those], ROUNDING, "ExactGeodesic", found)
    there = np.isfinite(fields)
    slack = ROUNDING * np.max(fields, where=there, initial=0.0)
    straight = np.linalg.norm(surface.vertices[:, None] - surface.vertices[ids], axis=2)
    found.expect(bool((straight <= fields + slack)[there].all()), "geodesic distances below straight lines")
    found.expect(bool((fields <= edges + slack)[there].all()), "geodesic distances above those along edges")


def _of_components(surface: Surface, ids: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
    """Each component that vertices are of, and which of them are."""
    of_ids = surface.component_of_vertex[ids]
    for component in np.unique(of_ids):
        yield int(component), np.flatnonzero(of_ids == component)


def _metric(surface: Surface, fields: np.ndarray, ids: np.ndarray, accuracy: float, name: str, found: Found) -> None:
    """Of fields (n, k) from vertices (k,) of one component, with an accuracy as a fraction of the maximum."""
    inside = surface.component_of_vertex == surface.component_of_vertex[ids[0]]
    found.expect(bool(np.isfinite(fields[inside]).all()), f"{name}: not a number within a component")
    found.expect(not np.isfinite(fields[~inside]).any(), f"{name}: a number outside of the component")
    if found.broken:
        return
    found.expect(bool((fields[inside] >= 0).all()), f"{name}: below zero")
    d = fields[ids]
    allowed = 2 * accuracy * float(fields[inside].max(initial=0.0))
    found.expect(bool((np.diag(d) == 0).all()), f"{name}: not zero at the source")
    found.differ(d, d.T, allowed, f"{name}: not symmetric")
    around = (d[:, :, None] + d[None]).min(axis=1)
    found.differ(np.maximum(d, around), around, 1.5 * allowed, f"{name}: the triangle inequality")


def _pairs(distance: Distance, fields: np.ndarray, ids: np.ndarray, accuracy: float, name: str, found: Found) -> None:
    if found.broken or len(ids) < 2:
        return
    i, j = int(ids[0]), int(ids[-1])
    allowed = 2 * accuracy * float(np.nanmax(fields))
    found.differ(distance.between(i, j), fields[j, 0], allowed, f"{name}: `between` is not `from_source`")
    found.differ(distance.from_source(i)[ids], fields[ids, 0], allowed, f"{name}: `from_source` is not `from_sources`")
    found.differ(distance.pairwise(ids), fields[ids], allowed, f"{name}: `pairwise` is not `from_sources`")
