"""Random meshes with all that makes geodesic distances hard, and random sources on them.

    vertices, faces = nasty_mesh(seed=3, count=80)      # (n, 3) float64 and (80, 3) int64
    origin = random_origin(np.random.default_rng(0), faces)   # a vertex, a place in a face or a segment

There are needles and caps with heights from 1e-2 down to 1e-12 and of exactly 0, edges of length 0, vertices at one
place that no edge joins, fans of thin faces, edges of up to five faces, edges and single vertices where pieces touch,
boundary, several components, vertices of no face, and faces turned at random.  No two faces have the same vertices.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from tests.core.geodesic_reference import FacePoint, FaceSegment, Origin, Weights

STEP = 2.0**-16
"""Coordinates start as multiples, so that points at dyadic fractions of edges are exactly on them."""

FRACTIONS = (0.5, 0.25, 0.75, 2.0**-10, 1 - 2.0**-10, 2.0**-30)
HEIGHTS = (0.0, 0.0, 1e-12, 1e-9, 1e-6, 1e-2)
MOST_FACES = 5
"""Of one edge."""

Vector = npt.NDArray[np.float64]
Face = tuple[int, int, int]


def nasty_mesh(seed: int, count: int, repeated: int = 0) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """The vertices (n, 3) and the faces (count + repeated, 3) of a mesh, `repeated` of which name a vertex twice."""
    return _Mesh(np.random.default_rng([seed, count])).grown(count, repeated)


def random_origin(rng: np.random.Generator, faces: npt.NDArray[np.int64]) -> Origin:
    """A vertex, a place or a segment, sometimes on an edge or at a corner, of a face that names no vertex twice."""
    proper = [f for f, face in enumerate(faces.tolist()) if len(set(face)) == 3]
    face = int(rng.choice(proper))
    kind = rng.integers(4)
    if kind == 0:
        return int(rng.choice(faces[face]))
    if kind == 1:
        return FacePoint(face, random_weights(rng))
    if rng.random() < 0.7:
        return FaceSegment(face, random_weights(rng), random_weights(rng))
    turn = int(rng.integers(3))  # along an edge
    t, u = rng.integers(0, 9, 2) / 8
    return FaceSegment(face, _turned((0.0, t, 1 - t), turn), _turned((0.0, u, 1 - u), turn))


def random_weights(rng: np.random.Generator) -> Weights:
    """Of a place within a face, on one of its edges or at a corner; they add up to exactly 1."""
    p, q = np.sort(rng.integers(0, 1025, 2)) / 1024
    kind = rng.random()
    if kind < 0.2:
        q = p
    elif kind < 0.25:
        p = q = 0.0
    return _turned((p, q - p, 1 - q), int(rng.integers(3)))


def _turned(weights: tuple[float, float, float], turn: int) -> Weights:
    a, b, c = map(float, weights)
    return [(a, b, c), (b, c, a), (c, a, b)][turn]


class _Mesh:
    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.vertices: list[Vector] = []
        self.faces: list[Face] = []

    def grown(self, count: int, repeated: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
        steps: list[Callable[[], None]] = [self._component, self._fan, self._fin, self._split_edge, self._split_face]
        chances = [0.06, 0.08, 0.3, 0.28, 0.28]
        self._component(count)
        while len(self.faces) < count:
            before = self.vertices.copy(), self.faces.copy()
            steps[self.rng.choice(len(steps), p=chances)]()
            if len(self.faces) > count:
                self.vertices, self.faces = before
            elif self.rng.random() < 0.05 and len(self.faces) > 4:
                self.faces.pop(self.rng.integers(len(self.faces)))
        used = list(self.faces)
        for _ in range(repeated):
            a, b, _ = used[self.rng.integers(len(used))]
            self.faces.append((a, b, a))
        order = self.rng.permutation(len(self.vertices))
        new = np.argsort(order)
        faces = np.array([self.rng.permutation(new[list(face)]) for face in self.faces], np.int64)
        return np.array(self.vertices)[order], self.rng.permutation(faces)

    # ------------------------------------------------------------------ steps
    def _component(self, most: int = 8) -> None:
        """A triangle, a tetrahedron, or a grid of up to `most` faces, on its own or at a vertex that is there.

        Grids are flat, flat with their vertices moved in the plane, or rough.
        """
        kind = self.rng.integers(3)
        if kind < 2:
            places = [self._random() for _ in range(3 + kind)]
            faces = [(0, 1, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3)][: 1 + 3 * kind]
        else:
            k = int(self.rng.integers(1, int((most / 2) ** 0.5) + 1))
            moved = STEP * 1000 * np.array([[0, 0, 0], [1, 1, 0], [1, 1, 3]][self.rng.integers(3)])
            corner, cells = self._random(), [y * (k + 1) + x for x in range(k) for y in range(k)]
            places = [
                corner + np.array([x, y, 0]) / 4 + moved * self.rng.integers(-3, 4, 3)
                for y in range(k + 1)
                for x in range(k + 1)
            ]
            faces = [face for a in cells for face in ((a, a + 1, a + k + 2), (a, a + k + 2, a + k + 1))]
        ids = [self._vertex(place) for place in places]
        if self.faces and self.rng.random() < 0.5:
            ids[0] = self._used_vertex()
        for face in faces:
            self._face(*(ids[k] for k in face))

    def _fan(self) -> None:
        """Thin faces around a vertex of an edge, from that edge on."""
        a, b = self._edge()
        thin = float(self.rng.choice([1e-9, 1e-6, 1e-3, 0.1]))
        for _ in range(self.rng.integers(2, 6)):
            c = self._vertex(self.vertices[b] + thin * self._random())
            self._face(a, b, c)
            b = c

    def _fin(self) -> None:
        """One face more at an edge: anywhere, of height 0, or to a vertex that is there."""
        a, b = self._edge()
        if sum(a in face and b in face for face in self.faces) >= MOST_FACES:
            return
        kind = self.rng.integers(6)
        if kind == 0:
            self._face(a, b, self._used_vertex())
            return
        p, q = self.vertices[a], self.vertices[b]
        if kind < 3:
            apex = self._random()
        elif kind == 3:
            apex = p + (q - p) * float(self.rng.choice([-0.5, 1.5, 2.0, *FRACTIONS]))
        elif kind == 4:
            apex = p.copy()
        else:
            apex = (p + q) / 2 + float(self.rng.choice(HEIGHTS)) * self._random()
        self._face(a, b, self._vertex(apex))

    def _split_edge(self) -> None:
        """A vertex on an edge, or close to it; all faces of the edge become two."""
        a, b = self._edge()
        p, q = self.vertices[a], self.vertices[b]
        height = float(self.rng.choice(HEIGHTS))
        c = self._vertex(p + (q - p) * float(self.rng.choice(FRACTIONS)) + height * self._random())
        for face in [face for face in self.faces if a in face and b in face]:
            self.faces.remove(face)
            self._face(*(c if v == a else v for v in face))
            self._face(*(c if v == b else v for v in face))

    def _split_face(self) -> None:
        """A vertex in a face: inside, close to an edge, exactly on it, or at a corner; the face becomes three."""
        face = self.faces[self.rng.integers(len(self.faces))]
        i, j, k = self.rng.permutation(face).tolist()
        p, q, r = self.vertices[i], self.vertices[j], self.vertices[k]
        t = float(self.rng.choice([0.0, *FRACTIONS]))
        inside = p + (q - p) * t
        inside = inside + (r - inside) * float(self.rng.choice([*HEIGHTS, 0.25, 0.5]))
        v = self._vertex(inside)
        self.faces.remove(face)
        for a, b in ((i, j), (j, k), (k, i)):
            self._face(a, b, v)

    # ------------------------------------------------------------------ parts
    def _random(self) -> Vector:
        """(3,) within the unit cube around the origin."""
        return STEP * self.rng.integers(-(2**15), 2**15, 3).astype(float)

    def _vertex(self, place: Vector) -> int:
        self.vertices.append(place)
        return len(self.vertices) - 1

    def _face(self, a: int, b: int, c: int) -> None:
        """Add a face, unless it names a vertex twice or is there."""
        if len({a, b, c}) == 3 and all({a, b, c} != set(face) for face in self.faces):
            self.faces.append((a, b, c))

    def _edge(self) -> tuple[int, int]:
        """The ends of an edge of a face, in any order."""
        a, b, _ = self.rng.permutation(self.faces[self.rng.integers(len(self.faces))]).tolist()
        return a, b

    def _used_vertex(self) -> int:
        return int(self.rng.choice(self.faces[self.rng.integers(len(self.faces))]))
