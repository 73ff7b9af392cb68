"""Directions from which a surface may be seen, by name.  Without NumPy, which takes long to load."""

HOME, HIGH = (0.45, 0.25, 1.0), (0.45, 0.9, 1.0)

OBLIQUE_VIEWS = {
    f"{name}{side}": (a * right + b * front, height, a * front - b * right)
    for name, (right, height, front) in {"home": HOME, "high": HIGH}.items()
    for side, a, b in (("", 1, 0), ("-right", 0, 1), ("-back", -1, 0), ("-left", 0, -1))
}
"""The direction from the shape to the camera, as fractions to the right, up and to the front: from a little or well
above, from four sides."""

FIRST_VIEWS = ("home", "home-right", "home-back", "home-left", "high")
"""The oblique views of which the first is chosen.  From above, the sides show hardly more than one of these."""
