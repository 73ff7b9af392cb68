"""`python -m assets.modelling.sheet OUT.png [--thumbnails FOLDER]`: contact sheet of the samples, and small pictures.

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
    "beast": [(1, 0.2, 0.5), (0.35, 0.1, 1), (-0.6, 0.4, -1)],
    "beast_pose2": [(-0.35, 0.15, 1), (-1, 0.1, 0.5), (-0.6, 0.3, -1)],
    "elephant": [(0.25, 0.1, 1), (1, 0.3, 0.9), (-0.9, 0.4, 0.8)],
    "octopus": [(0.05, 1, 0.4), (0.6, 0.7, 1), (1, 0.3, 0.1)],
    "hand": [(0, 0, 1), (1, 0.2, 0.8), (-0.3, 0.1, -1)],
    "genus3": [(0, 0, 1), (0.2, 0.7, 1), (1, 0.3, 0.6)],
    "domain": [(0, 0, 1), (0.5, -0.3, 1), (-0.5, -0.5, 1)],
    "part": [(0.1, -0.8, 1), (0, -0.2, 1), (0.15, -0.85, -0.8)],
    "scan": [(0, 0, 1), (1, 0.15, 0.7), (-0.5, 0.15, -1)],
    "hare": [(1, -0.45, 0.2), (-1, -0.9, 0.25), (-1, 0.4, 0.4)],
}

Y = (0, 1, 0)

UP = {
    # Where it is not y.
    "hare": (0, 0, 1),
}

SOURCES = {
    # The vertex nearest to this point is the source.
    "figure": (0, 1.70, 0.11),
    "figure_pose2": (0, 1.70, 0.11),
    "animal": (1.05, 1.40, 0),
    "beast": (0, 0.92, 0.38),
    "beast_pose2": (0.1, 0.80, 0.60),
    "elephant": (1.33, 0.65, 0),
    "octopus": (0.03, 0.35, -0.25),
    "hand": (0.15, 1.85, 0.3),
    "genus3": (0, 1.6, 0),
    "domain": (0.2, 1.2, 0),
    "part": (0, -68, 32),
    "scan": (0, 1.70, 0.11),
    "hare": (0, -0.21, 0.30),
}

THUMBNAIL = 160


def distances(name: str, surface: Surface) -> np.ndarray:
    """(n,) biharmonic distance from the sample's source."""
    source = np.linalg.norm(surface.vertices - SOURCES[name], axis=1).argmin()
    return BiharmonicDistance(surface).from_source(int(source))


def thumbnail(name: str, surface: Surface, field: np.ndarray) -> Image.Image:
    """Its best side, drawn twice as large and reduced, which smooths the isolines."""
    size = (2 * THUMBNAIL, 2 * THUMBNAIL)
    picture = row(surface, [SIDES[name][0]], field, size, isolines=12, scale=1.2, up=UP.get(name, Y))
    return Image.fromarray(picture).resize((THUMBNAIL, THUMBNAIL), Image.Resampling.LANCZOS)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m assets.modelling.sheet", description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, help="the contact sheet")
    parser.add_argument("--from", type=Path, default=ASSETS, dest="folder", help="where the PLY files are")
    parser.add_argument(
        "--thumbnails", type=Path, metavar="FOLDER", help="where the menu's pictures go, if they are made"
    )
    options = parser.parse_args()
    rows = []
    for name in SAMPLES:
        surface = read_surface(options.folder / f"{name}.ply")
        field, up = distances(name, surface), UP.get(name, Y)
        rows.append(np.hstack([row(surface, SIDES[name], up=up), row(surface, SIDES[name], field, up=up)]))
        if options.thumbnails is not None:
            options.thumbnails.mkdir(exist_ok=True)
            thumbnail(name, surface, field).save(options.thumbnails / f"{name}.png", optimize=True)
    Image.fromarray(np.vstack(rows)).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
