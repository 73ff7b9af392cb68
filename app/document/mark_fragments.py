"""What is marked on a surface, in words (`said`): insets, anchors, pins, a profile, regions, selections."""

from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import SurfacePoint
from bihdist_core.sources.words import words_of

from .anchors import Anchors
from .command_fragments import NOTHING, CommandFragment, NotExpressible, digits, if_unusual, vertex_of
from .labels import MARK_COLOURS
from .page import Recipe
from .pins import Pins
from .profile import SECTIONS, Profile, profile_words, shows_path
from .regions import divided_panels
from .selections import Selections, runs_in_words

MOST_LETTERS = 1000
"""Of selected vertices in a line that somebody is to read."""


def say_zooms(recipe: Recipe) -> CommandFragment:
    zooms = recipe.document.zooms
    if not zooms:
        return NOTHING
    if any(zoom.corner != "auto" for zoom in zooms):
        raise NotExpressible("An inset has a corner of its own.")
    steps = [() if zoom.isolines is None else (zoom.isolines,) for zoom in zooms]
    options = tuple(
        ("--zoom", ",".join([f"{zoom.vertex}", digits(zoom.factor), *map(str, n)]))
        for zoom, n in zip(zooms, steps, strict=True)
    )
    return CommandFragment(
        options, {"zooms": [(zoom.vertex, zoom.factor, *n) for zoom, n in zip(zooms, steps, strict=True)]}
    )


def say_anchors(recipe: Recipe) -> CommandFragment:
    document = recipe.document
    marks = [(vertex_of(document.point(anchor.point)), anchor.value) for anchor in document[Anchors].anchors]
    if not marks:
        return NOTHING
    if len(dict(marks)) < len(marks) or None in dict(marks):
        raise NotExpressible("Two marks are at one vertex, or one is where nobody has put it.")
    if any(anchor.left_out for anchor in document[Anchors].anchors):
        raise NotExpressible("An anchor is left out.")
    words = ",".join(f"{vertex}" if value is None else f"{vertex}={digits(value)}" for vertex, value in marks)
    return CommandFragment((("--anchors", words),), {"anchors": dict(marks)})


def say_weights(recipe: Recipe) -> CommandFragment:
    weights = recipe.document[Anchors].weights
    found = [
        if_unusual(weights.exponent, 1.0, "--exponent", "exponent"),
        if_unusual(weights.smoothness, 0.0, "--smoothness", "smoothness"),
    ]
    return CommandFragment(found[0].options + found[1].options, {**found[0].arguments, **found[1].arguments})


def say_pins(recipe: Recipe) -> CommandFragment:
    """In the colours that they get by themselves."""
    document = recipe.document
    places = [document.point(pin.point).at for pin in document[Pins].pins]
    if not places:
        return NOTHING
    if any(document.point(pin.point).surface != document.surfaces[0].name for pin in document[Pins].pins):
        raise NotExpressible("A pin is on another mesh.")
    if len(set(places)) < len(places):
        raise NotExpressible("Two pins are at one place.")
    if [pin.colour for pin in document[Pins].pins] != [k % MARK_COLOURS for k in range(len(places))]:
        raise NotExpressible("Pins have other colours than usual.")
    said = [at if isinstance(at, int) else words_of(at) for at in places if isinstance(at, int | SurfacePoint)]
    if len(said) < len(places):
        raise NotExpressible("A pin is at more than a point.")
    return CommandFragment(tuple(("--pin", str(at)) for at in said), {"pins": said})


def say_profile(recipe: Recipe) -> CommandFragment:
    """Of a path that is drawn: through which points, and how."""
    document, profile = recipe.document, recipe.document[Profile]
    if not shows_path(document):
        return NOTHING
    try:
        words = profile_words(document)
    except ParameterError as error:
        raise NotExpressible(str(error)) from error
    options = [("--profile", ",".join(map(str, words)) or None)]
    arguments: dict[str, Any] = {"profile": words or True}
    if profile.way != "auto":
        options.append(("--way", profile.way))
        arguments["way"] = profile.way
    if profile.way in SECTIONS:
        if profile.across is None:
            raise NotExpressible("The plane of the section turns with the view.")
        options.append(("--across", ",".join(map(digits, profile.across))))
        arguments["across"] = profile.across
    return CommandFragment(tuple(options), arguments)


def say_regions(recipe: Recipe) -> CommandFragment:
    which = divided_panels(recipe.document)
    if not which:
        return NOTHING
    words = which if isinstance(which, str) else ",".join(map(str, which))
    return CommandFragment((("--regions", words),), {"regions": which})


def say_selections(recipe: Recipe) -> CommandFragment:
    """In the colours that they get by themselves."""
    selections = recipe.document[Selections].selections
    if not selections:
        return NOTHING
    if any(each.surface != recipe.document.surfaces[0].name for each in selections):
        raise NotExpressible("Vertices of another mesh are selected.")
    if [each.colour for each in selections] != [k % MARK_COLOURS for k in range(len(selections))]:
        raise NotExpressible("Selections have other colours than usual.")
    words = [runs_in_words(each.runs) for each in selections]
    if sum(map(len, words)) > MOST_LETTERS:
        raise NotExpressible("More vertices are selected than a line can name.")
    return CommandFragment(tuple(("--select", each) for each in words), {"selections": words})
