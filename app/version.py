"""Which version this is, and whether what is installed is all of it."""

import shlex
import sys
import warnings
from functools import cache
from importlib import metadata
from importlib.machinery import PathFinder

from bihdist_core.version import VERSION

DISTRIBUTIONS = ("bihdist", "bihdist-core")
"""Both hold the library: whichever was installed last has written its files."""


def version() -> str:
    """The version of what is imported, installed or not."""
    return VERSION


def install_command(package: str) -> str:
    """Return the line for a shell that installs a package for the Python that runs this."""
    python = shlex.quote(sys.executable) if sys.platform != "win32" else f'"{sys.executable}"'
    if PathFinder.find_spec("pip") is None:  # not importlib.util: setuptools' hook on "pip" warns of distutils
        return f"uv pip install --python {python} {package}"
    return f"{python} -m pip install {package}"


@cache
def disagreement() -> str:
    """A sentence if the program and the library were installed by distributions of different versions; else nothing."""
    if (__package__ or "").partition(".")[0] != "bihdist":
        return ""  # in a checkout
    there = {}
    for name in DISTRIBUTIONS:
        try:
            there[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    if not set(there.values()) - {VERSION}:
        return ""
    found = " and ".join(f"{name} {number}" for name, number in there.items())
    again = " ".join(f"{name}=={there.get('bihdist', VERSION)}" for name in there)
    return (
        f"{found}, whose library says it is {VERSION}, do not fit together: install one version, by "
        f"`pip install --force-reinstall --no-deps {again}`."
    )


@cache
def warn_of_disagreement() -> None:
    """A warning, once, if the program and the library do not fit together."""
    if words := disagreement():
        warnings.warn(words, stacklevel=3)
