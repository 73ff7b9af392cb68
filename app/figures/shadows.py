"""Shadows in a picture: how much of the light from all round reaches what is seen, and the ground beneath it."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core.analysis.ambient_light import light_reached, nearest_faces
from bihdist_core.analysis.upright import axis_of
from bihdist_core.arrays import AnyArray, ByteArray, FloatArray, IntArray

from ..scene.camera import Projection
from ..scene.clipping import ClipPlane
from ..scene.creases import face_normals, to_length_one
from ..scene.drawable import faces_of
from .hidden_lines import cut_faces
from .raster import Rectangle

AT_ONCE = 2_000_000
"""Pixels that are looked at together: memory does not grow with the picture."""

REACH = 0.15
"""How far the shadow on the ground is drawn around the shape, as a fraction of its extent."""

FRAMED = 0.06
"""How far around the shape the picture shows the ground, as such a fraction."""

FADING, BLUR = 0.35, 0.004
"""The share of the way from its middle to there on which the shadow fades away, and how far it is made smooth, as a
fraction of the picture's width: there are so many directions of light only."""

GRID = 24
"""Squares of the ground along each side; those that reach behind the camera are left out."""

DEEPEST = 0.75
"""The opacity of the ground's shadow where no light arrives."""

BELOW, BRIGHTEST, SHARPNESS = 0.3, 1.5, 4
"""How bright the sky is from below, where it is 1 high above; how much brighter at `KEY`; and how narrow that is."""

KEY = np.array([-0.5, 0.6, 1.0])
"""To the brightest part of the sky, as to the first light of `scene.field_actor.light`: right, up and to the camera."""


def ground_around(points: FloatArray, up: str, reach: float) -> FloatArray:
    """Return the corners (4, 3), in turn, of the ground beneath points (n, 3), so far around them."""
    upright = axis_of(up)
    across = np.eye(3)[np.abs(upright) < 0.5]
    low, high = points.min(axis=0), points.max(axis=0)
    more = reach * float(np.linalg.norm(high - low))
    ends = np.stack([across @ low - more, across @ high + more])
    floor = upright * float((points @ upright).min())
    return floor + np.array([[ends[i, 0], ends[j, 1]] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]) @ across


def shadow_edge(points: FloatArray, up: str) -> FloatArray:
    """Return places (32, 3) all around the ground beneath points (n, 3), where its shadow has faded away."""
    a, b, c, d = ground_around(points, up, FRAMED)
    turn = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    way = np.stack([np.cos(turn), np.sin(turn)], 1)
    way /= (way**4).sum(axis=1, keepdims=True) ** 0.25
    edge: FloatArray = (a + c) / 2 + way @ np.stack([b - a, d - a]) / 2
    return edge


class Shadows:
    """The shadows of a surface as a camera sees them.

    Parameters
    ----------
    mesh
        As it is drawn.
    up
        The axis that is up.
    has_ground
        Whether there is ground beneath it, which is only seen from above.
    clip
        The plane beyond which nothing is left.
    """

    def __init__(
        self, mesh: vtkPolyData, projection: Projection, up: str, has_ground: bool, clip: ClipPlane | None = None
    ) -> None:
        self._projection, self._up = projection, axis_of(up)
        points, normals = mesh.GetPoints().GetData(), mesh.GetPointData().GetNormals()
        both = np.concatenate([vtk_to_numpy(points).astype(float), vtk_to_numpy(normals)], axis=1)
        self._own = faces_of(mesh)
        if clip is not None:
            both, self._own, _ = cut_faces(both, self._own, np.arange(len(self._own)), clip.depths(both[:, :3]))
        self._x, self._normals = np.split(both, 2, axis=1)
        used = both[np.unique(faces_of(mesh)), :3]
        self._low, self._high = used.min(axis=0), used.max(axis=0)
        self._found: dict[tuple[object, ...], tuple[AnyArray, AnyArray]] = {}
        x, faces = self._x, self._own
        if has_ground and projection.back @ self._up > 0:
            a, b, _, d = ground_around(used, up, REACH)
            share = np.linspace(0, 1, GRID + 1)
            x = np.concatenate([x, (a + share[:, None, None] * (b - a) + share[:, None] * (d - a)).reshape(-1, 3)])
            corner = len(self._x) + (np.arange(GRID)[:, None] * (GRID + 1) + np.arange(GRID)).ravel()
            for second, third in ((1, GRID + 2), (GRID + 2, GRID + 1)):
                faces = np.concatenate([faces, np.stack([corner, corner + second, corner + third], 1)])
        facing = face_normals(x, faces)
        to_length_one(facing)
        self._shown, self._faces, self._facing = x, faces, np.stack(facing, axis=1)

    def cast(self, image: ByteArray, part: Rectangle, strength: float) -> ByteArray:
        """Return a picture (h, w, 4) uint8, with premultiplied alpha, of a part of the view with the shadows in it.

        Those on the shape, where no light arrives, leave 1 - strength of its colours; the ground's are black, with
        alpha.
        """
        key = (image.shape, part, strength > 0)
        if key not in self._found:
            self._found[key] = self._shares(image.shape[1], image.shape[0], part, strength > 0)
        light, ground = self._found[key]
        result = image.astype(np.float32)
        result[..., :3] *= 1 - strength * (1 - light)[..., None]
        result[..., 3] += (255 - result[..., 3]) * ground
        return np.rint(result).astype(np.uint8)

    def _shares(self, width: int, height: int, part: Rectangle, on_shape: bool) -> tuple[AnyArray, AnyArray]:
        """Return the share of the light that reaches the shape, and the opacity of the ground's shadow, (h, w) each."""
        from scipy.ndimage import grey_closing

        left, right, bottom, top = part
        x, y, depth = self._projection(self._shown).T
        near = -depth if self._projection.is_parallel else 1 / np.where(depth > 0, depth, np.nan)
        at = np.stack([(x - left) / (right - left) * width, (top - y) / (top - bottom) * height, near], 1)
        light, ground = np.full((2, height, width), np.nan, np.float32)
        rows = max(AT_ONCE // width, 1)
        for start in range(0, height, rows):
            band = np.s_[start : min(start + rows, height)]
            face, _ = nearest_faces(self._faces, at - [0, start, 0], width, band.stop - start)
            is_ground = face >= len(self._own)
            # The ground's shadow is made smooth: every other pixel across and down will do.
            taken = (face >= 0) if on_shape else is_ground
            taken[::2][is_ground[::2]] = False
            taken[:, ::2][is_ground[:, ::2]] = False
            wanted = np.flatnonzero(taken)
            under = is_ground.ravel()[wanted]
            points, share = self._light(wanted, face.ravel()[wanted], at - [0, start, 0], width)
            light[band].ravel()[wanted[~under]] = share[~under]
            ground[band].ravel()[wanted[under]] = self._ground(points[under], share[under])
        # Where faces nearly touch, single pixels are dark.
        return grey_closing(_filled(light, 1.0), 3), _filled(ground, max(BLUR * width, 1.0), is_smooth=True)

    def _light(self, pixels: IntArray, face: IntArray, at: FloatArray, width: int) -> tuple[FloatArray, FloatArray]:
        """Return the points (k, 3) of faces (k,) seen at pixels (k,), and the share (k,) of the light that reaches
        them."""
        points, normals = np.empty((len(pixels), 3)), np.empty((len(pixels), 3), np.float32)
        facing = self._facing[face].astype(np.float32)
        for some in (np.s_[k : k + 100_000] for k in range(0, len(pixels), 100_000)):
            row, column = np.divmod(pixels[some], width)
            corners = self._faces[face[some]]
            a, b, c = at[corners].transpose(1, 2, 0)
            px, py = column + 0.5, row + 0.5
            shares = [(v[0] - px) * (w[1] - py) - (v[1] - py) * (w[0] - px) for v, w in ((b, c), (c, a), (a, b))]
            # In perspective, shares of the picture's triangle become those of the face.
            weights = np.stack(shares, 1) * (1 if self._projection.is_parallel else at[corners, 2])
            weights /= weights.sum(axis=1, keepdims=True)
            points[some] = (weights[..., None] * self._shown[corners]).sum(axis=1)
            is_own = face[some] < len(self._own)
            own = self._normals[np.where(is_own[:, None], corners, 0)]
            smooth = (weights[..., None] * own).sum(axis=1)
            normals[some] = np.where(is_own[:, None], smooth, facing[some])
        away = self._projection.back if self._projection.is_parallel else self._projection.position - points
        for each in (normals, facing):
            each[(each * away).sum(axis=1) < 0] *= -1
        return points, light_reached(self._x, self._own, (points, normals, facing), self._brightness)

    def _brightness(self, directions: FloatArray) -> FloatArray:
        """Return how bright the sky is in directions (d, 3)."""
        key = KEY / np.linalg.norm(KEY) @ self._projection.view[:3, :3]
        sky: FloatArray = BELOW + (1 - BELOW) * np.clip(0.5 + 1.5 * directions @ self._up, 0, 1)
        sky += BRIGHTEST * np.clip(directions @ key, 0, 1) ** SHARPNESS
        return sky

    def _ground(self, points: FloatArray, share: FloatArray) -> FloatArray:
        """Return the opacity (k,) of the shadow at points (k, 3) of the ground, which fades away around the shape."""
        half = (self._high - self._low) / 2
        off = np.abs(points - self._low - half) / (half + FRAMED * 2 * float(np.linalg.norm(half)))
        off[:, np.abs(self._up) > 0.5] = 0
        fade = np.clip((1 - (off**4).sum(axis=1) ** 0.25) / FADING, 0, 1)
        opacity: FloatArray = DEEPEST * (1 - share) * fade**2 * (3 - 2 * fade)
        return opacity


def _filled(values: AnyArray, blur: float, is_smooth: bool = False) -> AnyArray:
    """Return values (h, w) with those that are NaN made the mean of their neighbours, within so many pixels, 0 farther
    away; or all of them, if smooth."""
    from scipy.ndimage import gaussian_filter

    known = np.isfinite(values)
    count = gaussian_filter(known.astype(np.float32), blur)
    mean = gaussian_filter(np.where(known, values, 0), blur) / np.maximum(count, 1e-6)
    return np.where(known & (not is_smooth), values, np.where(count > 1e-3, mean, 0))
