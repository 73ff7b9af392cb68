"""Isotropy near sources, as what it is: a limit.  Geodesic circles that shrink, on a mesh that is fine enough for them.

Of biharmonic distance d^2 = r^2 / (4 pi) (ln 1/r + c), where c differs from direction to direction: the ratio of
farthest to nearest falls towards 1 as the circle shrinks, but only like 1 / ln(1/r).  Of diffusion distance it stays.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..analysis.diagnostics import isotropy_ratio
from ..analysis.isoline_tracing import isolines
from ..applications.local_refinement import refined_around
from ..arrays import BoolArray, FloatArray, IntArray
from ..distances.geodesic import GeodesicDistance
from ..errors import ParameterError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from ._stated_figures import CIRCLE, LONG, ROUNDER, TREND
from .parts import Parts
from .result import Chart, Gathered, Series
from .shapes import Shapes, distance, random_sources
from .verdicts import MOST

LARGEST, HALVED = 0.04, 4
"""The radius of the largest circle, as a share of the root of the area; it is halved, so often at most, until circles
around most sources are local on the mesh at hand."""
RADII = 1 / 2.0 ** np.arange(5)
"""Of the circles, largest first, as shares of the largest; the last is a sixteenth of the first."""
FLAT = 0.2
"""A circle is local if its length is that of one in the plane within this share."""
EDGES = 5
"""A circle is at least this many edges wide."""
BEYOND = 1.25
"""The mesh is fine up to this many times the largest radius."""


PROTOCOL = (
    "The isotropy ratio is that of the greatest to the least distance on a geodesic circle around the source; its "
    f"excess is the ratio less 1. Circles shrink to a sixteenth, from {100 * LARGEST:g} % of the root of the area, or "
    f"from a radius so small that around {100 * MOST:g} % of the sources the circle is local: a single closed curve, "
    f"2πr long within 20 %. The mesh is refined around the sources, so that each circle is at least {EDGES} edges "
    "wide, and geodesic distance there is exact. Sources whose largest circle is not local are left out of the trend."
)
"""A description of how isotropy is measured."""

FRONT, BACK, RANDOM_FROM = 0, 1, 2
"""Where in circles that experiments share the pictured sources are, and where random ones begin."""


@dataclass(frozen=True, eq=False)
class Circles:
    """Isotropy ratios on the circles of `RADII` around sources (s,).

    `radii` (5,) are shares of the root of the area. `ratios` are by kind of distance, (s, 5), largest circle first; NaN
    around a source where geodesic circles cannot be had, for the reason in `failure`. `are_local` (s,) is True where
    the largest circle is one closed curve; elsewhere it says nothing of the limit.
    """

    sources: IntArray
    radii: FloatArray
    ratios: Mapping[str, FloatArray]
    are_local: BoolArray
    failure: str = ""

    def trend(self, kind: str = "biharmonic") -> list[float]:
        """Return (s,) the ratio's excess over 1 on the smallest circle, over that on the largest."""
        ratios = self.ratios[kind]
        return _over(ratios[:, -1] - 1, ratios[:, 0] - 1)

    def smallest(self, kind: str) -> list[float]:
        """Return (s,) the ratio on the smallest circle."""
        return [float(x) for x in self.ratios[kind][:, -1]]

    def relative(self, other: str) -> list[float]:
        """Return (s,) biharmonic distance's excess over 1 on the smallest circle, over that of another kind."""
        return _over(self.ratios["biharmonic"][:, -1] - 1, self.ratios[other][:, -1] - 1)

    def chart(self, heading: str, source: int = 0) -> Chart:
        """Return the ratios around one of the sources."""
        series = (Series(kind, self.radii, values[source]) for kind, values in self.ratios.items())
        x, y = "radius of the circle over root of area", "isotropy ratio"
        return Chart(heading, x, y, tuple(series), log_x=True, log_y=True)


def circles(
    surface: Surface, sources: Sequence[int], kinds: Sequence[str], progress: Progress | None = None
) -> Circles:
    """Return the isotropy ratios of several kinds of distance on circles around each of the sources (s,).

    The mesh is refined around the sources, and geodesic distance is exact, as far as the circles reach.
    """
    ids = np.asarray(sources, int)
    unit = float(np.sqrt(surface.face_areas[surface.component_of_vertex[surface.faces[:, 0]] == 0].sum()))
    part(progress, 0, 1)(0.0, "refining around the sources")
    radii = _local_radius(surface, ids, unit) * RADII
    reach = BEYOND * radii[0]
    fine = refined_around(surface, ids, radii[-1], reach, EDGES)
    laplacian = Laplacian(fine)
    fields = {}
    for k, kind in enumerate(kinds):
        made = distance(laplacian, kind, part(progress, 0.1 + 0.4 * k / len(kinds), 0.1 + 0.4 * (k + 1) / len(kinds)))
        fields[kind] = made.from_sources(ids)
    geodesic = GeodesicDistance(laplacian, "exact", radius=reach).from_sources(ids, part(progress, 0.5, 0.8))
    ratios = {kind: np.full((len(ids), len(RADII)), np.nan) for kind in kinds}
    are_local = np.zeros(len(ids), bool)
    failure = ""
    for q, source in enumerate(ids.tolist()):
        part(progress, 0.8, 1)(q / len(ids), f"circles around vertex {source}")
        lengths = geodesic[:, q]
        are_local[q] = _is_local(fine, lengths, radii[0])
        try:
            for kind in kinds:
                field = fields[kind][:, q]
                ratios[kind][q] = [isotropy_ratio(fine, field, lengths, float(r)) for r in radii]
        except ParameterError as error:
            failure = str(error)
    return Circles(ids, radii / unit, ratios, are_local, failure)


def _local_radius(surface: Surface, sources: IntArray, unit: float) -> float:
    """Return the radius of the largest circles that are local around most sources (s,)."""
    radius, x = LARGEST * unit, surface.vertices[surface.edges]
    # Both ends of the edges that the circle crosses have a distance.
    reach = radius + float(np.linalg.norm(x[:, 0] - x[:, 1], axis=1).max())
    near = GeodesicDistance(Laplacian(surface), "exact", radius=reach).from_sources(sources)
    for _ in range(HALVED):
        if np.mean([_is_local(surface, lengths, radius) for lengths in near.T]) >= MOST:
            break
        radius /= 2
    return radius


def _is_local(surface: Surface, lengths: FloatArray, radius: float) -> bool:
    """Return whether the geodesic circle around a source is one closed curve about as long as in the plane.

    Given are the distances (n,) from the source. Round a fingertip it is closed and much shorter.
    """
    found = isolines(surface, lengths, [radius])
    return len(found) == 1 and found[0].closed and abs(found[0].length / (2 * np.pi * radius) - 1) <= FLAT


def shared_circles(shapes: Shapes, name: str, random: int, progress: Progress | None = None) -> Circles:
    """Measure circles of biharmonic distance and of diffusion distance with t = 1, and keep them for other experiments.

    They are around the pictured sources on the front and on the back (`FRONT`, `BACK`), then (`RANDOM_FROM`) around
    random ones.
    """
    key = ("circles", name, random)
    if key not in shapes.kept:
        surface = shapes[name]
        sides = [shapes.pictured_source(name, side) for side in ("front", "back")]
        sources = [*sides, *random_sources(surface, random)]
        shapes.kept[key] = circles(surface, sources, ("biharmonic", "diffusion t = 1"), progress)
    found = shapes.kept[key]
    assert isinstance(found, Circles)
    return found


def gather_circles(found: Gathered, circled: Circles, pictured: int, first_random: int) -> None:
    """Add the numbers of the parts that statements on isotropy share, around a pictured source and random ones.

    The trend is taken of those around which the largest circle is local.
    """
    trend, relative = circled.trend(), circled.relative("diffusion t = 1")
    own, long = circled.smallest("biharmonic"), circled.smallest("diffusion t = 1")
    for k in (pictured, *range(first_random, len(circled.sources))):
        if np.isfinite(own[k]):
            found.add(TREND.name, trend[k] if circled.are_local[k] else np.nan, k == pictured)
            for part_of, values in ((ROUNDER, relative), (CIRCLE, own), (LONG, long)):
                found.add(part_of.name, values[k], k == pictured)


def _over(numerator: FloatArray, denominator: FloatArray) -> list[float]:
    """Return ratios of excesses; a vanishing one over a vanishing one is 1, no trend."""
    tiny = np.abs(denominator) < 1e-9
    return [float(x) for x in np.where(tiny, 1.0, numerator / np.where(tiny, 1.0, denominator))]


def gather_shared_circles(
    found: Gathered, parts: Parts, shapes: Shapes, name: str, count: int, pictured: int, progress: Progress
) -> Circles | None:
    """Gather the numbers of the circles that experiments share; None, with the reason in `parts`, if there are none."""
    circled = parts.do(f"circles on {name}", shared_circles, shapes, name, count, progress)
    if circled is not None:
        gather_circles(found, circled, pictured, RANDOM_FROM)
        if circled.failure:
            parts.note(f"circles on {name}", circled.failure)
    return circled
