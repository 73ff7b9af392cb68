"""Reads and writes every text format under the environment's locale, as a program may that asks for it: see
`test_decimal_comma`.

Prints the digest of each array that is read and of each file that is written into the folder of the first argument.
"""

import hashlib
import locale
import sys
from pathlib import Path

import numpy as np

from app.main import main
from bihdist_core import BiharmonicDistance, Pins, read_pins, read_surface, write_mesh, write_pins
from bihdist_core.formats.anchors import read_anchors, write_anchors
from bihdist_core.formats.pins import PIN_FORMATS

TEXTS = {
    "text.off": "OFF\n4 2 0\n{0}\n3 0 1 2\n3 0 2 3\n",
    "text.obj": "{v}f 1 2 3\nf 1 3 4\n",
    "text.ply": "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n{0}\n3 0 1 2\n3 0 2 3\n",
    "text.vtk": "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n{0}\nPOLYGONS 2 8\n3 0 1 2\n"
    "3 0 2 3\n",
    "text.asc": "#!ascii version of text\n4 2\n{asc}0 1 2 0\n0 2 3 0\n",
}
POINTS = ["0.5 0.25 1e-3", "1.5 .125 0", "1.75 1.5 -0.0625", "-0.5 1.0625 2.5E-1"]


def run(folder: Path) -> None:
    locale.setlocale(locale.LC_ALL, "")
    print(locale.localeconv()["decimal_point"], file=sys.stderr)
    rows = {
        "0": "\n".join(POINTS),
        "v": "".join(f"v {point}\n" for point in POINTS),
        "asc": "".join(f"{point} 0\n" for point in POINTS),
    }
    for name, text in TEXTS.items():
        (folder / name).write_text(
            text.replace("{0}", rows["0"]).replace("{v}", rows["v"]).replace("{asc}", rows["asc"])
        )
        print(name, hashlib.sha256(read_surface(folder / name).vertices.tobytes()).hexdigest())
    surface = read_surface(folder / "text.off")
    for extension in PIN_FORMATS:
        write_pins(folder / f"pins{extension}", surface, Pins.of(surface, [1, 3], ["0.5", "1.5"]))
        print(extension, read_pins(folder / f"pins{extension}", surface).moved.tolist())
    write_anchors(folder / "anchors.csv", surface, [1, 3], [0.5, 1.5])
    print(read_anchors(folder / "anchors.csv", surface).values.tolist())
    for extension in (".off", ".obj", ".ply", ".vtp"):
        write_mesh(folder / f"written{extension}", surface)
    print(BiharmonicDistance(surface).from_source(0).tolist())
    mesh = str(folder / "text.off")
    for words in (
        ["field", mesh, "--sources", "0,f1:0.5,0.25", "-o", "field.csv"],
        ["field", mesh, "--sources", "xyz:0.5,0.25,0", "-o", "field.vtp"],
        ["isolines", mesh, "--sources", "0", "-o", "lines.csv"],
        ["isolines", mesh, "--sources", "0", "-o", "lines.obj"],
        ["pairs", mesh, "--sources", "@pins.fcsv", "-o", "pairs.csv"],
        ["figure", mesh, "--sources", "0", "--t", "0.5", "--isoline-spacing", "0.25", "-o", "figure.svg"],
        ["figure", mesh, "--sources", "0", "--clim", "0.5", "-o", "figure.png"],
        ["page", mesh, "--sources", "0", "-o", "page.html"],
    ):
        assert main([*words, "--quiet"]) == 0, words
    for path in sorted(folder.iterdir()):
        print(path.name, hashlib.sha256(path.read_bytes()).hexdigest())


if __name__ == "__main__":
    np.seterr(all="ignore")
    run(Path(sys.argv[1]))
