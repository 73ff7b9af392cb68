"""The pictures of the page, drawn by a process of its own while the next experiment is computed."""

import io
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures import wait as wait_for
from pathlib import Path
from types import TracebackType

from bihdist_core.whole_file import whole_file

from ..figures.draw import Figure, draw_figure
from ..figures.shots import Stage
from ..figures.worker import Worker

Picture = Callable[[], bytes]
"""Waits for a picture, and gives its PNG; raises BihdistError if it could not be drawn, OutputError if not written."""


class Pictures:
    """A context: within it pictures are drawn one after another."""

    def __enter__(self) -> "Pictures":
        self._worker = Worker(threads=1)
        self._turn = ThreadPoolExecutor(1, thread_name_prefix="pictures")
        self._begun: list[Future[bytes]] = []
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._turn.shutdown(wait=False, cancel_futures=True)
        self._worker.close()

    def draw(self, folder: Path, name: str, figure: Figure) -> Picture:
        """Have a figure drawn, and kept as NAME.png."""

        def drawn() -> bytes:
            content: bytes = self._worker.ask(png, figure)
            with whole_file(folder / f"{name}.png") as temporary:
                temporary.write_bytes(content)
            return content

        future = self._turn.submit(drawn)
        self._begun.append(future)
        return future.result

    def wait(self) -> None:
        """Until none is being drawn, so that what is timed has the computer for itself."""
        wait_for(self._begun)
        self._begun.clear()


def png(figure: Figure) -> bytes:
    """A figure as a PNG file."""
    from PIL import Image

    buffer = io.BytesIO()
    # It has more pixels than the page shows of it: with still finer ones it takes half as long again.
    with Stage(finer=1) as stage:
        pixels = draw_figure(figure, stage=stage)
    Image.fromarray(pixels).save(buffer, "PNG")  # optimized it is 2 % smaller, in five times as long
    return buffer.getvalue()
