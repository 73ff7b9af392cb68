"""Rows 5 and 6: eigenpairs, diffusion at four times, and geodesic distance by the heat method."""

from collections.abc import Iterator

import numpy as np

from bihdist_core import BiharmonicDistance, DiffusionDistance, GeodesicDistance, Surface
from bihdist_core.distances.diffusion import TOLERANCE
from bihdist_core.distances.heat_geodesic import heat_matrix, heat_time
from bihdist_core.solver.spectrum import Spectrum, smallest_eigenpairs

from . import peers
from .case import Case, difference, main_case
from .meshes import genus_two
from .size import Size
from .table import Line, compared
from .timing import alternate

HEAT = 1e-6
RESIDUAL, EIGENVALUE = 1e-4, 1e-6


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
    elongated = Surface(*genus_two(len(case.arrays[0])))
    for words, surface in ((f"{len(elongated.vertices):,}, elongated", elongated), (case.count, case.distance.surface)):
        for t in (1.0, 1 / 4, 1 / 15, 1 / 60):
            result = alternate(
                lambda s=surface, t=t: DiffusionDistance(s, t), lambda s=surface: BiharmonicDistance(s), 1
            )
            yield compared(
                5,
                f"diffusion, t = {t:.3g}, ready for a source, {words}",
                result,
                bound=6.5,
                error=result.answer.accuracy,
                tolerance=2 * TOLERANCE,  # TOLERANCE for what is left out, and what residuals of eigenpairs may add
                note="peer: the biharmonic distance",
            )
    diffusion, biharmonic, times = result.answer, case.distance, iter(np.linspace(1 / 60, 1 / 58, 99))
    sources = iter(range(99))
    result = alternate(lambda: diffusion.from_source(next(sources)), lambda: biharmonic.from_source(next(sources)), 3)
    yield compared(5, f"diffusion, from another source, {case.count}", result, bound=10.0, note="peer: biharmonic")
    result = alternate(
        lambda: DiffusionDistance(diffusion.laplacian, float(next(times))).from_source(7),
        lambda: biharmonic.from_source(7),
        3,
    )
    yield compared(5, f"diffusion, another t, {case.count}", result, bound=4.0, note="peer: biharmonic, a source")


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
