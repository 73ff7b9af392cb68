"""What has to be in a wheel: every file of its packages, the kernel of its platform, and what its name says."""

import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from .libraries import Library, library


@dataclass(frozen=True)
class Platform:
    """A platform by the last tag of its wheels, with what the kernel has to be there and the names of its files."""

    tag: str
    format: str
    machine: str
    newest: tuple[int, int]
    libraries: tuple[str, ...]


PLATFORMS = (
    Platform("manylinux_2_17_x86_64", "ELF", "x86_64", (2, 17), ("libbihdist.so", "libbihdist-avx2.so")),
    Platform("manylinux_2_17_aarch64", "ELF", "aarch64", (2, 17), ("libbihdist.so",)),
    Platform("macosx_10_13_x86_64", "Mach-O", "x86_64", (10, 13), ("libbihdist.dylib", "libbihdist-avx2.dylib")),
    Platform("macosx_11_0_arm64", "Mach-O", "arm64", (11, 0), ("libbihdist.dylib",)),
    Platform("win_amd64", "PE", "amd64", (0, 0), ("libbihdist.dll", "libbihdist-avx2.dll")),
    Platform("any", "", "", (0, 0), ()),
)

PACKAGES = {
    "bihdist": {"bihdist_core": "bihdist_core", "bihdist": "app", "bihdist_assets": ""},
    "bihdist_core": {"bihdist_core": "."},
}
"""By the distribution, the packages in it, and their folders in its source; the samples are checked by their kinds."""

LARGEST = {"bihdist": 12 << 20, "bihdist_core": 2 << 20}
"""Bytes of a wheel, and of the light library's files once they are installed."""

ESSENTIAL = {
    "bihdist": ("bihdist_core/py.typed", "bihdist/py.typed", "bihdist/web/kernel.wasm", "bihdist/web/viewer/page.html"),
    "bihdist_core": ("bihdist_core/py.typed", "bihdist_core/__init__.pyi"),
}
"""What is no Python and would be missed late."""

NOT_INSTALLED = re.compile(
    r"(^|/)(__pycache__|build|[\w.]+\.egg-info)/|\.[ch]$|libbihdist|^(LICENSE|MANIFEST\.in|PKG-INFO|setup\.cfg|pyproject\.toml)$"
)
"""Files of a package's folder that are not in wheels, or not for every platform."""


def complaints(wheel: Path, source: Path) -> Iterator[str]:
    """Yield sentences on what is wrong with a wheel that was built from a folder."""
    name, version, python, binary, platform = wheel.name.removesuffix(".whl").split("-")
    with zipfile.ZipFile(wheel) as archive:
        sizes = {info.filename: info.file_size for info in archive.infolist()}
        yield from _wrong_files(set(sizes), name, source)
        yield from _wrong_tags(archive, f"{name}-{version}.dist-info", (python, binary, platform))
        folder = PACKAGES[name]["bihdist_core"]
        yield from _wrong_kernel(archive, platform, _functions(source / folder / "kernel" / "library.py"))
    size = sum(sizes.values()) if name == "bihdist_core" else wheel.stat().st_size
    if size > LARGEST[name]:
        yield f"{size:,} bytes are more than {LARGEST[name]:,}."


def _wrong_files(names: set[str], distribution: str, source: Path) -> Iterator[str]:
    packages = PACKAGES[distribution]
    tops = {name.partition("/")[0] for name in names if ".dist-info/" not in name}
    if tops != set(packages):
        yield f"It holds {', '.join(sorted(tops))} in place of {', '.join(packages)}."
    for package, folder in packages.items():
        held = {name for name in names if name.startswith(f"{package}/") and "libbihdist" not in name}
        wanted = {f"{package}/{name}" for name in package_files(source / folder)} if folder else held
        for name in sorted(held ^ wanted):
            yield f"{name} is {'missing' if name in wanted else 'no file of the package'}."
    for name in ESSENTIAL[distribution]:
        if name not in names:
            yield f"{name} is missing."


def package_files(folder: Path) -> Iterator[str]:
    """Yield the names of the files of a package that belong into any wheel."""
    for path in folder.rglob("*"):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and not NOT_INSTALLED.search(name):
            yield name


def _wrong_tags(archive: zipfile.ZipFile, information: str, tags: tuple[str, str, str]) -> Iterator[str]:
    said = re.findall(r"^Tag: (\S+)$", archive.read(f"{information}/WHEEL").decode(), re.MULTILINE)
    if said != ["-".join(tags)] or tags[:2] != ("py3", "none"):
        yield f"Its tags are {', '.join(said)}, and its name has {'-'.join(tags)}."


def _functions(path: Path) -> set[str]:
    """Return the names of the functions that Python calls in the kernel, from the module that does."""
    text = path.read_text(encoding="utf-8").partition("_SIGNATURES")[2].partition("\n}")[0]
    return {f"bih_{name}" for name in re.findall(r'^    "(\w+)":', text, re.MULTILINE)}


def _wrong_kernel(archive: zipfile.ZipFile, tag: str, functions: set[str]) -> Iterator[str]:
    held = {PurePosixPath(name).name: name for name in archive.namelist() if "libbihdist" in name}
    platforms = [platform for platform in PLATFORMS if platform.tag == tag]
    if not platforms:
        yield f"{tag} is no platform of ours."
        return
    platform = platforms[0]
    if set(held) != set(platform.libraries):
        both = (", ".join(names) or "none" for names in (sorted(held), platform.libraries))
        yield f"It holds the libraries {', not '.join(both)}."
    for name, path in held.items():
        try:
            found = library(archive.read(path))
        except ValueError as error:
            yield f"{name} cannot be used: {error}."
        else:
            yield from _unfit(name, found, platform, functions)


def _unfit(name: str, found: Library, platform: Platform, functions: set[str]) -> Iterator[str]:
    if (found.format, found.machine) != (platform.format, platform.machine):
        yield f"{name} is {found.format} for {found.machine}, not {platform.format} for {platform.machine}."
    if found.needs > platform.newest:
        yield f"{name} needs version {found.needs[0]}.{found.needs[1]} of the system."
    if missing := functions - found.names:
        yield f"{name} lacks {', '.join(sorted(missing))}."
