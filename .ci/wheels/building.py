"""Source distributions of both projects, and from them one wheel for each platform."""

import os
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

LEFT_OUT = (".git", ".venv", ".*_cache", "__pycache__", "build", "dist", "*.egg-info", "libbihdist*", "stress-results")
"""What is in a checkout and no source."""

HOOK = (
    "import os, sys; from importlib import import_module; sys.path.insert(0, sys.argv[1]); "
    "print(import_module('build_backend').build_sdist(sys.argv[2]))"
)
"""Makes a source distribution, as pip would have it made."""


class Failed(Exception):
    """Something could not be built, or is not as it should be."""


def sources(folder: Path, output: Path) -> dict[str, Path]:
    """Return the source distributions, in `output`.

    By their names (bihdist, bihdist_core), their contents, in `folder`.
    """
    copy = folder / "checkout"
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*LEFT_OUT))
    unpacked = {}
    for project in (copy, copy / "bihdist_core"):
        kernel = "kernel" if project.name == "bihdist_core" else "bihdist_core/kernel"
        name = run([sys.executable, "-c", HOOK, kernel, str(output)], cwd=project).split()[-1]
        with tarfile.open(output / name) as archive:
            archive.extraction_filter = getattr(tarfile, "data_filter", None)  # of Python 3.11.4 and newer
            archive.extractall(folder)
        # setuptools made it in the folder, and would take it for another source.
        for left in project.glob("*.egg-info"):
            shutil.rmtree(left)
        unpacked[name.partition("-")[0]] = folder / name.removesuffix(".tar.gz")
    return unpacked


def wheel(source: Path, tag: str, output: Path) -> Path:
    """Return the wheel that a source distribution builds for a platform, in `output`; nothing is fetched for it."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet", "--no-index"]
    setting = f"--config-settings=--build-option=--plat-name={tag}"
    run([*command, "--no-deps", "--no-build-isolation", setting, "--wheel-dir", str(output), str(source)])
    (made,) = output.glob(f"{source.name}-*-{tag}.whl")
    return made


def run(command: Sequence[str], **options: object) -> str:
    """Return what a command prints; Failed with its last lines if it fails."""
    said = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if said.returncode:
        raise Failed(f"{' '.join(map(os.fspath, command))}:\n" + "\n".join(said.stdout.splitlines()[-30:]))
    return said.stdout
