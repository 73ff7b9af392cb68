"""What is on the screen in a view, as an array."""

import numpy as np


def painted(view):
    """(h, w, 3) uint8: the surface with all that lies over it."""
    return pixels_of(view.grab().toImage())[..., :3]


def pixels_of(image):
    """(h, w, 4) uint8: a copy of a picture's red, green, blue and opacity."""
    from qtpy import QtGui

    image = image.convertToFormat(QtGui.QImage.Format.Format_RGBA8888)
    pixels = image.constBits()
    if hasattr(pixels, "setsize"):  # of PyQt
        pixels.setsize(image.sizeInBytes())
    return np.frombuffer(pixels, np.uint8).reshape(image.height(), image.width(), 4).copy()
