"""Moving figures: the shape turning, the source wandering along a path, or both; as MP4 or GIF."""

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from bihdist_core import BihdistError, Laplacian, ParameterError, Surface
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import check_output, whole_file

from .answers import Answer
from .camera import VIEWS, Camera, Projection, standard_camera
from .figure_export import asked, figure_of, load_mesh, refuse_if_nothing
from .figure_layout import lay_out
from .figures import Figure, draw_figure
from .recipe import Recipe, RecipeCamera

MOVIE_FORMATS = (".mp4", ".gif")


@dataclass(frozen=True)
class Movie:
    """A figure in motion.

    turn: degrees the shape turns in all; path: vertices the source goes through, by way of edges; frames: how many
    pictures, fps: how many of them a second.
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
            raise ParameterError("A path goes through two vertices or more.")
        if self.turn == 0 and not self.path:
            raise ParameterError("Nothing would move: give a turn or a path.")


def check_movie(path: str | os.PathLike[str]) -> None:
    """Before long work: that a movie can be written there; BihdistError, with what to install, if not."""
    if check_output(path, MOVIE_FORMATS) == ".mp4":
        try:
            import imageio_ffmpeg  # noqa: F401
        except ImportError:
            raise BihdistError(
                "MP4 needs the package imageio-ffmpeg (pip install imageio-ffmpeg); GIF needs nothing more."
            ) from None


def write_movie(movie: Movie, path: str | os.PathLike[str], progress: Progress | None = None) -> list[Answer]:
    """Compute and draw a movie into a .mp4 or .gif file, whole or not at all.  Returns an answer of each panel."""
    check_movie(path)
    surface, recipe = load_mesh(movie.recipe)
    movie = replace(movie, recipe=recipe)
    sources = _sources(movie, surface)
    fields = _Fields(movie, surface, sources, part(progress, 0.0, 0.3))
    pictures = _pictures(movie, surface, sources, fields, part(progress, 0.3, 1.0))
    with whole_file(path) as temporary:
        (_write_mp4 if temporary.suffix.lower() == ".mp4" else _write_gif)(temporary, pictures, movie)
    return fields.examples


def route(surface: Surface, stops: tuple[int, ...]) -> np.ndarray:
    """(k,) vertices of the shortest way along edges through the stops; ParameterError where there is none."""
    surface.check_vertices(stops)
    i, j = surface.edges.T
    length = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    count = len(surface.vertices)
    graph = coo_matrix((np.maximum(length, 1e-300), (i, j)), shape=(count, count)).tocsr()
    way = [stops[0]]
    for start, stop in pairwise(stops):
        before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)[1]
        leg = [stop]
        while leg[-1] != start:
            leg.append(int(before[leg[-1]]))
            if leg[-1] < 0:
                raise ParameterError(f"There is no way from vertex {start} to vertex {stop} along edges.")
        way += leg[-2::-1]
    return np.array(way)


# ---------------------------------------------------------------------- what each frame shows
def _sources(movie: Movie, surface: Surface) -> list[int] | None:
    """The source of each frame; None if it does not move."""
    if not movie.path:
        return None
    way = route(surface, movie.path)
    steps = np.linalg.norm(np.diff(surface.vertices[way], axis=0), axis=1)
    at = np.append(0.0, np.cumsum(steps))
    places = np.linspace(0, at[-1], movie.frames)
    nearest = np.abs(at[None] - places[:, None]).argmin(axis=1)
    return [int(v) for v in way[nearest]]


class _Fields:
    """For each panel and source its answer, and one end of the colour bar for all frames.

    examples: an answer of each panel.
    """

    def __init__(self, movie: Movie, surface: Surface, sources: list[int] | None, progress: Progress) -> None:
        panels = movie.recipe.panels
        laplacian = Laplacian(surface, movie.recipe.areas)
        self._answers: list[dict[int, Answer]] = []
        self.examples: list[Answer] = []
        self.recipe = movie.recipe
        kept = []
        for k, panel in enumerate(panels):
            step = part(progress, k / len(panels), (k + 1) / len(panels))
            distance = asked(laplacian, panel.spec)
            wanted = sorted(set(sources or [panel.source]))
            surface.check_vertices(wanted)
            answers = {}
            for number, source in enumerate(wanted):
                answer = distance.answer(source, part(step, number / len(wanted), (number + 1) / len(wanted)))
                if answer.field is not None:
                    answer = replace(answer, field=answer.field.astype(np.float32))
                answers[source] = answer
            # One failure is that of all: the distance could not be made.
            failed = next((answer for answer in answers.values() if answer.failure), None)
            if failed is not None:
                answers = dict.fromkeys(answers, failed)
            self.examples.append(answers[wanted[0]])
            self._answers.append(answers)
            top = max(answer.maximum for answer in answers.values())
            kept.append(replace(panel, maximum=panel.maximum or top or None))
        refuse_if_nothing(self.examples)
        self.recipe = replace(movie.recipe, panels=tuple(kept))

    def figure(self, surface: Surface, source: int | None, views: tuple) -> Figure:
        panels = tuple(p if source is None else replace(p, source=source) for p in self.recipe.panels)
        recipe = replace(self.recipe, panels=panels, views=views, crop=False, transparent=False)
        return figure_of(recipe, surface, [a[p.source] for a, p in zip(self._answers, panels, strict=True)])


def _pictures(
    movie: Movie, surface: Surface, sources: list[int] | None, fields: _Fields, progress: Progress
) -> Iterator[np.ndarray]:
    first = fields.figure(surface, sources[0] if sources else None, movie.recipe.views)
    # Seen from everywhere it keeps its size, so it must fit from everywhere.
    box = lay_out(first).cells[0].views[0]
    axis, start = _start(movie.recipe.views[0], surface, box.width / box.height)
    if movie.turn:
        start = _roomy(start, axis, surface)
    for k in range(movie.frames):
        progress(k / movie.frames, f"frame {k + 1} of {movie.frames}")
        # A whole turn ends one step before where it began: shown again and again, it does not halt.
        seen = start.turned(movie.turn * k / movie.frames, axis)
        view = RecipeCamera(seen.position, seen.focal_point, seen.up, seen.extent)
        picture = draw_figure(fields.figure(surface, sources[k] if sources else None, (view,)))
        # The usual kind of MP4 has an even number of rows and columns.
        yield np.pad(picture, [(0, picture.shape[0] % 2), (0, picture.shape[1] % 2), (0, 0)], mode="edge")
    progress(1.0, "")


def _start(view: str | RecipeCamera, surface: Surface, aspect: float) -> tuple[np.ndarray, Camera]:
    if isinstance(view, str):
        shown = surface.vertices[surface.component_of_vertex >= 0]
        return np.array(VIEWS[view][1], float), standard_camera(shown, aspect, view)
    return np.array(view.up), Camera(view.position, view.focal_point, view.up, view.extent)


def _roomy(camera: Camera, axis: np.ndarray, surface: Surface) -> Camera:
    """The camera with an extent that holds the shape from all sides it will be seen from."""
    wide, high = camera.extent
    for degrees in range(0, 360, 10):
        turned = camera.turned(degrees, axis)
        projection = Projection(replace(turned, extent=(1.0, 1.0)), 1.0, surface.vertices)
        seen = np.abs(projection(surface.vertices[surface.component_of_vertex >= 0])[:, :2])
        wide, high = max(wide, float(np.nanmax(seen[:, 0]))), max(high, float(np.nanmax(seen[:, 1])))
    return replace(camera, extent=(wide, high))


# ---------------------------------------------------------------------- files
def _write_mp4(path: Path, pictures: Iterator[np.ndarray], movie: Movie) -> None:
    import imageio_ffmpeg

    first = next(pictures)
    height, width, _ = first.shape
    writer = imageio_ffmpeg.write_frames(str(path), (width, height), fps=movie.fps, quality=8, macro_block_size=2)
    try:
        writer.send(None)
        writer.send(np.ascontiguousarray(first))
        for picture in pictures:
            writer.send(np.ascontiguousarray(picture))
    finally:
        writer.close()


def _write_gif(path: Path, pictures: Iterator[np.ndarray], movie: Movie) -> None:
    from PIL import Image

    frames = (Image.fromarray(picture).quantize(256) for picture in pictures)
    first = next(frames)
    first.save(path, save_all=True, append_images=frames, duration=round(1000 / movie.fps), loop=0)
