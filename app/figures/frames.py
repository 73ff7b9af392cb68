"""The frames of a movie, drawn by several processes at once and handed over in their order."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from itertools import islice
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core import BihdistError
from bihdist_core.arrays import ByteArray
from bihdist_core.progress import Progress

from ..scene.style import Style
from .description import Figure
from .draw import draw_figure
from .page_output import KeptWords
from .shots import RenderCache
from .worker import Worker

if TYPE_CHECKING:
    from PIL.Image import Image

EACH = 6
"""A process is worth its start for so many frames."""

AHEAD = 2
"""Most frames for each process that wait to be drawn, or for those before them."""

ALIKE = 4.0
"""Steps of 255 by which a colour differs from another that is taken for it, at most."""

NOTICED = 0.1
"""Seconds within which it is noticed that the movie is not wanted any more."""


def drawn_frames(
    figures: Iterator[Figure], count: int, mode: str, workers: int | None, progress: Progress
) -> Generator[Any, None, None]:
    """Yield the pictures of a movie's figures.

    Parameters
    ----------
    mode
        "RGB" for arrays (height, width, 3) uint8, "P" for images of PIL with a palette.
    workers
        Number of processes that draw, one for each processor if None; a few frames are drawn in this process.
    """
    number = min(workers or processors(), count // EACH)
    if number < 2:
        yield from _drawn_here(figures, count, mode, progress)
    else:
        yield from _drawn_by_others(figures, count, mode, number, progress)
    progress(1.0, "")


def processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Drawing:
    """The state that a process keeps from one frame to the next."""

    def __init__(self) -> None:
        # Without a graphics card sampling costs three times as much; in what moves nobody sees its absence.
        self.render_cache, self.words = RenderCache(samples=0, curves=False), KeptWords()

    def frame(self, figure: Figure, mode: str, progress: Progress | None = None) -> Any:
        picture = draw_figure(figure, progress, self.render_cache, self.words)
        # The usual kind of MP4 has an even number of rows and columns.
        picture = np.pad(picture, [(0, picture.shape[0] % 2), (0, picture.shape[1] % 2), (0, 0)], mode="edge")
        if mode == "RGB":
            return picture
        return _with_256_colours(picture, figure.style)


def _with_256_colours(picture: ByteArray, style: Style) -> Image:
    """Return an image with a palette of its most frequent colours, and of its ground and marks, however small."""
    from PIL import Image as images

    own = [np.round(255 * np.array(c)) for c in (style.background, style.source, style.largest, style.mark_edge)]
    first = 256 - len(own)
    found = images.fromarray(picture).quantize(first)
    index = np.array(found)
    for k, colour in enumerate(own, first):
        low, high = (np.clip(colour + way * ALIKE, 0, 255).astype(np.uint8) for way in (-1, 1))
        is_alike = [(low[c] <= picture[..., c]) & (picture[..., c] <= high[c]) for c in range(3)]
        index[is_alike[0] & is_alike[1] & is_alike[2]] = k
    image = images.fromarray(index)
    palette = np.zeros((256, 3), np.uint8)
    palette[:first].flat[: len(found.getpalette() or [])] = found.getpalette()
    palette[first:] = own
    image.putpalette(palette.tobytes())
    return image


def _drawn_here(figures: Iterator[Figure], count: int, mode: str, progress: Progress) -> Iterator[Any]:
    drawing = _Drawing()
    with drawing.render_cache:
        for k, figure in enumerate(figures):

            def go_on(_fraction: float, _text: str, k: int = k) -> None:
                progress(k / count, f"frame {k + 1} of {count}")

            go_on(0.0, "")
            yield drawing.frame(figure, mode, go_on)


_OF_THIS_PROCESS: list[_Drawing] = []


def _frame(figure: Figure, mode: str) -> Any:
    """Draw one frame in a worker."""
    if not _OF_THIS_PROCESS:
        _OF_THIS_PROCESS.append(_Drawing())
    return _OF_THIS_PROCESS[0].frame(figure, mode)


def _drawn_by_others(
    figures: Iterator[Figure], count: int, mode: str, number: int, progress: Progress
) -> Iterator[Any]:
    # With a thread each, software OpenGL and the libraries of several processes do not stand in each other's way.
    workers = [Worker(threads=1) for _ in range(number)]
    idle: SimpleQueue[Worker] = SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def draw(figure: Figure) -> Any:
        worker = idle.get()
        try:
            return worker.ask(_frame, figure, mode)
        finally:
            idle.put(worker)

    pool, frames = ThreadPoolExecutor(number, "frames"), deque[Future[Any]]()
    try:
        for k in range(count):
            for figure in islice(figures, AHEAD * number - len(frames)):
                frames.append(pool.submit(draw, figure))
            frame = frames.popleft()
            progress(k / count, f"frame {k + 1} of {count}")
            while not wait([frame], NOTICED).done:
                progress(k / count, f"frame {k + 1} of {count}")
            if isinstance(error := frame.exception(), Exception) and not isinstance(error, BihdistError):
                raise BihdistError(f"Frame {k + 1} could not be drawn ({type(error).__name__}).") from error
            yield frame.result()
    finally:
        for worker in workers:
            worker.close()
        pool.shutdown(wait=False, cancel_futures=True)
