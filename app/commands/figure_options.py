"""The options that `bihdist figure` and `bihdist movie` share, and the recipe they make.

A new figure is the usual recipe with the options applied to it, and a recipe that is named is changed by them in the
same way: no option is ignored.
"""

import argparse
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING, Any

from ..document.anchors import Anchors
from ..document.looks import PROJECTIONS
from ..document.pins import Pins
from ..document.profile import Profile
from .colour_options import add_colours, add_range, tell_if_unseen, with_colours, with_range
from .isoline_options import add_isolines, with_isolines
from .map_options import add_maps, with_maps
from .options import (
    PANELS,
    SOURCE,
    add_areas,
    add_distance,
    add_pins,
    add_profile,
    add_selections,
    add_up,
    check_parameters,
    given_parameters,
    panel_numbers,
    quantities,
    source,
    with_path,
    with_pins,
    with_selections,
)
from .terminal import tell

if TYPE_CHECKING:
    from ..document.document import Document
    from ..document.page import Recipe
    from ..document.quantities import Quantity


def add_figure_options(parser: argparse.ArgumentParser, files: str) -> None:
    """All but what only one of the two has.  None stands for what is not given."""
    parser.add_argument("mesh", nargs="?", help="mesh file, or the name of a sample")
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help=files)
    parser.add_argument("--recipe", metavar="NAME.json", help="draw this again; all other options change it")
    parser.add_argument(
        "--mesh", dest="other_mesh", metavar="OTHER", help="with --recipe: the same of another mesh with these vertices"
    )
    parser.add_argument(
        "--source", type=source, metavar="V", action="append", help=f"{SOURCE}; repeat for a row of panels each"
    )
    parser.add_argument(
        "--perturb",
        metavar="WORDS",
        help="each distance before and after a change to the mesh, and the difference: pose=FILE, cut=FACES, "
        "simplify=N, noise=S, along=normals, holes=N, radius=R, weld=I:J, handle=I:J, seed=K, with commas between them",
    )
    add_maps(parser)
    add_isolines(parser)
    parser.add_argument(
        "--view",
        metavar="NAME",
        action="append",
        help="home and high, each also with -right, -back or -left, front, back, left, right, top, bottom, source, or "
        "auto, the one of the first eight that shows most of the shape (default); repeat",
    )
    parser.add_argument("--two-views", action="store_true", help="front and back, side by side")
    parser.add_argument(
        "--camera", type=_camera, metavar="NUMBERS", help="position, focal point, up, extent: 11 numbers"
    )
    add_up(parser)
    parser.add_argument("--projection", choices=PROJECTIONS, help="default: perspective")
    _add_switch(parser, "axes", "where x, y and z point to, in a corner (default: no)")
    parser.add_argument(
        "--columns", type=int, metavar="N", help="panels side by side (default: all, or one row a source)"
    )
    parser.add_argument(
        "--zoom",
        type=_zoom,
        action="append",
        metavar="V[,FACTOR[,N]]",
        help="enlarge the place of a vertex, perhaps with N isolines",
    )
    parser.add_argument("--anchors", type=_anchors, metavar="V[=VALUE],…", help="mark vertices, coloured by a value")
    _add_switch(parser, "anchor-values", "numbers beside the anchors that have a value (default: no)")
    parser.add_argument("--exponent", type=float, metavar="P", help="of anchors' weights in interpolants (default: 1)")
    parser.add_argument(
        "--smoothness", type=float, metavar="S", help="how far anchors' cones are rounded in interpolants, 0 to 1 (0)"
    )
    add_pins(parser)
    _add_switch(parser, "extrema", "triangles at maxima and at minima away from the source (default: no)")
    parser.add_argument(
        "--regions",
        type=panel_numbers,
        metavar="all|N,…",
        help="lines around what is nearest to each pin, on all panels or on some, from 1",
    )
    add_selections(parser)
    add_profile(parser)
    parser.add_argument(
        "--height",
        type=float,
        nargs="?",
        const=0.35,
        metavar="FRACTION",
        help="a flat mesh becomes a height field, its highest point at this fraction of its extent",
    )
    add_colours(parser)
    add_range(parser)
    _add_switch(parser, "hints", "what to look for, under the headings (default: no)")
    parser.add_argument("--title", metavar="WHERE", help="names as heading, as caption at the bars, or none")
    parser.add_argument("--font", metavar="FAMILY", help="of all words (default: DejaVu Sans)")
    parser.add_argument("--text", type=float, metavar="POINTS", help="size of labels; other words in proportion")
    parser.add_argument(
        "--size",
        metavar="SIZE",
        help="such as 85mm, 1680x640, 160mm@300dpi, 160x80mm; or column (85 mm), double (178 mm), slide, A0",
    )
    parser.add_argument("--style", metavar="NAME", help="paper, uniform, lines or dark (default: paper)")
    _add_switch(parser, "transparent", "no background")
    _add_switch(parser, "crop", "without the empty margins")
    parser.add_argument(
        "--shading", metavar="NAME", help="auto, smooth, creased or flat (default: creased where there are sharp edges)"
    )
    parser.add_argument("--crease", type=float, metavar="DEGREES", help="where faces meet at more is an edge (40)")
    _add_switch(parser, "wireframe", "the edges of the mesh")
    add_distance(parser, PANELS)
    add_areas(parser)


def _add_switch(parser: argparse.ArgumentParser, name: str, words: str) -> None:
    parser.add_argument(f"--{name}", action=argparse.BooleanOptionalAction, default=None, help=words)


def chosen_recipe(options: argparse.Namespace) -> "Recipe":
    """The recipe the options make; ParameterError for one that makes no sense here."""
    from bihdist_core import ParameterError

    if options.recipe is None:
        if options.other_mesh is not None:
            raise ParameterError("--mesh goes with --recipe; without one, the mesh is named by itself.")
        if options.mesh is None:
            raise ParameterError("There is nothing to draw; name a mesh, or a recipe with --recipe.")
        from ..document.document import comparison
        from ..document.page import Recipe
        from .mesh import check_mesh

        check_mesh(options.mesh)
        return _changed(Recipe(comparison(options.mesh)), options)
    if options.mesh is not None:
        raise ParameterError(f"With --recipe, another mesh is named as --mesh {options.mesh}.")
    from ..document.file import read_recipe

    return _changed(read_recipe(options.recipe), options)


def _changed(recipe: "Recipe", options: argparse.Namespace) -> "Recipe":
    from bihdist_core.applications.changes import change_from_words

    from ..document.camera import Camera
    from ..document.looks import shaded
    from ..document.perturbation import COLUMNS, split, with_changed

    document, change = split(recipe.document)
    page = recipe.page
    if options.perturb is not None:
        change = change_from_words(options.perturb)
    if options.other_mesh is not None:
        document = _with_other_mesh(document, options.other_mesh)
    document, rows = _with_panels(document, options)
    if options.anchors is not None:
        document = _with_anchors(document, options.anchors)
    weights = replace(document[Anchors].weights, **_given(options, "exponent", "smoothness"))
    document = with_pins(document.with_part(replace(document[Anchors], weights=weights)), options)
    document = with_path(document, options)
    if options.regions is not None:
        from ..document.regions import divide

        document = divide(document, options.regions)
    document = with_selections(document, options)
    views = [*(options.view or ()), *(("front", "back") if options.two_views else ())]
    if options.camera is not None:
        views.append(Camera(*options.camera))
    if options.zoom is not None:
        from ..document.document import Zoom

        zooms = tuple(Zoom(vertex, factor, isolines=steps) for vertex, factor, steps in options.zoom)
        document = replace(document, zooms=zooms)
    if options.up is not None and not views:
        from ..document.edits import stand

        # A camera that comes with a recipe would be askew.
        document = stand(document, options.up)
    document = replace(document, **_given(options, "areas", "height", "up", "projection", "axes", "extrema"))
    document = with_isolines(document, options)
    shading = shaded(document.shading, options.shading, options.crease, options.wireframe)
    document = replace(document, shading=shading)
    document = with_range(with_colours(document, options), options, tell)
    of_page = ("size", "style", "hints", "transparent", "crop", "title", "font", "text", "anchor_values")
    page = replace(page, **_given(options, *of_page))
    tell_if_unseen(page.style, options, tell)
    columns = options.columns if options.columns is not None else rows or page.columns
    if change is not None:
        document = with_changed(document, change)
        was = page.columns if options.perturb is None else None
        columns = options.columns or was or COLUMNS
    document = with_maps(document, options)
    if views:
        document = replace(document, camera=views[0])
        page = replace(page, views=tuple(views) if len(views) > 1 else ())
    return replace(recipe, document=document, page=replace(page, columns=columns))


def _given(options: argparse.Namespace, *names: str) -> dict[str, Any]:
    return {name: getattr(options, name) for name in names if getattr(options, name) is not None}


def _with_other_mesh(document: "Document", path: str) -> "Document":
    """The same points of another mesh, which may be any file."""
    from bihdist_core import ParameterError

    from .mesh import check_mesh

    if len(document.surfaces) != 1:
        raise ParameterError(f"--mesh replaces one mesh, and this recipe has {len(document.surfaces)}.")
    check_mesh(path)
    return replace(document, surfaces=(replace(document.surfaces[0], path=path, sha256=""),))


def _with_panels(document: "Document", options: argparse.Namespace) -> "tuple[Document, int | None]":
    """Other distances, parameters or sources; and how many panels a row then has, if they stand in rows."""
    from bihdist_core import ParameterError

    from ..document.document import Panel, Point, free_names
    from ..document.edits import put_point, show_in
    from ..document.quantities import from_point

    if options.distance or (options.source and len(options.source) != len(document.sources)):
        words = options.distance
        shows = tuple(quantities(options, words, [field.name for field in document.fields])) if words else ()
        shows = shows or tuple(
            dict.fromkeys(from_point(_respecified(panel.shows, options), "") for panel in document.panels)
        )
        if len(document.surfaces) != 1:
            what = "--distance" if words else f"{len(options.source)} times --source"
            raise ParameterError(f"{what} makes the panels of one mesh, and this recipe has {len(document.surfaces)}.")
        surface, sources = document.surfaces[0].name, tuple(options.source or document.sources)
        used = {*(anchor.point for anchor in document[Anchors].anchors), *document.isolines.through}
        used |= {*(pin.point for pin in document[Pins].pins), *document[Profile].points}
        kept = [point for point in document.points if point.name in used]
        names = free_names("source", len(sources), [point.name for point in kept])
        points = [Point(name, at, surface) for name, at in zip(names, sources, strict=True)]
        panels = [Panel(k, from_point(each, name), surface) for k, (name, each) in enumerate(product(names, shows))]
        document = replace(document, points=(*points, *kept), panels=tuple(panels), next_id=len(panels))
        check_parameters(options, [spec for panel in document.panels for spec in panel.shows.specs])
        return document, len(shows) if len(sources) > 1 else None
    for panel in document.panels:
        document = show_in(document, panel.id, _respecified(panel.shows, options))
    check_parameters(options, [spec for panel in document.panels for spec in panel.shows.specs])
    if options.source:
        moved = dict(zip(document.sources, options.source, strict=True))
        names = dict.fromkeys(name for panel in document.panels for name in panel.shows.points)
        for name, point in [(name, document.point(name)) for name in names]:
            document = put_point(document, name, moved[point.at], point.surface)
    return document, None


def _respecified(shows: "Quantity", options: argparse.Namespace) -> "Quantity":
    """The quantity with those parameters that the options name and its distances have."""
    from bihdist_core.distances.kinds import Spec

    given = given_parameters(options)

    def respecified(spec: Spec) -> Spec:
        return spec.changed(**{p.name: given[p.name] for p in spec.kind.parameters if p.name in given})

    return shows.with_parts(tuple(p.with_spec(respecified(p.specs[0])) if p.is_distance else p for p in shows.parts))


def _with_anchors(document: "Document", anchors: tuple[tuple[int, float | None], ...]) -> "Document":
    from bihdist_core import ParameterError

    from ..document.anchors import Anchor
    from ..document.document import Point, free_names

    if len(document.surfaces) != 1:
        raise ParameterError(f"--anchors are on one mesh, and this recipe has {len(document.surfaces)}.")
    shown = {name for panel in document.panels for name in panel.shows.points} | set(document.isolines.through)
    shown |= {*(pin.point for pin in document[Pins].pins), *document[Profile].points}
    gone = {anchor.point for anchor in document[Anchors].anchors} - shown
    kept = [point for point in document.points if point.name not in gone]
    names = free_names("anchor", len(anchors), [point.name for point in kept])
    surface = document.surfaces[0].name
    new = [Point(name, vertex, surface) for name, (vertex, _) in zip(names, anchors, strict=True)]
    values = tuple(Anchor(point.name, value) for point, (_, value) in zip(new, anchors, strict=True))
    return document.with_part(replace(document[Anchors], anchors=values), points=(*kept, *new))


def _camera(text: str) -> tuple[tuple[float, ...], ...]:
    numbers = _numbers(text, 11)
    return tuple(tuple(numbers[a:b]) for a, b in ((0, 3), (3, 6), (6, 9), (9, 11)))


def _zoom(text: str) -> tuple[int, float, int | None]:
    words = text.split(",")
    try:
        vertex, factor, steps, *others = *words, *[""] * (3 - len(words))
        if others:
            raise ValueError
        return int(vertex), float(factor or 3), int(steps) if steps else None
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a vertex id, or an id and a factor such as 12,3, or these and a number of steps: 12,3,60"
        ) from None


def _anchors(text: str) -> tuple[tuple[int, float | None], ...]:
    found = []
    for word in text.split(","):
        vertex, _, value = word.partition("=")
        try:
            found.append((int(vertex), float(value) if value else None))
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"{word!r} is not a vertex id, or one with a value such as 12=0.5"
            ) from None
    return tuple(found)


def _numbers(text: str, count: int) -> list[float]:
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        raise argparse.ArgumentTypeError(f"{text!r} is not {count} numbers with commas between them")
    return numbers
