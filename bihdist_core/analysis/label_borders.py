"""Borders between labels of vertices, as curves that go straight through faces.

Each vertex has a weight.  A place in a face has the label whose vertices have most of the weight there, so borders
cross edges and meet inside faces of three labels.
"""

import numpy as np

from ..arrays import FloatArray, IntArray
from .chains import chains

STEPS, LEAST_WEIGHT = 3, 0.25
"""How far neighbours are looked at, and the weight that a label of a single vertex has."""


def label_weights(labels: IntArray, faces: IntArray) -> FloatArray:
    """Return weights of vertices (n,) with labels (n,), of faces (m, 3), which smooth borders.

    The weight is how likely a few steps to neighbours stay in the label: less at a tooth, which so becomes shorter.
    """
    weights = np.ones(len(labels))
    a, b, c = labels[faces.T]
    is_near = (a != b) | (b != c)
    for _ in range(STEPS):
        near = np.zeros(len(labels), bool)
        near[faces[is_near]] = True
        is_near = near[faces].any(axis=1)
    corners = faces[is_near]
    ends = np.concatenate([corners.ravel(), np.roll(corners, 1, axis=1).ravel()])
    others = np.roll(ends, corners.size)
    count = np.bincount(ends, minlength=len(labels)) + 1
    stays = labels[ends] == labels[others]
    for _ in range(STEPS):
        weights = (weights + np.bincount(ends[stays], weights[others[stays]], len(labels))) / count
    return np.maximum(weights, LEAST_WEIGHT)


def label_borders(labels: IntArray, faces: IntArray) -> list[tuple[IntArray, FloatArray, bool]]:
    """Return the borders between labels (n,) of the vertices of faces (m, 3).

    Each has the corners (k, 3) of a face that holds each of its points, the barycentric weights (k, 3) there, and
    whether its last point joins its first.
    """
    weights, following = label_weights(labels, faces), np.roll(faces, -1, axis=1)
    differs = labels[faces] != labels[following]
    is_mixed = differs.any(axis=1)
    faces, following, differs = faces[is_mixed], following[is_mixed], differs[is_mixed]
    ends, number = np.unique(np.sort(np.stack([faces, following], 2)[differs]), axis=0, return_inverse=True)
    crossing = np.full(faces.shape, -1)
    crossing[differs] = number.reshape(-1)
    two, three = crossing[~differs.all(axis=1)], crossing[differs.all(axis=1)]
    meeting = len(ends) + np.arange(len(three))
    segments = np.concatenate([two[two >= 0].reshape(-1, 2), np.stack([three.ravel(), np.repeat(meeting, 3)], 1)])
    corners = np.concatenate([ends[:, [0, 1, 1]], faces[differs.all(axis=1)]])
    shares = 1 / weights[corners]
    shares[: len(ends), 2] = 0
    shares /= shares.sum(axis=1, keepdims=True)
    return [(corners[ids], shares[ids], closed) for ids, closed in chains(segments)]
