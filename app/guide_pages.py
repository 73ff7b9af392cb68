"""Where the guide is, as pages for a browser; `make guide` builds it into the program's own folder."""

from pathlib import Path

GUIDE = Path(__file__).resolve().parent / "guide" / "index.html"


def guide_page() -> Path:
    """The guide's first page; MissingInputError where it has not been built."""
    from bihdist_core.errors import MissingInputError

    if not GUIDE.is_file():
        raise MissingInputError(
            f"The guide has not been built: there is no {GUIDE}. Run `make guide` in a checkout of the project, or "
            "read its pages there in assets/guide."
        )
    return GUIDE
