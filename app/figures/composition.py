"""A page from its pictures and words: composed of pixels, or written as PDF or SVG with curves, text and bars."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from bihdist_core import Surface

from .canvas import Composition, drawn, matplotlib_settings
from .description import FigurePanel
from .layout import Box

CROP_MARGIN = 6.0
"""Units left around what is drawn."""


class KeptWords:
    """The words and bars of a page, kept while the next page has the same, as it has where only its shapes turn."""

    def __init__(self) -> None:
        self._of: tuple | None = None
        self._notes = np.empty((0, 0, 4), np.uint8)

    def of(self, page: Composition) -> np.ndarray:
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


def page_pixels(page: Composition, words: KeptWords | None = None) -> np.ndarray:
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


def crop(page: Composition, pixels: np.ndarray) -> np.ndarray:
    """The pixels without the empty margins."""
    x, y, width, height = content(page).pixels(page.layout.scale)
    return pixels[y : y + height, x : x + width].copy()


def content(page: Composition) -> Box:
    """The part of the page on which something is drawn, with a narrow margin."""
    scale = page.layout.scale
    boxes = []
    for shot in page.shots:
        found = _filled(shot.image[..., 3], scale)
        if found:
            boxes.append(Box(shot.box.x + found.x, shot.box.y + found.y, found.width, found.height))
    bare = replace(page, shots=[replace(shot, image=shot.image[:0], isolines=[]) for shot in page.shots])
    words = _filled(_drawn(replace(bare, figure=replace(page.figure, transparent=True)))[..., 3], scale)
    boxes += [words] if words else []
    width, height = (side / scale for side in page.layout.page)
    if not boxes:
        return Box(0, 0, width, height)
    x, y = (max(min(getattr(b, k) for b in boxes) - CROP_MARGIN, 0) for k in "xy")
    right = min(max(b.right for b in boxes) + CROP_MARGIN, width)
    bottom = min(max(b.bottom for b in boxes) + CROP_MARGIN, height)
    return Box(x, y, right - x, bottom - y).snapped(scale)


def write_vector(page: Composition, path: Path) -> None:
    """A .pdf or .svg file: one image per picture; isolines, outlines, text and bars as what they are."""
    from matplotlib.transforms import Bbox

    options: dict = {"transparent": page.figure.transparent, "facecolor": page.figure.style.background}
    if page.figure.crop:
        box = content(page)
        top = page.layout.height - box.y
        options["bbox_inches"] = Bbox(np.array([[box.x, top - box.height], [box.right, top]]) / 96)
    dates = {"CreationDate": None} if path.suffix.lower() == ".pdf" else {"Date": None}
    with matplotlib_settings():
        drawn(page, vector=True).savefig(path, metadata={"Creator": "bihdist", **dates}, **options)


def _drawn(page: Composition, shots: bool = True, words: bool = True) -> np.ndarray:
    """(height, width, 4) uint8, colours not multiplied by alpha; without shots, on nothing."""
    width, height = page.layout.page
    with matplotlib_settings():
        canvas = drawn(page, False, shots, words).canvas
        canvas.draw()
        return np.asarray(canvas.buffer_rgba())[:height, :width]


def _filled(alpha: np.ndarray, scale: float) -> Box | None:
    """The rectangle outside of which alpha is 0, in units."""
    rows, columns = np.flatnonzero(alpha.any(axis=1)), np.flatnonzero(alpha.any(axis=0))
    if not len(rows):
        return None
    return Box(
        columns[0] / scale,
        rows[0] / scale,
        (columns[-1] + 1 - columns[0]) / scale,
        (rows[-1] + 1 - rows[0]) / scale,
    )


def _scaled(colours: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return ((colours.astype(np.uint16) * alpha + 127) // 255).astype(np.uint8)
