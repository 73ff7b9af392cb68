"""The guide as pages for a browser: all of it where it has been built (`make guide`), else its text."""

from pathlib import Path

from .version import version

GUIDE = Path(__file__).resolve().parent / "guide" / "index.html"


def guide_page() -> Path:
    """Return the guide's first page.

    Returns
    -------
    Path
        In the program's own folder where the guide has been built; else its text, written into the user's cache.

    Raises
    ------
    OutputError
        If the text cannot be written there.
    """
    if GUIDE.is_file():
        return GUIDE
    from platformdirs import user_cache_path

    from bihdist_core.errors import OutputError

    from .plain_guide import write_plain_guide

    folder = user_cache_path("bihdist") / f"guide-{version()}"
    try:
        return write_plain_guide(folder)
    except OSError as error:
        raise OutputError(f"The guide cannot be written into {folder}: {error.strerror}.") from error
