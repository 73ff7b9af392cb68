"""The pictures of the page, and the pages that compute, made by a process while the next experiment is computed."""

import io
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import TracebackType
from typing import Any

from bihdist_core import BihdistError
from bihdist_core.file_output import atomic_write

from ..figures.draw import Figure, draw_figure
from ..figures.shots import RenderCache
from ..figures.worker import GONE, Worker
from .live import LivePage, write_live

Picture = Callable[[], bytes]
"""Waits for a picture, and gives its PNG; raises BihdistError if it could not be drawn, OutputError if not written."""

Written = Callable[[], int]
"""Waits for a page that computes, and gives its size in bytes; raises as `Picture` does."""


class Pictures:
    """A context: within it pictures are drawn, and pages written, one after another."""

    def __enter__(self) -> "Pictures":
        self._worker: Worker | None = None
        self._turn = ThreadPoolExecutor(1, thread_name_prefix="pictures")
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._turn.shutdown(wait=False, cancel_futures=True)
        if self._worker is not None:
            self._worker.close()

    def draw(self, folder: Path, name: str, figure: Figure) -> Picture:
        """Start to draw a figure as NAME.png."""

        def drawn() -> bytes:
            content: bytes = self._ask(png, figure)
            with atomic_write(folder / f"{name}.png") as temporary:
                temporary.write_bytes(content)
            return content

        return self._turn.submit(drawn).result

    def write(self, folder: Path, page: LivePage) -> Written:
        """Start to write a page that computes into a folder."""
        return self._turn.submit(self._ask, write_live, page, folder / page.file).result

    def _ask(self, function: Callable[..., Any], *arguments: object) -> Any:
        """Run a function in the process that draws, which starts with the first picture, and again after it has
        ended."""
        if self._worker is None:
            self._worker = Worker(threads=1)
        try:
            return self._worker.ask(function, *arguments)
        except BihdistError as error:
            if str(error) == GONE:
                self._worker.close()
                self._worker = None
            raise


def png(figure: Figure) -> bytes:
    """Return a figure as a PNG file."""
    from PIL import Image

    buffer = io.BytesIO()
    # It has more pixels than the page shows of it: with still finer ones it takes half as long again.
    with RenderCache(finer=1) as render_cache:
        pixels = draw_figure(figure, render_cache=render_cache)
    Image.fromarray(pixels).save(buffer, "PNG")  # optimized it is 2 % smaller, in five times as long
    return buffer.getvalue()
