"""How the place of a source is marked, in the window as in figures: a flat disc with a rim, or a dashed ring behind."""

RIM = 0.1
"""The width of the rim, as a share of what the disc with it is across."""

DASHED = 0.12
"""The width of the ring where the surface hides the place; the same."""

HALO = 1.9
"""How wide what lies under the dashes is, in widths of these."""

DASHES = (2.2, 1.4)
"""How long dashes and gaps are, in widths of the ring."""
