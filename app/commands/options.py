"""Options that several commands have: sources, the output, the distance with its parameters, the vertex areas."""

import argparse
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from bihdist_core.analysis.signature_types import SIGNATURES, SignatureSpec, is_signature
from bihdist_core.distances.distance_types import BUILT_IN, Spec, distance_types
from bihdist_core.errors import ParameterError

from ..document.document import COMPARISON, Document, FieldArray, check_unique, free_field_name, unnamed_fields
from ..document.edits import add_panel
from ..document.lists import pair_from_words, pairs_from_words, split_list
from ..document.option import Option, Row
from ..document.page import Page, Recipe
from ..document.quantities import Quantity, quantity
from ..document.repairs import Repairs
from ..document.sources import sources_from_words
from ..figures.options import PAGE_ROWS, VERTEX_AREAS, with_rows
from ..figures.repair_options import COTAN, CUT, LARGEST, REPAIRS

PANELS = f"a panel each (default: {','.join(str(spec) for spec in COMPARISON)})"
PLACES = (
    ", with places in faces (f311:0.2,0.5), boundary loops (loop:0), curves (curve.json) and the nearest of several "
    "(12+40+7) among them"
)
RULES = (
    "xyz:X,Y,Z, the vertex nearest to a position; farthest:K[:START], random:K[:SEED] or all; @FILE, or - for standard "
    "input"
)
HIGHEST = "(default: the highest vertex)"
NEIGHBOURS = 10
"""So many, unless `--k` says otherwise."""
DTYPES = ("float64", "float32")
"""The types of numbers in written arrays, the default first."""
MESH = "mesh file, two with + between (lh.pial+rh.pial), or the name of a sample"
PARAMETERS = {p.name: p for kind in BUILT_IN for p in kind.parameters}
"""The parameters of the built-in distances by name, each of which is an option."""


def add_mesh(parser: argparse.ArgumentParser) -> None:
    """Add the mesh that a command is about."""
    parser.add_argument("mesh", metavar="MESH", help=MESH)


def add_two_meshes(parser: argparse.ArgumentParser) -> None:
    """Add the two meshes between which a map leads."""
    parser.add_argument("mesh", metavar="A", help=f"the mesh that is mapped: {MESH}")
    parser.add_argument("other", metavar="B", help="the mesh that it is mapped to")


def add_sources(
    parser: argparse.ArgumentParser,
    what: str,
    default: str = HIGHEST,
    required: bool = False,
    are_vertices: bool = False,
) -> None:
    """Add `--sources`, whose value is a `Sources` or None; `what` says in words what starts there."""
    text = f"{what}: 12,40{'' if are_vertices else PLACES}; {RULES}{f' {default}' if default else ''}"
    parser.add_argument("--sources", metavar="SOURCES", type=sources, required=required, help=text)


def add_pins(parser: argparse.ArgumentParser) -> None:
    """Add `--pins`, whose value is a `Sources`, or None."""
    text = "numbered points, chosen as by --sources: 12,40, or those in a file, @FILE, or - for standard input"
    parser.add_argument("--pins", metavar="V,…|@FILE", type=sources, help=text)


def add_pairs(parser: argparse._ActionsContainer, what: str, required: bool = False) -> None:
    """Add `--pairs`, whose value is a list of pairs, or the path of a file of them."""
    parser.add_argument("--pairs", metavar="I:J,…|@FILE", type=pairs, required=required, help=what)


def add_output(
    parser: argparse.ArgumentParser, files: str, required: bool = True, metavar: str = "OUT", usual: str = ""
) -> None:
    """Add the option of what is written; `usual` is what follows the mesh's name in the name that it has by default."""
    help = f"{files} (default: the mesh's name with {usual})" if usual else files
    parser.add_argument("-o", "--output", metavar=metavar, required=required and not usual, help=help)
    parser.set_defaults(usual_output=usual)


def add_dtype(parser: argparse.ArgumentParser, of: str) -> None:
    """Add the option of how exactly numbers are written."""
    parser.add_argument("--dtype", choices=DTYPES, help=f"{of} (default: {DTYPES[0]})")


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Add the option of how many processes share the work."""
    parser.add_argument("--workers", type=count, metavar="N", help="processes (default: as many as cores)")


def add_dask(parser: argparse.ArgumentParser, what: str = "") -> None:
    """Add the option of a cluster that does the work."""
    text = f"{what}a Dask cluster: tcp://HOST:PORT or its scheduler's FILE.json"
    parser.add_argument("--dask", metavar="WHERE", help=text)


def add_distance(parser: argparse.ArgumentParser, several: str = "", k: str = "", is_field: bool = False) -> None:
    """Add `--distance`, and an option for each parameter of the built-in ones, which holds unless one says its own.

    `several` says what several with commas are; without it there is one, biharmonic if none is named. `k` says what
    else the command counts by `--k`. With `is_field` it may be the difference of two, and
    there is `--field`, whose value is a list of `FieldArray`, or None.
    """
    two = f"; a signature: {', '.join(SIGNATURES)}; or two like 'biharmonic - geodesic'" if is_field else ""
    if is_field:
        what = (
            "values at vertices that another program has computed, shown or used in --distance by their NAME, "
            "'biharmonic - thickness': .npy, .npz, .csv, .txt, .mat, .ply, .vtp, .vtu, .gltf, .glb, .gii, .annot, .nii "
            "(CIFTI) or such as lh.thickness; of several arrays in a file FILE:ARRAY; with commas for several"
        )
        parser.add_argument(
            "--field", dest="fields", metavar="NAME=FILE,…", type=as_argument(_fields), action="extend", help=what
        )
    words = f"{', '.join(distance_types())}; with parameters like 'diffusion(t=1/4)'{two}"
    if several:
        parser.add_argument(
            "--distance",
            metavar="NAME,…",
            type=as_argument(split_list),
            help=f"{words}; with commas: {several}",
        )
    else:
        text = f"{words} (default: {'the --field, else ' if is_field else ''}biharmonic)"
        names = ("--distance", "--quantity") if is_field else ("--distance",)
        usual = None if is_field else "biharmonic"
        parser.add_argument(*names, metavar="NAME", type=as_argument(_only_name), default=usual, help=text)
    for name, parameter in PARAMETERS.items():
        of = ", ".join(kind.word for kind in BUILT_IN if parameter in kind.parameters)
        also = f"{k}; or " if k and name == "k" else ""
        parser.add_argument(
            f"--{name}",
            metavar="{" + ",".join(parameter.choices) + "}" if parameter.choices else name.upper()[:1],
            help=f"{also}{parameter.meaning}, for {of} (default: {parameter.written(parameter.default)})",
        )


def _fields(text: str) -> list[FieldArray]:
    """Return the fields in NAME=FILE or FILE, with commas between them; they are read with the mesh."""
    from bihdist_core.formats.vertex_arrays import array_name, split_array

    found: list[FieldArray] = []
    for word in split_list(text):
        name, equals, file = word.partition("=")
        path, array = split_array(file if equals else word)
        name = name if equals else free_field_name(array_name(path, array), [field.name for field in found])
        found.append(FieldArray(name, "", "A", path, array))
    return found


def fields_of(options: argparse.Namespace) -> tuple[FieldArray, ...]:
    """Return the fields of the options with their checksums; ParameterError for one that cannot be read."""
    from ..session.array_store import ArrayStore

    return tuple(map(ArrayStore().add_file, options.fields or ()))


def with_fields(document: Document, found: tuple[FieldArray, ...]) -> Document:
    """Return the document with more fields, each with a panel of its own if it has none."""
    names = check_unique([field.name for field in found], "field")
    kept = tuple(field for field in document.fields if field.name not in names)
    document = replace(document, fields=(*kept, *found))
    for field in unnamed_fields(found, [panel.shows for panel in document.panels]):
        document = add_panel(document, field)
    return document


def eigenpair_count(options: argparse.Namespace, texts: Sequence[str], usual: int) -> int:
    """Read the command's own number of eigenpairs from `--k`, also that of distances without a number."""
    count = _k(options, usual)
    if not any(_counts_eigenpairs(text, _names(options)) for text in texts):
        options.k = None
    return count


def neighbour_count(options: argparse.Namespace, texts: Sequence[str]) -> int:
    """Read the number of neighbours from `--k`, and clear it; ParameterError where it may count eigenpairs."""
    unclear = [text for text in texts if _counts_eigenpairs(text)]
    if options.k is not None and unclear:
        raise ParameterError(
            f"--k {options.k} counts the nearest vertices; say how many eigenpairs {unclear[0]} has in its words, such "
            "as truncated(k=200)."
        )
    count, options.k = _k(options, NEIGHBOURS), None
    return count


def _k(options: argparse.Namespace, usual: int) -> int:
    return usual if options.k is None else int(PARAMETERS["k"].parsed(options.k))


def _names(options: argparse.Namespace) -> list[str]:
    """Return the names of the options' fields."""
    return [field.name for field in getattr(options, "fields", None) or ()]


def _counts_eigenpairs(text: str, fields: Sequence[str] = ()) -> bool:
    """Return True for the words of a distance that sums eigenpairs and does not say how many."""
    sums = [
        spec
        for spec in quantity(text, fields=fields).specs
        if any(each.name == "k" for each in spec.distance_type.parameters)
    ]
    return len(sums) > text.replace(" ", "").count("k=")


def add_chart(parser: argparse.ArgumentParser) -> None:
    """Add the options of how a chart looks."""
    add_rows(
        parser,
        *PAGE_ROWS,
        size="size of the chart: such as 85mm; or column (85 mm), double (178 mm)",
        style="style of the chart: paper, uniform, lines, dark or cover (default: paper)",
        font_family="font of the chart (default: DejaVu Sans)",
        font_size="font size of the chart, in points (default: 8)",
    )


def chart_page(options: argparse.Namespace) -> Page:
    """Return the page of a chart that the options describe."""
    return with_rows(Recipe(Document()), given(options, *PAGE_ROWS), PAGE_ROWS).page


SECTIONS = {
    "look": "colours and shading", "isolines": "isolines", "view": "view", "layout": "page", "marks": "marks",
    "areas": "mesh", "cut": "mesh", "merge": "mesh", "largest_component": "mesh", "operator": "mesh",
    **dict.fromkeys(("maps", "predict", "pairs", "perturb"), "two meshes"),
}  # fmt: skip
"""The sections of the help, by options and by their groups."""


def add_rows(parser: argparse.ArgumentParser, *rows: Row | Option, **meanings: str) -> None:
    """Add options of the table of figures' options; the value of one that is not given is None.

    `meanings` replace those of some, by name.
    """
    for option in _options(rows):
        section = _section(parser, SECTIONS.get(option.name, SECTIONS.get(option.group, "")))
        how: dict[str, Any] = {"dest": option.name, "help": meanings.get(option.name, option.meaning)}
        if option.is_switch:
            section.add_argument(option.word, action=argparse.BooleanOptionalAction, default=None, **how)
            continue
        how |= {"nargs": "?", "const": option.bare} if option.bare is not None else {}
        how |= {"metavar": option.metavar, "choices": option.choices, "type": as_argument(option.from_text)}
        section.add_argument(option.word, **how)


def _section(parser: argparse.ArgumentParser, title: str) -> argparse._ActionsContainer:
    """Return the section of the help with a title, made when it is first asked for; "" is the usual one."""
    known = {group.title: group for group in parser._action_groups}
    return (known.get(title) or parser.add_argument_group(title)) if title else parser


def _options(rows: Iterable[Row | Option]) -> Iterator[Option]:
    for row in rows:
        yield from row.options if isinstance(row, Row) else (row,)


def given(options: argparse.Namespace, *known: Row | Option) -> dict[str, Any]:
    """Return the values of the options that are given, by the names of their arguments."""
    found = {option.name: getattr(options, option.name) for option in _options(known)}
    return {name: value for name, value in found.items() if value is not None}


def as_argument(read: Callable[[str], Any]) -> Callable[[str], Any]:
    """Make a reader of texts for argparse, which reports its errors in the same words."""
    if read in (int, float, str):
        return read

    def read_argument(text: str) -> Any:
        try:
            return read(text)
        except ParameterError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None

    return read_argument


sources, pair, pairs = as_argument(sources_from_words), as_argument(pair_from_words), as_argument(pairs_from_words)
"""Readers of `--sources`, of a pair of vertex ids, and of `--pairs`."""


def add_areas(parser: argparse.ArgumentParser) -> None:
    """Add the options of how a mesh is taken: how vertex areas are measured, what is cut out of it and merged."""
    add_rows(parser, VERTEX_AREAS, REPAIRS)


def add_repairs(parser: argparse.ArgumentParser) -> None:
    """Add the options of what is cut out of a mesh and merged."""
    add_rows(parser, REPAIRS)


def add_cut(parser: argparse.ArgumentParser) -> None:
    """Add the options of what is cut out of a mesh, whose vertices keep their ids."""
    add_rows(parser, CUT, LARGEST)


def repairs_of(options: argparse.Namespace, mesh: str) -> Repairs:
    """Return the repairs of a mesh that the options name."""
    merge = getattr(options, "merge", None)
    operator = getattr(options, "operator", None) or COTAN
    return Repairs(options.cut or "", "", merge, bool(options.largest_component), operator).of(mesh)


def specs(options: argparse.Namespace, texts: Sequence[str], signatures: bool = False) -> list[Spec]:
    """Read distances, and signatures where these will do, from texts and the parameters beside them.

    ParameterError for a parameter that none of them has.
    """
    for text in texts:
        if " - " in text or (is_signature(text) and not signatures):
            raise ParameterError(f"{text!r} is a field, and has no value between two vertices; name a distance.")
    kinds = (SignatureSpec if is_signature(text) else Spec for text in texts)
    found = [kind.parse(text, **given_parameters(options)) for kind, text in zip(kinds, texts, strict=True)]
    check_parameters(options, found)
    return found


def _only_name(text: str) -> str:
    """Return the name of a distance; ParameterError for a list of several."""
    if len(split_list(text)) > 1:
        raise ParameterError(f"one distance at a time, not {text!r}; `bihdist batch` computes several")
    return text


def quantities(options: argparse.Namespace, texts: Sequence[str], fields: Sequence[str] = ()) -> list[Quantity]:
    """Read distances, differences, and fields of the options and a recipe from texts and the parameters beside them."""
    found = [
        quantity(text, fields=list(dict.fromkeys([*fields, *_names(options)])), **given_parameters(options))
        for text in texts
    ]
    check_parameters(options, [spec for shows in found for spec in shows.parametrised])
    return found


def given_parameters(options: argparse.Namespace) -> dict[str, Any]:
    """Return the parameters that are given as options."""
    given = {name: getattr(options, name) for name in PARAMETERS}
    return {name: PARAMETERS[name].parsed(text) for name, text in given.items() if text is not None}


def check_parameters(options: argparse.Namespace, specs: Sequence[Spec]) -> None:
    """Raise ParameterError for a parameter that none of the distances has, as it would be ignored."""
    known = {parameter.name for each in specs for parameter in each.distance_type.parameters}
    for name in given_parameters(options):
        if name not in known:
            shown = ", ".join(dict.fromkeys(each.word for each in specs))
            raise ParameterError(f"--{name} {getattr(options, name)} is not a parameter of {shown}.")


def count(text: str) -> int:
    """Read a whole number from 1; argparse.ArgumentTypeError for another text."""
    return int(_checked(text, int, lambda value: value >= 1, "a whole number from 1"))


def positive(text: str) -> float:
    """Read a positive finite number; argparse.ArgumentTypeError for another text."""
    return _checked(text, float, lambda value: 0 < value < math.inf, "a positive number")


def share(text: str) -> float:
    """Read a fraction from 0 to 1; argparse.ArgumentTypeError for another text."""
    return _checked(text, float, lambda value: 0 <= value <= 1, "a fraction from 0 to 1")


def _checked(text: str, read: Callable[[str], float], holds: Callable[[float], bool], what: str) -> float:
    with suppress(ValueError):
        if holds(value := read(text)):
            return value
    raise argparse.ArgumentTypeError(f"{text!r} is not {what}")
