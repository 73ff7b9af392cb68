"""The one line, for a shell or for Python, that makes the figure of a recipe: only what is not as usual is named.

It is the inverse of the options of `bihdist figure` and of the arguments of `bihdist.figure`, as all three follow from
the table in `options`.
"""

import os
import shlex
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.sources.source import Curve
from bihdist_core.sources.words import EMPTY

from ..document.derived_surfaces import COLUMNS
from ..document.document import from_points, usual_specs
from ..document.option import NotExpressible, Option, Row, Starts, as_argument, with_attribute
from ..document.page import Recipe
from ..document.quantities import Quantity, from_point, own_fields
from ..samples import mesh_path
from .options import made_from, rows, rows_of_sources


# ---------------------------------------------------------------------- the lines
def command_line(recipe: Recipe, output: str, files: Mapping[Curve, str] = EMPTY) -> str:
    """Return the line for a shell, ``bihdist figure ... -o OUTPUT``.

    Parameters
    ----------
    files
        Where curves that fields start from are saved.

    Raises
    ------
    ParameterError
        For what `why_not` names, and for a curve that has no file.
    """
    words = ["bihdist", "figure", mesh_word(recipe.document.surfaces[0].path)]
    for option, value in _options_of(recipe):
        word, texts = option.words(value)
        if texts is None:
            words.append(word)
            continue
        text = ",".join(each.words(files) if isinstance(each, Starts) else each for each in texts)
        words += [f"{word}={text}"] if text[:1] == "-" else [word, text]
    return _joined([*words, "-o", output])


def python_line(recipe: Recipe, output: str, files: Mapping[Curve, str] = EMPTY) -> str:
    """Return the line for Python, ``import bihdist; bihdist.figure(...).save(OUTPUT)``; see `command_line`."""
    arguments: dict[str, Any] = {}
    for option, value in _options_of(recipe):
        shown = as_argument(value[0] if option.may_be_lone and len(value) == 1 else value, files)
        name, key = option.argument
        if key:
            arguments.setdefault(name, {})[key] = shown
        else:
            arguments[name] = shown
    if arguments.get("isolines", {}).keys() == {"count"}:
        arguments["isolines"] = arguments["isolines"]["count"]
    words = [
        repr(mesh_word(recipe.document.surfaces[0].path)),
        *(f"{name}={each!r}" for name, each in arguments.items()),
    ]
    return f"import bihdist; bihdist.figure({', '.join(words)}).save({output!r})"


def recipe_command_line(path: str, output: str) -> str:
    """Return the line for a shell that draws the figure of a recipe's file again."""
    return _joined(["bihdist", "figure", "--recipe", path, "-o", output])


def recipe_python_line(path: str, output: str) -> str:
    """Return the line of Python that draws the figure of a recipe's file again."""
    return f"import bihdist; bihdist.figure_again({path!r}).save({output!r})"


def why_not(recipe: Recipe) -> str:
    """Return a sentence on what no line can say of a recipe; "" if a line can say all of it."""
    try:
        list(_options_of(recipe))
    except NotExpressible as reason:
        return str(reason)
    return ""


def mesh_word(path: str) -> str:
    """Return the name of a sample or the whole path of a file, which a line can name wherever it is run."""
    stem = os.path.splitext(os.path.basename(path))[0]
    sample = mesh_path(stem)
    if not os.path.exists(path) or (sample != stem and os.path.exists(sample) and os.path.samefile(path, sample)):
        return stem if os.path.exists(path) else path
    return os.path.abspath(path)


def _joined(words: list[str]) -> str:
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def _options_of(recipe: Recipe) -> Iterator[tuple[Option, Any]]:
    """Yield the options that are not as usual, with their values; raise NotExpressible where no option can say it."""
    document, made = made_from(recipe.document)
    if made:
        yield from _values_of(recipe, *(row for row in rows() if row.made_from is not None))
        columns = None if recipe.page.columns in (None, COLUMNS) else recipe.page.columns
        recipe = replace(recipe, document=document)
        recipe = with_attribute(recipe, "page.columns", columns or rows_of_sources(recipe))
    yield from _values_of(recipe, PANELS, *rows())


def _values_of(recipe: Recipe, *those: Row) -> Iterator[tuple[Option, Any]]:
    for row in those:
        values = row.get(recipe)
        yield from ((option, values[option.name]) for option in row.options if option.name in values)


# ---------------------------------------------------------------------- what is shown of what
def _panels_of(recipe: Recipe) -> dict[str, Any]:
    """Return the quantities, and the sources from each of which all of them are shown."""
    document = recipe.document
    if len(document.surfaces) != 1:
        raise NotExpressible(f"One line draws one mesh, and here are {len(document.surfaces)}.")
    if not document.surfaces[0].path:
        raise NotExpressible("The mesh was given from Python as arrays, which no line can hold.")
    used = dict.fromkeys(part.name for panel in document.panels for part in own_fields(panel.shows))
    shown_alone = list(used)
    used |= {field.name: None for field in document.fields if field.name == document.base.scalars}
    fields = [document.field(name) for name in used]
    if not all(field.path for field in (*fields, *document.fields)):
        raise NotExpressible("User-defined fields were given from Python as arrays, which no line can hold.")
    if not document.panels:
        raise NotExpressible("There are no panels.")
    names = list(dict.fromkeys(name for panel in document.panels for name in panel.shows.points))
    shows: list[Quantity] = [
        from_point(p.shows, "source") for p in document.panels if set(p.shows.points) <= set(names[:1])
    ]
    repeated = from_points(shows, names or ["source"])
    if [panel.shows for panel in document.panels] != repeated:
        raise NotExpressible("The panels start from different points, and not every distance from every point.")
    places = [document.point(name).at for name in names]
    if None in places and len(places) > 1:
        raise NotExpressible("One of several sources has not been placed.")
    starts = [Starts(at) for at in places if at is not None]
    words = [str(each) for each in shows]
    usual_words = [*map(str, usual_specs(document.surfaces[0].path))]
    usual = words in ([*usual_words, *shown_alone], usual_words)
    values: dict[str, Any] = {} if usual else {"distances": words}
    if fields:
        values["fields"] = {
            each.name: os.path.abspath(each.path) + f":{each.array}" * bool(each.array) for each in fields
        }
    return values | ({"source": starts} if starts else {})


PANELS = Row(
    (
        Option("distances", "", flag="distance", group="", is_list=True),
        Option("fields", "", flag="field", group="", write=lambda fields: ",".join(map("=".join, fields.items()))),
        Option("source", "", flag="sources", group="", write=lambda start: start, is_list=True, may_be_lone=True),
    ),
    ("Document.surfaces", "Document.fields", "Document.points", "Document.panels", "Panel.shows"),
    _panels_of,
)
