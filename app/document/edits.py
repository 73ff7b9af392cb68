"""Edits of documents: pure functions, for what `dataclasses.replace` alone does not do."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from bihdist_core.distances.distance_types import Spec, distance_types
from bihdist_core.sources.source import Source

from .derived_surfaces import changed_mesh, without_changed
from .document import (
    Document,
    FieldArray,
    MeshFile,
    Panel,
    Point,
    free_field_name,
    free_names,
    usual_specs,
    with_new_point,
)
from .looks import Isolines
from .quantities import Difference, DistanceFrom, OwnField, Quantity, from_point, own_fields
from .removal import without_orphans, without_surfaces

KEPT_OF_CLOSED = (
    "areas",
    "colours",
    "shading",
    "base",
    "parallel_projection",
    "axes",
    "scale_bar",
    "unit",
    "extrema",
    "docks",
    "snap",
    "linked",
    "next_id",
)
"""Fields of a document that stay when its meshes are closed."""

MOST_ADDED = 6
"""Up to which panels can be added; a recipe may have more."""


def open_mesh(document: Document, mesh: MeshFile, source: int | None = None) -> Document:
    """Another mesh under the same name; its own view and way up, and its points are where the first source is.

    What was tied to vertices or values of the old one (insets, what tools have there, where colour bars end, fields of
    the user's own with the panels that show them, which isolines there are but for their number) is left out; one panel
    there always is.
    """
    if not document.surfaces:
        document = put_point(replace(document, surfaces=(mesh,)), "source", source, mesh.name)
        for spec in usual_specs(mesh.path):
            document = add_panel(document, DistanceFrom(spec), mesh.name)
        return document
    document = without_changed(document)
    others = tuple(field for field in document.fields if field.surface != mesh.name)
    names = {field.name for field in others}
    kept = tuple(panel for panel in document.panels if all(part.name in names for part in own_fields(panel.shows)))
    if document.panels and not kept:
        return open_mesh(add_another(replace(document, panels=(), fields=others)), mesh, source)
    document = without_surfaces(replace(document, panels=kept, fields=others), {mesh.name})
    surfaces = tuple(mesh if other.name == mesh.name else other for other in document.surfaces)
    return replace(
        document,
        surfaces=surfaces if mesh in surfaces else (*surfaces, mesh),
        points=tuple(replace(p, at=source) if p.surface == mesh.name else p for p in document.points),
        panels=tuple(replace(p, maximum=None) if p.surface == mesh.name else p for p in document.panels),
        isolines=_isolines_of_any(document.isolines),
        range="own",
        insets=(),
        warp_factor=0.0,
        camera="auto",
        up="auto",
    )


def close_meshes(document: Document) -> Document:
    """Return the document without meshes and all that is on them; how fields and surfaces look stays."""
    kept = {word: getattr(document, word) for word in KEPT_OF_CLOSED}
    return Document(isolines=_isolines_of_any(document.isolines), **kept)


def _isolines_of_any(isolines: Isolines) -> Isolines:
    """Drop what is tied to values of a mesh."""
    return Isolines(isolines.count, round=isolines.round)


def put_point(document: Document, name: str, at: Source | None, surface: str = "A") -> Document:
    """Move a named point, or add it."""
    if all(other.name != name for other in document.points):
        return replace(document, points=(*document.points, Point(name, at, surface)))
    points = (replace(p, at=at, surface=surface) if p.name == name else p for p in document.points)
    return replace(document, points=tuple(points))


def source_name(document: Document, panel: int) -> str:
    """Return the point that a panel's quantity starts from.

    Of a quantity that starts nowhere, it is that of the first panel of the same surface that has one; "" for none.
    """
    shown = document.panel(panel)
    alike = [shown, *(other for other in document.panels if other.surface == shown.surface)]
    return next((name for each in alike for name in each.shows.points), "")


def move_source(document: Document, panel: int, at: Source) -> Document:
    """Move the point that a panel's quantity starts from (`source_name`), as a click in the panel does."""
    name = source_name(document, panel)
    return put_point(document, name, at, document.panel(panel).surface) if name else document


def show_in(document: Document, panel: int, shows: Quantity) -> Document:
    """Show another quantity in a panel; a colour bar with an end of its own belonged to the old one.

    A point that is not there yet is where the first source is.
    """
    surface = document.panel(panel).surface
    known = {point.name: point.surface for point in document.points}
    elsewhere = {name for name in shows.points if known.get(name, surface) != surface}
    if elsewhere:
        # The head of a panel that starts nowhere does not know where those of its surface start.
        name = source_name(document, panel) or free_names("source", 1, list(known))[0]
        shows = from_point(shows, name)
    for name in set(shows.points) - known.keys():
        document = put_point(document, name, None, surface)
    return replace(
        document,
        panels=tuple(
            replace(p, shows=shows, maximum=None) if p.id == panel and p.shows != shows else p for p in document.panels
        ),
    )


def show_in_row(document: Document, panel: int, shows: Quantity) -> Document:
    """Show another quantity in a panel; another distance goes into all three panels of a change.

    Of these, before and after are compared with each other.
    """
    before = document.panel(panel)
    if changed_mesh(document) is None or not (_is_in_row(shows) and _is_in_row(before.shows)):
        return show_in(document, panel, shows)
    old, roots = before.shows.specs, {point.name: point.image_of or point.name for point in document.points}
    root = roots[before.shows.points[0]]
    for other in document.panels:
        now = other.shows
        if _is_in_row(now) and now.specs == old and roots[now.points[0]] == root:
            document = show_in(document, other.id, now.with_spec(shows.specs[0]))
    return document


def _is_in_row(shows: Quantity) -> bool:
    """Return whether it is a distance before or after a change, or what the change does to it."""
    return shows.is_distance or shows.compares_meshes


def show_distances(document: Document, is_meant: Callable[[Panel], bool]) -> Document:
    """Every panel that is meant shows the distance that its quantity is made by, from where others start."""
    for panel in document.panels:
        if not is_meant(panel):
            continue
        (spec,), name = panel.shows.specs, source_name(document, panel.id)
        if not name:
            here = [p.name for p in document.points if p.name.startswith("source") and p.surface == panel.surface]
            name = (here or free_names("source", 1, [point.name for point in document.points]))[0]
        if all(point.name != name for point in document.points):
            document = put_point(document, name, None, panel.surface)
        shown = replace(panel, shows=DistanceFrom(spec, name), maximum=None)
        document = replace(document, panels=tuple(shown if p.id == panel.id else p for p in document.panels))
    return document


def add_panel(document: Document, shows: Quantity, surface: str = "A") -> Document:
    """One more panel, at the end, with an id that no panel has had."""
    panel = Panel(document.next_id, shows, surface)
    return replace(document, panels=(*document.panels, panel), next_id=document.next_id + 1)


def show_field(document: Document, field: FieldArray, panel: int) -> Document:
    """Show one more field of the user's own: in a panel of its own, or if there are six in the one named, or another of
    its surface.

    It gets a name that is free; the same array of the same file is not added again.
    """
    known = next((each for each in document.fields if replace(each, name=field.name) == field), None)
    if known is None:
        known = replace(field, name=free_field_name(field.name, [each.name for each in document.fields]))
        document = replace(document, fields=(*document.fields, known))
    if len(document.panels) < MOST_ADDED:
        return add_panel(document, OwnField(known.name), known.surface)
    here = [each.id for each in document.panels_of(known.surface)]
    return show_in(document, panel if panel in here else here[-1], OwnField(known.name))


def remove_panel(document: Document, panel: int) -> Document:
    """Return the document without a panel."""
    return replace(document, panels=tuple(p for p in document.panels if p.id != document.panel(panel).id))


def end_at(document: Document, panel: int, end: float | None) -> Document:
    """Let a panel's colour bar end at a number, or at its field's own maximum; then it is not that of all panels."""
    return with_ends(document, {panel: end})


def with_ends(document: Document, ends: Mapping[int, float | None]) -> Document:
    """Return the same for several, by the panels' ids."""
    panels = tuple(replace(p, maximum=ends[p.id]) if p.id in ends else p for p in document.panels)
    return replace(document, panels=panels, range="own")


def with_range(document: Document, word: str) -> Document:
    """One of RANGES; with "own" colour bars end at their fields' maxima, wherever they were made to end."""
    panels = tuple(replace(panel, maximum=None) for panel in document.panels) if word == "own" else document.panels
    return replace(document, range=word, panels=panels)


def has_ends(document: Document) -> bool:
    """Return whether a colour bar ends elsewhere than at its field's maximum."""
    return any(panel.maximum is not None for panel in document.panels)


def move_panel(document: Document, panel: int, place: int) -> Document:
    """Put a panel at a place among the others, 0 for the first."""
    others = [p for p in document.panels if p.id != panel]
    others.insert(place, document.panel(panel))
    return replace(document, panels=tuple(others))


def add_another(document: Document, surface: str | None = None, is_distance: bool = False) -> Document:
    """Add another panel of a surface, by default the first.

    It shows a distance of the usual three that is not shown yet; then the difference of the first two panels, unless
    there is a difference already or `is_distance` asks for none; then any distance that is not shown yet.
    """
    shown = {spec.word for panel in document.panels_of(surface) for spec in panel.shows.specs}
    surface = document.surfaces[0].name if surface is None else surface
    usual = [spec.word for mesh in document.surfaces if mesh.name == surface for spec in usual_specs(mesh.path)]
    words = [*usual, *distance_types()]
    word = next((word for word in words if word not in shown), words[0])
    here = document.panels_of(surface)
    first = [panel.shows for panel in here if panel.shows.is_distance][:2]
    has_usual = shown.issuperset(usual)
    may_differ = has_usual and not is_distance and not any(panel.shows.is_difference for panel in here)
    if may_differ and len(set(first)) == 2 and first[0].points == first[1].points:
        return add_panel(document, Difference(first[0], first[1]), surface)
    if here and all(panel.shows.relates_surfaces and not panel.shows.is_map for panel in here):
        return add_panel(document, here[0].shows.with_spec(Spec.of(word)), surface)
    starting = [name for panel in document.panels_of(surface) for name in panel.shows.points]
    starting += [point.name for point in document.points if point.name == "source" and point.surface == surface]
    if starting:
        name = "source" if "source" in starting else starting[0]
        return add_panel(document, DistanceFrom(Spec.of(word), name), surface)
    document, name = with_new_point(document, "source", None, surface)
    return add_panel(document, DistanceFrom(Spec.of(word), name), surface)


def duplicate_panel(document: Document, panel: int) -> Document:
    """Return the same once more, after it."""
    shown = document.panel(panel)
    more = add_panel(document, shown.shows, shown.surface)
    return move_panel(more, document.next_id, place_of(document, panel) + 1)


def place_of(document: Document, panel: int) -> int:
    """Return the place of a panel among the others."""
    return document.panels.index(document.panel(panel))


def show_dock(document: Document, dock: str, is_open: bool = True) -> Document:
    """Open or close a dock."""
    others = tuple(each for each in document.docks if each != dock)
    return replace(document, docks=(*others, dock) if is_open else others)


def mark_extrema(document: Document, is_shown: bool = True) -> Document:
    """Return whether extrema away from the source have triangles, in figures too."""
    return replace(document, extrema=is_shown)


def pass_through(document: Document, vertices: tuple[int, ...], surface: str = "A") -> Document:
    """One more line through each of the vertices of a surface."""
    names = free_names("line", len(vertices), [point.name for point in document.points])
    points = [Point(name, vertex, surface) for name, vertex in zip(names, vertices, strict=True)]
    through = (*document.isolines.through, *names)
    return replace(document, points=(*document.points, *points), isolines=replace(document.isolines, through=through))


def pass_through_none(document: Document) -> Document:
    """Remove isolines through points, and the points that only these had."""
    return without_orphans(document, replace(document, isolines=replace(document.isolines, through=())))
