"""Directions from which a surface may be seen first, by name.  Without NumPy, which takes long to load."""

HOME, HIGH = (0.45, 0.25, 1.0), (0.45, 0.9, 1.0)

FIRST_VIEWS = {
    f"{name}{side}": (a * right + b * front, height, a * front - b * right)
    for name, (right, height, front) in {"home": HOME, "high": HIGH}.items()
    for side, a, b in (("", 1, 0), ("-right", 0, 1), ("-back", -1, 0), ("-left", 0, -1))
}
"""From the shape to the camera, in shares of right, up and front: from a little or well above, from four sides."""
