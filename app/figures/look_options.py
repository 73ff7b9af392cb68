"""Options of figures for the look of fields and surfaces: isolines, colours and their ends, shading."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress

from ..document.document import Document
from ..document.edits import pass_through, pass_through_none
from ..document.looks import CURVATURE, Colours, Isolines
from ..document.option import (
    USUAL,
    NotExpressible,
    Option,
    Row,
    attribute,
    digits,
    numbers,
    vertex,
    vertex_of,
    with_commas,
)
from ..document.page import Recipe
from ..document.settings import BANDS, FLIP_SCALARS, GRADUAL_BASE, WHITE_ISOLINES
from .size import is_column


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
        raise NotExpressible("An isoline passes through a point that also marks something else.")
    return values | ({"isoline_through": vertices} if vertices else {})


def _has_own_points(document: Document) -> bool:
    """Return whether isolines pass through points of the first surface only, from which no field starts."""
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
    """Return isolines where the options say; raise ParameterError if two of them do."""
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


def _count(text: str) -> int:
    """Return the number of isolines in a text; raise ParameterError for any other text, such as their values."""
    try:
        return int(text)
    except ValueError:
        raise ParameterError(
            f"{text!r} is not a number of isolines; for lines at given values write --isoline-values 0.1,0.2"
        ) from None


def _isoline_option(name: str, key: str, meaning: str, default: Any = None, **how: Any) -> Option:
    return Option(name, meaning, default, group="isolines", key=key, **how)


ISOLINES = Row(
    (
        _isoline_option(
            "isolines",
            "count",
            "about this many isolines, at round values; 0 for none (default: 20)",
            20,
            metavar="N",
            read=_count,
        ),
        _isoline_option(
            "equal_isolines",
            "equal",
            "draw as many, at equal steps from 0 to the maximum instead of round values",
            False,
        ),
        _isoline_option(
            "isoline_spacing",
            "spacing",
            "isolines at multiples of this, in the field's unit",
            metavar="STEP",
            read=float,
        ),
        _isoline_option(
            "isoline_values", "values", "isolines at these values", (), metavar="A,B,…", read=numbers, write=with_commas
        ),
        _isoline_option(
            "isoline_through",
            "through",
            "one more isoline through each of these vertices",
            (),
            metavar="V,…",
            read=vertex,
            is_list=True,
        ),
    ),
    ("Document.isolines", *(f"Isolines.{name}" for name in ("count", "spacing", "values", "through", "round"))),
    _isolines_of,
    _with_isolines,
)


# ---------------------------------------------------------------------- colours, their ends, shading
def _map_of(recipe: Recipe) -> dict[str, Any]:
    colours = recipe.document.colours
    if colours.stops:
        raise NotExpressible("The colours came from a file.")
    return {"cmap": colours.map} if colours.map else {}


def _with_map(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    colours, chosen = recipe.document.colours, values["cmap"]
    if isinstance(chosen, Colours):
        colours = chosen
    else:
        from ..scene.colour_file import colours_named

        colours = colours_named(chosen, colours)
    return replace(recipe, document=replace(recipe.document, colours=colours))


COLOURS = (
    Row(
        (
            Option(
                "cmap",
                "colour map: paper (default), uniform (as viridis), ember (like inferno), safe (like cividis; also in "
                "grey), diverging; or a .txt, .csv or ParaView's .json",
                "",
                group="look",
                metavar="NAME|FILE",
            ),
        ),
        ("Document.colours", "Colours.map", "Colours.stops"),
        _map_of,
        _with_map,
    ),
    FLIP_SCALARS.row,
    BANDS.row,
)


def _with_base(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    document, page, name = recipe.document, recipe.page, values["base"]
    known = [field.name for field in document.fields]
    if name not in ("", CURVATURE, *known):
        raise ParameterError(
            f"There is no base {name!r}; choose {' or '.join([CURVATURE, *known])}, or name a file: "
            f"--field {name}=FILE."
        )
    # A field that is the base needs no panel of its own.
    kept = tuple(panel for panel in document.panels if str(panel.shows) != name) or document.panels
    columns = page.columns and max(page.columns - (len(document.panels) - len(kept)), 1)
    document = replace(document, panels=kept, base=replace(document.base, scalars=name))
    return replace(recipe, document=document, page=replace(page, columns=columns))


BASE = (
    Row(
        (
            Option(
                "base",
                "draw this in grey under isolines in the colours of the field: curvature, or the name of a field",
                "",
                group="look",
                metavar="curvature|NAME",
            ),
        ),
        ("Document.base", "Base.scalars"),
        lambda recipe: {"base": recipe.document.base.scalars} if recipe.document.base.scalars else {},
        _with_base,
    ),
    GRADUAL_BASE.row,
    WHITE_ISOLINES.row,
)


def suits_one_bar(recipe: Recipe) -> bool:
    """Return whether one colour bar, in fractions of each maximum, can take the place of the panels' own.

    It can where they are distances, whose isolines are at as many steps.
    """
    document, isolines = recipe.document, recipe.document.isolines
    is_by_steps = isolines.spacing is None and not (isolines.values or isolines.through or isolines.labels)
    panels = document.panels
    return (
        len(panels) > 1 and is_by_steps and all(panel.shows.is_distance and panel.maximum is None for panel in panels)
    )


def _range_of(recipe: Recipe) -> dict[str, Any]:
    """Return the word for the range, or where each colour bar ends."""
    word, ends = recipe.document.range, [panel.maximum for panel in recipe.document.panels]
    if all(end is None for end in ends):
        usual = "fraction" if is_column(recipe.page.size) and suits_one_bar(recipe) else USUAL.document.range
        return {} if word == usual else {"clim": word}
    if word != "own":
        raise NotExpressible("A colour bar ends at a typed value, and all share one range.")
    return {"clim": float(ends[0] or 0) if len(ends) == 1 else ends}


def _ends(text: str) -> str | list[float | None]:
    """Return the numbers in a text, None for a panel's own maximum; a word or a path is returned as it is."""
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
            "clim",
            "where colour bars end: own (own maximum, the default), shared (one for all panels of a unit), fraction "
            "(of each maximum; the default for distances in one column), a number, or one or `own` for each panel such "
            "as 0.8,own,2; or a session or recipe, whose limits are taken",
            group="look",
            metavar="LIMITS",
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
    """Return the recipe with the colour limits that the options say."""
    document, limits = recipe.document, values.get("clim")
    if limits is not None:
        from .colour_limits import with_limits

        document, sentence = with_limits(document, limits, progress)
        if sentence:
            tell(sentence)
    return replace(recipe, document=document)


SPLIT = {"smooth": False, "creased": True}
"""What `split_sharp_edges` says of normals; neither is for automatic."""


def _shading_of(recipe: Recipe) -> dict[str, Any]:
    shading, usual = recipe.document.shading, USUAL.document.shading
    values: dict[str, Any] = {"smooth_shading": False} if shading.normals == "flat" else {}
    # An angle alone splits sharp edges.
    if shading.normals in SPLIT:
        values["split_sharp_edges"] = SPLIT[shading.normals]
    if shading.feature_angle != usual.feature_angle:
        values["feature_angle"] = shading.feature_angle
        if shading.normals == "auto":
            raise NotExpressible("Sharp edges are found automatically, at an angle that was typed.")
    return values


def _with_shading(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    shading = recipe.document.shading
    normals, split = shading.normals, values.get("split_sharp_edges")
    if values.get("smooth_shading") is False:
        if split:
            raise ParameterError("Flat shading has no edges to split; leave out smooth_shading or split_sharp_edges.")
        normals = "flat"
    elif split is not None or "feature_angle" in values:
        normals = "smooth" if split is False else "creased"
    elif values.get("smooth_shading") and normals == "flat":
        normals = "auto"
    angle = values.get("feature_angle", shading.feature_angle)
    shading = replace(shading, normals=normals, feature_angle=angle)
    return replace(recipe, document=replace(recipe.document, shading=shading))


SHADING = Row(
    (
        Option(
            "smooth_shading",
            "use a normal at each vertex, or one for each face (default: yes)",
            True,
            group="look",
            is_flag=True,
        ),
        Option(
            "split_sharp_edges",
            "use a normal on each side of a sharp edge (default: on surfaces that have some)",
            group="look",
            is_flag=True,
        ),
        Option(
            "feature_angle",
            "an edge is sharp where faces meet at more than this (default: 40)",
            group="look",
            metavar="DEGREES",
            read=float,
        ),
    ),
    ("Document.shading", "Shading.normals", "Shading.feature_angle"),
    _shading_of,
    _with_shading,
)

OPACITY = attribute(
    "document.opacity",
    "opacity of the surface, from more than 0 to 1; below 1 marks, paths and isolines behind it are seen (default: 1)",
    "FRACTION",
    group="look",
    read=float,
)
