"""Faces too flat for floating-point numbers, and what the operators make of them.

With its longest side ab, of length l, its height h and the foot of the height at a share s from a to b, at most 1/2,
the energy of a face under the stiffness matrix is

    l / (2 h) (u_i - (1 - s) u_a - s u_b)^2 + h / (2 l) (u_a - u_b)^2:

a spring that holds the value at the apex i to that at its foot, and a link from end to end.  A spring of 1e10 leaves
few digits to its neighbours, and one of a face of no area is infinite.  So no spring is stronger than that of a face
whose height is the share `FLAT_RATIO` of its longest side; links and areas stay true.  A spring that is strong in any
case moves distances in proportion to h / l only: those on the exact surface, of whatever flatness, are met to some
`FLAT_RATIO` of the maximum, even if every face has a flat one beside it; where many hang in a chain their shares add
up, and the accuracy says so.  (Lengthening all three sides by a share e of the longest, the intrinsic mollification of
Sharp and Crane 2020, makes a flat obtuse face as high as the root of e.)

What hangs on faces of no area alone, too few to hold it, is infinitely far away.  By convention such loose faces, and
those with three points in one place, have equal sides.
"""

from dataclasses import dataclass, fields

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .surface import FLAT_RATIO, Surface, connected, dots

NOTHING = 1e-12
"""A height of so small a share of the longest side is the rounding of coordinates."""


@dataclass(frozen=True, eq=False)
class DegenerateFaces:
    """The degenerate faces of a surface, all (k,).

    Attributes
    ----------
    surface : Surface
        The surface.
    faces : (k,) ndarray
        The numbers of the faces.
    corners : (3, k) ndarray
        Which of its corners are i, a and b.
    foot : (k,) ndarray
        The fraction s.
    share : (k,) ndarray
        The true height over the longest side.
    length : (k,) ndarray
        The length of the longest side.
    spring, link : (k,) ndarray
        The strengths of spring and link, without a unit.
    loose : (k,) ndarray
        Whether these are by convention.
    """

    surface: Surface
    faces: IntArray
    corners: IntArray
    foot: FloatArray
    share: FloatArray
    length: FloatArray
    spring: FloatArray
    link: FloatArray
    loose: BoolArray

    @classmethod
    def of(cls, surface: Surface) -> "DegenerateFaces":
        """Find all degenerate faces of a surface."""
        faces = surface.degenerate_faces
        x = surface.vertices[surface.faces[faces]].transpose(1, 2, 0)
        side = [x[(k + 2) % 3] - x[(k + 1) % 3] for k in range(3)]
        squares = np.stack([dots(s, s) for s in side])
        apex, square = squares.argmax(axis=0), squares.max(axis=0)
        point = square == 0
        # From either end, so that a foot near one has all its digits.
        base, before, after = (np.choose((apex + s) % 3, side) for s in (0, 2, 1))
        feet = np.stack([-dots(base, before), -dots(base, after)]) / np.where(point, 1, square)
        nearer = feet.argmin(axis=0)
        share, high = surface.face_heights[faces], 0.75**0.5
        corners = np.stack([apex, (apex + 1 + nearer) % 3, (apex + 2 - nearer) % 3])
        loose = point | (_hanging(surface, faces) & (share < NOTHING))
        return cls(
            surface,
            faces,
            corners,
            np.where(point, 0.5, feet.min(axis=0)),
            share,
            np.sqrt(square),
            0.5 / np.where(loose, high, FLAT_RATIO),
            0.5 * np.where(loose, high, share),
            loose,
        )

    def select(self, index: IntArray) -> "DegenerateFaces":
        """Return some of them, by their numbers (j,)."""
        columns = {f.name: getattr(self, f.name)[..., index] for f in fields(self) if f.name != "surface"}
        return DegenerateFaces(self.surface, **columns)

    @property
    def lack(self) -> FloatArray:
        """The lack (k,) of the springs, to first order in the share by which they give way more than exact ones."""
        return np.where(self.loose, 0, self.spring * (1 - self.share / FLAT_RATIO))

    @property
    def vertices(self) -> tuple[IntArray, IntArray, IntArray]:
        """The vertices i, a and b, (k,) each."""
        i, a, b = self.surface.faces[self.faces, self.corners]
        return i, a, b

    def weights(self) -> FloatArray:
        """Return (3, k) their part of the weights of the sides opposite to their corners."""
        to_b = self.spring * self.foot
        return self._by_corner(self.link - to_b * (1 - self.foot), to_b, self.spring - to_b)

    def sides(self, true: bool = False) -> list[FloatArray]:
        """Return three (3, k) vectors along the sides, of each face in a plane of its own, as high as its spring makes
        it.

        With `true` they have their true heights instead.
        """
        # A point gets a side for others to be measured by.
        length = np.where(self.length > 0, self.length, FLAT_RATIO * (self.surface.mean_edge_length or 1.0))
        height, zero = length * (2 * self.link if true else 0.5 / self.spring), np.zeros(len(length))
        # i, a and b in the plane; which way round, no product of sides tells.
        at = self._by_corner(
            np.stack([self.foot * length, height, zero]),
            np.zeros((3, len(length))),
            np.stack([length, zero, zero]),
        )
        return [at[(k + 2) % 3] - at[(k + 1) % 3] for k in range(3)]

    def _by_corner(self, *values: FloatArray) -> FloatArray:
        """Return (3, ..., k) values of i, a and b in the order of the faces' corners."""
        order = np.argsort(self.corners, axis=0)
        return np.stack([np.choose(which, values) for which in order])

    def stretch(self, u: FloatArray) -> FloatArray:
        """Return (k, c) by how much the values u (n, c) at the apexes differ from those at their feet."""
        i, a, b = self.vertices
        return u[i] - (1 - self.foot[:, None]) * u[a] - self.foot[:, None] * u[b]

    def pull(self, force: FloatArray) -> FloatArray:
        """Return (n, c) loads by which forces (k, c) at the apexes are met at their feet: the transpose of
        `stretch`."""
        loads = np.zeros((len(self.surface.vertices), force.shape[1]))
        for vertices, share in zip(self.vertices, (np.ones_like(self.foot), self.foot - 1, -self.foot), strict=True):
            np.add.at(loads, vertices, share[:, None] * force)
        return loads

    def missing_springs(self) -> tuple[FloatArray, FloatArray]:
        """Return (n, k) columns g and (k,) slack: the exact stiffness matrix is L + the sum of g g^T / slack."""
        g, column = np.zeros((len(self.surface.vertices), len(self.faces))), np.arange(len(self.faces))
        for vertices, value in zip(self.vertices, (np.ones(len(column)), self.foot - 1, -self.foot), strict=True):
            g[vertices, column] = value
        return g, 2 * self.share * FLAT_RATIO / (FLAT_RATIO - self.share)


def _hanging(surface: Surface, faces: IntArray) -> BoolArray:
    """Return (k,) whether degenerate faces are too few to hold the vertices that they alone have: a spring holds
    one."""
    f = surface.faces[faces]
    free = ~surface.in_proper_face[f]
    hanging = np.zeros(len(faces), bool)
    if not free.any():
        return hanging
    # Two free vertices of a face are connected; one that is not free is connected to itself.
    ends = [np.where(free[:, k], f[:, k], -1) for k in range(3)]
    pairs = np.concatenate([np.stack([ends[k], ends[(k + 1) % 3]]) for k in range(3)], axis=1)
    label = connected(pairs[:, (pairs >= 0).all(axis=0)], len(surface.vertices))
    mine = np.flatnonzero(free.any(axis=1))
    of_face = label[f[mine, free[mine].argmax(axis=1)]]
    vertices = np.bincount(label[np.unique(f[free])], minlength=label.max() + 1)
    # Of a component that has nothing else one vertex is pinned.
    touches = np.bincount(of_face, (~free[mine]).any(axis=1), minlength=len(vertices)) > 0
    held = np.bincount(of_face, minlength=len(vertices)) >= vertices - ~touches
    hanging[mine] = ~held[of_face]
    return hanging
