"""What pictures look like: the one place where colours and line widths are defined."""

from dataclasses import dataclass

import numpy as np

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Style:
    """Colours are RGB from 0 to 1; widths are in pixels at scale 1."""

    stops: tuple[tuple[float, Colour], ...]
    background: Colour = (1, 1, 1)
    text: Colour = (0.13, 0.14, 0.16)
    quiet_text: Colour = (0.45, 0.47, 0.5)
    isoline: Colour = (1, 1, 1)
    isoline_width: float = 1.5
    undefined: Colour = (0.72, 0.72, 0.7)
    source: Colour = (1.0, 0.86, 0.1)
    pointer: Colour = (1, 1, 1)
    marker_size: float = 15.0

    def colours(self, count: int = 512) -> np.ndarray:
        """(count, 3) the colour map from the source to the farthest point."""
        at = np.array([s for s, _ in self.stops])
        colours = np.array([c for _, c in self.stops])
        x = np.linspace(0, 1, count)
        return np.stack([np.interp(x, at, colours[:, k]) for k in range(3)], 1)


PAPER = Style(
    stops=(
        (0.0, (0.03, 0.07, 0.42)),
        (0.17, (0.08, 0.32, 0.78)),
        (0.34, (0.33, 0.73, 0.90)),
        (0.50, (0.80, 0.82, 0.83)),
        (0.66, (0.95, 0.62, 0.66)),
        (0.84, (0.83, 0.18, 0.20)),
        (1.0, (0.45, 0.02, 0.06)),
    )
)
"""The paper's look: dark blue near, through cyan, grey and pink, to dark red far; white isolines."""
