"""The options of isolines, and what they make of a document."""

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..document.document import Document
    from ..document.looks import Isolines


def add_levels(parser: argparse.ArgumentParser) -> None:
    """Where isolines are."""
    parser.add_argument(
        "--isolines", type=int, metavar="N", help="about so many, at round values; 0 for none (default: 20)"
    )
    parser.add_argument(
        "--equal-isolines",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="as many equal steps from 0 to the maximum, instead of round values",
    )
    parser.add_argument(
        "--isoline-spacing", type=float, metavar="STEP", help="isolines at multiples of this, in the field's unit"
    )
    parser.add_argument("--isoline-values", type=_values, metavar="A,B,…", help="isolines at these values")
    parser.add_argument(
        "--isoline-through", type=int, action="append", metavar="V", help="one more through a vertex; repeat for more"
    )


def add_isolines(parser: argparse.ArgumentParser) -> None:
    """Where they are, and how they look."""
    add_levels(parser)
    parser.add_argument(
        "--bold-isolines", type=int, nargs="?", const=5, metavar="N", help="every fifth, or Nth, is bolder"
    )
    parser.add_argument(
        "--isoline-labels", action=argparse.BooleanOptionalAction, default=None, help="the values stand on the lines"
    )


def isolines_of(options: argparse.Namespace) -> "Isolines":
    """Where they are, but for those through vertices; ParameterError for two ways to say it."""
    from ..document.looks import TWENTY_STEPS

    return replace(TWENTY_STEPS, **_where(options, TWENTY_STEPS))


def _where(options: argparse.Namespace, now: "Isolines") -> dict[str, Any]:
    """What is asked for of `Isolines`."""
    from bihdist_core import ParameterError

    asked = {
        "--isolines": options.isolines,
        "--isoline-spacing": options.isoline_spacing,
        "--isoline-values": options.isoline_values,
    }
    named = [name for name, value in asked.items() if value is not None]
    round = {} if options.equal_isolines is None else {"round": not options.equal_isolines}
    if len(named) > 1:
        raise ParameterError(f"{' and '.join(named)} are two ways to say where isolines are; choose one.")
    if not named:
        return round
    count = now.count if options.isolines is None else options.isolines
    return {"spacing": options.isoline_spacing, "values": options.isoline_values or (), "count": count, **round}


def with_isolines(document: "Document", options: argparse.Namespace) -> "Document":
    """With the lines that are asked for; ParameterError for what there is not."""
    from bihdist_core import ParameterError

    from ..document.isoline_edits import pass_through, pass_through_none

    now = document.isolines
    given = _where(options, now)
    if options.bold_isolines is not None:
        given["bold"] = options.bold_isolines
    if options.isoline_labels is not None:
        given["labels"] = options.isoline_labels
    document = replace(document, isolines=replace(now, **given))
    if options.isoline_through is not None:
        if len(document.surfaces) != 1:
            raise ParameterError(
                f"--isoline-through names vertices of one mesh, and this recipe has {len(document.surfaces)}."
            )
        document = pass_through(pass_through_none(document), tuple(options.isoline_through), document.surfaces[0].name)
    return document


def _values(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not numbers with commas between them") from None
