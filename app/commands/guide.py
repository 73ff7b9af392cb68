"""`bihdist guide`: the guide in a browser."""

import argparse

from ..guide_pages import guide_page
from .terminal import Result

WORDS = "open the guide in a browser"
EXAMPLES = (
    "bihdist guide",
    "bihdist guide --where",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `guide` to its parser."""
    parser.add_argument("--where", action="store_true", help="print the path of the first page, and open nothing")


def run(options: argparse.Namespace) -> Result:
    """Open the guide, or print where it is; raise OutputError if no browser can be started."""
    import webbrowser

    from bihdist_core.errors import OutputError

    page = guide_page()
    if not options.where and not webbrowser.open(page.as_uri()):
        raise OutputError(f"No browser could be started; open {page} in one.")
    print(page)
    return Result({"page": str(page)})
