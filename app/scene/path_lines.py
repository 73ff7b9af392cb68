"""How the path of a profile looks: dark on white where it is seen, dotted where the surface hides it."""

WIDE, NARROW = 4.5, 2.0
"""Pixels, at scale 1, of the white line and of the dark one on it."""

THINNER = 0.5
"""By how many they are thinner where they are dotted."""

DOTS = 6.0
"""Pixels from one dot to the next."""
