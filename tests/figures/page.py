"""One page with two dozen figures, each made by its command line, whole and enlarged, for looking at.

    python -m tests.figures.page FOLDER [--meshes FOLDER] [--only WORDS]

--meshes: a folder with more meshes, for the figures that no sample can show; without it these are left out, and named.
Needs pdftoppm (poppler-utils), rsvg-convert (librsvg2-bin) and gs (ghostscript), which draw PDF, SVG and EPS as other
programs would.
"""

import argparse
import shlex
import subprocess
import sys
import time
from dataclasses import dataclass
from html import escape
from pathlib import Path

from PIL import Image

from app.samples import sample_names

ENLARGED = 4
"""The second picture of each file is this many times larger."""

CLOSE_UP = 340
"""Pixels of a 96 dpi page, along a side of what the second picture shows."""


@dataclass(frozen=True)
class Scene:
    """A figure: its mesh, the other words of its command, how its file ends, and where to look closely.

    close: shares of the page's width and height.
    """

    name: str
    mesh: str
    words: str
    extension: str = "png"
    close: tuple[float, float] = (0.17, 0.45)


SCENES = (
    Scene("One panel, one column", "figure", "--distance biharmonic --size column", "pdf", (0.5, 0.4)),
    Scene("Three panels, two columns", "figure", "--size double", "pdf"),
    Scene("The same in pixels", "figure", "--size double"),
    Scene("The same as SVG", "figure", "--size double", "svg"),
    Scene("The same as EPS", "figure", "--size double", "eps"),
    Scene("60 mm, three panels", "hand", "--size 60mm", "pdf", (0.5, 0.3)),
    Scene("A scan, z up, dark", "scan", "--style dark --size double"),
    Scene("A part: creases", "part", "--size double --sources 200"),
    Scene(
        "A part: edges of the mesh, flat",
        "part",
        "--distance biharmonic --show-edges --no-smooth-shading --size column",
    ),
    Scene("A height field, cropped", "domain", "--warp-factor 0.35 --crop --size double", "pdf"),
    Scene("Labels on every fifth isoline", "hare", "--isoline-labels --bold-isolines --size double", "pdf"),
    Scene("Bands", "beast", "--bands --isolines 12 --size double"),
    Scene("Bands, printed in grey", "beast", "--bands --isolines 12 --cmap safe --size double"),
    Scene("Isolines alone", "elephant", "--style lines --size double", "pdf"),
    Scene("An inset with its own isolines", "octopus", "--insets 100:4:80 --distance biharmonic --size column", "pdf"),
    Scene("One range", "genus3", "--distance biharmonic,geodesic --clim shared --size double", "pdf"),
    Scene("Fractions of the maximum", "genus3", "--clim fraction --size double", "pdf"),
    Scene("A difference", "hand", "--distance 'biharmonic - geodesic' --size column", "pdf", (0.5, 0.4)),
    Scene("A slide, six panels", "animal", "--sources 100,2000 --size slide"),
    Scene("A poster", "beast", "--distance biharmonic --size A0", "png", (0.5, 0.4)),
    Scene("Seen from the source, in parallel", "hare", "--cpos source --parallel-projection --axes --size double"),
    Scene("The source is hidden", "figure", "--cpos back --distance biharmonic --size column", "pdf", (0.5, 0.4)),
    Scene("One pose", "lion_ref.obj", "--sources 1000 --distance biharmonic --size column", "pdf", (0.5, 0.4)),
    Scene(
        "Another pose with its range",
        "lion_pose05.obj",
        "--sources 1000 --distance biharmonic --size column --clim one-pose.json",
        "pdf",
        (0.5, 0.4),
    ),
    Scene("A path through pins", "beast", "--pins 600,2400,5000 --profile --size double", "pdf"),
    Scene("A rough scan", "bunny_raw.obj", "--size double"),
    Scene("A rough scan as PDF", "bunny_raw.obj", "--size double", "pdf"),
    Scene("A part with holes, z up", "beetle.off", "--size double"),
    Scene("A poster of a scan", "armadillo_15k.obj", "--size A0 --isoline-labels"),
)


def write_page(folder: Path, meshes: Path | None, only: str = "") -> Path:
    """All files, and index.html; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    parts = ["<!doctype html><meta charset=utf-8><title>Figures</title><style>img{border:1px solid #ccc}</style>"]
    for scene in SCENES:
        mesh = scene.mesh if scene.mesh in sample_names() else str((meshes or folder) / scene.mesh)
        if only not in scene.name or not (scene.mesh in sample_names() or Path(mesh).exists()):
            print(f"{scene.name:36} left out")
            continue
        file = folder / f"{scene.name.lower().replace(' ', '-').replace(',', '').replace(':', '')}.{scene.extension}"
        words = scene.words.replace("one-pose.json", str(folder / "one-pose.json"))
        start = time.perf_counter()
        drawn = subprocess.run([sys.executable, "-m", "app", "figure", mesh, *shlex.split(words), "-o", str(file)])
        if drawn.returncode:
            parts.append(f"<h2>{escape(scene.name)}: failed</h2>")
            continue
        seconds = time.perf_counter() - start
        shown, close = pictures(file, scene.close)
        said = f"bihdist figure {scene.mesh} {scene.words}: {file.stat().st_size / 1e6:.2f} MB, {seconds:.1f} s"
        parts.append(f"<h2>{escape(scene.name)}</h2><p>{escape(said)}</p>")
        parts.append(f'<img src="{shown.name}"><br><img src="{close.name}">')
        print(f"{scene.name:36} {file.stat().st_size / 1e6:6.2f} MB {seconds:6.1f} s", flush=True)
    page = folder / "index.html"
    page.write_text("\n".join(parts), encoding="utf-8")
    return page


def pictures(file: Path, close: tuple[float, float]) -> tuple[Path, Path]:
    """A file as its readers see it at 96 dpi, and a part of it enlarged."""
    large = file.with_name(f"{file.stem}-{file.suffix[1:]}-large.png")
    finer = str(96 * ENLARGED)
    if file.suffix == ".pdf":
        subprocess.run(["pdftoppm", "-r", finer, "-png", "-singlefile", file, large.with_suffix("")], check=True)
    elif file.suffix == ".eps":
        drawn = ["gs", "-q", "-dBATCH", "-dNOPAUSE", "-dEPSCrop", "-sDEVICE=png16m", "-dTextAlphaBits=4"]
        subprocess.run([*drawn, "-dGraphicsAlphaBits=4", f"-r{finer}", f"-sOutputFile={large}", file], check=True)
    elif file.suffix == ".svg":
        subprocess.run(["rsvg-convert", "-z", str(ENLARGED), "-o", large, file], check=True)
    else:
        _at_most(file, large)
    picture = Image.open(large).convert("RGB")
    shown, enlarged = (file.with_name(f"{file.stem}-{file.suffix[1:]}-{kind}.png") for kind in ("100", "400"))
    whole = picture.copy()
    whole.thumbnail((1600, 1200), Image.Resampling.LANCZOS)
    whole.save(shown)
    side = CLOSE_UP * ENLARGED
    x, y = (max(0, round(share * length - side / 2)) for share, length in zip(close, picture.size, strict=True))
    picture.crop((x, y, min(x + side, picture.width), min(y + side, picture.height))).save(enlarged)
    large.unlink()
    return shown, enlarged


def _at_most(file: Path, large: Path) -> None:
    """A picture as large as its readers see it enlarged, where it has fewer pixels."""
    Image.MAX_IMAGE_PIXELS = None
    picture = Image.open(file).convert("RGB")
    dpi = picture.info.get("dpi", (96.0, 96.0))[0]
    factor = max(1.0, 96 * ENLARGED / dpi)
    picture.resize([round(side * factor) for side in picture.size], Image.Resampling.NEAREST).save(large)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.figures.page")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--meshes", type=Path)
    parser.add_argument("--only", default="", help="figures whose names hold this")
    options = parser.parse_args()
    print(write_page(options.folder, options.meshes, options.only))
