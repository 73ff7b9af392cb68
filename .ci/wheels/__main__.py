"""Build the files of a release and check them; with --python, install them in clean environments, too."""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from . import building, trials
from .building import ROOT, Failed
from .contents import LARGEST, PLATFORMS, complaints


def main() -> int:
    """Return the exit status: 1 if something could not be built, is not as it should be, or fails its tests."""
    tags = [platform.tag for platform in PLATFORMS]
    parser = argparse.ArgumentParser(prog="make wheels", description=__doc__)
    parser.add_argument("--output", type=Path, default=ROOT / "dist", metavar="FOLDER", help="by default dist")
    parser.add_argument("--platforms", nargs="+", choices=tags, default=tags, metavar="TAG", help=", ".join(tags))
    parser.add_argument(
        "--python", nargs="+", default=[], metavar="PYTHON", help="run the core's tests on what is installed for these"
    )
    parser.add_argument("--all", action="store_true", help="all tests of the core, not those that say most")
    parser.add_argument("--here", default=_here(), metavar="TAG", help="the platform that --python runs: %(default)s")
    options = parser.parse_args()
    if not (ROOT / "app/guide/index.html").is_file():
        parser.error("the guide, which travels in the wheels, is not there: `make guide` makes it")
    options.output = options.output.resolve()
    options.output.mkdir(exist_ok=True)
    for old in (path for name in LARGEST for path in options.output.glob(f"{name}-*")):
        old.unlink()
    with TemporaryDirectory() as folder:
        try:
            return _made(options, Path(folder))
        except Failed as error:
            print(error, file=sys.stderr)
            return 1


def _here() -> str:
    """Return the first of our platforms whose library this machine would load, by its name."""
    import platform

    system = {"Linux": "manylinux", "Darwin": "macosx", "Windows": "win"}.get(platform.system(), "")
    machine = platform.machine().lower()
    return next((p.tag for p in PLATFORMS if p.tag.startswith(system) and p.tag.endswith(machine)), "any")


def _made(options: argparse.Namespace, folder: Path) -> int:
    sources = building.sources(folder, options.output)
    wrong = 0
    for source in sources.values():
        for tag in options.platforms:
            wheel = building.wheel(source, tag, options.output)
            found = list(complaints(wheel, source))
            print(f"{wheel.name}  {wheel.stat().st_size:,} bytes{'' if found else ', as it should be'}", flush=True)
            print("".join(f"    {sentence}\n" for sentence in found), end="")
            wrong += bool(found)
    patterns = [f"bihdist_core-*-{tag}.whl" for tag in (options.here, "any")]
    wheels = [path for pattern in patterns for path in options.output.glob(pattern)]
    tests = ("tests/core",) if options.all else trials.QUICK
    if options.python:
        print(trials.HEAD)
    for python in options.python:
        for wheel in wheels:
            for resolution in ("lowest", "highest"):
                trial = trials.tried(wheel, python, resolution, sources["bihdist"], folder, tests)
                print(trial.row(), flush=True)
                wrong += not trial.passed
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
