"""Which version this is."""

from importlib import metadata


def version() -> str:
    """The installed version, or the checkout's."""
    try:
        return metadata.version("bihdist")
    except metadata.PackageNotFoundError:
        return "(not installed)"
