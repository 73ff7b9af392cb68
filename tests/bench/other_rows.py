"""Rows 5 and 6: eigenpairs and what diffusion needs of them, and geodesic distance by the heat method."""

from collections.abc import Iterator

import numpy as np

from bihdist_core import DiffusionDistance, GeodesicDistance, Laplacian, Surface
from bihdist_core.distances.diffusion import TOLERANCE
from bihdist_core.distances.heat_geodesic import heat_matrix, heat_time
from bihdist_core.solver.spectrum import Spectrum, smallest_eigenpairs

from . import peers
from .case import Case, difference, main_case
from .size import Size
from .table import Line, compared
from .timing import alternate

HEAT = 1e-6
RESIDUAL, EIGENVALUE = 1e-4, 1e-6
WEIGHT = 1e-8
"""Leaving out smaller ones is the obvious rule, and off by up to 1e-4 of the maximum."""


def eigenpairs(size: Size) -> Iterator[Line]:
    case = main_case(size)
    component = case.component
    for count, bound in zip(size.eigenpairs, (0.2, 0.13), strict=True):

        def ours(count: int = count) -> Spectrum:
            return smallest_eigenpairs(component.stiffness, component.areas, component.solve, count, tolerance=RESIDUAL)

        def arpack(count: int = count) -> np.ndarray:
            return peers.arpack_eigenvalues(component, count, RESIDUAL)

        result = alternate(ours, arpack, 1)
        yield compared(
            5,
            f"{count} eigenpairs, {case.count}",
            result,
            bound=bound,
            error=difference(result.answer.eigenvalues, result.peer_answer),
            tolerance=EIGENVALUE,
            note=f"residuals up to {result.answer.residuals.max():.0e}; peer: scipy eigsh, the same factor",
        )
    surface = case.distance.surface
    for t in (4.0, 1.0, 1 / 4):
        result = alternate(lambda t=t: DiffusionDistance(surface, t), lambda t=t: by_weights(surface, t), 1)
        yield compared(
            5,
            f"diffusion, t = {t:.3g}, right to {TOLERANCE:.0e}, {case.count}",
            result,
            bound=2.0,
            error=result.answer.accuracy,
            tolerance=2 * TOLERANCE,  # TOLERANCE for what is left out, and what residuals of eigenpairs may add
            note=f"{result.answer.pair_count(0)} eigenpairs; peer: the {result.peer_answer} of a weight above "
            f"{WEIGHT:.0e} of the first",
        )


def by_weights(surface: Surface, t: float) -> int:
    """Find the eigenpairs of a weight that is no less than a share of the first; how many there are."""
    component = Laplacian(surface).components[0]
    component.factor(diagonals=True)
    found = component.spectrum(16)
    last = found.eigenvalues[0] * (1 - np.log(WEIGHT) / t)
    while (value := found.eigenvalues[-1]) < last:
        found = component.spectrum(int(1.1 * len(found.eigenvalues) * last / value + 4))
    return int(np.searchsorted(found.eigenvalues, last))


def heat_geodesic(size: Size) -> Iterator[Line]:
    case = main_case(size)

    def ours() -> GeodesicDistance:
        distance = GeodesicDistance(Surface(*case.arrays), method="heat")
        distance.from_source(case.source)
        return distance

    result = alternate(ours, lambda: peers.heat_solver(*case.arrays), size.rounds)
    distance = result.answer
    error = difference(distance.from_source(case.source), slow_heat(case))
    yield compared(
        6,
        f"heat geodesic, set-up, {case.count}",
        result,
        bound=0.2,
        error=error,
        tolerance=HEAT,
        note="peer: potpourri3d, heat solver constructed",
    )
    result = alternate(
        lambda: distance.from_source(case.source),
        lambda: case.heat_peer.compute_distance(case.source),
        3 * size.rounds,
        size.repeat,
    )
    yield compared(
        6,
        f"heat geodesic, one field, {case.count}",
        result,
        bound=0.2,
        note="peer: one potpourri3d heat solve",
    )


def slow_heat(case: Case) -> np.ndarray:
    """(n,) the heat method, step by step, with SuperLU."""
    from scipy.sparse.linalg import splu

    component, surface = case.component, case.distance.surface
    matrix = heat_matrix(component.stiffness, component.areas, heat_time(surface))
    b = np.zeros(len(surface.vertices))
    # Heat far away is smaller than any double where it starts from 1.
    b[case.source] = 1e200
    u = splu(matrix.tocsc()).solve(b)
    x, f = surface.vertices, surface.faces
    side = [x[f[:, (k + 2) % 3]] - x[f[:, (k + 1) % 3]] for k in range(3)]
    normal = np.cross(side[0], side[1])
    scale = np.abs(u[f]).max(axis=1)
    gradient = sum(np.cross(normal, side[k]) * (u[f[:, k]] / scale)[:, None] for k in range(3))
    flow = -gradient / np.linalg.norm(gradient, axis=1)[:, None]
    divergence = np.zeros(len(x))
    for k in range(3):
        turned = np.cross(normal, side[k]) / np.linalg.norm(normal, axis=1)[:, None] / 2
        np.add.at(divergence, f[:, k], np.einsum("ij,ij->i", turned, flow))
    phi = case.reference.solve(divergence[:, None])[:, 0]
    return np.maximum(phi - phi[case.source], 0)
