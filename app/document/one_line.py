"""The one line, for a shell or for Python, that makes the figure of a recipe: only what is not as usual is named.

It is the inverse of the options of `bihdist figure` and of the arguments of `bihdist.figure`.  ROWS says which part of
a document or a page is said by which option and which argument; what is added to either needs a row.
"""

import os
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Curve, Place
from bihdist_core.sources.words import NONE, words_of

from ..samples import mesh_path
from .camera import Camera
from .document import COMPARISON, Document, Point
from .edits import divided_panels
from .instruments import PIN_COLOURS, SECTIONS
from .measuring import runs_in_words
from .page import Page, Recipe
from .profile_words import profile_words, shows_path
from .quantities import Quantity, from_point, own_fields
from .starts import Starts, as_argument

USUAL, USUAL_PAGE = Document(), Page()

MOST_LETTERS = 1000
"""Of selected vertices in a line that somebody is to read."""


class _Unsaid(ParameterError):
    """Why a line cannot say it."""


@dataclass(frozen=True)
class Said:
    """A part in words: options with their values (None for a switch), and arguments by name.

    Where a field starts is put into words at the end, since a curve has to have a file.
    """

    options: tuple[tuple[str, "str | Starts | None"], ...] = ()
    arguments: dict[str, Any] = field(default_factory=dict)


NOTHING = Said()


# ---------------------------------------------------------------------- the lines
def command_line(recipe: Recipe, output: str, files: Mapping[Curve, str] = NONE) -> str:
    """For a shell: `bihdist figure ... -o OUTPUT`.

    files: where curves that fields start from are saved.  ParameterError for what `why_not` names, and for a curve that
    has no file.
    """
    words = ["bihdist", "figure", mesh_word(recipe.document.surfaces[0].path)]
    for said in _all_said(recipe):
        for option, told in said.options:
            value = told.words(files) if isinstance(told, Starts) else told
            words += [option] if value is None else [f"{option}={value}"] if value[:1] == "-" else [option, value]
    return _joined([*words, "-o", output])


def python_line(recipe: Recipe, output: str, files: Mapping[Curve, str] = NONE) -> str:
    """For Python: `import bihdist; bihdist.figure(...).save(OUTPUT)`; otherwise as `command_line`."""
    arguments = [repr(mesh_word(recipe.document.surfaces[0].path))]
    for said in _all_said(recipe):
        arguments += [f"{name}={as_argument(value, files)!r}" for name, value in said.arguments.items()]
    return f"import bihdist; bihdist.figure({', '.join(arguments)}).save({output!r})"


def recipe_command_line(path: str, output: str) -> str:
    """The same from a recipe's file, for what no line can say."""
    return _joined(["bihdist", "figure", "--recipe", path, "-o", output])


def recipe_python_line(path: str, output: str) -> str:
    return f"import bihdist; bihdist.figure_again({path!r}).save({output!r})"


def why_not(recipe: Recipe) -> str:
    """A sentence on what of a recipe no line can say; empty if all of it can be said."""
    try:
        for _ in _all_said(recipe):
            pass
    except _Unsaid as reason:
        return str(reason)
    return ""


def mesh_word(path: str) -> str:
    """How a line names a mesh wherever it is run: a sample by its name, a file by its whole path."""
    stem = os.path.splitext(os.path.basename(path))[0]
    sample = mesh_path(stem)
    if not os.path.exists(path) or (sample != stem and os.path.exists(sample) and os.path.samefile(path, sample)):
        return stem if os.path.exists(path) else path
    return os.path.abspath(path)


def _joined(words: list[str]) -> str:
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def _all_said(recipe: Recipe) -> Iterable[Said]:
    return (row.say(recipe) for row in ROWS)


# ---------------------------------------------------------------------- what is shown of what
def _mesh(recipe: Recipe) -> Said:
    if len(recipe.document.surfaces) != 1:
        raise _Unsaid(f"{len(recipe.document.surfaces)} meshes do not go into one line.")
    if not recipe.document.surfaces[0].path:
        raise _Unsaid("The mesh was given from Python as arrays, which no line can hold.")
    if recipe.document.fields or any(own_fields(panel.shows) for panel in recipe.document.panels):
        raise _Unsaid("Fields of one's own were given from Python as arrays, which no line can hold.")
    return NOTHING


def _panels(recipe: Recipe) -> Said:
    """Quantities, and the sources from which each of them is shown, if that is how the panels stand."""
    document = recipe.document
    if not document.panels:
        raise _Unsaid("There are no panels.")
    names = list(dict.fromkeys(name for panel in document.panels for name in panel.shows.points))
    shows: list[Quantity] = [
        from_point(p.shows, "source") for p in document.panels if set(p.shows.points) == {names[0]}
    ]
    if [panel.shows for panel in document.panels] != [from_point(each, name) for name in names for each in shows]:
        raise _Unsaid("The panels start from different points, and not each distance from each.")
    places = [document.point(name).at for name in names]
    if None in places and len(places) > 1:
        raise _Unsaid("One of several sources is where nobody has put it.")
    starts = [Starts(at) for at in places if at is not None]
    words = [str(each) for each in shows]
    is_usual = words == [str(spec) for spec in COMPARISON]
    options: list[tuple[str, str | Starts | None]] = []
    options += [] if is_usual else [("--distance", word) for word in words]
    options += [("--source", start) for start in starts]
    arguments: dict[str, Any] = {} if is_usual else {"distances": words}
    if starts:
        arguments["source"] = starts if len(starts) > 1 else starts[0]
    return Said(tuple(options), arguments)


def _vertex(point: Point) -> int | None:
    if point.at is not None and not isinstance(point.at, int):
        raise _Unsaid("An anchor is at no vertex.")
    return point.at


def _columns(recipe: Recipe) -> Said:
    """Without a word, one row a source."""
    names = {name for panel in recipe.document.panels for name in panel.shows.points}
    usual = len(recipe.document.panels) // len(names) if len(names) > 1 else None
    if recipe.page.columns is None and usual is not None:
        raise _Unsaid("The panels of several sources are in one row.")
    if recipe.page.columns == usual:
        return NOTHING
    return _option("--columns", "columns", recipe.page.columns)


def _views(recipe: Recipe) -> Said:
    views = recipe.views
    cameras = [view for view in views if isinstance(view, Camera)]
    if len(cameras) > 1 or (cameras and views[-1] is not cameras[0]):
        raise _Unsaid("There are several cameras.")
    names = [view for view in views if isinstance(view, str)]
    if names == ["home"] and not cameras:
        return NOTHING
    options: list[tuple[str, str | None]] = [("--view", name) for name in names]
    arguments: dict[str, Any] = {"views": names[0] if len(views) == 1 else names} if names else {}
    for camera in cameras:
        numbers = (*camera.position, *camera.focal_point, *camera.up, *camera.extent)
        options.append(("--camera", ",".join(map(_number, numbers))))
        arguments["camera"] = tuple(map(float, numbers))
    return Said(tuple(options), arguments)


def _zooms(recipe: Recipe) -> Said:
    zooms = recipe.document.zooms
    if not zooms:
        return NOTHING
    if any(zoom.corner != "auto" for zoom in zooms):
        raise _Unsaid("An inset has a corner of its own.")
    steps = [() if zoom.isolines is None else (zoom.isolines,) for zoom in zooms]
    options = tuple(
        ("--zoom", ",".join([f"{zoom.vertex}", _number(zoom.factor), *map(str, n)]))
        for zoom, n in zip(zooms, steps, strict=True)
    )
    return Said(options, {"zooms": [(zoom.vertex, zoom.factor, *n) for zoom, n in zip(zooms, steps, strict=True)]})


def _anchors(recipe: Recipe) -> Said:
    document = recipe.document
    marks = [(_vertex(document.point(anchor.point)), anchor.value) for anchor in document.anchors]
    if not marks:
        return NOTHING
    if len(dict(marks)) < len(marks) or None in dict(marks):
        raise _Unsaid("Two marks are at one vertex, or one is where nobody has put it.")
    words = ",".join(f"{vertex}" if value is None else f"{vertex}={_number(value)}" for vertex, value in marks)
    return Said((("--anchors", words),), {"anchors": dict(marks)})


def _pins(recipe: Recipe) -> Said:
    """In the colours that they get by themselves."""
    document = recipe.document
    places = [document.point(pin.point).at for pin in document.pins]
    if not places:
        return NOTHING
    if any(document.point(pin.point).surface != document.surfaces[0].name for pin in document.pins):
        raise _Unsaid("A pin is on another mesh.")
    if len(set(places)) < len(places):
        raise _Unsaid("Two pins are at one place.")
    if [pin.colour for pin in document.pins] != [k % PIN_COLOURS for k in range(len(places))]:
        raise _Unsaid("Pins have other colours than usual.")
    said = [at if isinstance(at, int) else words_of(at) for at in places if isinstance(at, int | Place)]
    if len(said) < len(places):
        raise _Unsaid("A pin is at more than a point.")
    return Said(tuple(("--pin", str(at)) for at in said), {"pins": said})


def _profile(recipe: Recipe) -> Said:
    """Of a path that is drawn: through which points, and how."""
    document, profile = recipe.document, recipe.document.profile
    if not shows_path(document):
        return NOTHING
    try:
        words = profile_words(document)
    except ParameterError as error:
        raise _Unsaid(str(error)) from error
    options = [("--profile", ",".join(map(str, words)) or None)]
    arguments: dict[str, Any] = {"profile": words or True}
    if profile.way != "auto":
        options.append(("--way", profile.way))
        arguments["way"] = profile.way
    if profile.way in SECTIONS:
        if profile.across is None:
            raise _Unsaid("The plane of the section turns with the view.")
        options.append(("--across", ",".join(map(_number, profile.across))))
        arguments["across"] = profile.across
    return Said(tuple(options), arguments)


def _regions(recipe: Recipe) -> Said:
    which = divided_panels(recipe.document)
    if not which:
        return NOTHING
    words = which if isinstance(which, str) else ",".join(map(str, which))
    return Said((("--regions", words),), {"regions": which})


def _selections(recipe: Recipe) -> Said:
    """In the colours that they get by themselves."""
    selections = recipe.document.selections
    if not selections:
        return NOTHING
    if any(each.surface != recipe.document.surfaces[0].name for each in selections):
        raise _Unsaid("Vertices of another mesh are selected.")
    if [each.colour for each in selections] != [k % PIN_COLOURS for k in range(len(selections))]:
        raise _Unsaid("Selections have other colours than usual.")
    words = [runs_in_words(each.runs) for each in selections]
    if sum(map(len, words)) > MOST_LETTERS:
        raise _Unsaid("More vertices are selected than a line can name.")
    return Said(tuple(("--select", each) for each in words), {"selections": words})


# ---------------------------------------------------------------------- how it looks
def _isolines(recipe: Recipe) -> Said:
    isolines = recipe.document.isolines
    options: list[tuple[str, str | None]] = []
    arguments: dict[str, Any] = {}
    if isolines.spacing is not None:
        options.append(("--isoline-spacing", _number(isolines.spacing)))
        arguments["isoline_spacing"] = isolines.spacing
    elif isolines.values:
        options.append(("--isoline-values", ",".join(map(_number, isolines.values))))
        arguments["isoline_values"] = list(isolines.values)
    elif isolines.count != USUAL.isolines.count:
        options.append(("--isolines", _number(isolines.count)))
        arguments["isolines"] = isolines.count
    vertices = [_vertex(recipe.document.point(name)) for name in isolines.through]
    if None in vertices or not _has_own_points(recipe.document):
        raise _Unsaid("An isoline passes through a point that is more than that.")
    if vertices:
        options += [("--isoline-through", str(vertex)) for vertex in vertices]
        arguments["isoline_through"] = vertices
    if isolines.bold:
        options.append(("--bold-isolines", str(isolines.bold)))
        arguments["bold_isolines"] = isolines.bold
    if isolines.labels:
        options.append(("--isoline-labels", None))
        arguments["isoline_labels"] = True
    return Said(tuple(options), arguments)


def _has_own_points(document: Document) -> bool:
    """Whether the points that isolines pass through are nothing else, and on the first surface."""
    used = {name for panel in document.panels for name in panel.shows.points}
    used |= {anchor.point for anchor in document.anchors}
    first = document.surfaces[0].name
    return all(name not in used and document.point(name).surface == first for name in document.isolines.through)


def _range(recipe: Recipe) -> Said:
    """A word, or where each colour bar ends."""
    word, ends = recipe.document.range, [panel.maximum for panel in recipe.document.panels]
    if any(end is not None for end in ends):
        if word != "own":
            raise _Unsaid("A colour bar ends where somebody typed, and they all have one range.")
        if len(ends) == 1:
            return _option("--range", "range", float(ends[0] or 0))
        return Said((("--range", ",".join("own" if end is None else _number(end) for end in ends)),), {"range": ends})
    return NOTHING if word == USUAL.range else _option("--range", "range", word)


def _colours(recipe: Recipe) -> Said:
    colours = recipe.document.colours
    if colours.stops:
        raise _Unsaid("The colours came from a file.")
    said = [_option("--colours", "colours", colours.map)] if colours.map else []
    said += [_switched(f"--{name}", name) for name in ("reversed", "bands") if getattr(colours, name)]
    arguments = {name: value for each in said for name, value in each.arguments.items()}
    return Said(tuple(option for each in said for option in each.options), arguments)


def _shading(recipe: Recipe) -> Said:
    """An angle alone would make it creased."""
    shading, usual = recipe.document.shading, USUAL.shading
    options: list[tuple[str, str | None]] = []
    arguments: dict[str, Any] = {}
    if (shading.normals, shading.crease) != (usual.normals, usual.crease):
        options.append(("--shading", shading.normals))
        arguments["shading"] = shading.normals
    if shading.crease != usual.crease:
        options.append(("--crease", _number(shading.crease)))
        arguments["crease"] = shading.crease
    if shading.wireframe:
        options.append(("--wireframe", None))
        arguments["wireframe"] = True
    return Said(tuple(options), arguments)


def _of_document(name: str, option: str, argument: str) -> Callable[[Recipe], Said]:
    """A field that is said by one option; a switch if it is a flag."""
    return lambda recipe: _if_unusual(getattr(recipe.document, name), getattr(USUAL, name), option, argument)


def _of_page(name: str, option: str, argument: str) -> Callable[[Recipe], Said]:
    return lambda recipe: _if_unusual(getattr(recipe.page, name), getattr(USUAL_PAGE, name), option, argument)


def _if_unusual(value: Any, usual: Any, option: str, argument: str) -> Said:
    if value == usual:
        return NOTHING
    return _switched(option, argument) if isinstance(value, bool) else _option(option, argument, value)


def _only_usual(get: Callable[[Recipe], Any], sentence: str) -> Callable[[Recipe], Said]:
    """What no option says yet."""
    usual = get(Recipe(USUAL, USUAL_PAGE))

    def say(recipe: Recipe) -> Said:
        if get(recipe) != usual:
            raise _Unsaid(sentence)
        return NOTHING

    return say


def _switched(option: str, argument: str) -> Said:
    return Said(((option, None),), {argument: True})


def _option(option: str, argument: str, value: Any) -> Said:
    return Said(((option, value if isinstance(value, str) else _number(value)),), {argument: value})


def _number(value: float) -> str:
    """The shortest digits that are the number again."""
    return repr(value if isinstance(value, int) else float(value))


@dataclass(frozen=True)
class Row:
    """Parts, such as "Document.areas", and what says them."""

    parts: tuple[str, ...]
    say: Callable[[Recipe], Said]


ROWS = (
    Row(("Document.surfaces", "Document.fields"), _mesh),
    Row(("Document.points", "Document.panels", "Panel.shows"), _panels),
    Row(("Document.areas",), _of_document("areas", "--areas", "areas")),
    Row(("Document.camera", "Page.views"), _views),
    Row(("Document.zooms", "Zoom.vertex", "Zoom.factor", "Zoom.corner", "Zoom.isolines"), _zooms),
    Row(("Document.anchors", "Anchor.point", "Anchor.value"), _anchors),
    Row(
        (
            "Document.isolines",
            "Isolines.count",
            "Isolines.spacing",
            "Isolines.values",
            "Isolines.bold",
            "Isolines.labels",
            "Isolines.through",
        ),
        _isolines,
    ),
    Row(("Document.range", "Panel.maximum"), _range),
    Row(
        ("Document.colours", "Colours.map", "Colours.stops", "Colours.reversed", "Colours.bands"),
        _colours,
    ),
    Row(
        ("Document.shading", "Shading.normals", "Shading.crease", "Shading.wireframe"),
        _shading,
    ),
    Row(("Document.up",), _of_document("up", "--up", "up")),
    Row(("Document.projection",), _of_document("projection", "--projection", "projection")),
    Row(("Document.axes",), _of_document("axes", "--axes", "axes")),
    Row(("Document.height",), _of_document("height", "--height", "height")),
    Row(("Document.pins", "Pin.point", "Pin.colour"), _pins),
    Row(("Document.extrema",), _of_document("extrema", "--extrema", "extrema")),
    Row(("Document.regions",), _regions),
    Row(("Document.selections",), _selections),
    Row(("Document.profile", "Document.docks", "Profile.points", "Profile.way", "Profile.across"), _profile),
    Row(("Page.columns",), _columns),
    Row(("Page.hints",), _of_page("hints", "--hints", "hints")),
    Row(("Page.size",), _of_page("size", "--size", "size")),
    Row(("Page.style",), _of_page("style", "--style", "style")),
    Row(("Page.title",), _of_page("title", "--title", "title")),
    Row(("Page.font",), _of_page("font", "--font", "font")),
    Row(("Page.text",), _of_page("text", "--text", "text")),
    Row(("Page.transparent",), _of_page("transparent", "--transparent", "transparent")),
    Row(("Page.crop",), _of_page("crop", "--crop", "crop")),
)

UNSEEN = {
    "Document.tool": "what a click does in the window",
    "Document.next_id": "for panels that are still to come",
    "Document.dock_places": "where instruments stand in the window",
    "Document.snap": "what the pointer does in the window",
    "Document.pin_list": "for the window's list",
    "Document.scatter": "for the window's chart",
    "Profile.shares": "for the window's chart",
    "Pin.name": "figures show numbers",
    "Panel.id": "for the window and the history",
    "Panel.surface": "with one mesh all panels are of it",
    "Page.format": "the file's name says it",
}
"""Parts that no line names, since no figure shows them, and what they are for."""
