"""Distances of sound and of damaged meshes by one library, for sanitizers to watch; a program of its own.

LD_PRELOAD=... python -m tests.packaging.mutated_meshes FOLDER NAME
"""

import sys
import warnings
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, Surface
from bihdist_core.errors import BihdistError
from bihdist_core.kernel import library
from bihdist_core.solver.elimination_tree import EliminationTree
from bihdist_core.solver.factor import Factor
from tests.shapes import bumpy, fin, grid, slivers, tetrahedron, torus, two_pieces

MUTATED = 300
MATRICES = 100


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


def main(folder: str, name: str) -> None:
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
    still = sum(measure(mutated(sound[rng.integers(len(sound) - 1)], rng)) for _ in range(MUTATED))
    factored = sum(factor(int(rng.integers(1, 200)), rng) for _ in range(MATRICES))
    print(f"{still} of {MUTATED} mutated meshes have distances, {factored} of {MATRICES} matrices a factor")


if __name__ == "__main__":
    main(*sys.argv[1:])
