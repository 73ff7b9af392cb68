"""The frames of a movie, drawn by several processes at once and handed over in their order."""

from __future__ import annotations

import os
from collections.abc import Generator, Iterator
from queue import Empty, SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core import BihdistError
from bihdist_core.arrays import ByteArray
from bihdist_core.progress import Progress

from ..scene.style import Style
from .composition import KeptWords
from .description import Figure
from .draw import draw_figure
from .shots import RenderCache
from .worker import Worker

if TYPE_CHECKING:
    from PIL.Image import Image

EACH = 6
"""A process is worth its start for so many frames."""

AHEAD = 2
"""How many frames for each process may wait to be drawn, or for those before them."""

ALIKE = 4.0
"""Steps of 255 by which a colour differs from another that is taken for it, at most."""

NOTICED = 0.1
"""Seconds within which it is noticed that the movie is not wanted any more."""


def drawn_frames(
    figures: Iterator[Figure], count: int, mode: str, workers: int | None, progress: Progress
) -> Generator[Any, None, None]:
    """The pictures of so many figures: arrays (height, width, 3) uint8 for the mode "RGB", images of PIL for "P".

    workers: how many processes draw, one for each processor if None; few frames are drawn in this one.
    """
    number = min(workers or processors(), count // EACH)
    if number < 2:
        yield from _drawn_here(figures, count, mode, progress)
    else:
        yield from _drawn_by_others(figures, count, mode, number, progress)
    progress(1.0, "")


def processors() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Drawing:
    """What a process keeps from one frame to the next."""

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
    """An image with a palette of what there is most of, and of the ground and the marks, though these be small."""
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
    """What a worker is asked."""
    if not _OF_THIS_PROCESS:
        _OF_THIS_PROCESS.append(_Drawing())
    return _OF_THIS_PROCESS[0].frame(figure, mode)


def _drawn_by_others(
    figures: Iterator[Figure], count: int, mode: str, number: int, progress: Progress
) -> Iterator[Any]:
    asked: SimpleQueue[tuple[int, Figure] | None] = SimpleQueue()
    answers: SimpleQueue[tuple[int, Any]] = SimpleQueue()
    # With a thread each, software OpenGL and the libraries of several processes do not stand in each other's way.
    workers = [Worker(threads=1) for _ in range(number)]

    def draw(worker: Worker) -> None:
        while (work := asked.get()) is not None:
            k, figure = work
            try:
                answers.put((k, worker.ask(_frame, figure, mode)))
            except Exception as error:
                answers.put((k, error))

    for worker in workers:
        Thread(target=draw, args=(worker,), name="frames", daemon=True).start()
    try:
        yield from _in_order(figures, count, AHEAD * number, asked, answers, progress)
    finally:
        for _ in workers:
            asked.put(None)
        for worker in workers:
            worker.close()


def _in_order(
    figures: Iterator[Figure],
    count: int,
    ahead: int,
    asked: SimpleQueue[tuple[int, Figure] | None],
    answers: SimpleQueue[tuple[int, Any]],
    progress: Progress,
) -> Iterator[Any]:
    drawn: dict[int, Any] = {}
    waiting = enumerate(figures)
    for work in (next(waiting) for _ in range(min(ahead, count))):
        asked.put(work)
    for k in range(count):
        while k not in drawn:
            progress(k / count, f"frame {k + 1} of {count}")
            try:
                number, picture = answers.get(timeout=NOTICED)
            except Empty:
                continue
            if isinstance(picture, BihdistError):
                raise picture
            if isinstance(picture, Exception):
                raise BihdistError(f"Frame {number + 1} could not be drawn ({type(picture).__name__}).") from picture
            drawn[number] = picture
        yield drawn.pop(k)
        for work in waiting:
            asked.put(work)
            break
