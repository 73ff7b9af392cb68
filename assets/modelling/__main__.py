"""`python -m assets.modelling [NAME ...] [--to FOLDER]`: model the sample meshes and write them as PLY."""

import argparse
import time
from pathlib import Path

from .build import SAMPLES, Workshop
from .ply import write_ply
from .triangles import corner_angles

ASSETS = Path(__file__).resolve().parent.parent


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m assets.modelling", description="Model the sample meshes.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(SAMPLES)}; all if none is given")
    parser.add_argument("--to", type=Path, default=ASSETS, metavar="FOLDER", help="where the PLY files go")
    options = parser.parse_args()
    unknown = sorted(set(options.names) - set(SAMPLES))
    if unknown:
        parser.error(f"there is no sample named {', '.join(unknown)}")
    options.to.mkdir(parents=True, exist_ok=True)
    workshop = Workshop()
    for name in options.names or SAMPLES:
        start = time.perf_counter()
        points, faces = workshop.finished(name)
        write_ply(options.to / f"{name}.ply", points, faces, f"bihdist sample {name}, CC0 1.0")
        angle = corner_angles(points, faces).min()
        took = time.perf_counter() - start
        print(
            f"{name:13s}{len(points):7d} vertices{len(faces):7d} faces, angles from {angle:.1f} degrees, {took:.0f} s"
        )


if __name__ == "__main__":
    main()
