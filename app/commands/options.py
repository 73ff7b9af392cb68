"""Options that several commands have: the distance with its parameters, the vertex areas, vertex ids."""

import argparse
import math
from collections.abc import Sequence

from bihdist_core.distances.kinds import OURS, Spec, Value, kinds
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import source_from_words

from ..document.document import AREAS, COMPARISON, Document
from ..document.looks import UPS
from ..document.profile import WAYS
from ..document.quantities import Quantity, quantity

PANELS = f"a panel; repeat for more (default: {', '.join(str(spec) for spec in COMPARISON)})"
SOURCE = "vertex (12), several (12+40+7), place in a face (f311:0.2,0.5), boundary loop (loop:0) or curve (curve.json)"
PARAMETERS = {p.name: p for kind in OURS for p in kind.parameters}
"""By name: the parameters of our distances, each of which is an option."""


def add_distance(parser: argparse.ArgumentParser, several: str = "") -> None:
    """`--distance`, and an option for each parameter of ours, which holds where the distance does not say otherwise."""
    words = f"{', '.join(kinds())}; with parameters like 'diffusion(t=1/4)', or two like 'biharmonic - geodesic'"
    if several:
        parser.add_argument("--distance", metavar="NAME", action="append", help=f"{words}: {several}")
    else:
        text = f"{words} (default: biharmonic)"
        parser.add_argument("--distance", metavar="NAME", default="biharmonic", help=text)
    for name, parameter in PARAMETERS.items():
        of = ", ".join(kind.word for kind in OURS if parameter in kind.parameters)
        parser.add_argument(
            f"--{name}",
            metavar="{" + ",".join(parameter.choices) + "}" if parameter.choices else name.upper()[:1],
            help=f"{parameter.meaning}, for {of} (default: {parameter.written(parameter.default)})",
        )


def add_areas(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--areas", choices=AREAS, help="vertex areas (default: voronoi)")


def add_up(parser: argparse.ArgumentParser, default: str = "guessed") -> None:
    words = f"which axis points up: {', '.join(UPS)} (default: {default}); write --up=-z for those with a sign"
    parser.add_argument("--up", choices=UPS, metavar="AXIS", help=words)


def add_pins(parser: argparse.ArgumentParser) -> None:
    words = "a pin with a number at a vertex or a place in a face (f311:0.2,0.5); repeat for more, in their order"
    parser.add_argument("--pin", type=point, metavar="V", action="append", help=words)


def add_profile(parser: argparse.ArgumentParser) -> None:
    """The path of a profile, as figures draw it."""
    parser.add_argument(
        "--profile",
        nargs="?",
        const="",
        metavar="V,W,…",
        help="the path through points: vertices, places in faces, source, pin:1 (nothing: through the pins in order)",
    )
    add_way(parser)


def add_way(parser: argparse.ArgumentParser) -> None:
    words = "from point to point by auto, exact, straightened or edges; or by a section, section-longer, section-whole"
    parser.add_argument("--way", choices=WAYS, metavar="NAME", help=f"{words} (default: auto)")
    parser.add_argument("--across", type=direction, metavar="X,Y,Z", help="a direction that lies in a section's plane")


def direction(text: str) -> tuple[float, ...]:
    try:
        found = tuple(float(word) for word in text.split(","))
    except ValueError:
        found = ()
    if len(found) != 3:
        raise argparse.ArgumentTypeError(f"{text!r} is no direction such as 0,0,1")
    return found


def with_path(document: Document, options: argparse.Namespace) -> Document:
    """The document with the path that is named, if one is."""
    if options.profile is None:
        if options.way is not None or options.across is not None:
            raise ParameterError("--way and --across go with --profile, the path that is drawn.")
        return document
    from ..document.profile import with_profile, words_in

    return with_profile(document, words_in(options.profile), options.way or "auto", options.across)


def panel_numbers(text: str) -> str | tuple[int, ...]:
    """ "all", or numbers of panels."""
    if text == "all":
        return text
    try:
        return tuple(int(word) for word in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not all, or numbers of panels such as 1,3") from None


def with_pins(document: Document, options: argparse.Namespace) -> Document:
    """The document with the pins that are named, if any are, and no others."""
    if options.pin is None:
        return document
    from ..document.pins import pin_instead

    return pin_instead(document, options.pin, document.surfaces[0].name)


def add_selections(parser: argparse.ArgumentParser) -> None:
    words = "vertices that stand out: ids and ranges (12,40-77), or a .txt, .npy or .csv file of ids; repeat for more"
    parser.add_argument("--select", metavar="IDS", action="append", help=words)


def with_selections(document: Document, options: argparse.Namespace) -> Document:
    """The document with the selections that are named, if any are, and no others."""
    if options.select is None:
        return document
    from bihdist_core.analysis.selecting import is_ids_file, read_ids

    from ..document.selections import runs_from_words, runs_of, select_instead

    chosen = [runs_of(read_ids(word)) if is_ids_file(word) else runs_from_words(word) for word in options.select]
    return select_instead(document, chosen, document.surfaces[0].name)


def spec(options: argparse.Namespace, text: str) -> Spec:
    """The distance that a text means with the options beside it."""
    return Spec.parse(text, **given_parameters(options))


def specs(options: argparse.Namespace, texts: Sequence[str]) -> list[Spec]:
    """The same for several; ParameterError for an option that none of them has."""
    for text in texts:
        if " - " in text:
            raise ParameterError(f"{text!r} is a field, and has no value between two vertices; name a distance.")
    found = [spec(options, text) for text in texts]
    check_parameters(options, found)
    return found


def quantities(options: argparse.Namespace, texts: Sequence[str], fields: Sequence[str] = ()) -> list[Quantity]:
    """The same for distances, differences, and a recipe's own fields."""
    found = [quantity(text, fields=fields, **given_parameters(options)) for text in texts]
    check_parameters(options, [spec for shows in found for spec in shows.specs])
    return found


def given_parameters(options: argparse.Namespace) -> dict[str, Value]:
    """The parameters that have been named, by option."""
    given = {name: getattr(options, name) for name in PARAMETERS}
    return {name: PARAMETERS[name].parsed(text) for name, text in given.items() if text is not None}


def check_parameters(options: argparse.Namespace, specs: Sequence[Spec]) -> None:
    """ParameterError for a parameter that none of the distances has: it would be ignored."""
    known = {parameter.name for each in specs for parameter in each.kind.parameters}
    for name in given_parameters(options):
        if name not in known:
            shown = ", ".join(dict.fromkeys(each.word for each in specs))
            raise ParameterError(f"--{name} {getattr(options, name)} is no parameter of {shown}.")


def source(text: str) -> Source:
    """A source from its words."""
    try:
        return source_from_words(text)
    except ParameterError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def point(text: str) -> Source:
    """A vertex id, or a place in a face from its words."""
    return source(text) if text.strip().startswith("f") else vertex(text)


def vertex(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a vertex id (a whole number)") from None


def vertices(text: str) -> list[int]:
    return [vertex(word) for word in text.split(",")]


def count(text: str) -> int:
    """How many of something."""
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1")
    return value


def _number(text: str) -> float:
    """NaN for what is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def positive(text: str) -> float:
    value = _number(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number")
    return value


def share(text: str) -> float:
    value = _number(text)
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a fraction from 0 to 1")
    return value
