"""The options that `bihdist figure` and `bihdist movie` share, and the recipe they make.

A new figure is the usual recipe with the options applied to it, and a recipe that is named is changed by them in the
same way: no option is ignored.
"""

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from .options import PANELS, add_areas, add_distance, check_parameters, given_parameters, spec

if TYPE_CHECKING:
    from ..document.document import Document
    from ..document.page import Recipe


def add_figure_options(parser: argparse.ArgumentParser, files: str) -> None:
    """All but what only one of the two has.  None stands for what is not given."""
    parser.add_argument("mesh", nargs="?", help="mesh file, or the name of a sample")
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help=files)
    parser.add_argument("--recipe", metavar="NAME.json", help="draw this again; all other options change it")
    parser.add_argument(
        "--mesh", dest="other_mesh", metavar="OTHER", help="with --recipe: the same of another mesh with these vertices"
    )
    parser.add_argument(
        "--source", type=int, metavar="V", action="append", help="vertex id; repeat for a row of panels each"
    )
    parser.add_argument("--isolines", type=int, metavar="N", help="number of steps (default: 20)")
    parser.add_argument(
        "--view", metavar="NAME", action="append", help="home, front, back, left, right, top, bottom; repeat for more"
    )
    parser.add_argument("--two-views", action="store_true", help="front and back, side by side")
    parser.add_argument(
        "--camera", type=_camera, metavar="NUMBERS", help="position, focal point, up, extent: 11 numbers"
    )
    parser.add_argument(
        "--columns", type=int, metavar="N", help="panels side by side (default: all, or one row a source)"
    )
    parser.add_argument(
        "--zoom", type=_zoom, action="append", metavar="V[,FACTOR]", help="enlarge the place of a vertex"
    )
    parser.add_argument("--anchors", type=_anchors, metavar="V[=VALUE],…", help="mark vertices, coloured by a value")
    parser.add_argument(
        "--height", type=float, nargs="?", const=0.35, metavar="SHARE", help="a flat mesh becomes a relief"
    )
    _add_switch(parser, "shared-range", "one colour bar for all panels")
    _add_switch(parser, "hints", "what to look for, under the headings (default: yes)")
    parser.add_argument("--size", metavar="SIZE", help="such as 1680x640, 8000px, 160mm@300dpi, 160x80mm")
    parser.add_argument("--style", metavar="NAME", help="paper, uniform, lines or dark (default: paper)")
    _add_switch(parser, "transparent", "no background")
    _add_switch(parser, "crop", "without the empty margins")
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

        return _changed(Recipe(comparison(options.mesh)), options)
    if options.mesh is not None:
        raise ParameterError(f"With --recipe, another mesh is named as --mesh {options.mesh}.")
    from ..document.file import read_recipe

    return _changed(read_recipe(options.recipe), options)


def _changed(recipe: "Recipe", options: argparse.Namespace) -> "Recipe":
    from ..document.camera import Camera

    document, page = recipe.document, recipe.page
    if options.other_mesh is not None:
        document = _with_other_mesh(document, options.other_mesh)
    document, rows = _with_panels(document, options)
    if options.anchors is not None:
        document = _with_anchors(document, options.anchors)
    views = [*(options.view or ()), *(("front", "back") if options.two_views else ())]
    if options.camera is not None:
        views.append(Camera(*options.camera))
    if options.zoom is not None:
        from ..document.document import Zoom

        document = replace(document, zooms=tuple(Zoom(*zoom) for zoom in options.zoom))
    document = replace(document, **_given(options, "areas", "isolines", "height", "shared_range"))
    page = replace(page, **_given(options, "size", "style", "hints", "transparent", "crop"))
    if views:
        document = replace(document, camera=views[0])
        page = replace(page, views=tuple(views) if len(views) > 1 else ())
    return replace(recipe, document=document, page=replace(page, columns=options.columns or rows or page.columns))


def _given(options: argparse.Namespace, *names: str) -> dict[str, Any]:
    return {name: getattr(options, name) for name in names if getattr(options, name) is not None}


def _with_other_mesh(document: "Document", path: str) -> "Document":
    """The same points of another mesh, which may be any file."""
    from bihdist_core import ParameterError

    if len(document.surfaces) != 1:
        raise ParameterError(f"--mesh replaces one mesh, and this recipe has {len(document.surfaces)}.")
    return replace(document, surfaces=(replace(document.surfaces[0], path=path, sha256=""),))


def _with_panels(document: "Document", options: argparse.Namespace) -> "tuple[Document, int | None]":
    """Other distances, parameters or sources; and how many panels a row then has, if they stand in rows."""
    from ..document.document import comparison
    from ..document.edits import put_point, show_in

    if options.distance or (options.source and len(options.source) != len(document.sources)):
        words = options.distance
        specs = tuple(spec(options, word) for word in words) if words else ()
        specs = specs or tuple(dict.fromkeys(_respecified(p.shows.spec, options) for p in document.panels))
        sources = tuple(options.source or document.sources)
        new = comparison(document.surfaces[0].path, specs, sources)
        kept = [point for point in document.points if point.name in {anchor.point for anchor in document.anchors}]
        document = replace(document, points=(*new.points, *kept), panels=new.panels, next_id=new.next_id)
        check_parameters(options, [panel.shows.spec for panel in document.panels])
        return document, len(specs) if len(sources) > 1 else None
    for panel in document.panels:
        shows = replace(panel.shows, spec=_respecified(panel.shows.spec, options))
        document = show_in(document, panel.id, shows)
    check_parameters(options, [panel.shows.spec for panel in document.panels])
    if options.source:
        moved = dict(zip(document.sources, options.source, strict=True))
        names = dict.fromkeys(name for panel in document.panels for name in panel.shows.points)
        for name, point in [(name, document.point(name)) for name in names]:
            document = put_point(document, name, moved[point.at], point.surface)
    return document, None


def _respecified(chosen: Any, options: argparse.Namespace) -> Any:
    """A spec with those parameters that the options name and it has."""
    own = {parameter.name for parameter in chosen.kind.parameters}
    return chosen.changed(**{name: v for name, v in given_parameters(options).items() if name in own})


def _with_anchors(document: "Document", anchors: tuple[tuple[int, float | None], ...]) -> "Document":
    from ..document.document import Anchor, Point

    gone = {anchor.point for anchor in document.anchors}
    kept = [point for point in document.points if point.name not in gone]
    new = [Point(f"anchor {k}", vertex) for k, (vertex, _) in enumerate(anchors, 1)]
    values = tuple(Anchor(point.name, value) for point, (_, value) in zip(new, anchors, strict=True))
    return replace(document, points=(*kept, *new), anchors=values)


def _camera(text: str) -> tuple[tuple[float, ...], ...]:
    numbers = _numbers(text, 11)
    return tuple(tuple(numbers[a:b]) for a, b in ((0, 3), (3, 6), (6, 9), (9, 11)))


def _zoom(text: str) -> tuple[int, float]:
    vertex, _, factor = text.partition(",")
    try:
        return int(vertex), float(factor) if factor else 3.0
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a vertex id, or an id and a factor such as 12,3") from None


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
