"""Which version this is, and whether what is installed is all of it."""

import warnings
from functools import cache
from importlib import metadata

from bihdist_core.version import VERSION

DISTRIBUTIONS = ("bihdist", "bihdist-core")
"""Both hold the library: whichever was installed last has written its files."""


def version() -> str:
    """The version of what is imported, installed or not."""
    return VERSION


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
