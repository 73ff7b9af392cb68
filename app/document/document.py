"""What is shown, all of it, as one frozen value: the state of the window, a saved recipe, a step of the history.

A document says what is wanted and holds nothing that is computed.  It is hashable, pickles, and is written as JSON
(`file`); the functions in `edits` lead from one to the next.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from bihdist_core.applications.changes import Perturbation
from bihdist_core.distances.kinds import Spec, kinds
from bihdist_core.errors import ParameterError
from bihdist_core.scalars import whole_number
from bihdist_core.sources.source import Source, checked_source

from .beside import Beside
from .camera import View, checked_view
from .docks import DockPlaces
from .looks import (
    AS_IT_IS,
    LARGEST,
    OF_THE_STYLE,
    PROJECTIONS,
    RANGES,
    TWENTY_STEPS,
    UPS,
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
"""The panels of the window and of figures where nothing else is asked for."""

AREAS = ("voronoi", "barycentric")
CORNERS = ("auto", "top right", "top left", "bottom right", "bottom left")

MOST_PANELS = 1000
LONGEST_NAME = 60


@dataclass(frozen=True)
class MeshFile:
    """A surface by where it comes from, under a name of its own in the document.

    path: a file, or the name of a sample; empty for a surface in memory.  sha256: of the file's bytes, or of the arrays
    in memory; empty as long as any content will do.  repairs: what is done to it on reading.  change: what is made of
    that (`changing`), None for itself.
    """

    name: str
    path: str
    sha256: str = ""
    change: Perturbation | None = None
    repairs: Repairs = NO_REPAIRS


@dataclass(frozen=True)
class Point:
    """A named source: a vertex, a place in a face, a set, a boundary loop or a curve (`bihdist_core.sources`).

    None, for a vertex of the largest component that is seen, becomes that vertex once the surface is there.
    image_of: a point on the surface that this one is made from, whose place this always has.
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
    """A field of the user's own, given from Python: values at a surface's vertices, under a name.

    sha256: of the values, which stand beside the document (`session.array_store`).
    """

    name: str
    sha256: str
    surface: str = "A"

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise ParameterError(f"A field has a text for a name, not {self.name!r}.")
        if not self.name or self.name != self.name.strip() or " - " in self.name or self.name.startswith("raw "):
            raise ParameterError(f"{self.name!r} is no name for a field; use a word or two.")
        if not self.name.isprintable() or len(self.name) > LONGEST_NAME:
            raise ParameterError(f"A field's name has up to {LONGEST_NAME} characters, all of them printable.")
        if self.name.partition("(")[0] in kinds():
            raise ParameterError(f"A field needs a name of its own; {self.name!r} is a distance.")


@dataclass(frozen=True)
class Panel:
    """A quantity on a surface.  id: never another panel's; maximum: the end of its colour bar, its own if None."""

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
class Zoom:
    """An inset: the place of a vertex enlarged, in a corner of each panel.

    corner: "auto" (where the least is hidden), "top left", "top right", "bottom left" or "bottom right".  isolines: so
    many steps from 0 to the maximum, those of the panel if None.
    """

    vertex: int
    factor: float = 3.0
    corner: str = "auto"
    isolines: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertex", whole_number(self.vertex, "A vertex id"))
        object.__setattr__(self, "factor", float(self.factor))
        if not 1 < self.factor <= 100:
            raise ParameterError(f"A zoom enlarges by more than 1 and at most 100 times, not {self.factor:g}.")
        one_of(self.corner, CORNERS, "corner")
        if self.isolines is not None:
            Isolines(whole_number(self.isolines, "A number of steps"))


def isolines_in(zoom: Zoom, isolines: Isolines) -> Isolines:
    """Those that an inset of a panel with these isolines has."""
    return isolines if zoom.isolines is None else replace(isolines, count=zoom.isolines, spacing=None, values=())


@dataclass(frozen=True)
class Document:
    """See the module; ParameterError for parts that do not fit together.

    areas: which vertex areas the operators have.  range: where colour bars end, one of RANGES.  height: a flat surface
    becomes a height field whose highest point is this share of its extent.  next_id: of the panel that is added next.
    fields: of the user's own, for panels to show.  up: the axis that points up, "auto" as long as it is to be guessed.
    projection: one of PROJECTIONS.  axes: whether their directions are shown.  extrema: whether those of the fields
    are marked.  docks: the words of those that are open; dock_places: where they were when this was saved, None for
    where docks are at first.
    snap: whether the pointer puts sources on vertices, and not anywhere in faces.
    beside: how surfaces but the first are seen, and linked: whether turning one of them turns the others.
    parts: of tools, those that are not as usual (`document[Pins]` has the usual one as well), in the order of their
    names.
    """

    surfaces: tuple[MeshFile, ...] = ()
    points: tuple[Point, ...] = ()
    panels: tuple[Panel, ...] = ()
    areas: str = "voronoi"
    isolines: Isolines = TWENTY_STEPS
    range: str = "own"
    camera: View = "auto"
    zooms: tuple[Zoom, ...] = ()
    height: float = 0.0
    next_id: int = 0
    fields: tuple[FieldArray, ...] = ()
    colours: Colours = OF_THE_STYLE
    shading: Shading = AS_IT_IS
    up: str = "auto"
    projection: str = "perspective"
    axes: bool = False
    extrema: bool = False
    docks: tuple[str, ...] = ()
    dock_places: DockPlaces | None = None
    snap: bool = True
    beside: tuple[Beside, ...] = ()
    linked: bool = True
    parts: tuple[Part, ...] = ()

    def __post_init__(self) -> None:
        if isinstance(self.isolines, int):
            object.__setattr__(self, "isolines", Isolines(self.isolines))  # a number of steps does
        ids = {panel.id for panel in self.panels}
        # Of panels that are gone nothing more is shown.
        parts = {type(part): part.renumbered({id: id for id in ids}) for part in self.parts}
        if len(parts) < len(self.parts):
            raise ParameterError("A document has one part of a kind.")
        kept = (part for kind, part in parts.items() if part != kind())
        object.__setattr__(self, "parts", tuple(sorted(kept, key=lambda part: type(part).__qualname__)))
        self._check_names()
        unlike(self.docks, "dock")
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
        one_of(self.projection, PROJECTIONS, "projection")
        if not 0 <= self.height <= 10:
            raise ParameterError(
                f"The height of a height field is a fraction of the surface's extent, not {self.height:g}."
            )
        checked_view(self.camera)

    def _check_names(self) -> None:
        """ParameterError for two of one name, and for the name of nothing."""
        surfaces = unlike([mesh.name for mesh in self.surfaces], "surface")
        points = unlike([point.name for point in self.points], "point")
        fields = unlike([field.name for field in self.fields], "field")
        unlike([panel.id for panel in self.panels], "panel")
        unlike([each.surface for each in self.beside], "surface")
        for placed in (self.points, self.panels, self.fields, self.beside):
            known([each.surface for each in placed], surfaces, "surface")
        known([point.image_of for point in self.points if point.image_of], points, "point")
        known([name for panel in self.panels for name in panel.shows.points], points, "point")
        known(self.isolines.through, points, "point")
        known([part.name for panel in self.panels for part in own_fields(panel.shows)], fields, "field")
        for panel in self.panels:
            panel.shows.check(self, panel.surface)
        for part in self.parts:
            known(part.surfaces, surfaces, "surface")
            known(part.points, points, "point")
            part.check(self)

    def __getitem__(self, kind: type[AnyPart]) -> AnyPart:
        """The part of this type; the usual one where nothing is said."""
        return next((part for part in self.parts if isinstance(part, kind)), None) or kind()

    def with_part(self, part: Part, **changes: Any) -> "Document":
        """With this instead of the part of its type, and with other changes of the document that go with it."""
        others = (other for other in self.parts if type(other) is not type(part))
        return replace(self, parts=(*others, part), **changes)

    @property
    def held_points(self) -> frozenset[str]:
        """The names of points that panels, isolines and parts need."""
        of_parts = (part.points for part in self.parts if part.holds_points)
        return frozenset(self.isolines.through).union(*(panel.shows.points for panel in self.panels), *of_parts)

    def mesh(self, name: str = "A") -> MeshFile:
        """The surface of a name; ParameterError if there is none."""
        return _named(self.surfaces, name, "surface")

    def point(self, name: str = "source") -> Point:
        """The point of a name; ParameterError if there is none."""
        return _named(self.points, name, "point")

    def field(self, name: str) -> FieldArray:
        """The field of the user's own of a name; ParameterError if there is none."""
        return _named(self.fields, name, "field")

    def panel(self, id: int) -> Panel:
        """The panel of an id; ParameterError if there is none."""
        for panel in self.panels:
            if panel.id == id:
                return panel
        raise ParameterError(f"There is no panel {id}.")

    def camera_of(self, surface: str) -> View:
        """From where a surface is seen; from where the first is, if nothing else is said."""
        return next((each.camera for each in self.beside if each.surface == surface), self.camera)

    def up_of(self, surface: str) -> str:
        """Which of its axes points up; the same."""
        return next((each.up for each in self.beside if each.surface == surface), self.up)

    def panels_of(self, surface: str | None = None) -> tuple[Panel, ...]:
        """Those that show a surface, the first if none is named."""
        name = self.surfaces[0].name if surface is None and self.surfaces else surface
        return tuple(panel for panel in self.panels if panel.surface == name)

    @property
    def sources(self) -> tuple[Source | None, ...]:
        """Where the panels' fields start, each place once, in order."""
        return tuple(dict.fromkeys(self.point(name).at for panel in self.panels for name in panel.shows.points))


def comparison(
    path: str,
    shows: "tuple[Spec | Quantity, ...]" = COMPARISON,
    sources: tuple[Source | str | None, ...] = (None,),
    areas: str = "voronoi",
    fields: tuple[FieldArray, ...] = (),
) -> Document:
    """A mesh with a panel for each quantity from each source: the panels of one source after another.

    fields: of the user's own; those that no quantity names have panels of their own at the end.
    """
    names = free_names("source", len(sources), [])
    # What starts nowhere is the same for all sources.
    starting = [each for each in shows if isinstance(each, Spec) or each.points]
    shown = [from_point(each, name) for k, name in enumerate(names) for each in (starting if k else shows)]
    named = {part.name for each in shown for part in own_fields(each)}
    shown += [OwnField(field.name) for field in fields if field.name not in named]
    return Document(
        surfaces=(MeshFile("A", path),),
        points=tuple(Point(name, at) for name, at in zip(names, sources, strict=True)),  # type: ignore[arg-type]
        panels=tuple(Panel(k, each) for k, each in enumerate(shown)),
        areas=areas,
        next_id=len(shown),
        fields=fields,
    )


def starting_points(document: Document) -> tuple[Point, ...]:
    """Those that fields start from, in the document's order."""
    shown = {name for panel in document.panels for name in panel.shows.points}
    return tuple(point for point in document.points if point.name in shown)


def free_names(base: str, count: int, taken: list[str]) -> list[str]:
    """So many names: "source", "source 2", ..., but for those that are taken."""
    numbered = (f"{base} {k}" if k > 1 else base for k in range(1, count + len(taken) + 1))
    return [name for name in numbered if name not in taken][:count]


def content(document: Document) -> Document:
    """What two documents have in common that differ in nothing but cameras, open docks and snapping."""
    beside = tuple(Beside(mesh.name, "home", document.up_of(mesh.name)) for mesh in document.surfaces[1:])
    return replace(document, camera="home", docks=(), dock_places=None, snap=True, beside=beside, linked=True)


def unlike(names: Sequence[Any], what: str) -> set[Any]:
    """The names; ParameterError if two of them are alike."""
    for k, name in enumerate(names):
        if name in names[:k]:
            raise ParameterError(f"There are two {what}s {name!r}.")
    return set(names)


def known(names: Iterable[str], there: set[str], what: str) -> None:
    """ParameterError for a name that is none of those that are there."""
    for name in names:
        if name not in there:
            raise ParameterError(f"There is no {what} {name!r}.")


def _named(items: tuple[Named, ...], name: str, what: str) -> Named:
    for item in items:
        if item.name == name:
            return item
    raise ParameterError(f"There is no {what} {name!r}.")
