"""The numbers of a field's quality, in words: what each is called, what it means, and how it is written."""

from collections.abc import Callable, Sized
from dataclasses import dataclass

import numpy as np

from bihdist_core.analysis.persistence import OtherExtrema
from bihdist_core.analysis.quality import FieldQuality

from ...drawing.numbers import number, share
from .quality_worker import KnownQuality

WAITING, NONE = "…", "–"


@dataclass(frozen=True)
class Measure:
    """A row of the table: its name, what it means, and functions that write the number and a sentence on it.

    `written` returns WAITING while the number is not known. `value` is the number itself, unless it is a count.
    """

    name: str
    tip: str
    written: Callable[[KnownQuality], str]
    sentence: Callable[[KnownQuality], str] = lambda found: ""
    value: Callable[[FieldQuality], float] | None = None

    def with_all_digits(self, found: KnownQuality) -> str:
        """Return the number with all digits, for the clipboard."""
        exact = None if self.value is None or found.whole is None else float(self.value(found.whole))
        return repr(exact) if exact is not None and np.isfinite(exact) else self.written(found)


def _count(extrema: Callable[[OtherExtrema], Sized]) -> Callable[[KnownQuality], str]:
    def written(found: KnownQuality) -> str:
        if found.extrema is None:
            return NONE if found.failure else WAITING
        return str(len(extrema(found.extrema)))

    return written


def _minima_sentence(found: KnownQuality) -> str:
    if found.extrema is None or not len(found.extrema.minima):
        return ""
    return f"The deepest, at vertex {found.extrema.minima[0]}, by {share(found.extrema.minima_depth[0])} of the maximum"


def _maxima_sentence(found: KnownQuality) -> str:
    if found.extrema is None or len(found.extrema.maxima) < 2:
        return ""
    second, height = found.extrema.maxima[1], found.extrema.maxima_height[1]
    return f"After the farthest point, that at vertex {second} stands out most, by {share(height)} of the maximum"


def _of_whole(value: Callable[[FieldQuality], float]) -> Callable[[KnownQuality], str]:
    def written(found: KnownQuality) -> str:
        if found.whole is None:
            return NONE if found.failure else WAITING
        # Infinite, too, where the field is 0 beside the source; NaN becomes NONE.
        return "∞" if np.isinf(value(found.whole)) else number(value(found.whole))

    return written


def _isotropy_sentence(found: KnownQuality) -> str:
    if found.whole is None:
        return found.failure
    if found.whole.circles:
        return ""
    return "Isotropy is measured around a single source point."


def _kink_sentence(found: KnownQuality) -> str:
    if found.whole is None or found.whole.kink_edge[0] < 0:
        return ""
    first, second = found.whole.kink_edge
    return f"Across the edge from vertex {first} to vertex {second}"


def _triangles(found: KnownQuality) -> str:
    if found.triangles_failure:
        return NONE
    if found.triangles is None:
        return WAITING
    if not found.triangles.violations:
        return "0"
    return share(found.triangles.violations / found.triangles.triples)


def _triangles_sentence(found: KnownQuality) -> str:
    sample = found.triangles
    if sample is None:
        return found.triangles_failure or "Being computed; exact geodesic distances take a while."
    so_far = "" if found.is_sampled else f"; so far, among {found.points:,} points"
    sentence = f"{sample.violations:,} of {sample.triples:,} triples break it"
    if sample.violations:
        return f"{sentence}, the worst by {100 * sample.worst:.2g} % of the largest distance{so_far}"
    return f"{sentence}; the closest has {100 * sample.tightest:.2g} % to spare{so_far}"


MEASURES = (
    Measure(
        "Other minima",
        "Minima away from the source that persist over a thousandth of the range or more: places that look like the "
        "source. White triangles that point down. A distance should have none. Of a difference or a field that starts "
        "nowhere, all minima.",
        _count(lambda extrema: extrema.minima),
        _minima_sentence,
    ),
    Measure(
        "Maxima",
        "Maxima that persist over a thousandth of the range or more. White triangles that point up. One at the end of "
        "each limb is the shape's; more are the distance's.",
        _count(lambda extrema: extrema.maxima),
        _maxima_sentence,
    ),
    Measure(
        "Isotropy",
        "The greatest over the least value on the geodesic circle around the source whose radius is 4 % of the root of "
        "the area, or four edges if that is more. 1 where the distance grows equally in all directions.",
        _of_whole(lambda whole: whole.isotropy),
        _isotropy_sentence,
        lambda whole: whole.isotropy,
    ),
    Measure(
        "Largest kink",
        "How far the gradient jumps across an edge away from the source, over its length. About 2 where it turns "
        "round, as on a ridge; a smooth field's shrinks with the edges.",
        _of_whole(lambda whole: whole.kink),
        _kink_sentence,
        lambda whole: whole.kink,
    ),
    Measure(
        "Kink length",
        "The length of all edges with a kink of 1 or more, over the root of the surface's area: long where there is a "
        "ridge, next to nothing where a few edges are too long for the field.",
        _of_whole(lambda whole: whole.kink_length),
        value=lambda whole: whole.kink_length,
    ),
    Measure(
        "Triangles",
        "Of 100,000 random triples among 40 random points, those that break the triangle inequality by more than "
        "rounding. A metric has none, wherever it starts.",
        _triangles,
        _triangles_sentence,
    ),
)
