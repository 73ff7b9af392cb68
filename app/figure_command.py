"""The commands `bihdist figure` and `bihdist movie`: their options, and the recipe they make."""

import argparse
from collections.abc import Callable

OVERRIDES = ("size", "style", "transparent", "crop")
"""What may be chosen anew when a recipe is drawn; the mesh too."""


def add_movie_options(movie: argparse.ArgumentParser) -> None:
    """What a movie has besides the options of a figure."""
    movie.add_argument(
        "--turn", type=float, metavar="DEGREES", help="how far the shape turns (default: 360, or 0 with --path)"
    )
    movie.add_argument("--path", type=_path, default=(), metavar="V,W,…", help="the source goes through these vertices")
    movie.add_argument("--frames", type=int, default=120, metavar="N", help="how many pictures (default: 120)")
    movie.add_argument("--fps", type=float, default=25.0, metavar="N", help="how many of them a second (default: 25)")


def chosen_movie(options: argparse.Namespace, panel: Callable[[argparse.Namespace, str], object]):
    """The movie the options make."""
    from .movie import Movie

    turn = options.turn if options.turn is not None else 0.0 if options.path else 360.0
    return Movie(chosen_recipe(options, panel), turn, options.path, options.frames, options.fps)


def add_figure_options(figure: argparse.ArgumentParser, files: str = "a .png, .pdf or .svg file") -> None:
    """All but the distances and areas, which other commands have too."""
    figure.add_argument("mesh", nargs="?", help="mesh file, or the name of a sample")
    figure.add_argument("-o", "--output", metavar="OUT", required=True, help=files)
    figure.add_argument(
        "--source", type=int, metavar="V", action="append", help="vertex id; repeat for a row of panels each"
    )
    figure.add_argument("--isolines", type=int, default=20, metavar="N", help="number of steps (default: 20)")
    figure.add_argument(
        "--view", metavar="NAME", action="append", help="home, front, back, left, right, top, bottom; repeat for more"
    )
    figure.add_argument("--two-views", action="store_true", help="front and back, side by side")
    figure.add_argument(
        "--camera", type=_camera, metavar="NUMBERS", help="position, focal point, up, extent: 11 numbers"
    )
    figure.add_argument(
        "--columns", type=int, metavar="N", help="panels side by side (default: all, or one row a source)"
    )
    figure.add_argument(
        "--zoom", type=_zoom, action="append", metavar="V[,FACTOR]", help="enlarge the place of a vertex"
    )
    figure.add_argument(
        "--anchors", type=_anchors, default=(), metavar="V[=VALUE],…", help="mark vertices, in the colour of a value"
    )
    figure.add_argument(
        "--height", type=float, nargs="?", const=0.35, default=0.0, metavar="SHARE", help="a flat mesh becomes a relief"
    )
    figure.add_argument("--shared-range", action="store_true", help="one colour bar for all panels")
    figure.add_argument("--no-hints", action="store_true", help="leave out what to look for, under the headings")
    figure.add_argument("--size", metavar="SIZE", help="such as 1680x640, 8000px, 160mm@300dpi, 160x80mm")
    figure.add_argument("--style", metavar="NAME", help="paper, uniform, lines or dark (default: paper)")
    figure.add_argument("--transparent", action="store_true", default=None, help="no background")
    figure.add_argument("--crop", action="store_true", default=None, help="without the empty margins")
    figure.add_argument("--recipe", metavar="NAME.json", help="draw what was drawn before; size and style may differ")
    figure.add_argument(
        "--mesh", dest="other_mesh", metavar="OTHER", help="with --recipe: the same of another mesh with these vertices"
    )


def chosen_recipe(options: argparse.Namespace, panel: Callable[[argparse.Namespace, str], object]):
    """The recipe the options make; `panel(options, text)` gives a distance's spec."""
    from bihdist_core import ParameterError

    if options.recipe is None:
        if options.other_mesh is not None:
            raise ParameterError("--mesh goes with --recipe; without one, the mesh is named by itself.")
        if options.mesh is None:
            raise ParameterError("There is nothing to draw; name a mesh, or a recipe with --recipe.")
        return _new_recipe(options, panel)
    from dataclasses import replace

    from .recipe import read_recipe

    if options.mesh is not None:
        raise ParameterError(f"With --recipe, another mesh is named as --mesh {options.mesh}.")
    recipe = read_recipe(options.recipe)
    if options.other_mesh is not None:
        recipe = replace(recipe, mesh=options.other_mesh, sha256="")
    chosen = {name: getattr(options, name) for name in OVERRIDES if getattr(options, name) is not None}
    return replace(recipe, **chosen)


def _new_recipe(options: argparse.Namespace, panel: Callable):
    from .recipe import Recipe, RecipePanel, RecipeZoom
    from .state import COMPARISON

    words = options.distance or [spec.word for spec in COMPARISON]
    sources = options.source or [None]
    views = options.view or []
    if options.two_views:
        views = [*views, "front", "back"]
    if options.camera:
        views = [*views, options.camera]
    return Recipe(
        mesh=options.mesh,
        panels=tuple(RecipePanel(panel(options, word), source) for source in sources for word in words),
        areas=options.areas,
        isolines=options.isolines,
        shared_range=options.shared_range,
        views=tuple(views) or ("home",),
        zooms=tuple(RecipeZoom(*zoom) for zoom in options.zoom or ()),
        anchors=tuple(options.anchors),
        height=options.height,
        hints=not options.no_hints,
        columns=options.columns or (len(words) if len(sources) > 1 else None),
        size=options.size or "",
        style=options.style or "paper",
        transparent=bool(options.transparent),
        crop=bool(options.crop),
    )


def _camera(text: str):
    from .recipe import RecipeCamera

    numbers = _numbers(text, 11)
    return RecipeCamera(*(tuple(numbers[a:b]) for a, b in ((0, 3), (3, 6), (6, 9), (9, 11))))


def _zoom(text: str) -> tuple[int, float]:
    vertex, _, factor = text.partition(",")
    try:
        return int(vertex), float(factor) if factor else 3.0
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a vertex id, or an id and a factor such as 12,3") from None


def _path(text: str) -> tuple[int, ...]:
    try:
        return tuple(int(word) for word in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not vertex ids with commas between them") from None


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
