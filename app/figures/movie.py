"""Moving figures: the shape turning, the source wandering along a path, a parameter changing, or all of these."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.distance_types import Parameter, Spec, Value
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ..document.camera import View
from ..document.document import Document, Panel
from ..document.edits import put_point
from ..document.page import Recipe
from ..document.quantities import Quantity
from ..scene.camera import turned
from ..session.array_store import ArrayStore
from ..session.questions import Question, questions, vertex_at
from .description import Figure
from .export import Surfaces, check_drawable, figure_of, open_document, refuse_if_nothing
from .frames import drawn_frames
from .movie_files import check_movie, picture_mode, write_frames
from .turning import fitted_size, start_and_axis

RAMP = 0.2
"""The share of the time in which a movement becomes as fast as it will be, and that in which it ends."""

DIGITS = 3
"""Of values in headings, always as many, so that words stay where they are."""


def eased(times: FloatArray) -> FloatArray:
    """Return fractions of a way (k,) at fractions of the time (k,): even but for a slow start and a slow end."""
    to_end = np.minimum(times, 1 - times)
    way = np.where(to_end < RAMP, to_end**2 / (2 * RAMP), to_end - RAMP / 2) / (1 - RAMP)
    return np.where(times < 0.5, way, 1 - way)


def way(frames: int, is_loop: bool) -> FloatArray:
    """Return the fraction of a way (frames,) at each frame.

    One that ends where it began is gone at an even speed, and its end is left out: shown again and again, it does not
    halt.
    """
    return np.arange(frames) / frames if is_loop else eased(np.linspace(0, 1, frames))


def angles(turn: float, is_swing: bool, frames: int) -> FloatArray:
    """Return by how many degrees (frames,) the shape is turned in each frame."""
    if is_swing:
        return turn / 2 * np.sin(2 * np.pi * way(frames, is_loop=True))
    return turn * way(frames, is_loop=turn % 360 == 0)


def span(turn: float, is_swing: bool) -> tuple[float, float]:
    """Return the least and the largest of all angles between frames, in degrees."""
    return (-abs(turn) / 2, abs(turn) / 2) if is_swing else (min(turn, 0.0), max(turn, 0.0))


@dataclass(frozen=True)
class Sweep:
    """The values that a parameter takes in turn.

    Attributes
    ----------
    name
        The parameter's name.
    stops
        Values in words.
    is_range
        Whether it goes evenly from each value to the next, in equal ratios if the parameter is logarithmic, or stays at
        each for as many frames.
    """

    name: str
    stops: tuple[str, ...]
    is_range: bool

    @staticmethod
    def parse(text: str) -> Sweep:
        """Read "t=4..1/60", a range, or "t=4,1,1/4"; ParameterError for another text."""
        name, _, values = (word.strip() for word in text.partition("="))
        is_range = ".." in values
        stops = tuple(word.strip() for word in values.split(".." if is_range else ","))
        if not name or len(stops) < 2 or not all(stops):
            raise ParameterError(f"A sweep is a range like t=4..1/60 or values like t=4,1,1/4, not {text!r}.")
        return Sweep(name, stops, is_range)

    def values(self, parameter: Parameter, frames: int) -> list[Value]:
        """Return the value in each frame; ParameterError for one that is not allowed."""
        stops = [parameter.parsed(stop) for stop in self.stops]
        if not self.is_range:
            return [stops[k * len(stops) // frames] for k in range(frames)]
        if parameter.choices:
            raise ParameterError(f"{self.name} has no range; name some of {', '.join(parameter.choices)}.")
        # Slow at each value that is named, as it is looked at.
        place = (len(stops) - 1) * np.linspace(0, 1, frames, endpoint=stops[0] != stops[-1])
        leg = np.minimum(place.astype(int), len(stops) - 2)
        numbers, share = np.array(stops, float), eased(place - leg)
        low, high = numbers[leg], numbers[leg + 1]
        found = low * (high / low) ** share if parameter.logarithmic else low + (high - low) * share
        return [parameter.checked(round(value) if parameter.is_whole else value) for value in found.tolist()]


def with_digits(label: str, value: Value) -> str:
    """Return a label that holds a value with as many digits as all others have: "t = 0.250", "λ^1.50"."""
    if not isinstance(value, float):
        return label
    words = f"{value:#.{DIGITS}g}".rstrip(".")
    return re.sub(rf"(= |\^){re.escape(f'{value:g}')}(?![\d.])", rf"\g<1>{words}", label)


SWING = 90.0
"""Degrees of a swing, if nothing else is said: the source at its edge is seen half from the side."""

PLACES = 12
"""Places of a source's way that are looked for in the picture."""

SETTING_UP = 0.03
"""The share of a movie's progress before its first frame; the rest goes evenly with the frames."""


@dataclass(frozen=True)
class Movie:
    """A figure in motion.

    What ends as it began, to be shown again and again, goes on evenly; anything else starts and ends slowly.

    Attributes
    ----------
    turn
        Degrees by which the shape turns in all; None for a whole turn, unless something else moves.
    is_swing
        Whether it turns back and forth, with the source in view.
    path
        Vertices that the source goes through, along edges.
    sweep
        Values that a parameter of the distances takes, as `Sweep.parse` reads them.
    frames, fps
        Number of pictures, and how many of them a second shows.
    """

    recipe: Recipe
    turn: float | None = None
    is_swing: bool = False
    path: tuple[int, ...] = ()
    sweep: str = ""
    frames: int = 120
    fps: float = 25.0

    def __post_init__(self) -> None:
        if not 2 <= self.frames <= 10_000:
            raise ParameterError(f"A movie has 2 to 10,000 frames, not {self.frames}.")
        if not 1 <= self.fps <= 50:
            raise ParameterError(f"A movie shows 1 to 50 frames a second, not {self.fps:g}.")
        if not np.isfinite(self.degrees):
            raise ParameterError(f"A turn is a number of degrees, not {self.turn}.")
        if len(self.path) == 1:
            raise ParameterError("A path needs at least two vertices.")
        if self.degrees == 0 and not self.path and not self.sweep:
            raise ParameterError("Nothing would move: give a turn, a path or a sweep.")
        if self.sweep:
            self.values()

    @property
    def degrees(self) -> float:
        """Degrees by which the shape turns."""
        if self.turn is not None:
            return self.turn
        return SWING if self.is_swing else 0.0 if self.path or self.sweep else 360.0

    def values(self) -> list[Value]:
        """Return the value of the parameter in each frame.

        ParameterError if the distances have no such parameter, or for a value that is not allowed.
        """
        sweep = Sweep.parse(self.sweep)
        shown = (spec for panel in self.recipe.document.panels for spec in panel.shows.parametrised)
        kinds = {spec.word: spec.distance_type for spec in shown}
        found = [p for kind in kinds.values() for p in kind.parameters if p.name == sweep.name]
        if not found:
            raise ParameterError(f"{sweep.name} is not a parameter of {', '.join(kinds) or 'what is shown'}.")
        return sweep.values(found[0], self.frames)


def write_movie(
    movie: Movie,
    path: str | os.PathLike[str],
    progress: Progress | None = None,
    given: ArrayStore | None = None,
    workers: int | None = None,
) -> list[Answer]:
    """Compute and draw a movie, and write all of its frames or none; return an answer of each panel.

    Parameters
    ----------
    given
        What the document has from Python; None for that in the recipe's archive.
    workers
        How many processes draw, one for each processor if None.
    """
    check_movie(path, movie.frames)
    if not movie.recipe.document.panels:
        raise ParameterError("The recipe has no panels.")
    document, surfaces = open_document(movie.recipe, given or ArrayStore.read(movie.recipe))
    if movie.sweep and document.range == "own" and not any(panel.maximum for panel in document.panels):
        # Maxima change with the parameter, and isolines at round values would jump.
        document = replace(document, range="fraction")
    movie = replace(movie, recipe=replace(movie.recipe, document=document))
    check_drawable(movie.recipe, surfaces)
    fields = _Fields(movie, surfaces, part(progress, 0.0, SETTING_UP))
    figures, mode = _figures(movie, fields), picture_mode(path)
    with closing(drawn_frames(figures, movie.frames, mode, workers, part(progress, SETTING_UP, 1.0))) as frames:
        write_frames(path, frames, movie.fps)
    return fields.examples


def route(surface: Surface, stops: tuple[int, ...]) -> AnyArray:
    """Return the vertices (k,) of the shortest way along edges through the stops; raise ParameterError without one."""
    edges = EdgeGeodesic(surface)
    legs = [edges.path(start, stop) for start, stop in pairwise(stops)]
    return np.concatenate([legs[0][:1], *(leg[1:] for leg in legs)])


# ---------------------------------------------------------------------- what each frame shows
def _documents(movie: Movie, surface: Surface) -> list[Document]:
    """Return the document of each frame, but for the cameras."""
    documents = [movie.recipe.document] * movie.frames
    if movie.path:
        vertices = route(surface, movie.path)
        steps = np.linalg.norm(np.diff(surface.vertices[vertices], axis=0), axis=1)
        at = np.append(0.0, np.cumsum(steps))
        places = at[-1] * way(movie.frames, movie.path[0] == movie.path[-1])
        nearest = np.abs(at[None] - places[:, None]).argmin(axis=1)
        documents = [_from(documents[0], int(vertex)) for vertex in vertices[nearest]]
    if movie.sweep:
        name = Sweep.parse(movie.sweep).name
        documents = [_at(each, name, value) for each, value in zip(documents, movie.values(), strict=True)]
    return documents


def _from(document: Document, vertex: int) -> Document:
    """Return the document with every field of the first panel's surface from one vertex."""
    first = document.panels[0].surface
    for name in dict.fromkeys(name for panel in document.panels_of(first) for name in panel.shows.points):
        document = put_point(document, name, vertex, first)
    return document


def _at(document: Document, name: str, value: Value) -> Document:
    """Return the document with another value of a parameter in all distances that have it."""

    def changed(shows: Quantity) -> Quantity:
        if len(shows.parts) > 1:
            return shows.with_parts(tuple(map(changed, shows.parts)))
        found = (spec for spec in shows.parametrised if _has(spec, name))
        return next((shows.with_spec(spec.changed(**{name: value})) for spec in found), shows)

    panels = tuple(replace(panel, shows=changed(panel.shows)) for panel in document.panels)
    return replace(document, panels=panels)


def _has(spec: Spec, name: str) -> bool:
    return any(name == known for known, _ in spec.values)


class _Fields:
    """The answers that all frames need, and where their colours end.

    Attributes
    ----------
    examples
        An answer of each panel.
    """

    def __init__(self, movie: Movie, surfaces: Surfaces, progress: Progress) -> None:
        self._recipe, self.surfaces = movie.recipe, surfaces
        self._parameter = Sweep.parse(movie.sweep).name if movie.sweep else ""
        self.surface = surfaces[movie.recipe.document.panels[0].surface].surface
        self.documents = _documents(movie, self.surface)
        self._answers: dict[Question, Answer] = {}
        self._tops: dict[int, float | None] = {}
        self.examples: list[Answer] = []
        panels = movie.recipe.document.panels
        for k, panel in enumerate(panels):
            wanted = list(dict.fromkeys(questions(document)[panel.id] for document in self.documents))
            step = part(progress, k / len(panels), (k + 1) / len(panels))
            self._answer(panel, wanted, step)
            self.examples.append(self._answers[wanted[0]])
        refuse_if_nothing(self.examples)

    def _answer(self, panel: Panel, wanted: list[Question], progress: Progress) -> None:
        answers = {}
        swept = next((s for question in wanted for s in question.specs if _has(s, self._parameter)), None)
        # The other end first: what it needs of eigenpairs serves all between.
        for number, question in enumerate([*wanted[-1:], *wanted[:-1]]):
            step = part(progress, number / len(wanted), (number + 1) / len(wanted))
            loaded = self.surfaces[panel.surface]
            # How accurate each of many distances is would take longer than they do.
            answer = question.answer(loaded, step, (lambda _: True) if swept else None)
            if answer.field is not None:
                answer = replace(answer, field=answer.field.astype(np.float32))
            if swept:
                (value,) = {spec[self._parameter] for spec in question.specs if _has(spec, self._parameter)}
                answer = replace(answer, label=with_digits(answer.label, value))
                loaded.keep(question.areas, question.specs)
            answers[question] = answer
        # One failure is that of all: the distance could not be made.
        failed = next((answer for answer in answers.values() if answer.failure), None)
        self._answers |= answers if failed is None else dict.fromkeys(answers, failed)
        # With the parameter maxima change, and units may: a common end is for those who ask for it.
        if not swept or self._recipe.document.range == "shared":
            self._tops[panel.id] = max(answer.maximum for answer in answers.values()) or None

    def figure(self, frame: int, cameras: Mapping[str, View]) -> Figure:
        """Return the figure of a frame; `cameras` has those of the surfaces, by their names in the document."""
        document = self.documents[frame]
        panels = tuple(replace(p, maximum=p.maximum or self._tops.get(p.id)) for p in document.panels)
        recipe = Recipe(
            replace(document, panels=panels),
            replace(self._recipe.page, views=(), crop=False, transparent=False, layout=""),
        )
        answers = [self._answers[q] for q in questions(document).values()]
        figure = figure_of(recipe, self.surfaces, answers)
        drawn = zip(figure.panels, figure.order, strict=True)
        seen = tuple(replace(each, views=(cameras[document.panels[k].surface],)) for each, k in drawn)
        return replace(figure, panels=seen, is_moving=True)


def _figures(movie: Movie, fields: _Fields) -> Iterator[Figure]:
    """Return the figure of each frame."""
    document, turns = fields.documents[0], angles(movie.degrees, movie.is_swing, movie.frames)
    ends = span(movie.degrees, movie.is_swing)
    # What turns round shows its source at first; anything else, as often as may be.
    step = max(movie.frames // PLACES, 1) if ends[1] - ends[0] < 360 else movie.frames
    starts = {}
    for name in dict.fromkeys(panel.surface for panel in document.panels):
        loaded = fields.surfaces[name]
        surface = loaded.surface
        looks = [
            (float(turns[k]), vertex_at(at, surface))
            for k in range(0, movie.frames, step)
            for at in _sources_on(fields.documents[k], name)
        ]
        view = movie.recipe.page.views[0] if movie.recipe.page.views else document.camera_of(name)
        up = document.up_of(name)
        view = loaded.view_of(view, up)
        starts[name] = start_and_axis(
            view, surface, ends, document.warp_factor, looks, up, document.parallel_projection
        )
    first, _ = starts[document.panels[0].surface]
    figure = fields.figure(0, {name: camera for name, (camera, _) in starts.items()})
    # The height that turning shapes need, and under it the legend.
    size = fitted_size(replace(figure, legend=()), first.extent)
    for k, angle in enumerate(turns):
        cameras = {name: turned(camera, angle, axis) for name, (camera, axis) in starts.items()}
        yield replace(fields.figure(k, cameras), size=size, legend=figure.legend)


def _sources_on(document: Document, surface: str) -> list[Source | None]:
    """Return the sources of a surface's fields, each once, in order."""
    names = [name for panel in document.panels_of(surface) for name in panel.shows.points]
    return list(dict.fromkeys(document.point(name).at for name in names))
