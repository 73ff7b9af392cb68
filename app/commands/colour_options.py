"""The options of colours and of where colour bars end, and what they make of a document."""

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from .terminal import progress_line

if TYPE_CHECKING:
    from ..document.document import Document


def add_colours(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--colours",
        metavar="NAME|FILE",
        help="a colour map: paper, uniform, ember, safe (also in grey), diverging; or a .txt, .csv or ParaView's .json",
    )
    for name, words in (("reversed", "the colours from the other end"), ("bands", "one colour between isolines")):
        parser.add_argument(f"--{name}", action=argparse.BooleanOptionalAction, default=None, help=words)


def add_range(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--range",
        metavar="RANGE",
        help="where colour bars end: own (own maximum), shared (one for all panels of a unit), shares (fraction of "
        "the maximum), a number, or one or `own` for each panel such as 0.8,own,2; or a session or recipe, whose ends "
        "are taken",
    )
    parser.add_argument(
        "--shared-range", action=argparse.BooleanOptionalAction, default=None, help="the same as --range shared"
    )


def with_colours(document: "Document", options: argparse.Namespace) -> "Document":
    """In the colours that are named; ParameterError for none."""
    colours = document.colours
    if options.colours is not None:
        from ..scene.colour_file import colours_named

        colours = colours_named(options.colours, colours)
    given = {name: getattr(options, name) for name in ("reversed", "bands") if getattr(options, name) is not None}
    return replace(document, colours=replace(colours, **given))


def tell_if_unseen(style: str, options: argparse.Namespace, say: Callable[[str], None]) -> None:
    """A sentence on colours that are named for a style that has none."""
    from ..scene.style import STYLES

    named = [f"--{name}" for name in ("colours", "reversed", "bands") if getattr(options, name)]
    if named and style in STYLES and not STYLES[style].coloured:
        say(f"The style {style} has no colours; {', '.join(named)} cannot be seen in it.")


def with_range(document: "Document", options: argparse.Namespace, say: Callable[[str], None]) -> "Document":
    """With the ends that are asked for; `say` gets a sentence on those that were taken from a file."""
    from bihdist_core import ParameterError

    if options.shared_range is not None:
        word = "shared" if options.shared_range else "own"
        if options.range not in (None, word):
            other = "--shared-range" if options.shared_range else "--no-shared-range"
            raise ParameterError(f"--range {options.range} and {other} differ; leave one out.")
        document = replace(document, range=word)
    if options.range is not None:
        from ..figures.ends import ranged

        with progress_line() as progress:
            document, said = ranged(document, _ends(options.range), progress)
        if said:
            say(said)
    return document


def _ends(text: str) -> str | list[float | None]:
    """Numbers, with None for a panel's own; a word or a path as it is."""
    try:
        return [None if word.strip() == "own" else float(word) for word in text.split(",")] if text != "own" else text
    except ValueError:
        return text
