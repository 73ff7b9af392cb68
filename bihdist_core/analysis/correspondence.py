"""How well each vertex of one surface corresponds to a vertex of another (paper, section 5.2, surface matching)."""

import numpy as np
import numpy.typing as npt

from ..distances.distance import Distance
from ..errors import ParameterError


def correspondence_prediction(
    distance_m: Distance,
    distance_n: Distance,
    pairs: npt.ArrayLike,
    x: npt.ArrayLike,
    weights: npt.ArrayLike | None = None,
) -> np.ndarray:
    """c(y) = (sum_i w_i (x~_i - y~_i)^2)^(1/2) for every vertex y of N: (n,) for one vertex x of M, (n, m) for (m,).

    x~_i = d_M(x, x_i) / max_j d_M(x, x_j) are the distances of x from the known points, y~_i = d_N(y, y_i) /
    max_j d_N(y, y_j) likewise; the least c marks the best candidate.  If a maximum is 0 the vector is 0.  (The paper
    normalises where it defines the vectors, and prints distances that are not normalised in its last formula; here
    they are, as its text explains: so that a scaled surface N changes nothing.)

    pairs: (k, 2) known corresponding vertices (x_i of M, y_i of N).  weights: (k,), at least 0; 1 each by default,
    as in the paper.  NaN where y or x is on another component than one of the known points.

    Raises VertexError for bad vertices, ParameterError for pairs or weights of another form.
    """
    known = np.asarray(pairs)
    if known.ndim != 2 or known.shape[1] != 2 or not len(known):
        raise ParameterError(f"Known correspondences are an array of shape (k, 2), k at least 1, not {known.shape}.")
    w = np.ones(len(known)) if weights is None else np.asarray(weights, np.float64)
    if w.shape != (len(known),) or not (np.isfinite(w) & (w >= 0)).all():
        raise ParameterError(
            f"{len(known)} correspondences need as many finite weights of at least 0, not {weights!r}."
        )
    ids = distance_m.surface.check_vertices(x)
    from_x = _normalised(distance_m.from_sources(known[:, 0])[ids])
    from_y = _normalised(distance_n.from_sources(known[:, 1]))
    squares = np.zeros((len(from_y), len(ids)))
    for w_i, here, there in zip(w, from_x.T, from_y.T, strict=True):
        squares += w_i * (there[:, None] - here) ** 2
    prediction = np.sqrt(squares)
    return prediction[:, 0] if np.ndim(x) == 0 else prediction


def _normalised(distances: np.ndarray) -> np.ndarray:
    """(m, k) rows divided by their maximum; rows of zeros stay."""
    largest = distances.max(axis=1, keepdims=True)
    return np.divide(distances, largest, out=np.where(np.isnan(largest), np.nan, distances), where=largest > 0)
