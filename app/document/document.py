"""The document: all that is shown, as one frozen value; a state of the window, a recipe, a step of the history.

A document says what is wanted and holds nothing that is computed.  It is hashable, pickles, and is written as JSON
(`file`); the functions in `edits` lead from one to the next.
"""

from base64 import b64decode
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from bihdist_core.applications.changes import Perturbation
from bihdist_core.distances.distance_types import Spec, distance_types
from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import SOLIDS, holds_points, mesh_format
from bihdist_core.scalars import whole_number
from bihdist_core.sources.source import Source, checked_source

from ..samples import mesh_path
from .camera import SecondMeshView, View, checked_view
from .looks import (
    AS_IT_IS,
    CURVATURE,
    LARGEST,
    NO_BASE,
    OF_THE_STYLE,
    RANGES,
    TWENTY_STEPS,
    UPS,
    Base,
    Clip,
    Colours,
    Isolines,
    Shading,
    one_of,
)
from .part import Part
from .quantities import OwnField, Quantity, from_point, own_fields
from .repairs import NO_REPAIRS, Repairs
from .tools import docked_tools

AnyPart = TypeVar("AnyPart", bound=Part)
Named = TypeVar("Named", "MeshFile", "Point", "FieldArray")

COMPARISON = (Spec.of("biharmonic"), Spec.of("geodesic"), Spec.of("diffusion"))
ON_POINTS = {Spec.of("geodesic"): Spec.of("commute-time")}
"""What stands on points for a distance that needs faces."""
"""The panels of the window and of figures where nothing else is asked for."""

AREAS = ("voronoi", "barycentric")
CORNERS = ("auto", "top right", "top left", "bottom right", "bottom left")

MESH_UNITS = "mesh units"
"""What lengths are in as long as nobody says it."""

MOST_PANELS = 1000
LONGEST_NAME = 60
LONGEST_UNIT = 20


@dataclass(frozen=True)
class MeshFile:
    """A surface by where it comes from, under a name of its own in the document.

    Attributes
    ----------
    name
        Its name, which points and panels refer to.
    path
        A file, or the name of a sample; empty for a surface in memory.
    sha256
        The checksum of the file's bytes, or of the arrays in memory; empty as long as any content will do.
    change
        The change that the surface is made by (`app.document.changing`), after the repairs; None for no change.
    repairs
        The repairs that are made when it is read.
    """

    name: str
    path: str
    sha256: str = ""
    change: Perturbation | None = None
    repairs: Repairs = NO_REPAIRS


@dataclass(frozen=True)
class Point:
    """A named source: a vertex, a place in a face, a set, a boundary loop or a curve (`bihdist_core.sources`).

    Attributes
    ----------
    name
        Its name, which panels refer to.
    at
        The source. None stands for a vertex of the largest component that is seen, and becomes that vertex once the
        surface is there.
    surface
        The name of the surface that it is on.
    image_of
        The name of a point on the surface from which this point's surface is made; this point is always its image.
    """

    name: str
    at: Source | None
    surface: str = "A"
    image_of: str = ""

    def __post_init__(self) -> None:
        if self.at is not None:
            object.__setattr__(self, "at", checked_source(self.at))


@dataclass(frozen=True)
class FieldArray:
    """A field of the user's own: values at a surface's vertices, in a file or given from Python.

    Attributes
    ----------
    name
        Its name.
    sha256
        The checksum of the values; those from Python stand beside the document (`session.array_store`).
    surface
        The name of the surface.
    path, array
        The file, and the name of the array in a file of several; both empty for values from Python.
    """

    name: str
    sha256: str
    surface: str = "A"
    path: str = ""
    array: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise ParameterError(f"The name of a field is a string, not {self.name!r}.")
        if not self.name or self.name != self.name.strip() or " - " in self.name or self.name.startswith("raw "):
            raise ParameterError(f"{self.name!r} is not a name for a field; use a word or two.")
        if not self.name.isprintable() or len(self.name) > LONGEST_NAME:
            raise ParameterError(f"A field's name has up to {LONGEST_NAME} characters, all of them printable.")
        if self.name.partition("(")[0] in distance_types():
            raise ParameterError(f"A field needs a name of its own; {self.name!r} is a distance.")


def free_field_name(text: str, taken: list[str]) -> str:
    """Return a name for a field that is not taken, as near as may be to a text, such as the name of its file."""
    words = "".join(letter for letter in text if letter.isprintable()).replace(" - ", " ").removeprefix("raw ")
    name = words.strip()[: LONGEST_NAME - 10].strip() or "field"
    name = f"other {name}" if name.partition("(")[0] in distance_types() else name
    return free_names(name, 1, taken)[0]


@dataclass(frozen=True)
class Panel:
    """A quantity on a surface.

    Attributes
    ----------
    id
        A number that no other panel of the document has or had.
    shows
        The quantity that it shows.
    surface
        The name of the surface.
    maximum
        The end of the colour bar; None for the end that the document's `range` gives.
    """

    id: int
    shows: Quantity
    surface: str = "A"
    maximum: float | None = None

    def __post_init__(self) -> None:
        if self.maximum is not None and not 1 / LARGEST <= self.maximum <= LARGEST:
            raise ParameterError(
                f"A colour bar ends at a number from {1 / LARGEST:g} to {LARGEST:g}, not {self.maximum:g}."
            )


@dataclass(frozen=True)
class Inset:
    """An enlarged picture of the place of a vertex, in a corner of each panel.

    Attributes
    ----------
    vertex
        The vertex in the middle of it.
    factor
        How many times it enlarges, more than 1 and at most 100.
    corner
        One of "auto" (where the least is hidden), "top left", "top right", "bottom left" and "bottom right".
    isolines
        The number of isoline steps from 0 to the maximum; None for the isolines of the panel.
    """

    vertex: int
    factor: float = 3.0
    corner: str = "auto"
    isolines: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertex", whole_number(self.vertex, "A vertex id"))
        object.__setattr__(self, "factor", float(self.factor))
        if not 1 < self.factor <= 100:
            raise ParameterError(f"An inset enlarges by more than 1 and at most 100 times, not {self.factor:g}.")
        one_of(self.corner, CORNERS, "corner")
        if self.isolines is not None:
            Isolines(whole_number(self.isolines, "A number of steps"))


def isolines_in(inset: Inset, isolines: Isolines) -> Isolines:
    """Return the isolines of an inset in a panel with these isolines."""
    return isolines if inset.isolines is None else replace(isolines, count=inset.isolines, spacing=None, values=())


@dataclass(frozen=True)
class DockPlaces:
    """The places and sizes of open docks in the window.

    Attributes
    ----------
    width, height
        The size of the window, in logical pixels.
    state
        The state of the docks as Qt saves it, in base64.
    """

    width: int
    height: int
    state: str

    def __post_init__(self) -> None:
        if min(self.width, self.height) < 1:
            raise ParameterError(f"A window has a size of 1 or more, not {self.width} x {self.height}.")
        try:
            b64decode(self.state, validate=True)
        except ValueError:
            raise ParameterError(f"The places of docks are base64, not {self.state[:20]!r}.") from None


@dataclass(frozen=True)
class Document:
    """All that is shown, as one frozen value; ParameterError for parts that do not fit together.

    Attributes
    ----------
    surfaces
        The surfaces, by their files.
    points
        The named sources on them.
    panels
        The panels, each of which shows a quantity.
    areas
        The vertex areas of the operators, one of AREAS.
    isolines
        The isolines of all panels.
    range
        Where colour bars end, one of RANGES.
    camera
        The camera of the first surface, or the name of an automatic view.
    insets
        Enlarged pictures in the corners of each panel.
    warp_factor
        A flat surface becomes a height field whose highest point is at this fraction of its extent; 0 for none.
    next_id
        The id of the panel that is added next.
    fields
        The user's own fields, which panels can show.
    colours
        The colours of the fields.
    shading
        The shading of the surfaces.
    clip
        The plane beyond which surfaces are cut away; None for none.
    opacity
        Of surfaces, more than 0 and at most 1.
    base
        The scalars in grey under the isolines.
    up
        The axis of the first surface that points up; "auto" as long as it is to be guessed.
    parallel_projection
        Whether the picture has no perspective.
    axes
        Whether a cross of the coordinate axes is shown.
    scale_bar
        Whether a scale bar is shown.
    unit
        The unit of the meshes' lengths, "" where it is not known.
    extrema
        Whether the extrema of the fields are marked.
    docks
        The names of the docks that are open.
    dock_places
        Where the docks were when this was saved; None for where they are at first.
    snap
        Whether the pointer puts sources on vertices, and not anywhere in faces.
    second_views
        The views of the surfaces after the first.
    linked
        Whether turning one surface turns the others.
    parts
        The parts of tools that differ from the usual ones, in the order of their names; `document[Pins]` returns the
        usual one, too.
    """

    surfaces: tuple[MeshFile, ...] = ()
    points: tuple[Point, ...] = ()
    panels: tuple[Panel, ...] = ()
    areas: str = "voronoi"
    isolines: Isolines = TWENTY_STEPS
    range: str = "own"
    camera: View = "auto"
    insets: tuple[Inset, ...] = ()
    warp_factor: float = 0.0
    next_id: int = 0
    fields: tuple[FieldArray, ...] = ()
    colours: Colours = OF_THE_STYLE
    shading: Shading = AS_IT_IS
    clip: Clip | None = None
    opacity: float = 1.0
    base: Base = NO_BASE
    up: str = "auto"
    parallel_projection: bool = False
    axes: bool = False
    scale_bar: bool = False
    unit: str = ""
    extrema: bool = False
    docks: tuple[str, ...] = ()
    dock_places: DockPlaces | None = None
    snap: bool = True
    second_views: tuple[SecondMeshView, ...] = ()
    linked: bool = True
    parts: tuple[Part, ...] = ()

    def __post_init__(self) -> None:
        if isinstance(self.isolines, int):
            object.__setattr__(self, "isolines", Isolines(self.isolines))  # a number of steps does
        if self.base.scalars not in ("", CURVATURE, *(field.name for field in self.fields)):
            object.__setattr__(self, "base", NO_BASE)  # its field is gone
        ids = {panel.id for panel in self.panels}
        # Of panels that are gone nothing more is shown.
        parts = {type(part): part.renumbered({id: id for id in ids}) for part in self.parts}
        if len(parts) < len(self.parts):
            raise ParameterError("A document has one part of a kind.")
        kept = (part for kind, part in parts.items() if part != kind())
        object.__setattr__(self, "parts", tuple(sorted(kept, key=lambda part: type(part).__qualname__)))
        self._check_names()
        check_unique(self.docks, "dock")
        for dock in self.docks:
            one_of(dock, tuple(docked_tools()), "dock")
        if ids and max(ids) >= self.next_id:
            raise ParameterError(f"next_id is {self.next_id}, and there is a panel {max(ids)}.")
        if len(self.panels) > MOST_PANELS:
            raise ParameterError(f"There are at most {MOST_PANELS} panels, not {len(self.panels)}.")
        if self.areas not in AREAS:
            raise ParameterError(f"There are no areas {self.areas!r}; choose one of {', '.join(AREAS)}.")
        one_of(self.range, RANGES, "range")
        one_of(self.up, UPS, "direction")
        if len(self.unit) > LONGEST_UNIT or not self.unit.isprintable() or self.unit != self.unit.strip():
            raise ParameterError(f"A unit is a word such as mm, not {self.unit!r}.")
        if not 0 <= self.warp_factor <= 10:
            raise ParameterError(
                f"The warp factor of a height field is a fraction of the surface's extent, not {self.warp_factor:g}."
            )
        if not 0 < self.opacity <= 1:
            raise ParameterError(f"The opacity of surfaces is more than 0 and at most 1, not {self.opacity:g}.")
        checked_view(self.camera)
        fitted = tuple(part.fitted(self) for part in self.parts)
        object.__setattr__(self, "parts", tuple(part for part in fitted if part != type(part)()))

    def _check_names(self) -> None:
        """ParameterError for two of one name, and for the name of nothing."""
        surfaces = check_unique([mesh.name for mesh in self.surfaces], "surface")
        points = check_unique([point.name for point in self.points], "point")
        fields = check_unique([field.name for field in self.fields], "field")
        check_unique([panel.id for panel in self.panels], "panel")
        check_unique([each.surface for each in self.second_views], "surface")
        for placed in (self.points, self.panels, self.fields, self.second_views):
            check_known([each.surface for each in placed], surfaces, "surface")
        check_known([point.image_of for point in self.points if point.image_of], points, "point")
        check_known([name for panel in self.panels for name in panel.shows.points], points, "point")
        check_known(self.isolines.through, points, "point")
        check_known([part.name for panel in self.panels for part in own_fields(panel.shows)], fields, "field")
        for panel in self.panels:
            panel.shows.check(self, panel.surface)
        for part in self.parts:
            check_known(part.surfaces, surfaces, "surface")
            check_known(part.points, points, "point")
            part.check(self)

    def __getitem__(self, kind: type[AnyPart]) -> AnyPart:
        """Return the part of this type; the usual one where nothing is said."""
        return next((part for part in self.parts if isinstance(part, kind)), None) or kind()

    def with_part(self, part: Part, **changes: Any) -> "Document":
        """Replace the part of this type, and the fields of the document that are given."""
        others = (other for other in self.parts if type(other) is not type(part))
        return replace(self, parts=(*others, part), **changes)

    def with_changed(self, kind: type[Part], **changes: Any) -> "Document":
        """Replace fields of the part of this type."""
        return self.with_part(replace(self[kind], **changes))

    @property
    def held_points(self) -> frozenset[str]:
        """The names of points that panels, isolines and parts need."""
        of_parts = (part.points for part in self.parts if part.holds_points)
        return frozenset(self.isolines.through).union(*(panel.shows.points for panel in self.panels), *of_parts)

    def mesh(self, name: str = "A") -> MeshFile:
        """Return the surface of a name; ParameterError if there is none."""
        return _named(self.surfaces, name, "surface")

    def point(self, name: str = "source") -> Point:
        """Return the point of a name; ParameterError if there is none."""
        return _named(self.points, name, "point")

    def field(self, name: str) -> FieldArray:
        """Return the field of the user's own of a name; ParameterError if there is none."""
        return _named(self.fields, name, "field")

    def panel(self, id: int) -> Panel:
        """Return the panel of an id; ParameterError if there is none."""
        for panel in self.panels:
            if panel.id == id:
                return panel
        raise ParameterError(f"There is no panel {id}.")

    def unit_of(self, unit: str) -> str:
        """Return a unit of an answer, such as "mesh units^2", with the meshes' own unit where that is known."""
        return unit.replace(MESH_UNITS, self.unit) if self.unit else unit

    @property
    def scale_unit(self) -> str:
        """The unit of the scale bar; "" where there is no bar."""
        return (self.unit or MESH_UNITS) * self.scale_bar

    def camera_of(self, surface: str) -> View:
        """Return the camera of a surface; that of the first one if it has none of its own."""
        return next((each.camera for each in self.second_views if each.surface == surface), self.camera)

    def up_of(self, surface: str) -> str:
        """Return which of its axes points up; the same."""
        return next((each.up for each in self.second_views if each.surface == surface), self.up)

    def panels_of(self, surface: str | None = None) -> tuple[Panel, ...]:
        """Return the panels of a surface, by default the first."""
        name = self.surfaces[0].name if surface is None and self.surfaces else surface
        return tuple(panel for panel in self.panels if panel.surface == name)

    @property
    def sources(self) -> tuple[Source | None, ...]:
        """The sources of the panels' fields, each once, in order."""
        return tuple(dict.fromkeys(self.point(name).at for panel in self.panels for name in panel.shows.points))


def usual_specs(path: str, has_faces: bool = True) -> tuple[Spec, ...]:
    """Return the distances of a new document of a mesh: COMPARISON, without what points and solids do not have."""
    path = mesh_path(path)
    lacks_faces = not has_faces or holds_points(path) or mesh_format(path) in SOLIDS
    return tuple(ON_POINTS.get(spec, spec) for spec in COMPARISON) if lacks_faces else COMPARISON


def comparison(
    path: str,
    shows: "tuple[Spec | Quantity, ...] | None" = None,
    sources: tuple[Source | str | None, ...] = (None,),
    areas: str = "voronoi",
    fields: tuple[FieldArray, ...] = (),
) -> Document:
    """Return a document of one mesh with a panel for each quantity from each source, source by source.

    None stands for the usual ones. `fields` are the user's own; those that no quantity names have panels of their own
    at the end.
    """
    names = free_names("source", len(sources), [])
    shown = from_points(usual_specs(path) if shows is None else shows, names)
    shown += unnamed_fields(fields, shown)
    return Document(
        surfaces=(MeshFile("A", path),),
        points=tuple(Point(name, at) for name, at in zip(names, sources, strict=True)),  # type: ignore[arg-type]
        panels=tuple(Panel(k, each) for k, each in enumerate(shown)),
        areas=areas,
        next_id=len(shown),
        fields=fields,
    )


def from_points(shows: "Sequence[Spec | Quantity]", names: Sequence[str]) -> list[Quantity]:
    """Return quantities from each of some points, point by point."""
    # What starts nowhere is the same for all sources.
    starting = [each for each in shows if isinstance(each, Spec) or each.points]
    return [from_point(each, name) for k, name in enumerate(names) for each in (starting if k else shows)]


def unnamed_fields(fields: Iterable[FieldArray], shown: Iterable[Quantity]) -> list[OwnField]:
    """Return those of the user's own fields of which none of the quantities is made."""
    named = {part.name for each in shown for part in own_fields(each)}
    return [OwnField(field.name) for field in fields if field.name not in named]


def starting_points(document: Document) -> tuple[Point, ...]:
    """Return the points that fields start from, in the document's order."""
    shown = {name for panel in document.panels for name in panel.shows.points}
    return tuple(point for point in document.points if point.name in shown)


def with_new_point(document: Document, base: str, at: Source | None, surface: str) -> tuple[Document, str]:
    """Return the document with one more point, and its name: `base`, or that with a number."""
    (name,) = free_names(base, 1, [point.name for point in document.points])
    return replace(document, points=(*document.points, Point(name, at, surface))), name


def free_names(base: str, count: int, taken: list[str]) -> list[str]:
    """Return `count` names that are not taken: "source", "source 2", ...."""
    numbered = (f"{base} {k}" if k > 1 else base for k in range(1, count + len(taken) + 1))
    return [name for name in numbered if name not in taken][:count]


def content(document: Document) -> Document:
    """Return a document without its cameras, open docks and snapping, for comparison with another."""
    second_views = tuple(SecondMeshView(mesh.name, "home", document.up_of(mesh.name)) for mesh in document.surfaces[1:])
    return replace(
        document, camera="home", docks=(), dock_places=None, snap=True, second_views=second_views, linked=True
    )


def check_unique(names: Sequence[Any], what: str) -> set[Any]:
    """Return the names; ParameterError if two of them are alike."""
    for k, name in enumerate(names):
        if name in names[:k]:
            raise ParameterError(f"There are two {what}s {name!r}.")
    return set(names)


def check_known(names: Iterable[str], there: set[str], what: str) -> None:
    """ParameterError for a name that is none of those that are there."""
    for name in names:
        if name not in there:
            raise ParameterError(f"There is no {what} {name!r}.")


def _named(items: tuple[Named, ...], name: str, what: str) -> Named:
    for item in items:
        if item.name == name:
            return item
    raise ParameterError(f"There is no {what} {name!r}.")
