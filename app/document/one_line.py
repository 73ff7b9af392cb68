"""The one line, for a shell or for Python, that makes the figure of a recipe: only what is not as usual is named.

It is the inverse of the options of `bihdist figure` and of the arguments of `bihdist.figure`.  ROWS says which part of
a document or a page is said by which option and which argument; what is added to either needs a row.
"""

import os
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from bihdist_core.applications.changes import words_of_change
from bihdist_core.sources.source import Curve
from bihdist_core.sources.words import NONE

from ..samples import mesh_path
from .camera import Camera
from .command_fragments import (
    NOTHING,
    CommandFragment,
    NotExpressible,
    digits,
    of_document,
    of_page,
    with_value,
)
from .document import COMPARISON
from .look_fragments import say_colours, say_isolines, say_range, say_shading
from .mark_fragments import say_anchors, say_pins, say_profile, say_regions, say_selections, say_weights, say_zooms
from .page import Recipe
from .perturbation import COLUMNS, split
from .quantities import Quantity, from_point, own_fields
from .starts import Starts, as_argument


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
    except NotExpressible as reason:
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


def _all_said(recipe: Recipe) -> Iterable[CommandFragment]:
    document, change = split(recipe.document)
    if change is None:
        return (row.say(recipe) for row in ROWS)
    names = {name for panel in document.panels for name in panel.shows.points}
    columns = recipe.page.columns
    if columns in (None, COLUMNS):
        columns = len(document.panels) // len(names) if len(names) > 1 else None
    pose = mesh_word(change.pose) if change.pose else ""
    said = with_value("--perturb", "perturb", words_of_change(replace(change, pose=pose)))
    base = replace(recipe, document=document, page=replace(recipe.page, columns=columns))
    return (said, *(row.say(base) for row in ROWS))


# ---------------------------------------------------------------------- what is shown of what
def _mesh(recipe: Recipe) -> CommandFragment:
    if len(recipe.document.surfaces) != 1:
        raise NotExpressible(f"{len(recipe.document.surfaces)} meshes do not go into one line.")
    if not recipe.document.surfaces[0].path:
        raise NotExpressible("The mesh was given from Python as arrays, which no line can hold.")
    if recipe.document.fields or any(own_fields(panel.shows) for panel in recipe.document.panels):
        raise NotExpressible("Fields of one's own were given from Python as arrays, which no line can hold.")
    return NOTHING


def _panels(recipe: Recipe) -> CommandFragment:
    """Quantities, and the sources from which each of them is shown, if that is how the panels stand."""
    document = recipe.document
    if not document.panels:
        raise NotExpressible("There are no panels.")
    names = list(dict.fromkeys(name for panel in document.panels for name in panel.shows.points))
    shows: list[Quantity] = [
        from_point(p.shows, "source") for p in document.panels if set(p.shows.points) == set(names[:1])
    ]
    # What starts nowhere, such as interpolants, is named once.
    repeated = [from_point(each, name) for name in names or ["source"] for each in shows]
    if [panel.shows for panel in document.panels] != repeated:
        raise NotExpressible("The panels start from different points, and not each distance from each.")
    places = [document.point(name).at for name in names]
    if None in places and len(places) > 1:
        raise NotExpressible("One of several sources is where nobody has put it.")
    starts = [Starts(at) for at in places if at is not None]
    words = [str(each) for each in shows]
    is_usual = words == [str(spec) for spec in COMPARISON]
    options: list[tuple[str, str | Starts | None]] = []
    options += [] if is_usual else [("--distance", word) for word in words]
    options += [("--source", start) for start in starts]
    arguments: dict[str, Any] = {} if is_usual else {"distances": words}
    if starts:
        arguments["source"] = starts if len(starts) > 1 else starts[0]
    return CommandFragment(tuple(options), arguments)


def _columns(recipe: Recipe) -> CommandFragment:
    """Without a word, one row a source."""
    names = {name for panel in recipe.document.panels for name in panel.shows.points}
    usual = len(recipe.document.panels) // len(names) if len(names) > 1 else None
    if recipe.page.columns is None and usual is not None:
        raise NotExpressible("The panels of several sources are in one row.")
    if recipe.page.columns == usual:
        return NOTHING
    return with_value("--columns", "columns", recipe.page.columns)


def _views(recipe: Recipe) -> CommandFragment:
    views = recipe.views
    cameras = [view for view in views if isinstance(view, Camera)]
    if len(cameras) > 1 or (cameras and views[-1] is not cameras[0]):
        raise NotExpressible("There are several cameras.")
    names = [view for view in views if isinstance(view, str)]
    if names == ["auto"] and not cameras:
        return NOTHING
    options: list[tuple[str, str | None]] = [("--view", name) for name in names]
    arguments: dict[str, Any] = {"views": names[0] if len(views) == 1 else names} if names else {}
    for camera in cameras:
        numbers = (*camera.position, *camera.focal_point, *camera.up, *camera.extent)
        options.append(("--camera", ",".join(map(digits, numbers))))
        arguments["camera"] = tuple(map(float, numbers))
    return CommandFragment(tuple(options), arguments)


# ---------------------------------------------------------------------- all of it
@dataclass(frozen=True)
class Row:
    """Parts, such as "Document.areas", and what says them."""

    parts: tuple[str, ...]
    say: Callable[[Recipe], CommandFragment]


ROWS = (
    Row(("Document.surfaces", "Document.fields"), _mesh),
    Row(("Document.points", "Document.panels", "Panel.shows"), _panels),
    Row(("Document.areas",), of_document("areas", "--areas", "areas")),
    Row(("Document.camera", "Page.views"), _views),
    Row(("Document.zooms", "Zoom.vertex", "Zoom.factor", "Zoom.corner", "Zoom.isolines"), say_zooms),
    Row(("Anchors.anchors", "Anchor.point", "Anchor.value", "Anchor.left_out"), say_anchors),
    Row(("Anchors.weights",), say_weights),
    Row(
        (
            "Document.isolines",
            "Isolines.count",
            "Isolines.spacing",
            "Isolines.values",
            "Isolines.bold",
            "Isolines.labels",
            "Isolines.through",
            "Isolines.round",
        ),
        say_isolines,
    ),
    Row(("Document.range", "Panel.maximum"), say_range),
    Row(
        ("Document.colours", "Colours.map", "Colours.stops", "Colours.reversed", "Colours.bands"),
        say_colours,
    ),
    Row(
        ("Document.shading", "Shading.normals", "Shading.crease", "Shading.wireframe"),
        say_shading,
    ),
    Row(("Document.up",), of_document("up", "--up", "up")),
    Row(("Document.projection",), of_document("projection", "--projection", "projection")),
    Row(("Document.axes",), of_document("axes", "--axes", "axes")),
    Row(("Document.height",), of_document("height", "--height", "height")),
    Row(("Pins.pins", "Pin.point", "Pin.colour"), say_pins),
    Row(("Document.extrema",), of_document("extrema", "--extrema", "extrema")),
    Row(("DividedPanels.regions",), say_regions),
    Row(("Selections.selections",), say_selections),
    Row(("Document.docks", "Profile.points", "Profile.way", "Profile.across"), say_profile),
    Row(("Page.columns",), _columns),
    Row(("Page.hints",), of_page("hints", "--hints", "hints")),
    Row(("Page.size",), of_page("size", "--size", "size")),
    Row(("Page.style",), of_page("style", "--style", "style")),
    Row(("Page.title",), of_page("title", "--title", "title")),
    Row(("Page.font",), of_page("font", "--font", "font")),
    Row(("Page.text",), of_page("text", "--text", "text")),
    Row(("Page.anchor_values",), of_page("anchor_values", "--anchor-values", "anchor_values")),
    Row(("Page.transparent",), of_page("transparent", "--transparent", "transparent")),
    Row(("Page.crop",), of_page("crop", "--crop", "crop")),
)

UNSEEN = {
    "Document.tool": "what a click does in the window",
    "Document.next_id": "for panels that are still to come",
    "Document.dock_places": "where instruments stand in the window",
    "Document.snap": "what the pointer does in the window",
    "Pins.pin_list": "for the window's list",
    "Scatter.across": "for the window's chart",
    "Scatter.up": "for the window's chart",
    "Scatter.shares": "for the window's chart",
    "Document.parts": "each is said by itself",
    "Profile.shares": "for the window's chart",
    "Pin.name": "figures show numbers",
    "Anchor.name": "figures show colours",
    "Panel.id": "for the window and the history",
    "Panel.surface": "with one mesh all panels are of it",
    "Document.beside": "with one mesh there is none beside it",
    "Document.linked": "what the cameras of the window do",
    "Pairs.pairs": "with one mesh there are none",
    "Maps.maps": "with one mesh there are none",
    "Maps.truth": "what maps are measured by, which no picture shows",
    "Page.format": "the file's name says it",
}
"""Parts that no line names, since no figure shows them, and what they are for."""
