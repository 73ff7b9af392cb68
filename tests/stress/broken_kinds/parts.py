"""What kinds of broken meshes are made of: sound meshes, some of their elements, and the table that a kind goes into.

The arrays are as a file would have them: with coordinates that are no numbers and with ids that do not exist.
"""

from collections.abc import Callable

import numpy as np

from tests.shapes import bumpy, grid, torus

Rng = np.random.Generator
Mesh = tuple[np.ndarray, np.ndarray]
Make = Callable[[Rng], Mesh]
Kinds = dict[str, Make]
"""Functions of a random generator to vertices (n, 3) and faces (m, 3), by their names in words."""


def kind_in(kinds: Kinds) -> Callable[[Make], Make]:
    """A decorator that puts a function among some kinds, called by its name."""

    def put(make: Make) -> Make:
        kinds[make.__name__.replace("_", " ")] = make
        return make

    return put


def whole(rng: Rng) -> Mesh:
    """A sound mesh, closed or with boundary, of a random size."""
    n = int(rng.integers(20, 60))
    surface = [bumpy(n, int(rng.integers(9))), grid(n // 8, 5), torus(n // 6 + 3, 5)][rng.integers(3)]
    return surface.vertices.copy(), surface.faces.copy()


def a_few(count: int, rng: Rng, at_most: int = 4) -> np.ndarray:
    """Different numbers below a count."""
    return rng.choice(count, min(count, int(rng.integers(1, at_most + 1))), replace=False)


def joined(*meshes: Mesh) -> Mesh:
    """Meshes beside each other, with nothing in common."""
    starts = np.cumsum([0, *(len(x) for x, _ in meshes)])
    return np.concatenate([x for x, _ in meshes]), np.concatenate(
        [faces + start for (_, faces), start in zip(meshes, starts, strict=False)]
    )
