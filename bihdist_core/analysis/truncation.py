"""Truncation errors of the biharmonic distance: the loss of a sum over the first k eigenpairs, for every k at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of
from ..distances.biharmonic import BiharmonicDistance
from ..distances.spectral import TruncatedBiharmonicDistance, checked_count
from ..errors import ParameterError
from ..laplacian import Laplacian, as_laplacian
from ..mesh_like import MeshLike
from ..progress import Progress, part, silent
from ..solver.tall import over_rows
from ..sources.pieces import pieces_of
from ..sources.source import Source, checked_source
from ..sources.words import short_words_of
from .field_statistics import corner_areas

LINE_COUNTS = (1, 2, 3, 5, 8, 12, 18, 25, 35, 50, 70, 100, 140, 200)
"""For lines, and for sources on several components, where each count costs a field of its own; and so on by 1.4."""


@dataclass(frozen=True, eq=False)
class TruncationLoss:
    """The loss of a biharmonic distance with fewer eigenpairs, without a unit.

    Attributes
    ----------
    source : Source
        Where the distance starts.
    counts : (q,) int64 ndarray
        How many eigenpairs.
    means : (q,) float64 ndarray
        Mean of the absolute value of d_k - d over max d, by area; the loss is taken as linear on each face.
    largest : (q,) float64 ndarray
        Its largest value.
    at : (q,) int64 ndarray
        The vertex of the largest.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> loss = bihdist.truncation_loss(pyvista.Icosphere(nsub=3), 0, counts=[8, 80])
    >>> loss.counts.tolist(), loss.largest.round(3).tolist()
    ([8, 80], [0.099, 0.034])
    """

    source: Source
    counts: IntArray
    means: FloatArray
    largest: FloatArray
    at: IntArray


def truncation_loss(
    laplacian: Laplacian | MeshLike,
    source: Source | str,
    most: int = 200,
    counts: npt.ArrayLike | None = None,
    progress: Progress | None = None,
) -> TruncationLoss:
    """Compute the loss of the truncated biharmonic distance for every number of eigenpairs.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The Laplacian keeps the eigenpairs, so that another source costs a field and a pass over them.
    source : Source or str
        A vertex or any other source, or its words.
    most : int
        The largest number of eigenpairs. No more are used than the source's component has.
    counts : (q,) array_like, optional
        The numbers of eigenpairs, ascending. By default all from 1 to `most`; for a boundary loop, a curve, or sources
        on several components, 14 numbers up to 200 and more beyond.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    TruncationLoss
        The loss for each number of eigenpairs.

    Raises
    ------
    VertexError
        If a source vertex is not on the surface.
    ParameterError
        For another bad source, for bad numbers, and if the component has no second point.

    Notes
    -----
    The truncated distance is Eq. 11 of the paper.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> loss = bihdist.truncation_loss(sphere, 0, counts=[10, 20, 40, 80])
    >>> loss.means.round(4).tolist()
    [0.0499, 0.025, 0.0149, 0.0087]
    """
    laplacian = as_laplacian(laplacian)
    at = checked_source(source)
    pieces = pieces_of(at, laplacian.surface)
    components = [
        laplacian.components[k] for k in np.unique(laplacian.surface.component_of_vertex[pieces.corners[:, 0]])
    ]
    is_simple = len(components) == 1 and not pieces.along.any()
    highest = max(component.most_eigenpairs for component in components)
    last = min(checked_count(most), max(highest, 1))
    usual = np.arange(1, last + 1) if is_simple else _some_counts(last)
    counted = usual if counts is None else array_of(counts, "Counts")
    if (
        counted.ndim != 1
        or not len(counted)
        or counted.dtype.kind not in "iu"
        or not (np.diff(counted, prepend=0) > 0).all()
    ):
        raise ParameterError(f"counts are whole numbers of at least 1, ascending, not {counts!r}.")
    counted = counted[counted <= highest]
    if not len(counted):
        raise ParameterError(f"{laplacian.surface.name} has {highest:,} eigenpairs at {_words(at)}.")
    report = progress or silent
    distance = BiharmonicDistance(laplacian, progress=part(report, 0, 0.2))
    exact = distance.from_source(at, part(report, 0.2, 0.3))
    largest = np.nanmax(exact)
    if not largest > 0:
        raise ParameterError(f"{laplacian.surface.name} has no second point beside {_words(at)}.")
    for k, component in enumerate(components):
        step = part(report, 0.3 + 0.6 * k / len(components), 0.3 + 0.6 * (k + 1) / len(components))
        spectrum = component.spectrum(int(counted[-1]), step)
    report(0.9, "sums over eigenpairs")
    if not is_simple:
        return TruncationLoss(at, counted, *_losses_of_fields(laplacian, at, exact, counted, part(report, 0.9, 1)))
    (component,) = components
    local = component.local(pieces.touched)
    areas = corner_areas(component.surface)
    means, worst, places = _losses(
        spectrum.eigenvectors,
        1 / spectrum.eigenvalues,
        np.einsum("kc,kcj->kj", pieces.start, spectrum.eigenvectors[local]),
        exact[component.vertices] / largest,
        areas / areas.sum(),
        counted,
        largest,
    )
    report(1.0, "sums over eigenpairs")
    return TruncationLoss(at, counted, means, worst, component.vertices[places])


def _words(source: Source) -> str:
    return f"vertex {source}" if isinstance(source, int) else short_words_of(source)


def _some_counts(most: int) -> IntArray:
    found = list(LINE_COUNTS)
    while found[-1] < most:
        found.append(round(1.4 * found[-1]))
    return np.array([count for count in found if count < most] + [most])


def _losses_of_fields(
    laplacian: Laplacian, source: Source, exact: FloatArray, counts: IntArray, report: Progress
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return the same as `_losses`, from a field for each count."""
    means, worst, at = np.empty(len(counts)), np.empty(len(counts)), np.empty(len(counts), np.int64)
    there, areas = np.flatnonzero(np.isfinite(exact)), corner_areas(laplacian.surface)
    for k, count in enumerate(counts.tolist()):
        report(k / len(counts), "sums over eigenpairs")
        lost = (
            np.abs(TruncatedBiharmonicDistance(laplacian, count).from_source(source) - exact)[there]
            / exact[there].max()
        )
        means[k] = np.average(lost, weights=areas[there])
        worst[k], at[k] = lost.max(), there[lost.argmax()]
    return means, worst, at


def _losses(
    vectors: FloatArray,
    scale: FloatArray,
    here: FloatArray,
    exact: FloatArray,
    areas: FloatArray,
    counts: IntArray,
    unit: float,
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return mean, largest loss and its vertex for each count, (q,) each, summing over eigenvectors.

    `here` (m, K) are the eigenvectors at the points of the source, of which the nearest counts.
    """
    last = int(counts[-1])
    factor = (scale[:last] / unit) ** 2

    def one(rows: slice) -> tuple[FloatArray, FloatArray, IntArray]:
        sums = np.zeros((len(here), rows.stop - rows.start))
        mean, worst, at = np.empty(len(counts)), np.empty(len(counts)), np.empty(len(counts), np.int64)
        first = 0
        # Eigenvector by eigenvector, so that all stays in the cache.
        terms = np.ascontiguousarray(vectors[rows, :last].T)
        for k, count in enumerate(counts.tolist()):
            for j in range(first, count):
                term = terms[j] - here[:, j, None]
                term *= term
                term *= factor[j]
                sums += term
            first = count
            lost = np.sqrt(sums.min(axis=0))
            lost -= exact[rows]
            np.abs(lost, out=lost)
            at[k] = lost.argmax()
            worst[k] = lost[at[k]]
            mean[k] = areas[rows] @ lost
        return mean, worst, at + rows.start

    means, worst, at = (np.array(each) for each in zip(*over_rows(one, len(exact)), strict=True))
    chunk = worst.argmax(axis=0)
    column = np.arange(len(counts))
    return means.sum(axis=0), worst[chunk, column], at[chunk, column]
