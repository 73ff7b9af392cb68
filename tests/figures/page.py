"""One page with figures of five kinds of surface in PNG, PDF and SVG, whole and enlarged, for looking at.

    python -m tests.figures.page FOLDER

Needs pdftoppm (poppler-utils) and rsvg-convert (librsvg2-bin), which draw PDF and SVG as other programs would.
"""

import subprocess
import sys
import time
from html import escape
from pathlib import Path

import numpy as np
from PIL import Image

from app.drawing.style import STYLES
from app.figures.draw import Figure, FigurePanel, Mark, Zoom, draw_figure, save_figure
from app.figures.size import Size
from app.samples import mesh_path
from app.session.session import first_source
from bihdist_core import BiharmonicDistance, DiffusionDistance, GeodesicDistance, Laplacian, Surface, read_surface
from tests.shapes import bumpy, torus

SIZE = Size(160, unit="mm", dpi=300)
ENLARGED = 4
"""The second picture of each file is this many times larger."""

CLOSE_UP = 340
"""Pixels of a 96 dpi page, along a side of what the second picture shows."""


def many_components() -> Surface:
    """Bumpy balls and rings, some before others."""
    parts = [bumpy(1200, seed=k) for k in range(5)] + [torus(80, 40)]
    places = [(0, 0, 0), (2.2, 0.6, -1), (-2.0, 0.9, -0.5), (0.6, 2.2, -0.8), (-1.1, -1.6, 1.0), (0.8, -0.6, 0.2)]
    vertices, faces, start = [], [], 0
    for part, place in zip(parts, places, strict=True):
        vertices.append(part.vertices * (1.0 if part.name != "torus" else 0.55) + place)
        faces.append(part.faces + start)
        start += len(part.vertices)
    return Surface(np.concatenate(vertices), np.concatenate(faces), "many components")


def comparison(surface: Surface, source: int, **options) -> tuple[FigurePanel, ...]:
    """The three distances of the paper."""
    laplacian = Laplacian(surface)
    distances = [
        BiharmonicDistance(laplacian),
        GeodesicDistance(laplacian, "heat"),
        DiffusionDistance(laplacian, t=1.0),
    ]
    return tuple(
        FigurePanel(
            surface, d.from_source(source), d.label, label=d.label, unit=d.unit, marks=(Mark(source),), **options
        )
        for d in distances
    )


def scenes() -> dict[str, Figure]:
    """Name: figure; the styles and the options of figures are spread over them."""
    person, hand, ring, scan, flat = (
        read_surface(mesh_path(name)) for name in ("figure", "hand", "genus3", "scan", "domain")
    )
    tip = int(hand.vertices[:, 0].argmax())
    return {
        "closed": Figure(
            comparison(person, first_source(person), zooms=(Zoom(int(person.vertices[:, 0].argmax())),)), size=SIZE
        ),
        "with boundary": Figure(comparison(scan, first_source(scan)), size=SIZE, style=STYLES["dark"]),
        "many components": Figure(comparison(many_components(), 0), size=SIZE, style=STYLES["uniform"]),
        "genus 3": Figure(comparison(ring, first_source(ring), views=("home", "back"))[:1], size=SIZE, crop=True),
        "flat": Figure(comparison(flat, first_source(flat)), size=SIZE),
        "flat, as a relief": Figure(comparison(flat, first_source(flat), height=0.35), size=SIZE, crop=True),
        "isolines only": Figure(comparison(hand, tip), size=SIZE, style=STYLES["lines"]),
    }


def write_page(folder: Path) -> Path:
    """All files, and index.html; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    parts = ["<!doctype html><meta charset=utf-8><title>Figures</title><style>img{border:1px solid #ccc}</style>"]
    for name, figure in scenes().items():
        stem = name.replace(" ", "-").replace(",", "")
        parts.append(f"<h2>{escape(name)}</h2>")
        for extension in ("png", "pdf", "svg"):
            start = time.perf_counter()
            file = folder / f"{stem}.{extension}"
            save_figure(figure, file)
            seconds = time.perf_counter() - start
            shown, close = pictures(figure, file)
            size = file.stat().st_size / 1e6
            parts.append(f"<p>{escape(file.name)}, {size:.2f} MB, {seconds:.1f} s</p>")
            parts.append(f'<img src="{shown.name}"><br><img src="{close.name}">')
            print(f"{file.name:28} {size:6.2f} MB {seconds:6.1f} s", flush=True)
    page = folder / "index.html"
    page.write_text("\n".join(parts), encoding="utf-8")
    return page


def pictures(figure: Figure, file: Path) -> tuple[Path, Path]:
    """A file as its readers see it at 96 dpi, and its middle enlarged."""
    large = file.with_name(f"{file.stem}-{file.suffix[1:]}-large.png")
    if file.suffix == ".pdf":
        target = large.with_suffix("")
        subprocess.run(["pdftoppm", "-r", str(96 * ENLARGED), "-png", "-singlefile", file, target], check=True)
    elif file.suffix == ".svg":
        subprocess.run(["rsvg-convert", "-z", str(ENLARGED), "-o", large, file], check=True)
    else:
        Image.fromarray(
            draw_figure(Figure(**{**figure.__dict__, "size": Size(160, unit="mm", dpi=96 * ENLARGED)}))
        ).save(large)
    picture = Image.open(large).convert("RGB")
    shown, close = (file.with_name(f"{file.stem}-{file.suffix[1:]}-{kind}.png") for kind in ("100", "400"))
    picture.resize([side // ENLARGED for side in picture.size], Image.Resampling.LANCZOS).save(shown)
    side = CLOSE_UP * ENLARGED
    x, y = (max(0, round(share * length - side / 2)) for share, length in zip((0.17, 0.45), picture.size, strict=True))
    picture.crop((x, y, min(x + side, picture.width), min(y + side, picture.height))).save(close)
    large.unlink()
    return shown, close


if __name__ == "__main__":
    print(write_page(Path(sys.argv[1])))
