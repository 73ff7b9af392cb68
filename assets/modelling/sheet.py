"""`python -m assets.modelling.sheet [OUT.png]`: contact sheet of the samples, and their thumbnails for the menu.

Each sample has a row: from three sides in clay, from the same sides with isolines of the biharmonic distance.
"""

import argparse
from pathlib import Path

import numpy as np
from PIL import Image

from bihdist_core import BiharmonicDistance, Surface, read_surface

from .__main__ import ASSETS
from .build import SAMPLES
from .pictures import row

SIDES = {
    # Directions from the shape to the camera.
    "figure": [(0, 0, 1), (1, 0.15, 0.7), (-0.5, 0.15, -1)],
    "figure_pose2": [(0.1, 0.1, 1), (1, 0.15, 0.7), (-0.5, 0.15, -1)],
    "animal": [(0.05, 0.1, 1), (1, 0.3, 0.8), (-0.9, 0.4, 0.7)],
    "hand": [(0, 0, 1), (1, 0.2, 0.8), (-0.3, 0.1, -1)],
    "genus3": [(0, 0, 1), (0.2, 0.7, 1), (1, 0.3, 0.6)],
    "domain": [(0, 0, 1), (0.5, -0.3, 1), (-0.5, -0.5, 1)],
    "scan": [(0, 0, 1), (1, 0.15, 0.7), (-0.5, 0.15, -1)],
}

SOURCES = {
    # The vertex nearest to this point is the source.
    "figure": (0, 1.70, 0.11),
    "figure_pose2": (0, 1.70, 0.11),
    "animal": (1.05, 1.40, 0),
    "hand": (0.15, 1.85, 0.3),
    "genus3": (0, 1.6, 0),
    "domain": (0.2, 1.2, 0),
    "scan": (0, 1.70, 0.11),
}

THUMBNAIL = 160


def distances(name: str, surface: Surface) -> np.ndarray:
    """(n,) biharmonic distance from the sample's source."""
    source = np.linalg.norm(surface.vertices - SOURCES[name], axis=1).argmin()
    return BiharmonicDistance(surface).from_source(int(source))


def thumbnail(name: str, surface: Surface, field: np.ndarray) -> Image.Image:
    """Its best side, drawn twice as large and reduced, which smooths the isolines."""
    picture = row(surface, [SIDES[name][0]], field, (2 * THUMBNAIL, 2 * THUMBNAIL), isolines=12, scale=1.2)
    return Image.fromarray(picture).resize((THUMBNAIL, THUMBNAIL), Image.Resampling.LANCZOS)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m assets.modelling.sheet", description=__doc__.splitlines()[0])
    parser.add_argument("out", nargs="?", type=Path, help="the contact sheet; thumbnails only if none is given")
    parser.add_argument("--from", type=Path, default=ASSETS, dest="folder", help="where the PLY files are")
    options = parser.parse_args()
    thumbnails = options.folder / "thumbnails"
    thumbnails.mkdir(exist_ok=True)
    rows = []
    for name in SAMPLES:
        surface = read_surface(options.folder / f"{name}.ply")
        field = distances(name, surface)
        thumbnail(name, surface, field).save(thumbnails / f"{name}.png", optimize=True)
        if options.out:
            rows.append(np.hstack([row(surface, SIDES[name]), row(surface, SIDES[name], field)]))
    if options.out:
        Image.fromarray(np.vstack(rows)).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
