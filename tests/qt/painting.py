"""What is on the screen in a view, as an array."""

import numpy as np


def painted(view):
    """(h, w, 3) uint8: the surface with all that lies over it."""
    from qtpy import QtGui

    image = view.grab().toImage().convertToFormat(QtGui.QImage.Format.Format_RGBX8888)
    pixels = image.constBits()
    if hasattr(pixels, "setsize"):
        pixels.setsize(image.sizeInBytes())
    return np.frombuffer(pixels, np.uint8).reshape(image.height(), image.width(), 4)[..., :3].copy()
