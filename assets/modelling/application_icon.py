"""`python -m assets.modelling.application_icon`: the program's icon, into `assets/application`.

A sphere with the bands between isolines of the distance from a point on it, as the viewer shows them.
"""

import os

import numpy as np
from PIL import Image

from app.scene.colour_maps import PAPER

from .__main__ import ASSETS

SIDE, RADIUS = 256, 122
SOURCE = np.array([-0.5, 0.55, np.sqrt(1 - 0.5**2 - 0.55**2)])
"""On the sphere of radius 1, seen from +z; y up."""
SEEN = np.pi - np.arccos(SOURCE[2])
"""The angle from the source to the farthest point that is seen."""
BANDS, LINE = 10, 3.5
STEPS = 128
"""Corners of a circle."""
PIXELS = {16: 5, 24: 5, 32: 6, 48: 7, 64: BANDS, 128: BANDS, 256: BANDS}
"""The sides of pictures, for what draws no SVG, with their bands: of small ones, else lines alone would be seen."""

ICNS = {16: b"icp4", 32: b"icp5", 64: b"icp6", 128: b"ic07", 256: b"ic08"}
"""What macOS calls pictures of these sides."""


def drawing(bands: int = BANDS) -> str:
    """The icon as SVG, of shapes that every program draws."""
    places, colours = np.array([place for place, _ in PAPER]), np.array([colour for _, colour in PAPER])
    line = LINE * BANDS / bands
    parts = []
    for band in reversed(range(bands)):
        middle = [np.interp((band + 0.5) / bands, places, column) for column in colours.T]
        fill = "#" + "".join(f"{round(255 * value):02x}" for value in middle)
        corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in _cap((band + 1) / bands * SEEN))
        parts.append(f'<polygon points="{corners}" fill="{fill}"/>')
    (x, y), radius, ring = _on_ground(SOURCE), 3 * line, 1.75 * line
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIDE}" height="{SIDE}" viewBox="0 0 {SIDE} {SIDE}">\n'
        f'<g stroke="#fff" stroke-width="{line:g}" stroke-linejoin="round">\n' + "\n".join(parts) + "\n</g>\n"
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="#fff" stroke="#141414" stroke-width="{ring:g}"/>\n'
        "</svg>\n"
    )


def _cap(angle: float) -> np.ndarray:
    """(k, 2) the outline of what is seen of the points of the sphere up to an angle from the source."""
    across = np.cross(SOURCE, [0, 0, 1]) / np.hypot(*SOURCE[:2])
    down = np.cross(SOURCE, across)
    turn = np.linspace(0, 2 * np.pi, STEPS, endpoint=False)[:, None]
    isoline = np.cos(angle) * SOURCE + np.sin(angle) * (np.cos(turn) * across + np.sin(turn) * down)
    limb = np.hstack([np.cos(turn), np.sin(turn), 0 * turn])
    inside = np.vstack([isoline[isoline[:, 2] > 0], limb[limb @ SOURCE > np.cos(angle)]])
    # All of it is seen from the source, so its corners have an order around that.
    x, y = (inside - SOURCE)[:, :2].T
    return _on_ground(inside[np.argsort(np.arctan2(y, x))])


def _on_ground(at: np.ndarray) -> np.ndarray:
    """Points (..., 3) of the sphere where the drawing has them (..., 2)."""
    return SIDE / 2 + RADIUS * at[..., :2] * [1, -1]


def picture(pixels: int, bands: int) -> Image.Image:
    """The icon at a size."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from qtpy import QtCore, QtGui, QtSvg

    _ = QtGui.QGuiApplication.instance() or QtGui.QGuiApplication([])
    image = QtGui.QImage(pixels, pixels, QtGui.QImage.Format.Format_RGBA8888)
    image.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(image)
    QtSvg.QSvgRenderer(drawing(bands).encode()).render(painter)
    painter.end()
    bits = image.constBits()
    data = bits.asstring(image.sizeInBytes()) if hasattr(bits, "asstring") else bytes(bits)
    return Image.frombytes("RGBA", (pixels, pixels), data)


def main() -> None:
    """Write the drawing, its pictures, and the files that Windows and macOS want."""
    folder = ASSETS / "application"
    folder.mkdir(exist_ok=True)
    (folder / "bihdist.svg").write_text(drawing(), encoding="utf-8")
    pictures = {pixels: picture(pixels, bands) for pixels, bands in PIXELS.items()}
    for pixels, each in pictures.items():
        each.save(folder / f"bihdist-{pixels}.png", optimize=True)
    *others, largest = pictures.values()
    largest.save(folder / "bihdist.ico", sizes=[each.size for each in pictures.values()], append_images=others)
    # Pillow would also write sizes there is no picture of, blown up.
    entries = [
        kind + (8 + len(data)).to_bytes(4, "big") + data
        for pixels, kind in ICNS.items()
        for data in [(folder / f"bihdist-{pixels}.png").read_bytes()]
    ]
    content = b"".join(entries)
    (folder / "bihdist.icns").write_bytes(b"icns" + (8 + len(content)).to_bytes(4, "big") + content)


if __name__ == "__main__":
    main()
