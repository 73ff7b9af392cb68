"""Which side of a face is the outside, where that can be told: files say it wrongly, or of each face differently."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray
from bihdist_core.surface import connected, dots

BODY, SHELL = 0.3, 0.6
"""Of the area, how much of it points one way: 0 for what is closed, half for half a sphere, 1 for what is flat.  What
has less than BODY is one, perhaps with holes; up to SHELL it is hollow on one side, like a car without a floor; the two
sides of what has more, a sheet, are alike."""

HOLLOW = 0.005
"""Volume over area to the power 3/2: what has less (a sphere has 0.094) has no inside to speak of."""


@dataclass(frozen=True, eq=False)
class Winding:
    """The orientation of faces.

    Attributes
    ----------
    turn
        (m,) faces to turn over, so that the outside sees all counter-clockwise, where there is an outside, and
        neighbours
        are wound alike, where that is possible.
    edges
        (e,) edges of two faces.
    left, right
        (e,) their sides there, as face + m * corner.
    is_turned
        (e,) whether these are still wound against each other, as somewhere on a Möbius strip.
    has_backs
        Whether an inside can be seen.
    has_inside
        Whether it can be seen once the surface is cut.
    """

    turn: BoolArray
    edges: IntArray
    left: IntArray
    right: IntArray
    is_turned: BoolArray
    has_backs: bool
    has_inside: bool

    def faces(self, faces: IntArray) -> IntArray:
        """Return faces (m, 3), turned over where they are to be."""
        if not self.turn.any():
            return faces
        if self.turn.all():
            return np.ascontiguousarray(faces[:, [0, 2, 1]])
        return np.where(self.turn[:, None], faces[:, [0, 2, 1]], faces)


def winding(surface: Surface, normals: list[FloatArray]) -> Winding:
    """Return the winding that the faces of a surface are to have.

    It is NumPy, most of which releases the interpreter lock, and takes half a second for a million vertices.

    Parameters
    ----------
    normals
        x, y and z (m,) of the faces' normals, twice as long as their areas.
    """
    faces, m = surface.faces, len(surface.faces)
    of_side, count = surface.edge_of_side, surface.faces_per_edge
    first, last = np.empty_like(count), np.empty_like(count)
    sides = np.arange(3 * m)
    last[of_side] = sides
    first[of_side[::-1]] = sides[::-1]
    edges = np.flatnonzero(count == 2)
    left, right = first.take(edges), last.take(edges)
    tail = faces.T.ravel()
    is_turned = tail.take(left) == tail.take(right)
    if is_turned.any():
        turn, patch, is_turned = _alike(left % m, right % m, is_turned, m)
    else:
        turn, patch = np.zeros(m, bool), surface.component_of_vertex.take(faces[:, 0])
    inward, *insides = _insides(surface, normals, turn, patch, np.unique(patch[left[is_turned] % m]))
    return Winding(turn ^ inward, edges, left, right, is_turned, *insides)


def _alike(one: IntArray, other: IntArray, is_turned: BoolArray, m: int) -> tuple[AnyArray, ...]:
    """Return which faces to turn over (m,), the patch of each (m,), and where neighbours still disagree (e,).

    Each face is a node twice, as it is and turned over, joined to its neighbours as they then fit.  Each connected
    component
    is one way to wind a patch; of a patch's two ways, the one that turns fewer faces over is taken.
    """
    ahead, behind = np.stack([one, one + m]), np.where(is_turned, other + m, other)
    behind = np.stack([behind, np.where(is_turned, other, other + m)])
    way = connected(np.stack([ahead.ravel(), behind.ravel()]), 2 * m)
    kept = np.bincount(way[:m], minlength=2 * m)
    mine, turned = way[:m], way[m:]
    turn = (kept[mine] < kept[turned]) | ((kept[mine] == kept[turned]) & (mine > turned))
    return turn, np.minimum(mine, turned), is_turned ^ turn[one] ^ turn[other]


def _insides(
    surface: Surface, normals: list[FloatArray], turn: BoolArray, patch: IntArray, one_sided: IntArray
) -> tuple[BoolArray, bool, bool]:
    """Return the faces (m,) of patches that are wound inwards, whether an inside can be seen, and whether in a cut.

    The patches `one_sided` (k,) have only one side.
    """
    m, patches = len(patch), int(patch.max()) + 1
    area = np.bincount(patch, np.sqrt(dots(normals, normals)) / 2, patches)
    half = np.where(turn, -0.5, 0.5) if turn.any() else 0.5
    normals = [half * x for x in normals]
    pointing = [np.bincount(patch, x, patches).astype(float, copy=False) for x in normals]
    # A hole is closed by triangles that meet in the middle of all edges of holes, so that they have no part in it.
    boundary = np.flatnonzero(surface.faces_per_edge.take(surface.edge_of_side) != 2)
    corner, where = surface.faces.T.ravel().take(boundary), patch.take(boundary % m)
    holes = np.bincount(where, minlength=patches)
    corners = surface.faces[:, 0]
    volume = np.zeros(patches)
    for x, along in zip(surface.vertices.T, normals, strict=True):
        middle = np.bincount(where, x.take(corner), patches) / np.maximum(holes, 1)
        volume += np.bincount(patch, (x.take(corners) - middle.take(patch)) * along, patches) / 3
    points, has_inside = np.sqrt(dots(pointing, pointing)), np.abs(volume) > HOLLOW * area**1.5
    has_inside[one_sided] = False
    is_body = (points < BODY * area) & has_inside
    # Of a bowl the file may mean the inside.
    is_shell = (points < SHELL * area) & has_inside & (volume > 0)
    open_area = float(area[(is_body | is_shell) & (holes > 0)].sum())
    # A loose sheet beside a body has sides that nobody can tell apart, and beside many the body would not be seen.
    has_backs = open_area > 0 and open_area > 0.5 * float(area[holes > 0].sum())
    is_hollow = has_backs or float(area[is_body & (holes == 0)].sum()) > 0.5 * float(area.sum())
    return (is_body & (volume < 0))[patch], bool(has_backs), bool(is_hollow)
