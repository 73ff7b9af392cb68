"""A page from its pictures and words: composed of pixels, or written as PDF or SVG with curves, text and bars."""

from __future__ import annotations

import io
import re
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core.arrays import AnyArray, ByteArray

from .canvas import drawn, matplotlib_settings
from .description import Figure, FigurePanel
from .page_layout import ComposedPage

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas


class KeptWords:
    """The words and bars of a page, kept while the next page has the same, as it has where only its shapes turn."""

    def __init__(self) -> None:
        self._of: ComposedPage | None = None
        self._notes = np.empty((0, 0, 4), np.uint8)

    def of(self, page: ComposedPage) -> ByteArray:
        """Return pixels (height, width, 4) uint8 of a page's words and bars."""
        kept = self._of
        if kept is None or kept.layout != page.layout or not _read_alike(kept.figure, page.figure):
            self._of, self._notes = replace(page, shots=[]), _drawn(page, shots=False)
        return self._notes


def _read_alike(one: Figure, other: Figure) -> bool:
    """Return whether two figures have the same words and bars; arrays and surfaces are equal to themselves alone."""
    if any(getattr(one, name) != getattr(other, name) for name in ("style", "range", "charts")):
        return False
    if len(one.panels) != len(other.panels):
        return False
    names = [f.name for f in fields(FigurePanel) if f.name not in ("views", "marks")]
    return all(
        _is_same(getattr(a, name), getattr(b, name))
        for a, b in zip(one.panels, other.panels, strict=True)
        for name in names
    )


def _is_same(a: object, b: object) -> bool:
    return a is b or not (isinstance(a, np.ndarray) or isinstance(b, np.ndarray) or a != b)


def page_pixels(page: ComposedPage, words: KeptWords | None = None) -> ByteArray:
    """Return the page's pixels (height, width, 3) uint8, (height, width, 4) if it is transparent.

    Words that are kept are not drawn again.
    """
    if words is not None and not page.figure.transparent:
        pixels, notes = _drawn(page, words=False)[..., :3].copy(), words.of(page)
        # By rows: a whole page in wider numbers would take several times its memory.
        for y in np.flatnonzero(notes[..., 3].any(axis=1)):
            alpha = notes[y, :, 3:]
            pixels[y] = _scaled(notes[y, :, :3], alpha) + _scaled(pixels[y], 255 - alpha)
        return pixels
    pixels = _drawn(page)
    if not page.figure.transparent:
        return pixels[..., :3].copy()
    pixels = pixels.copy()
    pixels[pixels[..., 3] == 0] = 0
    return pixels


def write_vector(page: ComposedPage, path: Path) -> None:
    """Write a .pdf, .svg or .eps file: an image for each picture; isolines, outlines, text and bars as vectors."""
    figure = page.figure
    # What is white is left out: paper is white by itself.
    is_bare = figure.transparent or figure.style.background == (1, 1, 1)
    options: dict[str, Any] = {"transparent": is_bare, "facecolor": figure.style.background}
    with matplotlib_settings(figure.font):
        write_undated(drawn(page, vector=True), path, {"Creator": "bihdist"}, **options)


def write_undated(canvas: Canvas, path: Path, metadata: dict[str, Any], **options: Any) -> None:
    """Write a page of matplotlib's so that the file is equal when it is written again."""
    extension = path.suffix.lower()
    dates = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(extension, {})
    # Not to the file: where a disk is full, matplotlib's PDF ends with an error of zlib's.
    memory = io.BytesIO()
    canvas.savefig(memory, format=extension[1:], metadata={**metadata, **dates}, **options)
    content = memory.getvalue()
    if extension == ".eps":
        content = re.sub(rb"^%%(CreationDate|Title):[^\n]*\n", b"", content, count=2, flags=re.MULTILINE)
    path.write_bytes(content)


def _drawn(page: ComposedPage, shots: bool = True, words: bool = True) -> ByteArray:
    """Return pixels (height, width, 4) uint8 with straight alpha, transparent around words without shots."""
    width, height = page.layout.page
    with matplotlib_settings(page.figure.font):
        canvas: Any = drawn(page, False, shots, words).canvas  # Agg's
        canvas.draw()
        pixels: ByteArray = np.asarray(canvas.buffer_rgba())[:height, :width]
        return pixels


def _scaled(colours: AnyArray, alpha: AnyArray) -> AnyArray:
    return ((colours.astype(np.uint16) * alpha + 127) // 255).astype(np.uint8)
