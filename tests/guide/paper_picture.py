"""Makes the picture of the paper's Figure 2 in the guide again: `python -m tests.guide.paper_picture`, ten seconds."""

import tempfile
from pathlib import Path

from PIL import Image

from app.main import main

PICTURE = Path(__file__).parents[2] / "assets/guide/explanation/paper-figure-2.png"
WIDTH = 1000


def make(path: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        assert main(["paper", "-o", folder, "--quick", "--only", "fig2", "--quiet"]) == 0
        with Image.open(Path(folder) / "fig2-fields.png") as drawn:
            small = drawn.convert("RGB").resize((WIDTH, drawn.height * WIDTH // drawn.width), Image.Resampling.LANCZOS)
    # A palette of the octree keeps the yellow of the source, which has few pixels.
    small.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(path, optimize=True)


if __name__ == "__main__":
    make(PICTURE)
