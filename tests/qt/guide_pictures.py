"""`python -m tests.qt.guide_pictures [NAME...]`: the guide's pictures of the window, made anew from the real one.

It is driven with a pointer and keys on a screen of its own (Xvfb); all pictures go to assets/guide/pictures, the moving
one of the README to assets.  With names, only the scenes that have them are played.
"""

import argparse
import io
import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

from .driver import ROOT, Driver, Look, drive_elsewhere
from .guide_scenes import SCENES, Scene

MOVING = ROOT / "assets"
PICTURES = ROOT / "assets/guide/pictures"
SCALE = 1.2
"""Device pixels of a logical one: letters stay readable where a page shows a picture smaller than it is."""

LARGEST = Look("light", 1000, 620, SCALE)
MARGIN = 40
"""Pixels of the screen beside the window, for the pointer where it is not to be seen."""

EDGE = {"light": (200, 205, 211), "dark": (70, 76, 84)}
"""Colours of the line around a picture, which a window has from its desktop."""

BADGE = "#b4235a"
"""Colour of the numbers that name parts of the window; it is none of the window's own."""

MOVING_WIDTH, FRAME_MS = 720, 50
"""Pixels across a moving picture, and how long each of its frames is seen."""

FLAT = 20
"""How many colours of a picture's palette are those of flat parts, such as the ground and the bars."""

ARROW = ((0, 0), (0, 16.5), (3.9, 12.9), (6.5, 18.9), (9.2, 17.7), (6.7, 11.9), (11.9, 11.9))
"""Corners of the pointer that is drawn into pictures, from its tip, in logical pixels."""


def picture_names() -> set[str]:
    """The names of the pictures that the command makes for pages, without `.png`."""
    return {name for scene in SCENES for name in scene.names if not scene.is_moving}


class Photographer(Driver):
    """A driver whose pictures are those of the guide: with the pointer, cut to what they are of, in few colours.

    badges: places of the screen (QPoint) that get numbers, from 1 on.  is_pressed: whether a ring is drawn around the
    pointer.
    """

    def __init__(self, look: Look, out: Path) -> None:
        super().__init__(look, out)
        self.window.context.quiet, self.window.context.remembers = True, False
        self.made: set[str] = set()
        self.badges: list[Any] = []
        self.is_pressed = False
        self._frames: list[Image.Image] = []
        self.rest()

    def rest(self) -> None:
        """The pointer beside the window, where no picture has it."""
        self.pointer("mousemove", *(round(side * SCALE) + MARGIN // 2 for side in (LARGEST.width, LARGEST.height)))

    def shot(self, name: str, of: Any = None) -> None:
        """A picture of the screen now, of a widget or a rectangle of the screen (QRect) if one is given.

        How long the fields took is left out: it depends on what else this machine was doing.
        """
        self.window.status.show_time("")
        self.spin(0.3)
        in_few_colours(self.frame(of)).save(self._out / f"{name}.png", optimize=True)
        self.made.add(name)

    def film(self, count: int = 1) -> None:
        """Some frames of a moving picture."""
        frame = self.frame(self.without_status)
        height = round(frame.height * MOVING_WIDTH / frame.width)
        self._frames += [frame.resize((MOVING_WIDTH, height), Image.Resampling.LANCZOS)] * count

    @property
    def without_status(self) -> Any:
        """The window but its status bar (QRect), which says while one drags how quickly this machine follows."""
        from qtpy import QtCore

        return QtCore.QRect(0, 0, self.look.width, self.look.height - self.window.status.height())

    def moving(self, name: str) -> None:
        """What has been filmed, as a moving picture that begins again and again."""
        first, *others = self._frames
        first.save(
            self._out / f"{name}.webp",
            save_all=True,
            append_images=others,
            duration=FRAME_MS,
            loop=0,
            quality=50,
            method=4,
        )
        self.made.add(name)

    def frame(self, of: Any = None) -> Image.Image:
        """The window, or the part of it that `of` says, with the pointer where it is there."""
        from qtpy import QtCore

        with_pointer = self._with_pointer()
        if of is None:
            of = QtCore.QRect(0, 0, self.look.width, self.look.height)
        elif not isinstance(of, QtCore.QRect):
            of = QtCore.QRect(of.mapToGlobal(of.rect().topLeft()), of.rect().size())
        left, top = self.on_screen(of.topLeft())
        right, bottom = self.on_screen(of.topLeft() + QtCore.QPoint(of.width(), of.height()))
        picture = with_pointer.crop((left, top, right, bottom))
        edged = Image.new("RGB", picture.size, EDGE[self.look.theme])
        edged.paste(picture.crop((1, 1, picture.width - 1, picture.height - 1)), (1, 1))
        return edged

    def _with_pointer(self) -> Image.Image:
        from qtpy import QtCore, QtGui

        screen = self.screen_picture().toImage()
        screen.setDevicePixelRatio(1)
        painter = QtGui.QPainter(screen)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        at = self.on_screen(QtGui.QCursor.pos())
        for number, place in enumerate(self.badges, 1):
            self._paint_badge(painter, self.on_screen(place), str(number))
        painter.translate(*at)
        painter.scale(self.look.scale * 1.15, self.look.scale * 1.15)
        if self.is_pressed:
            painter.setPen(QtGui.QPen(QtGui.QColor("white"), 4))
            painter.drawEllipse(QtCore.QPointF(0, 0), 15, 15)
            painter.setPen(QtGui.QPen(QtGui.QColor("black"), 2))
            painter.drawEllipse(QtCore.QPointF(0, 0), 15, 15)
        pen = QtGui.QPen(QtGui.QColor("white"), 1.4)
        pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)  # the bindings call the argument differently
        painter.setPen(pen)
        painter.setBrush(QtGui.QColor("black"))
        painter.drawPolygon(QtGui.QPolygonF([QtCore.QPointF(*corner) for corner in ARROW]))
        painter.end()
        buffer = QtCore.QBuffer()
        buffer.open(QtCore.QIODevice.OpenModeFlag.WriteOnly)
        screen.save(buffer, "PNG")
        return Image.open(io.BytesIO(bytes(buffer.data()))).convert("RGB")

    def _paint_badge(self, painter: Any, at: tuple[int, int], text: str) -> None:
        from qtpy import QtCore, QtGui

        size = 20 * self.look.scale
        box = QtCore.QRectF(at[0] - size / 2, at[1] - size / 2, size, size)
        painter.setPen(QtGui.QPen(QtGui.QColor("white"), 2))
        painter.setBrush(QtGui.QColor(BADGE))
        painter.drawEllipse(box)
        font = QtGui.QFont(self.application.font())
        font.setPixelSize(round(12 * self.look.scale))
        font.setBold(True)
        painter.setFont(font)
        painter.drawText(box, QtCore.Qt.AlignmentFlag.AlignCenter, text)


def in_few_colours(picture: Image.Image) -> Image.Image:
    """With a palette of 256: colours of flat parts as they are, the others shared among what is large and small."""
    pixels = np.asarray(picture)
    colours, which, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_inverse=True, return_counts=True)
    flat = colours[np.argsort(-counts)[:FLAT]]
    # What is small counts for more than its area: marks, pins and text have colours of their own.
    samples = np.repeat(colours, np.ceil(counts**0.3).astype(int), axis=0)
    others = Image.fromarray(samples[None]).quantize(256 - FLAT, Image.Quantize.MEDIANCUT, kmeans=2)
    chosen = np.concatenate([flat, np.reshape(others.getpalette() or [], (-1, 3))]).astype(np.uint8)
    _, nearest = cKDTree(chosen).query(colours)  # Pillow's own search is off by some shades
    few = Image.fromarray(nearest[which].reshape(pixels.shape[:2]).astype(np.uint8))
    few.putpalette(chosen.ravel().tolist())
    return few


def play(scene: Scene, out: Path) -> None:
    """Make the pictures of a scene, in a window of its own."""
    photographer = Photographer(Look(scene.theme, scene.width, scene.height, SCALE), out)
    scene.act(photographer)
    photographer.close_dialogs()
    photographer.window.close()
    photographer.spin(0.2)
    if photographer.made != set(scene.names):
        raise RuntimeError(f"A scene made {sorted(photographer.made)}, and its row says {sorted(scene.names)}.")
    print(*scene.names, flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.qt.guide_pictures")
    parser.add_argument(
        "names", nargs="*", choices=[*(name for scene in SCENES for name in scene.names), []], metavar="NAME"
    )
    parser.add_argument("--out", type=Path, default=PICTURES)
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if not options.here:
        drive_elsewhere(LARGEST, "tests.qt.guide_pictures", [*sys.argv[1:], "--here"], margin=MARGIN)
        return
    for scene in SCENES:
        if not options.names or set(options.names) & set(scene.names):
            play(scene, MOVING if scene.is_moving and options.out == PICTURES else options.out.resolve())
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
