"""What a figure looks like, in words (`said`): isolines, ends of colour bars, colours, shading."""

from typing import Any

from .anchors import Anchors
from .command_fragments import NOTHING, USUAL, CommandFragment, NotExpressible, as_switch, digits, vertex_of, with_value
from .document import Document
from .page import Recipe


def say_isolines(recipe: Recipe) -> CommandFragment:
    isolines = recipe.document.isolines
    options: list[tuple[str, str | None]] = []
    arguments: dict[str, Any] = {}
    if isolines.spacing is not None:
        options.append(("--isoline-spacing", digits(isolines.spacing)))
        arguments["isoline_spacing"] = isolines.spacing
    elif isolines.values:
        options.append(("--isoline-values", ",".join(map(digits, isolines.values))))
        arguments["isoline_values"] = list(isolines.values)
    elif isolines.count != USUAL.isolines.count:
        options.append(("--isolines", digits(isolines.count)))
        arguments["isolines"] = isolines.count
    if not isolines.round:
        options.append(("--equal-isolines", None))
        arguments["equal_isolines"] = True
    vertices = [vertex_of(recipe.document.point(name)) for name in isolines.through]
    if None in vertices or not _has_own_points(recipe.document):
        raise NotExpressible("An isoline passes through a point that is more than that.")
    if vertices:
        options += [("--isoline-through", str(vertex)) for vertex in vertices]
        arguments["isoline_through"] = vertices
    if isolines.bold:
        options.append(("--bold-isolines", str(isolines.bold)))
        arguments["bold_isolines"] = isolines.bold
    if isolines.labels:
        options.append(("--isoline-labels", None))
        arguments["isoline_labels"] = True
    return CommandFragment(tuple(options), arguments)


def _has_own_points(document: Document) -> bool:
    """Whether the points that isolines pass through are nothing else, and on the first surface."""
    used = {name for panel in document.panels for name in panel.shows.points}
    used |= {anchor.point for anchor in document[Anchors].anchors}
    first = document.surfaces[0].name
    return all(name not in used and document.point(name).surface == first for name in document.isolines.through)


def say_range(recipe: Recipe) -> CommandFragment:
    """A word, or where each colour bar ends."""
    word, ends = recipe.document.range, [panel.maximum for panel in recipe.document.panels]
    if any(end is not None for end in ends):
        if word != "own":
            raise NotExpressible("A colour bar ends where somebody typed, and they all have one range.")
        if len(ends) == 1:
            return with_value("--range", "range", float(ends[0] or 0))
        return CommandFragment(
            (("--range", ",".join("own" if end is None else digits(end) for end in ends)),), {"range": ends}
        )
    return NOTHING if word == USUAL.range else with_value("--range", "range", word)


def say_colours(recipe: Recipe) -> CommandFragment:
    colours = recipe.document.colours
    if colours.stops:
        raise NotExpressible("The colours came from a file.")
    said = [with_value("--colours", "colours", colours.map)] if colours.map else []
    said += [as_switch(f"--{name}", name) for name in ("reversed", "bands") if getattr(colours, name)]
    arguments = {name: value for each in said for name, value in each.arguments.items()}
    return CommandFragment(tuple(option for each in said for option in each.options), arguments)


def say_shading(recipe: Recipe) -> CommandFragment:
    """An angle alone would make it creased."""
    shading, usual = recipe.document.shading, USUAL.shading
    options: list[tuple[str, str | None]] = []
    arguments: dict[str, Any] = {}
    if (shading.normals, shading.crease) != (usual.normals, usual.crease):
        options.append(("--shading", shading.normals))
        arguments["shading"] = shading.normals
    if shading.crease != usual.crease:
        options.append(("--crease", digits(shading.crease)))
        arguments["crease"] = shading.crease
    if shading.wireframe:
        options.append(("--wireframe", None))
        arguments["wireframe"] = True
    return CommandFragment(tuple(options), arguments)
