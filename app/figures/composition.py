"""A page from its pictures and words: composed of pixels, or written as PDF or SVG with curves, text and bars."""

from __future__ import annotations

from dataclasses import fields
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
        """(height, width, 4) uint8, as `_notes`."""
        names = [f.name for f in fields(FigurePanel) if f.name not in ("views", "marks")]
        panels = [tuple(_told_apart(getattr(panel, name)) for name in names) for panel in page.figure.panels]
        key = (page.layout, page.figure.style, page.figure.range, *panels)
        if key != self._of:
            self._of, self._notes = key, _notes(page, shots=False)
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
    layout, background = page.layout, page.figure.style.background
    width, height = layout.page
    paper = np.array([*np.round(255 * np.array(background)), 255], np.uint8)
    pixels = np.zeros((height, width, 4), np.uint8)  # colours multiplied by alpha
    if not page.figure.transparent:
        pixels[:] = paper
    for shot in page.shots:
        x, y, w, h = shot.box.pixels(layout.scale)
        place = pixels[y : y + h, x : x + w]
        if shot.source is not None:
            place[:] = paper
        image = shot.image[: place.shape[0], : place.shape[1]]
        place[:] = image + _scaled(place, 255 - image[..., 3:])
    for notes in (_notes(page),) if words is None else (_notes(page, words=False), words.of(page)):
        # By rows: a whole page in wider numbers would take several times its memory.
        for y in np.flatnonzero(notes[..., 3].any(axis=1)):
            alpha = notes[y, :, 3:]
            ink = np.concatenate([_scaled(notes[y, :, :3], alpha), alpha], axis=1)
            pixels[y] = ink + _scaled(pixels[y], 255 - alpha)
    if not page.figure.transparent:
        return pixels[..., :3].copy()
    for row in pixels:
        row[:, :3] = _straight(row)
    return pixels


def crop(page: Composition, pixels: np.ndarray) -> np.ndarray:
    """The pixels without the empty margins."""
    x, y, width, height = content(page).pixels(page.layout.scale)
    return pixels[y : y + height, x : x + width].copy()


def content(page: Composition) -> Box:
    """The part of the page on which something is drawn, with a narrow margin."""
    scale = page.layout.scale
    boxes = [Box(s.box.x, s.box.y, s.box.width, s.box.height) for s in page.shots if s.source is not None]
    for shot in page.shots:
        found = _filled(shot.image[..., 3], scale)
        if found:
            boxes.append(Box(shot.box.x + found.x, shot.box.y + found.y, found.width, found.height))
    words = _filled(_notes(page)[..., 3], scale)
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


def _notes(page: Composition, shots: bool = True, words: bool = True) -> np.ndarray:
    """(height, width, 4) uint8: words, bars, marks and frames on nothing; colours not multiplied by alpha."""
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


def _straight(image: np.ndarray) -> np.ndarray:
    alpha = np.maximum(image[..., 3:], 1).astype(np.uint16)
    return np.minimum((image[..., :3].astype(np.uint16) * 255 + alpha // 2) // alpha, 255).astype(np.uint8)
