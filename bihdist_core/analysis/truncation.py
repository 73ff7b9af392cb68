"""What a sum over the first k eigenpairs loses of the exact biharmonic distance, for every k at once."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..distances.biharmonic import BiharmonicDistance
from ..distances.spectral import checked_count
from ..errors import ParameterError
from ..laplacian import Laplacian, as_laplacian
from ..progress import Progress, part, silent
from ..solver.tall import over_rows
from ..surface import Surface


@dataclass(frozen=True, eq=False)
class TruncationLoss:
    """counts (q,): how many eigenpairs; means, largest (q,): |d_k - d| over max d, by area and at worst; at (q,): the
    vertex where it is worst.  No unit."""

    source: int
    counts: np.ndarray
    means: np.ndarray
    largest: np.ndarray
    at: np.ndarray


def truncation_loss(
    laplacian: Laplacian | Surface,
    source: int,
    most: int = 200,
    counts: npt.ArrayLike | None = None,
    progress: Progress | None = None,
) -> TruncationLoss:
    """The loss of the truncated biharmonic distance (paper, Eq. 11) from a vertex, with 1 to `most` eigenpairs.

    counts: (q,) those wanted, ascending, instead of all.  The Laplacian keeps the eigenpairs, so
    that another source costs a field and a pass over them.  No more are used than the source's component has.
    Raises ParameterError for bad numbers, VertexError for a bad source.
    """
    laplacian = as_laplacian(laplacian)
    component = laplacian.component_of(source)
    wanted = np.arange(1, checked_count(most) + 1) if counts is None else np.asarray(counts)
    if (
        wanted.ndim != 1
        or not len(wanted)
        or wanted.dtype.kind not in "iu"
        or not (np.diff(wanted, prepend=0) > 0).all()
    ):
        raise ParameterError(f"counts are whole numbers of at least 1, ascending, not {counts!r}.")
    wanted = wanted[wanted <= component.most_eigenpairs]
    if not len(wanted):
        raise ParameterError(f"{laplacian.surface.name} has {component.most_eigenpairs} eigenpairs at vertex {source}.")
    report = progress or silent
    distance = BiharmonicDistance(laplacian, part(report, 0, 0.2))
    exact = distance.from_source(source, part(report, 0.2, 0.3))[component.vertices]
    spectrum = component.spectrum(int(wanted[-1]), part(report, 0.3, 0.9))
    report(0.9, "sums over eigenpairs")
    largest = exact.max()
    if not largest > 0:
        raise ParameterError(f"{laplacian.surface.name} has no second point beside vertex {source}.")
    means, worst, at = _losses(
        spectrum.eigenvectors,
        1 / spectrum.eigenvalues,
        int(component.local(np.array([source]))[0]),
        exact / largest,
        component.areas / component.areas.sum(),
        wanted,
        largest,
    )
    report(1.0, "sums over eigenpairs")
    return TruncationLoss(int(source), wanted, means, worst, component.vertices[at])


def _losses(
    vectors: np.ndarray,
    scale: np.ndarray,
    source: int,
    exact: np.ndarray,
    areas: np.ndarray,
    counts: np.ndarray,
    unit: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    last = int(counts[-1])
    here = vectors[source, :last]
    factor = (scale[:last] / unit) ** 2

    def one(rows: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        sums = np.zeros(rows.stop - rows.start)
        mean, worst, at = np.empty(len(counts)), np.empty(len(counts)), np.empty(len(counts), np.int64)
        first = 0
        # Eigenvector by eigenvector, so that all stays in the cache.
        terms = np.ascontiguousarray(vectors[rows, :last].T)
        for k, count in enumerate(counts.tolist()):
            for j in range(first, count):
                term = np.subtract(terms[j], here[j], out=terms[j])
                term *= term
                term *= factor[j]
                sums += term
            first = count
            lost = np.sqrt(sums)
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
