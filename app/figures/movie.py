"""Moving figures: the shape turning, the source wandering along a path, or both; as MP4 or GIF."""

from __future__ import annotations

import os
from collections.abc import Generator, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from itertools import chain, pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import BihdistError, OutputError, ParameterError, Surface
from bihdist_core.arrays import AnyArray, ByteArray
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ..document.camera import View
from ..document.document import Document, Panel
from ..document.edits import put_point
from ..document.page import Recipe
from ..scene.camera import turned
from ..session.array_store import ArrayStore
from ..session.questions import Question, questions, vertex_at
from ..version import install_command
from .description import Figure
from .export import Surfaces, check_drawable, figure_of, open_document, refuse_if_nothing
from .frames import drawn_frames
from .turning import fitted_size, start_and_axis

if TYPE_CHECKING:
    from PIL.Image import Image

MOVIE_FORMATS = (".mp4", ".gif")

PLACES = 12
"""Places of a source's way that are looked for in the picture."""

SETTING_UP = 0.03
"""The share of a movie's progress before its first frame; the rest goes evenly with the frames."""


@dataclass(frozen=True)
class Movie:
    """A figure in motion.

    Attributes
    ----------
    turn
        Degrees by which the shape turns in all.
    path
        Vertices that the source goes through, along edges.
    frames, fps
        Number of pictures, and how many of them a second shows.
    """

    recipe: Recipe
    turn: float = 360.0
    path: tuple[int, ...] = ()
    frames: int = 120
    fps: float = 25.0

    def __post_init__(self) -> None:
        if not 2 <= self.frames <= 10_000:
            raise ParameterError(f"A movie has 2 to 10,000 frames, not {self.frames}.")
        if not 1 <= self.fps <= 50:
            raise ParameterError(f"A movie shows 1 to 50 frames a second, not {self.fps:g}.")
        if not np.isfinite(self.turn):
            raise ParameterError(f"A turn is a number of degrees, not {self.turn}.")
        if len(self.path) == 1:
            raise ParameterError("A path needs at least two vertices.")
        if self.turn == 0 and not self.path:
            raise ParameterError("Nothing would move: give a turn or a path.")


def check_movie(path: str | os.PathLike[str]) -> None:
    """Raise BihdistError, with what to install, before long work if a movie cannot be written there."""
    if check_output(path, MOVIE_FORMATS) == ".mp4" and (lack := mp4_lack()):
        raise BihdistError(f"A GIF needs no further package. {lack}")


def mp4_lack() -> str:
    """Return a sentence on the package that MP4 lacks, with the line that installs it; "" if none does."""
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        get_ffmpeg_exe()
    except ImportError:
        return f"MP4 needs the package imageio-ffmpeg: {install_command('imageio-ffmpeg')}"
    except RuntimeError:  # the package has come without it
        return "MP4 needs the program ffmpeg, which was not found."
    return ""


def write_movie(
    movie: Movie,
    path: str | os.PathLike[str],
    progress: Progress | None = None,
    given: ArrayStore | None = None,
    workers: int | None = None,
) -> list[Answer]:
    """Compute and draw a movie into a .mp4 or .gif file, whole or not at all; return an answer of each panel.

    Parameters
    ----------
    given
        What the document has from Python; None for that in the recipe's archive.
    workers
        How many processes draw, one for each processor if None.
    """
    check_movie(path)
    if not movie.recipe.document.panels:
        raise ParameterError("The recipe has no panels.")
    document, surfaces = open_document(movie.recipe, given or ArrayStore.read(movie.recipe))
    movie = replace(movie, recipe=replace(movie.recipe, document=document))
    check_drawable(movie.recipe, surfaces)
    fields = _Fields(movie, surfaces, part(progress, 0.0, SETTING_UP))
    with atomic_write(path) as temporary:
        is_mp4 = temporary.suffix.lower() == ".mp4"
        frames = drawn_frames(
            _figures(movie, fields), movie.frames, "RGB" if is_mp4 else "P", workers, part(progress, SETTING_UP, 1.0)
        )
        with closing(frames):
            (_write_mp4 if is_mp4 else _write_gif)(temporary, frames, movie)
    return fields.examples


def route(surface: Surface, stops: tuple[int, ...]) -> AnyArray:
    """Return the vertices (k,) of the shortest way along edges through the stops; raise ParameterError without one."""
    edges = EdgeGeodesic(surface)
    legs = [edges.path(start, stop) for start, stop in pairwise(stops)]
    return np.concatenate([legs[0][:1], *(leg[1:] for leg in legs)])


# ---------------------------------------------------------------------- what each frame shows
def _documents(movie: Movie, surface: Surface) -> list[Document]:
    """Return the document of each frame, but for the cameras."""
    document = movie.recipe.document
    if not movie.path:
        return [document] * movie.frames
    way = route(surface, movie.path)
    steps = np.linalg.norm(np.diff(surface.vertices[way], axis=0), axis=1)
    at = np.append(0.0, np.cumsum(steps))
    places = np.linspace(0, at[-1], movie.frames)
    nearest = np.abs(at[None] - places[:, None]).argmin(axis=1)
    return [_from(document, int(vertex)) for vertex in way[nearest]]


def _from(document: Document, vertex: int) -> Document:
    """Return the document with every field of the first panel's surface from one vertex."""
    first = document.panels[0].surface
    for name in dict.fromkeys(name for panel in document.panels_of(first) for name in panel.shows.points):
        document = put_point(document, name, vertex, first)
    return document


class _Fields:
    """The answers that all frames need, and one upper colour limit for all of them.

    Attributes
    ----------
    examples
        An answer of each panel.
    """

    def __init__(self, movie: Movie, surfaces: Surfaces, progress: Progress) -> None:
        self._recipe, self.surfaces = movie.recipe, surfaces
        self.surface = surfaces[movie.recipe.document.panels[0].surface].surface
        self.documents = _documents(movie, self.surface)
        self._answers: dict[Question, Answer] = {}
        self._tops: dict[int, float] = {}
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
        for number, question in enumerate(wanted):
            step = part(progress, number / len(wanted), (number + 1) / len(wanted))
            answer = question.answer(self.surfaces[panel.surface], step)
            if answer.field is not None:
                answer = replace(answer, field=answer.field.astype(np.float32))
            answers[question] = answer
        # One failure is that of all: the distance could not be made.
        failed = next((answer for answer in answers.values() if answer.failure), None)
        self._answers |= answers if failed is None else dict.fromkeys(answers, failed)
        self._tops[panel.id] = max(self._answers[question].maximum for question in wanted)

    def figure(self, frame: int, cameras: Mapping[str, View]) -> Figure:
        """Return the figure of a frame; `cameras` has those of the surfaces, by their names in the document."""
        document = self.documents[frame]
        panels = tuple(replace(p, maximum=p.maximum or self._tops[p.id] or None) for p in document.panels)
        recipe = Recipe(
            replace(document, panels=panels), replace(self._recipe.page, views=(), crop=False, transparent=False)
        )
        answers = [self._answers[q] for q in questions(document).values()]
        figure = figure_of(recipe, self.surfaces, answers)
        drawn = zip(figure.panels, document.panels, strict=True)
        seen = tuple(replace(each, views=(cameras[panel.surface],)) for each, panel in drawn)
        # A frame has the height that turning shapes need, and no room for a legend.
        return replace(figure, panels=seen, is_moving=True, legend=())


def _figures(movie: Movie, fields: _Fields) -> Iterator[Figure]:
    """Return the figure of each frame."""
    document = fields.documents[0]
    # What turns shows its source at first; what stands, as much as may be of the source's way.
    seen = fields.documents[:1] if movie.turn else fields.documents[:: max(len(fields.documents) // PLACES, 1)]
    starts = {}
    for name in dict.fromkeys(panel.surface for panel in document.panels):
        loaded = fields.surfaces[name]
        surface = loaded.surface
        sources = [vertex_at(at, surface) for each in seen for at in _sources_on(each, name)]
        view = movie.recipe.page.views[0] if movie.recipe.page.views else document.camera_of(name)
        up = document.up_of(name)
        view = loaded.view_of(view, up)
        starts[name] = start_and_axis(
            view, surface, movie.turn, document.warp_factor, sources, up, document.parallel_projection
        )
    first, _ = starts[document.panels[0].surface]
    size = fitted_size(fields.figure(0, {name: camera for name, (camera, _) in starts.items()}), first.extent)
    for k in range(movie.frames):
        # A whole turn ends one step before where it began: shown again and again, it does not halt.
        angle = movie.turn * k / movie.frames
        cameras = {name: turned(camera, angle, axis) for name, (camera, axis) in starts.items()}
        yield replace(fields.figure(k, cameras), size=size)


def _sources_on(document: Document, surface: str) -> list[Source | None]:
    """Return the sources of a surface's fields, each once, in order."""
    names = [name for panel in document.panels_of(surface) for name in panel.shows.points]
    return list(dict.fromkeys(document.point(name).at for name in names))


# ---------------------------------------------------------------------- files
def _write_mp4(path: Path, frames: Iterator[AnyArray], movie: Movie) -> None:
    import imageio_ffmpeg

    first = next(frames)
    height, width, _ = first.shape
    writer = imageio_ffmpeg.write_frames(str(path), (width, height), fps=movie.fps, quality=8, macro_block_size=2)
    try:
        _send(writer, None)
        for frame in chain([first], frames):
            _send(writer, np.ascontiguousarray(frame))
    finally:
        writer.close()


def _send(writer: Generator[None, ByteArray | None, None], frame: ByteArray | None) -> None:
    try:
        writer.send(frame)
    except (OSError, StopIteration) as error:
        words = next((line for line in reversed(str(error).splitlines()) if line.strip()), type(error).__name__)
        raise OutputError(f"The movie could not be encoded: {words.strip()[:200]}") from error


def _write_gif(path: Path, frames: Iterator[Image], movie: Movie) -> None:
    first = next(frames)
    first.save(path, save_all=True, append_images=frames, duration=round(1000 / movie.fps), loop=0)
