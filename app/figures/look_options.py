"""What figures can be told of how fields and surfaces look: isolines, colours and their ends, shading."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress

from ..document.document import Document
from ..document.isoline_edits import pass_through, pass_through_none
from ..document.looks import Colours, Isolines, shaded
from ..document.option import (
    USUAL,
    NotExpressible,
    Option,
    Row,
    digits,
    numbers,
    vertex,
    vertex_of,
    with_attribute,
    with_commas,
)
from ..document.page import Recipe


# ---------------------------------------------------------------------- isolines
def _isolines_of(recipe: Recipe) -> dict[str, Any]:
    isolines, values = recipe.document.isolines, dict[str, Any]()
    if isolines.spacing is not None:
        values["isoline_spacing"] = isolines.spacing
    elif isolines.values:
        values["isoline_values"] = list(isolines.values)
    elif isolines.count != USUAL.document.isolines.count:
        values["isolines"] = isolines.count
    if not isolines.round:
        values["equal_isolines"] = True
    vertices = [vertex_of(recipe.document.point(name)) for name in isolines.through]
    if None in vertices or not _has_own_points(recipe.document):
        raise NotExpressible("An isoline passes through a point that is more than that.")
    return values | ({"isoline_through": vertices} if vertices else {})


def _has_own_points(document: Document) -> bool:
    """Whether nothing starts at the points that isolines pass through, and they are on the first surface."""
    used = {name for panel in document.panels for name in panel.shows.points}
    first = document.surfaces[0].name
    return all(name not in used and document.point(name).surface == first for name in document.isolines.through)


def _with_isolines(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    through = values.get("isoline_through", ())
    document = replace(recipe.document, isolines=isolines_with(recipe.document.isolines, values))
    if len(through):
        if len(document.surfaces) != 1:
            raise ParameterError(
                f"--isoline-through names vertices of one mesh, and this recipe has {len(document.surfaces)}."
            )
        document = pass_through(pass_through_none(document), tuple(through), document.surfaces[0].name)
    return replace(recipe, document=document)


def isolines_with(isolines: Isolines, values: Mapping[str, Any]) -> Isolines:
    """Isolines where some options say; ParameterError for two ways to say where."""
    where = [
        f"--{name.replace('_', '-')}" for name in ("isolines", "isoline_spacing", "isoline_values") if name in values
    ]
    if len(where) > 1:
        raise ParameterError(f"{' and '.join(where)} are two ways to say where isolines are; choose one.")
    if isinstance(values.get("isolines"), Isolines):
        isolines = values["isolines"]
    elif where:
        isolines = replace(
            isolines,
            count=values.get("isolines", isolines.count),
            spacing=values.get("isoline_spacing"),
            values=tuple(values.get("isoline_values", ())),
        )
    return replace(isolines, round=not values.get("equal_isolines", not isolines.round))


ISOLINES = Row(
    (
        Option("isolines", "about so many, at round values; 0 for none (default: 20)", 20, metavar="N", read=int),
        Option("equal_isolines", "as many equal steps from 0 to the maximum, instead of round values", False),
        Option("isoline_spacing", "isolines at multiples of this, in the field's unit", metavar="STEP", read=float),
        Option("isoline_values", "isolines at these values", (), metavar="A,B,…", read=numbers, write=with_commas),
        Option("isoline_through", "one more through each of these vertices", (), "", "V,…", read=vertex, is_list=True),
    ),
    ("Document.isolines", *(f"Isolines.{name}" for name in ("count", "spacing", "values", "through", "round"))),
    _isolines_of,
    _with_isolines,
)


# ---------------------------------------------------------------------- colours, their ends, shading
def _colours_of(recipe: Recipe) -> dict[str, Any]:
    colours = recipe.document.colours
    if colours.stops:
        raise NotExpressible("The colours came from a file.")
    values = {"colours": colours.map, "reversed": colours.reversed, "bands": colours.bands}
    return {name: value for name, value in values.items() if value}


def _with_colours(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    colours, chosen = recipe.document.colours, values.get("colours")
    if isinstance(chosen, Colours):
        colours = chosen
    elif chosen is not None:
        from ..scene.colour_file import colours_named

        colours = colours_named(chosen, colours)
    flags = {name: values[name] for name in ("reversed", "bands") if name in values}
    return replace(recipe, document=replace(recipe.document, colours=replace(colours, **flags)))


COLOURS = Row(
    (
        Option(
            "colours",
            "a colour map: paper (default), uniform, ember, safe (also in grey), diverging; or a .txt, .csv or "
            "ParaView's .json",
            "",
            metavar="NAME|FILE",
        ),
        Option("reversed", "the colours from the other end", False),
        Option("bands", "one colour between isolines", False),
    ),
    ("Document.colours", "Colours.map", "Colours.stops", "Colours.reversed", "Colours.bands"),
    _colours_of,
    _with_colours,
)


def _range_of(recipe: Recipe) -> dict[str, Any]:
    """A word, or where each colour bar ends."""
    word, ends = recipe.document.range, [panel.maximum for panel in recipe.document.panels]
    if all(end is None for end in ends):
        return {} if word == USUAL.document.range else {"range": word}
    if word != "own":
        raise NotExpressible("A colour bar ends where somebody typed, and they all have one range.")
    return {"range": float(ends[0] or 0) if len(ends) == 1 else ends}


def _ends(text: str) -> str | list[float | None]:
    """Numbers, with None for a panel's own; a word or a path as it is."""
    try:
        return [None if word.strip() == "own" else float(word) for word in text.split(",")] if text != "own" else text
    except ValueError:
        return text


def _ends_text(ends: Any) -> str:
    if isinstance(ends, list):
        return ",".join("own" if end is None else digits(end) for end in ends)
    return ends if isinstance(ends, str) else digits(ends)


RANGE = Row(
    (
        Option(
            "range",
            "where colour bars end: own (own maximum, the default), shared (one for all panels of a unit), shares "
            "(fraction of the maximum), a number, or one or `own` for each panel such as 0.8,own,2; or a session or "
            "recipe, whose ends are taken",
            "own",
            metavar="RANGE",
            read=_ends,
            write=_ends_text,
        ),
    ),
    ("Document.range", "Panel.maximum"),
    _range_of,
)
"""Not put by itself: what ends are taken from may have to be computed, and says what it has taken."""


def with_range(
    recipe: Recipe, values: Mapping[str, Any], tell: Callable[[str], None], progress: Progress | None
) -> Recipe:
    """The recipe with the range of colours that the options say."""
    document, range = recipe.document, values.get("range")
    if range is not None:
        from .ends import ranged

        document, sentence = ranged(document, range, progress)
        if sentence:
            tell(sentence)
    return replace(recipe, document=document)


def _shading_of(recipe: Recipe) -> dict[str, Any]:
    """An angle alone would make it creased."""
    shading, usual = recipe.document.shading, USUAL.document.shading
    values: dict[str, Any] = {}
    if (shading.normals, shading.crease) != (usual.normals, usual.crease):
        values["shading"] = shading.normals
    if shading.crease != usual.crease:
        values["crease"] = shading.crease
    return values | ({"wireframe": True} if shading.wireframe else {})


SHADING = Row(
    (
        Option(
            "shading",
            "auto, smooth, creased or flat (default: creased where there are sharp edges)",
            metavar="NAME",
        ),
        Option("crease", "where faces meet at more is an edge (default: 40)", metavar="DEGREES", read=float),
        Option("wireframe", "the edges of the mesh", False),
    ),
    ("Document.shading", "Shading.normals", "Shading.crease", "Shading.wireframe"),
    _shading_of,
    lambda recipe, values: with_attribute(
        recipe,
        "document.shading",
        shaded(recipe.document.shading, *(values.get(name) for name in ("shading", "crease", "wireframe"))),
    ),
)
