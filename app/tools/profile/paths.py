"""The path of a document's profile, computed in the background."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from weakref import WeakKeyDictionary

from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.plane_sections import plane_section
from bihdist_core.analysis.surface_paths import SurfacePath
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress, silent
from bihdist_core.sources.source import Source, SurfacePoint
from bihdist_core.sources.words import words_of
from bihdist_core.surface import Surface

from ...document.document import Document
from ...document.shared_parts.pins import Pins
from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh
from .part import SECTIONS, Profile, points_along

SLOW_PATH_S = 0.5
"""Seconds after which a path gives way to the next one, where its places have moved meanwhile."""

FEW = "A profile goes from point to point: pin two points, or choose its ends above."


@dataclass(frozen=True)
class PathWanted:
    """A path through vertices and places in faces of a surface, in one of the document's WAYS.

    A section has a direction `across` (3,) in its plane.
    """

    surface: Surface
    places: tuple[int | SurfacePoint, ...]
    way: str
    across: tuple[float, float, float] | None = None

    def is_alike(self, other: "PathWanted | None") -> bool:
        """Return whether both differ in their places only, as while one is dragged."""
        mine = self.way, len(self.places)
        return other is not None and self.surface is other.surface and mine == (other.way, len(other.places))


def wanted_path(
    document: Document, surfaces: Callable[[str], Surface], seen: tuple[float, float, float] | None = None
) -> PathWanted:
    """Return the path that a document's profile asks for.

    `surfaces` returns a surface by its name; `seen` is the direction (3,) of a section that has none. Raises
    ParameterError for fewer than two points, for sources that are not points, and for points on several surfaces.
    """
    points = [document.point(name) for name in points_along(document)]
    if len(points) < 2:
        raise ParameterError(FEW)
    names = {point.surface for point in points}
    if len(names) > 1:
        raise ParameterError("A profile lies on one surface; its points are on several.")
    profile = document[Profile]
    places = tuple(_place(point.at, point.name) for point in points)
    if SECTIONS.get(profile.way) == "whole" and len(places) > 2:
        raise ParameterError("A whole section goes through two points; choose them above.")
    surface, words = surfaces(points[0].surface), [point_words(document, point.name) for point in points]
    components = surface.component_of_vertex[Places.of(surface, places).corners[:, 0]].tolist()
    for (before, a, one), (after, b, other) in pairwise(zip(words, places, components, strict=True)):
        if a == b:
            raise ParameterError(f"There is no path from {before} to {after}: they are at the same place.")
        if one != other:
            raise ParameterError(
                f"There is no path from {before} to {after}: they are on different components of the mesh."
            )
    across = (profile.across or seen) if profile.way in SECTIONS else None
    return PathWanted(surface, places, profile.way, across)


def path_of(document: Document, surfaces: Mapping[str, LoadedMesh]) -> tuple[str, SurfacePath]:
    """Compute the path of a document's profile; return the name of its surface and the path.

    The last path of each surface is kept. Raises the errors of `wanted_path` and of making the path.
    """
    wanted = wanted_path(document, lambda name: surfaces[name].surface)
    name = document.point(points_along(document)[0]).surface
    maker = _makers.setdefault(surfaces[name], PathMaker())
    return name, maker.path(wanted, silent)


def point_words(document: Document, name: str) -> str:
    """Return the name of a point in sentences: a pin's number, or another point's name or place."""
    number = document[Pins].number(name)
    if number:
        return f"pin {number}"
    at = document.point(name).at
    shown = {point for panel in document.panels for point in panel.shows.points}
    return name if name in shown or at is None else f"vertex {at}" if isinstance(at, int) else words_of(at)


def _place(at: Source | None, name: str) -> int | SurfacePoint:
    if isinstance(at, int | SurfacePoint):
        return at
    raise ParameterError(f"A profile goes through vertices and places in faces; {name!r} is neither.")


class PathMaker:
    """Makes paths one after another; the last one is kept, and what paths on its surface need."""

    def __init__(self) -> None:
        self._paths: GeodesicPaths | None = None
        self._last: tuple[PathWanted, SurfacePath] | None = None

    def path(self, wanted: PathWanted, progress: Progress) -> SurfacePath:
        """Return the path; the one before is returned again if it is the same."""
        if self._last is None or wanted != self._last[0]:
            self._last = wanted, self._make(wanted, progress)
        return self._last[1]

    def _make(self, wanted: PathWanted, progress: Progress) -> SurfacePath:
        if wanted.way in SECTIONS:
            if wanted.across is None:
                raise ParameterError("A section needs a direction that lies in its plane; none is given.")
            return plane_section(wanted.surface, wanted.places, wanted.across, SECTIONS[wanted.way])
        if self._paths is None or self._paths.surface is not wanted.surface:
            self._paths = GeodesicPaths(wanted.surface)
        return self._paths.path(wanted.places, wanted.way, progress)


_makers: WeakKeyDictionary[LoadedMesh, PathMaker] = WeakKeyDictionary()


class PathWorker:
    """Computes the latest path that was asked for, on a thread of its own.

    `found` is called by `post` with the request and a `SurfacePath`, or a sentence that says why there is none;
    answers that are no longer wanted are dropped. `going` is called with the step of a slow path.

    While points move, paths follow them as fast as they are found; a slow one is given up for the next.
    """

    def __init__(
        self,
        post: Callable[[Callable[[], None]], None],
        found: Callable[[PathWanted, SurfacePath | str], None],
        going: Callable[[str], None],
    ) -> None:
        self._post, self._found, self._going = post, found, going
        self._wanted: PathWanted | None = None
        self._maker = PathMaker()
        self._worker: LatestRequestWorker[PathWanted] = LatestRequestWorker(
            "profile", self._work, self._report, self._failed
        )

    def ask(self, wanted: PathWanted | None) -> None:
        """Compute this path; None for none."""
        self._wanted = wanted
        self._worker.submit(wanted)

    def close(self) -> None:
        """Stop for good, and give up a path on its way."""
        self._wanted = None
        self._worker.end()

    # ------------------------------------------------------------------ on the lane's thread
    def _work(self, wanted: PathWanted, worker: LatestRequestWorker[PathWanted]) -> None:
        begun = time.monotonic()

        def is_wanted(latest: PathWanted) -> bool:
            return latest is wanted or (wanted.is_alike(latest) and time.monotonic() - begun < SLOW_PATH_S)

        self._post(partial(self._tell, wanted, self._maker.path(wanted, worker.progress(is_wanted))))

    def _failed(self, wanted: PathWanted, error: Exception) -> None:
        self._post(partial(self._tell, wanted, failure_in_words(error)))

    def _report(self, fraction: float | None, text: str) -> None:
        self._post(partial(self._going, text))

    def _tell(self, wanted: PathWanted, found: SurfacePath | str) -> None:
        is_on_its_way = isinstance(found, SurfacePath) and wanted.is_alike(self._wanted)
        if wanted is self._wanted or is_on_its_way:
            self._found(wanted, found)
