"""`bihdist.figure`: the command `bihdist figure` as a function, whose result a notebook draws by itself."""

import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from bihdist_core import ParameterError
from bihdist_core.applications.changes import change_from_words
from bihdist_core.applications.weights import Weights
from bihdist_core.distances.answers import Answer
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source, checked_source

from ..document import between
from ..document.anchors import Anchor, Anchors
from ..document.camera import Camera, View
from ..document.document import Document, Point, Zoom, free_names
from ..document.file import read_recipe
from ..document.isoline_edits import pass_through
from ..document.looks import AS_IT_IS, Colours, Isolines, shaded
from ..document.page import Page, Recipe
from ..document.perturbation import COLUMNS, with_changed
from ..document.pins import add_pins
from ..document.profile import with_profile
from ..document.quantities import Quantity
from ..document.regions import divide
from ..document.selections import runs_from_words, runs_of, select_instead
from ..scene.colour_file import colours_named
from ..session.array_store import ArrayStore, Mesh, comparison_of_arrays, with_beside
from ..version import version
from .description import Figure
from .draw import draw_figure
from .ends import ranged
from .export import Surfaces, compute, figure_of, open_document, write_figure


class Picture:
    """A figure that is drawn when it is first looked at.

    document: what it shows.  answers: for each panel the field, its label, unit and accuracy, or why there is none.
    """

    def __init__(self, recipe: Recipe, surfaces: Surfaces, given: ArrayStore, answers: list[Answer]) -> None:
        self.document: Document = recipe.document
        self.answers = answers
        self._recipe, self._surfaces, self._given = recipe, surfaces, given

    def save(self, path: str | os.PathLike[str], tex: bool = False) -> Path:
        """Into a .png, .pdf, .svg or .eps file, with its recipe beside it, and what came as arrays; OutputError if not.

        tex: with a LaTeX snippet of the same name that includes it.
        """
        answers = self.answers if tex else None
        write_figure(self._figure, self._recipe, self._given, os.fspath(path), version(), tex=answers)
        return Path(path)

    @property
    def pixels(self) -> np.ndarray:
        """(height, width, 3) uint8, or (height, width, 4) if it is transparent."""
        return draw_figure(self._figure)

    @cached_property
    def _figure(self) -> Figure:
        return figure_of(self._recipe, self._surfaces, self.answers)

    @cached_property
    def _png(self) -> bytes:
        from PIL import Image

        content = io.BytesIO()
        Image.fromarray(self.pixels).save(content, "PNG")
        return content.getvalue()

    def _repr_png_(self) -> bytes:
        return self._png

    def __repr__(self) -> str:
        shown = ", ".join(answer.label for answer in self.answers)
        return f"Picture({shown}, of {', '.join(o.surface.name for o in self._surfaces.values())})"


def figure(
    mesh: Mesh,
    distances: Sequence[str | Quantity] = ("biharmonic", "geodesic", "diffusion"),
    source: Source | str | Sequence[Source | str] | npt.NDArray[np.integer] | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike] | None = None,
    areas: str = "voronoi",
    perturb: str = "",
    beside: Mesh | None = None,
    pairs: npt.ArrayLike = (),
    predict: int | None = None,
    maps: Sequence[str] = (),
    isolines: int | Isolines = 20,
    equal_isolines: bool = False,
    isoline_spacing: float | None = None,
    isoline_values: Sequence[float] = (),
    isoline_through: Sequence[int] = (),
    bold_isolines: int = 0,
    isoline_labels: bool = False,
    colours: str | Colours = "",
    reversed: bool = False,
    bands: bool = False,
    range: str | float | Sequence[float | None] = "own",
    shared_range: bool = False,
    views: View | Sequence[View] = "auto",
    up: str = "auto",
    projection: str = "perspective",
    axes: bool = False,
    camera: Sequence[float] | None = None,
    zooms: Sequence[int | tuple[int, float] | tuple[int, float, int]] = (),
    anchors: Mapping[int, float | None] | Sequence[int] = (),
    anchor_values: bool = False,
    exponent: float = 1.0,
    smoothness: float = 0.0,
    pins: Sequence[Source | str] = (),
    extrema: bool = False,
    regions: str | Sequence[int] = (),
    selections: Sequence[str | npt.ArrayLike] = (),
    profile: bool | Sequence[Source | str] = False,
    way: str = "auto",
    across: Sequence[float] | None = None,
    height: float = 0.0,
    shading: str | None = None,
    crease: float | None = None,
    wireframe: bool = False,
    columns: int | None = None,
    hints: bool = False,
    size: str = "",
    style: str = "paper",
    transparent: bool = False,
    crop: bool = False,
    title: str = "heading",
    font: str = "",
    text: float | None = None,
    progress: Progress | None = None,
) -> Picture:
    """What `bihdist figure` draws, with its options.

    distances: in words, "diffusion(t=1/4)" or "biharmonic - geodesic".  source: a vertex, the highest if None, a
    `SurfacePoint`, `BoundaryLoop`, `Curve` or `SourceSet`, or words such as "12+40"; or a list of these for a row of
    panels each.  fields: your own by name, (n,) with NaN where undefined; each has a panel, or is named in `distances`
    like one: "biharmonic - mine".  perturb: what is done to the mesh, such as "noise=0.4,along=normals,seed=1",
    "pose=FILE", "cut=3+10-20": each distance before and after, and the difference. beside: a second mesh, with panels
    of its own; pairs: (k, 2) known vertices of both that correspond.  By each distance from these, instead of the
    distances themselves, predict: where that vertex of the first is on the second; or maps: where all are, in colours,
    "pairs" for the maps by pairs, or files of others.  views: names or cameras, side by side.  camera: the eleven
    numbers that `--camera` takes, after other views.  up: the axis that points up, "z" or "-z", "auto" for a guess.
    projection: "perspective" or "orthographic".  axes: a corner says where x, y and z point to.  zooms: vertices, or
    with a factor, or with that and a number of steps.  isolines: about how many, at round values; equal_isolines: at so
    many equal steps from 0 to the maximum; isoline_spacing, isoline_values: where they are instead; isoline_through:
    vertices that have one more; bold_isolines: every so many.  anchors: vertices to be marked, perhaps each with a
    value; anchor_values: written beside them.  pins: vertices, or places in faces, with numbers, in their order.
    extrema: triangles at maxima, and at minima away from the source, that persist over a thousandth of the range.
    regions: the panels, numbered from 1, or "all", that show lines around what is nearest to each pin. selections: ids
    (k,) of vertices that stand out together, or words such as "12,40-77", a colour each. profile: True for the path
    through the pins, or the points it goes through: vertices, places in faces, "source" and "pin:1"; way: how it goes
    from one to the next, "auto", "exact", "straightened" or "edges", or by a "section" whose plane holds the direction
    `across`, "section-longer" or "section-whole". shading: "smooth", "creased" at more than `crease` degrees, or
    "flat"; "auto" is creased on what has sharp edges.  colours: the word of a map, or a file of one.  range: "own",
    "shared" (equal units), "shares" (0 to 100 %), where all colour bars end, one end for each panel (None: its own), or
    the session or recipe whose ends are taken; shared_range: the same as "shared".  size: "85mm", "1680x640", "column",
    "slide", as the command takes it.  title: names as "heading", as "caption" at the colour bars, or "none".  font: a
    family; text: the size of labels in points.  Raises BihdistError, as the command says its sentences.

    >>> import bihdist
    >>> picture = bihdist.figure("hand", ["biharmonic", "biharmonic - geodesic"], source=12, size="400x200")
    >>> picture
    Picture(biharmonic, exact, biharmonic, exact − geodesic, exact, of hand.ply)
    >>> picture.pixels.shape
    (200, 400, 3)
    """
    several = isinstance(source, Sequence | np.ndarray) and not isinstance(source, str)
    sources = tuple(source) if isinstance(source, Sequence | np.ndarray) and not isinstance(source, str) else (source,)
    if not sources:
        raise ParameterError("There is no source in an empty list; name one, or None for the highest vertex.")
    document, given = comparison_of_arrays(mesh, distances, {} if fields is None else fields, sources, areas)
    marked = dict(anchors) if isinstance(anchors, Mapping) else dict.fromkeys(anchors)
    names = free_names("anchor", len(marked), [point.name for point in document.points])
    chosen = _views(views, camera)
    lines = isolines if isinstance(isolines, Isolines) else Isolines(isolines, isoline_spacing, tuple(isoline_values))
    lines = replace(
        lines,
        bold=bold_isolines or lines.bold,
        labels=isoline_labels or lines.labels,
        round=lines.round and not equal_isolines,
    )
    found = colours if isinstance(colours, Colours) else colours_named(colours)
    document = replace(
        document,
        points=(*document.points, *(Point(name, vertex) for name, vertex in zip(names, marked, strict=True))),
        zooms=tuple(_zoom(zoom) for zoom in zooms),
        isolines=lines,
        colours=replace(found, reversed=reversed or found.reversed, bands=bands or found.bands),
        height=height,
        up=up,
        projection=projection,
        axes=axes,
        extrema=extrema,
        shading=shaded(AS_IT_IS, shading, crease, wireframe),
        camera=chosen[0] if chosen else "auto",
    ).with_part(
        Anchors(
            anchors=tuple(Anchor(name, value) for name, value in zip(names, marked.values(), strict=True)),
            weights=Weights(exponent, smoothness),
        )
    )
    if len(pins):
        document = add_pins(document, [checked_source(at) for at in pins])
    if profile is not False:
        document = with_profile(document, () if profile is True else profile, way, across)
    if len(regions):
        document = divide(document, regions)
    if len(selections):
        runs = (runs_from_words(each) if isinstance(each, str) else runs_of(np.asarray(each)) for each in selections)
        document = select_instead(document, runs)
    if len(isoline_through):
        document = pass_through(document, tuple(isoline_through))
    usual = len(distances) if several and len(sources) > 1 else None
    if perturb:
        usual = COLUMNS
    page = Page(
        size=size,
        style=style,
        views=chosen if len(chosen) > 1 else (),
        columns=columns or usual,
        hints=hints,
        transparent=transparent,
        crop=crop,
        title=title,
        font=font,
        text=text,
        anchor_values=anchor_values,
    )
    if perturb:
        document = with_changed(document, change_from_words(perturb))
    document = _with_second(document, given, beside, pairs, predict, maps)
    document, _ = ranged(document, "shared" if shared_range and range == "own" else range)
    document, surfaces = open_document(Recipe(document, page), given)
    recipe = Recipe(document, page)
    # What cannot be drawn is refused before the long work.
    figure_of(recipe, surfaces, [Answer(label="")] * len(document.panels))
    return Picture(recipe, surfaces, given, compute(document, surfaces, progress))


def _with_second(
    document: Document,
    given: ArrayStore,
    beside: Mesh | None,
    pairs: npt.ArrayLike,
    predict: int | None,
    maps: Sequence[str],
) -> Document:
    """With a second mesh, and what is shown of both, if anything is."""
    if beside is not None:
        document = with_beside(document, given, beside)
    if np.size(pairs):
        places = np.asarray(pairs)
        if places.ndim != 2 or places.shape[1] != 2 or places.dtype.kind not in "iu":
            raise ParameterError(f"Pairs are whole numbers of shape (k, 2), not {places.dtype} of {places.shape}.")
        document = between.with_pairs(document, [(int(i), int(j)) for i, j in places])
    if predict is not None and len(maps):
        raise ParameterError("predict= and maps= are figures of their own; leave one of them out.")
    if predict is not None:
        return between.with_prediction(document, predict)
    return between.with_maps(document, maps) if len(maps) else document


def figure_again(recipe: str | os.PathLike[str], progress: Progress | None = None) -> Picture:
    """The figure of a recipe's file, as `bihdist figure --recipe` draws it; BihdistError where it cannot be drawn."""
    read = read_recipe(recipe)
    given = ArrayStore.read(read)
    document, surfaces = open_document(read, given)
    read = replace(read, document=document)
    figure_of(read, surfaces, [Answer(label="")] * len(document.panels))
    return Picture(read, surfaces, given, compute(document, surfaces, progress))


def _views(views: View | Sequence[View], camera: Sequence[float] | None) -> tuple[View, ...]:
    chosen = (views,) if isinstance(views, str | Camera) else tuple(views)
    if camera is None:
        return chosen
    numbers = [float(number) for number in camera]
    if len(numbers) != 11:
        raise ParameterError(f"A camera is eleven numbers (position, focal point, up, extent), not {len(numbers)}.")
    x = tuple(numbers)
    given = Camera((x[0], x[1], x[2]), (x[3], x[4], x[5]), (x[6], x[7], x[8]), (x[9], x[10]))
    return (given,) if views == "auto" else (*chosen, given)  # a list with "auto" asks for both


def _zoom(zoom: int | tuple[int, float] | tuple[int, float, int]) -> Zoom:
    if not isinstance(zoom, tuple):
        return Zoom(zoom)
    vertex, factor, *steps = zoom
    return Zoom(vertex, factor, isolines=steps[0] if steps else None)
