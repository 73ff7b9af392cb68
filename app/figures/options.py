"""All that a figure can be told, in one table: from it come options of commands, arguments of `bihdist.figure`, and the
lines that make a figure again (`one_line`).  Rows of tools stand in their folders (`Tool.options`).
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from bihdist_core.applications.changes import change_from_words
from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress

from ..document import between
from ..document.camera import Camera, View
from ..document.document import AREAS, Document, Zoom
from ..document.edits import stand
from ..document.isoline_edits import pass_through, pass_through_none
from ..document.looks import PROJECTIONS, UPS, Colours, Isolines, shaded
from ..document.option import (
    USUAL,
    NotExpressible,
    Option,
    Row,
    attribute,
    digits,
    numbers,
    unsaid,
    vertex_of,
    with_attribute,
    with_commas,
)
from ..document.page import Recipe
from ..document.perturbation import COLUMNS, split, with_changed
from ..document.tools import tools


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
        Option(
            "isoline_through", "one more through a vertex; repeat for more", (), metavar="V", read=int, repeats=True
        ),
    ),
    ("Document.isolines", *(f"Isolines.{name}" for name in ("count", "spacing", "values", "through", "round"))),
    _isolines_of,
    _with_isolines,
)


# ---------------------------------------------------------------------- views
def _views_of(recipe: Recipe) -> dict[str, Any]:
    cameras = [view for view in recipe.views if isinstance(view, Camera)]
    if len(cameras) > 1 or (cameras and recipe.views[-1] is not cameras[0]):
        raise NotExpressible("There are several cameras.")
    names = [view for view in recipe.views if isinstance(view, str)]
    values: dict[str, Any] = {"views": names} if names and (names != ["auto"] or cameras) else {}
    for camera in cameras:
        values["camera"] = tuple(map(float, (*camera.position, *camera.focal_point, *camera.up, *camera.extent)))
    return values


def _with_views(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    asked = values.get("views", ())
    views: list[View] = [asked] if isinstance(asked, str | Camera) else list(asked)
    if "camera" in values:
        x = [float(number) for number in values["camera"]]
        if len(x) != 11:
            raise ParameterError(f"A camera is eleven numbers (position, focal point, up, extent), not {len(x)}.")
        views.append(Camera((x[0], x[1], x[2]), (x[3], x[4], x[5]), (x[6], x[7], x[8]), (x[9], x[10])))
    page = replace(recipe.page, views=tuple(views) if len(views) > 1 else ())
    return replace(recipe, document=replace(recipe.document, camera=views[0] if views else "auto"), page=page)


def _camera_numbers(text: str) -> tuple[float, ...]:
    found = numbers(text)
    if len(found) != 11:
        raise ParameterError(f"{text!r} is not 11 numbers with commas between them")
    return found


VIEWS = Row(
    (
        Option(
            "views",
            "home and high, each also with -right, -back or -left, front, back, left, right, top, bottom, source, or "
            "auto, the one of the first eight that shows most of the shape (default); repeat",
            "auto",
            flag="view",
            metavar="NAME",
            repeats=True,
            may_be_lone=True,
        ),
        Option(
            "camera",
            "position, focal point, up, extent: 11 numbers",
            metavar="NUMBERS",
            read=_camera_numbers,
            write=with_commas,
        ),
    ),
    ("Document.camera", "Page.views"),
    _views_of,
    _with_views,
)


def up_meaning(default: str) -> str:
    """What `--up` means; default: what is up without it, in words."""
    return f"which axis points up: {', '.join(UPS)} (default: {default}); write --up=-z for those with a sign"


UP = replace(
    attribute("document.up", up_meaning("guessed"), "AXIS", choices=UPS),
    # A camera that comes with a recipe would be askew.
    put=lambda recipe, values: replace(recipe, document=stand(recipe.document, values["up"])),
)

VERTEX_AREAS = attribute("document.areas", "vertex areas (default: voronoi)", choices=AREAS)


# ---------------------------------------------------------------------- insets
def _zooms_of(recipe: Recipe) -> dict[str, Any]:
    zooms = recipe.document.zooms
    if any(zoom.corner != "auto" for zoom in zooms):
        raise NotExpressible("An inset has a corner of its own.")
    values = [(zoom.vertex, zoom.factor, *(() if zoom.isolines is None else (zoom.isolines,))) for zoom in zooms]
    return {"zooms": values} if values else {}


def _with_zooms(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    found = (zoom if isinstance(zoom, tuple) else (zoom,) for zoom in values["zooms"])
    zooms = tuple(replace(Zoom(*each[:2]), isolines=each[2] if len(each) > 2 else None) for each in found)
    return replace(recipe, document=replace(recipe.document, zooms=zooms))


def _zoom(text: str) -> tuple[Any, ...]:
    words = text.split(",")
    try:
        vertex, factor, steps, *others = *words, *[""] * (3 - len(words))
        if others:
            raise ValueError
        return int(vertex), float(factor or 3), int(steps) if steps else None
    except ValueError:
        raise ParameterError(
            f"{text!r} is not a vertex id, or an id and a factor such as 12,3, or these and a number of steps: 12,3,60"
        ) from None


ZOOMS = Row(
    (
        Option(
            "zooms",
            "enlarge the place of a vertex, perhaps with N isolines",
            (),
            flag="zoom",
            metavar="V[,FACTOR[,N]]",
            read=_zoom,
            write=with_commas,
            repeats=True,
        ),
    ),
    ("Document.zooms", "Zoom.vertex", "Zoom.factor", "Zoom.corner", "Zoom.isolines"),
    _zooms_of,
    _with_zooms,
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
            "a colour map: paper, uniform, ember, safe (also in grey), diverging; or a .txt, .csv or ParaView's .json",
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
            "where colour bars end: own (own maximum), shared (one for all panels of a unit), shares (fraction of "
            "the maximum), a number, or one or `own` for each panel such as 0.8,own,2; or a session or recipe, whose "
            "ends are taken",
            "own",
            metavar="RANGE",
            read=_ends,
            write=_ends_text,
        ),
        Option("shared_range", "the same as --range shared", False),
    ),
    ("Document.range", "Panel.maximum"),
    _range_of,
)
"""Not put by itself: what ends are taken from may have to be computed, and says what it has taken."""


def _with_range(
    recipe: Recipe, values: Mapping[str, Any], tell: Callable[[str], None], progress: Progress | None
) -> Recipe:
    document, range = recipe.document, values.get("range")
    if "shared_range" in values:
        word = "shared" if values["shared_range"] else "own"
        if range not in (None, word):
            other = "--shared-range" if values["shared_range"] else "--no-shared-range"
            raise ParameterError(f"--range {range} and {other} differ; leave one out.")
        document = replace(document, range=word)
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
        Option("crease", "where faces meet at more is an edge (40)", metavar="DEGREES", read=float),
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


# ---------------------------------------------------------------------- columns
def rows_of_sources(recipe: Recipe) -> int | None:
    """The columns of a page with a row of panels for each source, None if there are not several sources."""
    names = {name for panel in recipe.document.panels for name in panel.shows.points}
    return len(recipe.document.panels) // len(names) if len(names) > 1 else None


def _columns_of(recipe: Recipe) -> dict[str, Any]:
    """Without a word, one row a source."""
    usual = rows_of_sources(recipe)
    if recipe.page.columns is None and usual is not None:
        raise NotExpressible("The panels of several sources are in one row.")
    return {} if recipe.page.columns == usual else {"columns": recipe.page.columns}


# ---------------------------------------------------------------------- another mesh
PERTURB = Option(
    "perturb",
    "each distance before and after a change to the mesh, and the difference: pose=FILE, cut=FACES, simplify=N, "
    "noise=S, along=normals, holes=N, radius=R, weld=I:J, handle=I:J, seed=K, with commas between them",
    "",
    metavar="WORDS",
)


def _with_maps(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    import numpy as np

    from bihdist_core.formats.vertex_maps import read_pairs

    document, pairs = recipe.document, values.get("pairs", ())
    pairs = np.asarray(read_pairs(pairs) if isinstance(pairs, str) else pairs)
    if pairs.size:
        if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
            raise ParameterError(f"Pairs are whole numbers of shape (k, 2), not {pairs.dtype} of {pairs.shape}.")
        document = between.with_pairs(document, [(int(i), int(j)) for i, j in pairs])
    if "predict" in values and values.get("maps"):
        raise ParameterError(
            "--predict and --map (in Python predict= and maps=) are figures of their own; leave one of them out."
        )
    if "predict" in values:
        document = between.with_prediction(document, values["predict"])
    elif len(values.get("maps", ())):
        document = between.with_maps(document, values["maps"])
    return replace(recipe, document=document)


MAPS = Row(
    (
        Option(
            "maps",
            "instead of distances where each vertex of A is on B, in colours: a .npy or .txt file with one of B for "
            f"each of A; or `{between.PAIRS}`, for the maps by each --distance from --pairs; repeat",
            (),
            flag="map",
            metavar="MAP",
            repeats=True,
        ),
        Option(
            "predict",
            "instead of distances how badly each vertex of B fits vertex V of A, by each --distance from --pairs, and "
            "which fits best",
            metavar="V",
            read=int,
        ),
        Option("pairs", "known pairs, a line `i,j` for each: vertex i of A is j of B", (), metavar="FILE"),
    ),
    put=_with_maps,
)

# ---------------------------------------------------------------------- all of them
ROWS = (
    ISOLINES,
    attribute("document.isolines.bold", "every fifth, or Nth, is bolder", "N", name="bold_isolines", read=int, bare=5),
    attribute("document.isolines.labels", "the values stand on the lines", name="isoline_labels"),
    UP,
    VIEWS,
    attribute("document.projection", "default: perspective", choices=PROJECTIONS),
    attribute("document.axes", "where x, y and z point to, in a corner (default: no)"),
    Row(
        (Option("columns", "panels side by side (default: all, or one row a source)", metavar="N", read=int),),
        ("Page.columns",),
        _columns_of,
        lambda recipe, values: with_attribute(recipe, "page.columns", values["columns"]),
    ),
    ZOOMS,
    attribute("document.extrema", "triangles at maxima and at minima away from the source (default: no)"),
    attribute(
        "document.height",
        "a flat mesh becomes a height field, its highest point at this fraction of its extent",
        "FRACTION",
        read=float,
        bare=0.35,
    ),
    COLOURS,
    RANGE,
    attribute("page.hints", "what to look for, under the headings (default: no)"),
    attribute("page.title", "names as heading, as caption at the bars, or none", "WHERE"),
    attribute("page.font", "of all words (default: DejaVu Sans)", "FAMILY"),
    attribute("page.text", "size of labels; other words in proportion", "POINTS", read=float),
    attribute(
        "page.size",
        "such as 85mm, 1680x640, 160mm@300dpi, 160x80mm; or column (85 mm), double (178 mm), slide, A0",
        "SIZE",
    ),
    attribute("page.style", "paper, uniform, lines or dark (default: paper)", "NAME"),
    attribute("page.transparent", "no background"),
    attribute("page.crop", "without the empty margins"),
    SHADING,
    VERTEX_AREAS,
    unsaid("what a click does in the window", "Document.tool"),
    unsaid("for panels that are still to come", "Document.next_id"),
    unsaid("where instruments stand in the window", "Document.dock_places"),
    unsaid("what the pointer does in the window", "Document.snap"),
    unsaid("each is said by itself", "Document.parts"),
    unsaid("for the window and the history", "Panel.id"),
    unsaid("with one mesh all panels are of it", "Panel.surface"),
    unsaid("with one mesh there is none beside it", "Document.beside"),
    unsaid("what the cameras of the window do", "Document.linked"),
    unsaid("the file's name says it", "Page.format"),
)


@cache
def tool_rows() -> tuple[Row, ...]:
    """Those of tools, in their order."""
    return tuple(row for tool in tools() if tool.options for row in tool.load(tool.options))


def rows() -> tuple[Row, ...]:
    """The table, with the rows of tools at its end."""
    return (*ROWS, *tool_rows())


def arguments() -> dict[str, Option]:
    """By name, what `bihdist.figure` takes besides a mesh, what is shown of it, and from where."""
    return {option.name: option for row in (*rows(), MAPS) for option in row.options} | {PERTURB.name: PERTURB}


def with_rows(recipe: Recipe, values: Mapping[str, Any], those: Iterable[Row]) -> Recipe:
    """The recipe with the values that some rows know, by name."""
    for row in those:
        own = {option.name: values[option.name] for option in row.options if option.name in values}
        recipe = row.put(recipe, own) if own else recipe
    return recipe


def with_options(
    recipe: Recipe,
    values: Mapping[str, Any],
    beside: Callable[[Document], Document] = lambda document: document,
    tell: Callable[[str], None] = lambda sentence: None,
    progress: Progress | None = None,
) -> Recipe:
    """The recipe with the values of any options, by name; ParameterError where they make no sense.

    beside: the document with a second mesh, if there is to be one.  tell: gets a sentence on colour bars that end as in
    a file.  progress: of fields that this takes.
    """
    document, change = split(recipe.document)
    was = recipe.page.columns if change is not None else None
    recipe = with_rows(replace(recipe, document=document), values, rows())
    ends = values.get("range")
    is_ranged = bool({"range", "shared_range"} & {*values})
    # What replaces the panels has colour bars of its own.
    is_of_all = bool({"maps", "predict"} & {*values}) or (
        isinstance(ends, list | tuple) and len(ends) not in (1, len(document.panels))
    )
    if is_ranged and not is_of_all:
        recipe = _with_range(recipe, values, tell, progress)
    if "perturb" in values:
        change, was = change_from_words(values["perturb"]), None
    if change is not None:
        recipe = replace(recipe, document=with_changed(recipe.document, change))
        recipe = with_attribute(recipe, "page.columns", values.get("columns") or was or COLUMNS)
    recipe = with_rows(replace(recipe, document=beside(recipe.document)), values, [MAPS])
    return _with_range(recipe, values, tell, progress) if is_ranged and is_of_all else recipe
