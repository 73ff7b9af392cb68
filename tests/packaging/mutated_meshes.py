"""Distances of sound and of damaged meshes by one library, for sanitizers to watch; a program of its own.

LD_PRELOAD=... python -m tests.packaging.mutated_meshes FOLDER NAME [COUNT]
"""

import sys
import warnings
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, PointCloud, Surface
from bihdist_core.distances import exact_geodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.errors import BihdistError, Cancelled
from bihdist_core.intrinsic import OPERATORS
from bihdist_core.kernel import library
from bihdist_core.operators import operators
from bihdist_core.solver.elimination_tree import EliminationTree
from bihdist_core.solver.factor import Factor
from bihdist_core.sources.pieces import Pieces
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import bumpy, fin, grid, slivers, tetrahedron, torus, two_pieces

MUTATED = 150
MATRICES = 60
HARD_FACES = 60
WINDOWS = 10_000
"""Of a run of exact geodesics; a few meshes would take any number."""


def mutated(surface: Surface, rng: np.random.Generator) -> Surface:
    """The surface after one to four damages to its positions and faces."""
    x, faces = surface.vertices.copy(), surface.faces.copy()
    for damage in rng.integers(8, size=rng.integers(1, 5)):
        some, corner = rng.integers(len(x), size=1 + len(x) // 10), rng.integers(len(faces), size=1 + len(faces) // 20)
        match damage:
            case 0:
                x[some] += rng.normal(size=(len(some), 3)) * 10.0 ** rng.integers(-3, 3)
            case 1:
                x[some] = x[some[0]]
            case 2:
                x *= 10.0 ** rng.integers(-120, 120)
            case 3:
                x[:, rng.integers(3)] *= rng.choice([0, 1e-9, 1e6])
            case 4:
                faces[corner, rng.integers(3)] = rng.integers(len(x), size=len(corner))
            case 5:
                faces = np.delete(faces, corner, axis=0)
            case 6:
                faces = np.concatenate([faces, faces[corner][:, ::-1]])
            case 7:
                faces[corner, 0] = some[0]
    return Surface(x, faces)


def measure(surface: Surface) -> bool:
    """Whether a surface has distances."""
    try:
        distance = BiharmonicDistance(surface)
        distance.from_source(len(surface.vertices) // 2)
        distance.pairwise(np.arange(min(9, len(surface.vertices))))
        CommuteTimeDistance(distance.laplacian).from_source(0)
    except BihdistError:
        return False
    return True


def triangulate(surface: Surface) -> bool:
    """Whether a surface has a Delaunay triangulation and a tufted cover, and its points, also in a plane, triangles."""
    try:
        for operator in OPERATORS[1:]:
            operators(surface, operator=operator)
        PointCloud(surface.vertices)
        PointCloud(surface.vertices * (1, 1, 0))
    except BihdistError:
        return False
    return True


def go_over(surface: Surface, rng: np.random.Generator) -> bool:
    """Whether exact geodesics come to an end on a surface: fields from all kinds of sources, distances, and paths."""
    face = rng.integers(len(surface.faces), size=8)
    start, stop = rng.dirichlet([1, 1, 1], (2, len(face)))
    start[0], stop[-1] = np.eye(3)[rng.integers(3, size=2)]
    start[1] = stop[1] = np.roll([0.0, *rng.dirichlet([1, 1])], rng.integers(3))
    places, lines = (
        Pieces(face, surface.faces[face], start, other, (start != other).any(axis=1)) for other in (start, stop)
    )
    size = float(np.ptp(surface.vertices, axis=0).max())
    try:
        solver = ExactGeodesic(surface)
        for sources in (int(surface.faces[face[0], 0]), surface.faces[face, 1], places.select(np.arange(3)), lines):
            count = len(sources) if isinstance(sources, Pieces) else np.size(sources)
            offsets = rng.uniform(0, size / 9, count) if rng.random() < 0.3 else None
            field = solver.field(sources, places, radius=rng.choice([0.3 * size, size, np.inf]), offsets=offsets)
            for target in np.flatnonzero(np.isfinite(field.distances))[:: 1 + len(surface.vertices) // 5]:
                field.path(int(target))
            for target in np.flatnonzero(np.isfinite(field.at_places)):
                field.path_to_place(int(target))
        solver.between(places, places.select(np.arange(len(face))[::-1]))
        solver.columns(surface.faces[face[:2], 2])
    except BihdistError:
        return False
    return True


def is_cancelled(surface: Surface) -> bool:
    """Whether exact geodesics stop when they are told to, and answer afterwards."""

    def stop(_share: float, _text: str) -> None:
        raise Cancelled

    solver = ExactGeodesic(surface)
    try:
        solver.columns(range(9), stop)
    except Cancelled:
        return bool(np.isfinite(solver.distances(0, radius=0.1)).any())
    return False


def factor(n: int, rng: np.random.Generator) -> bool:
    """Whether a random matrix is factored; some are not positive definite, some have a row that is full."""
    pattern = sp.random(n, n, min(1.0, rng.uniform(0, 8 / n)), random_state=rng)
    pattern = sp.lil_matrix(pattern + pattern.T)
    if rng.random() < 0.3:
        hub = rng.integers(n)
        pattern[hub, :] = pattern[:, hub] = 1
    matrix = sp.csr_matrix(pattern + sp.diags(rng.uniform(0, 40, n)))
    tree = EliminationTree(matrix, rng.normal(size=(n, 3)) * rng.choice([0, 1, 1e200]))
    try:
        made = Factor(tree, matrix, rng.uniform(0, 1, n))
        made.solve(rng.normal(size=(n, 3)))
        made.sandwich_columns(rng.integers(n, size=5))
    except BihdistError:
        return False
    return True


def main(folder: str, name: str, count: str = str(MUTATED)) -> None:
    """Measure them all, and say how many there were."""
    library.FOLDER = Path(folder)
    watched = library._loaded(name)
    assert watched is not None
    library._loaded = lambda name: watched
    warnings.simplefilter("ignore")
    rng = np.random.default_rng(1)
    sound = [tetrahedron(), two_pieces(), fin(), slivers(), grid(9, 7), torus(), bumpy(120), bumpy(21_000)]
    good = sum(measure(surface) for surface in sound)
    assert good == len(sound), good
    assert is_cancelled(sound[-1])
    assert all(map(triangulate, sound[1:]))
    # So little room that windows have to move several times.
    exact_geodesic.FIRST_WINDOWS, exact_geodesic.MOST_WINDOWS_PER_VERTEX = 16, 0
    exact_geodesic.MOST_WINDOWS_AT_LEAST = 40 * WINDOWS
    assert all(go_over(surface, rng) for surface in [*sound[:-1], bumpy(2_000)])
    exact_geodesic.MOST_WINDOWS_AT_LEAST = WINDOWS
    number = int(count)
    meshes = [mutated(sound[rng.integers(len(sound) - 1)], rng) for _ in range(number)]
    still, flipped = (sum(map(what, meshes)) for what in (measure, triangulate))
    meshes = meshes[::2] + [Surface(*nasty_mesh(seed, HARD_FACES)) for seed in range(number // 6)]
    gone = sum(go_over(surface, rng) for surface in meshes)
    factored = sum(factor(int(rng.integers(1, 200)), rng) for _ in range(MATRICES))
    print(f"{still} of {number} mutated meshes have distances, {factored} of {MATRICES} matrices a factor")
    print(f"{flipped} of {number} mutated meshes have Delaunay triangulations")
    print(f"{gone} of {len(meshes)} mutated and hard meshes have exact geodesics")


if __name__ == "__main__":
    main(*sys.argv[1:])
