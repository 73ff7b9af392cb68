"""A page from its pictures and words: composed of pixels, or written as PDF or SVG with curves, text and bars."""

from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, ByteArray

from .canvas import Composition, drawn, matplotlib_settings
from .description import FigurePanel


class KeptWords:
    """The words and bars of a page, kept while the next page has the same, as it has where only its shapes turn."""

    def __init__(self) -> None:
        self._of: tuple[object, ...] | None = None
        self._notes = np.empty((0, 0, 4), np.uint8)

    def of(self, page: Composition) -> ByteArray:
        """(height, width, 4) uint8, as `_drawn`."""
        names = [f.name for f in fields(FigurePanel) if f.name not in ("views", "marks")]
        panels = [tuple(_told_apart(getattr(panel, name)) for name in names) for panel in page.figure.panels]
        key = (page.layout, page.figure.style, page.figure.range, *panels)
        if key != self._of:
            self._of, self._notes = key, _drawn(page, shots=False)
        return self._notes


class _Same:
    """An array or a surface, equal to itself alone."""

    def __init__(self, thing: object) -> None:
        self._thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other._thing is self._thing

    def __hash__(self) -> int:
        return id(self._thing)


def _told_apart(value: object) -> object:
    return _Same(value) if isinstance(value, np.ndarray | Surface) else value


def page_pixels(page: Composition, words: KeptWords | None = None) -> ByteArray:
    """(height, width, 3) uint8, or (height, width, 4) if it is transparent.  words: of the page before, if kept."""
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


def write_vector(page: Composition, path: Path) -> None:
    """A .pdf, .svg or .eps file: one image per picture; isolines, outlines, text and bars as what they are."""
    figure = page.figure
    # What is white is left out: paper is white by itself.
    is_bare = figure.transparent or figure.style.background == (1, 1, 1)
    options: dict[str, Any] = {"transparent": is_bare, "facecolor": figure.style.background}
    dates = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(path.suffix.lower(), {})
    with matplotlib_settings(figure.font):
        drawn(page, vector=True).savefig(path, metadata={"Creator": "bihdist", **dates}, **options)
    if path.suffix.lower() == ".eps":
        content = path.read_bytes()
        path.write_bytes(re.sub(rb"^%%(CreationDate|Title):[^\n]*\n", b"", content, count=2, flags=re.MULTILINE))


def _drawn(page: Composition, shots: bool = True, words: bool = True) -> ByteArray:
    """(height, width, 4) uint8, colours not multiplied by alpha; without shots, on nothing."""
    width, height = page.layout.page
    with matplotlib_settings(page.figure.font):
        canvas: Any = drawn(page, False, shots, words).canvas  # Agg's
        canvas.draw()
        pixels: ByteArray = np.asarray(canvas.buffer_rgba())[:height, :width]
        return pixels


def _scaled(colours: AnyArray, alpha: AnyArray) -> AnyArray:
    return ((colours.astype(np.uint16) * alpha + 127) // 255).astype(np.uint8)
