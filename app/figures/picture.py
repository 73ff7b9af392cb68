"""`bihdist.figure`: the command `bihdist figure` as a function, whose result a notebook draws by itself."""

from __future__ import annotations

import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from bihdist_core import ParameterError
from bihdist_core.arrays import ByteArray
from bihdist_core.distances.answers import Answer
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.camera import View
from ..document.document import Document
from ..document.file import read_recipe
from ..document.looks import Colours, Isolines
from ..document.page import Page, Recipe
from ..document.quantities import Quantity
from ..session.array_store import ArrayStore, Mesh, comparison_of_arrays, with_beside
from ..version import version
from .description import Figure
from .draw import draw_figure
from .export import Surfaces, check_drawable, compute, figure_of, open_document, write_figure
from .options import arguments, with_options


class Picture:
    """A figure that is drawn when it is first looked at.

    document: what it shows.  answers: for each panel the field, its label, unit and accuracy, or why there is none.

    >>> import bihdist, pyvista
    >>> picture = bihdist.figure(pyvista.Icosphere(nsub=3), ["biharmonic", "geodesic"], source=0)
    >>> [round(float(answer.field.max()), 3) for answer in picture.answers]
    [0.515, 3.134]
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

    def save_movie(
        self,
        path: str | os.PathLike[str],
        turn: float = 360.0,
        frames: int = 120,
        fps: float = 25.0,
        progress: Progress | None = None,
    ) -> Path:
        """Turning by so many degrees, into a .gif or .mp4 file, as `bihdist movie` draws it; BihdistError if not.

        frames: how many pictures; fps: how many of them a second.
        """
        from .movie import Movie, check_movie, write_movie

        check_movie(path)
        write_movie(Movie(self._recipe, turn, frames=frames, fps=fps), path, progress, self._given)
        return Path(path)

    @property
    def pixels(self) -> ByteArray:
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
    cut: str = "",
    merge: float | None = None,
    beside: Mesh | None = None,
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
    views: View | Sequence[View] = "auto",
    up: str = "auto",
    projection: str = "perspective",
    axes: bool = False,
    camera: Sequence[float] | None = None,
    zooms: Sequence[int | tuple[int, float] | tuple[int, float, int]] = (),
    extrema: bool = False,
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
    **of_tools: Any,
) -> Picture:
    """What `bihdist figure` draws, with its options.

    distances: in words, "diffusion(t=1/4)" or "biharmonic - geodesic".  source: a vertex, the highest if None, a
    `SurfacePoint`, `BoundaryLoop`, `Curve` or `SourceSet`, or words such as "12+40"; or a list of these for a row of
    panels each, or with a second mesh one of each.
    fields: your own by name, (n,) with NaN where undefined; each has a panel, or is named in `distances`
    like one: "biharmonic - mine".  cut: a file with 1 for each vertex that stays and 0 for each that is cut out; {name}
    in it is the mesh's name.  merge: what is no farther apart becomes one vertex.  perturb: what is done to the mesh,
    such as "noise=0.4,along=normals,seed=1", "pose=FILE", "cut=3+10-20": each distance before and after, and the
    difference. beside: a second mesh, with panels of its own; pairs: (k, 2) known vertices of both that correspond.  By
    each distance from these, instead of the distances themselves, predict: where that vertex of the first is on the
    second; or maps: where all are, in colours, "pairs" for the maps by pairs, or files of others.  views: names or
    cameras, side by side.  camera: the eleven numbers that `--camera` takes, after other views.  up: the axis that
    points up, "z" or "-z", "auto" for a guess. projection: "perspective" or "orthographic".  axes: a corner says where
    x, y and z point to.  zooms: vertices, or with a factor, or with that and a number of steps.  isolines: about how
    many, at round values; equal_isolines: at so many equal steps from 0 to the maximum; isoline_spacing,
    isoline_values: where they are instead; isoline_through: vertices that have one more; bold_isolines: every so many.
    anchors: vertices to be marked, perhaps each with a value; anchor_values: written beside them.  pins: vertices, or
    places in faces, with numbers, in their order. extrema: triangles at maxima, and at minima away from the source,
    that persist over a thousandth of the range. regions: the panels, numbered from 1, or "all", that show lines around
    what is nearest to each pin. selections: ids (k,) of vertices that stand out together, or words such as "12+40-77",
    a colour each. profile: True for the path through the pins, or the points it goes through: vertices, places in
    faces, "source" and "pin:1"; way: how it goes from one to the next, "auto", "exact" or "edges", or by a "section"
    whose plane holds the direction `across`, "section-longer" or "section-whole". shading: "smooth", "creased" at more
    than `crease` degrees, or "flat"; "auto" is creased on what has sharp edges.  colours: the word of a map, or a file
    of one.  range: "own", "shared" (equal units), "shares" (0 to 100 %), where all colour bars end, one end for each
    panel (None: its own), or the session or recipe whose ends are taken.  size: "85mm", "1680x640", "column",
    "slide", as the command takes it.  title: names as "heading", as "caption" at the colour bars, or "none".  font: a
    family; text: the size of labels in points.  Raises BihdistError, as the command says its sentences.

    >>> import bihdist
    >>> picture = bihdist.figure("hand", ["biharmonic", "biharmonic - geodesic"], source=12, size="400x200")
    >>> picture
    Picture(biharmonic, exact, biharmonic, exact − geodesic, exact, of hand.ply)
    >>> picture.pixels.shape
    (200, 400, 3)
    """
    named = dict(locals())
    several = isinstance(source, Sequence | np.ndarray) and not isinstance(source, str)
    sources = tuple(source) if isinstance(source, Sequence | np.ndarray) and not isinstance(source, str) else (source,)
    if not sources:
        raise ParameterError("There is no source in an empty list; name one, or None for the highest vertex.")
    second = None
    if beside is not None and several:
        if len(sources) > 2:
            raise ParameterError(
                f"Two meshes have a source each, not {len(sources)}; give one of the first, then one of the second."
            )
        sources, second = sources[:1], sources[1] if len(sources) > 1 else None
    known = arguments()
    named |= named.pop("of_tools")
    unknown = named.keys() - known.keys() - {"mesh", "distances", "source", "fields", "beside", "progress"}
    if unknown:
        raise TypeError(f"figure() got an unexpected keyword argument {min(unknown)!r}")
    values = {name: value for name, value in named.items() if name in known and not known[name].is_usual(value)}
    document, store = comparison_of_arrays(mesh, distances, {} if fields is None else fields, sources)
    columns = len(distances) if several and len(sources) > 1 else None

    def with_second(document: Document) -> Document:
        return document if beside is None else with_beside(document, store, beside, second)

    recipe = with_options(Recipe(document, Page(columns=columns)), values, with_second, progress=progress)
    document, surfaces = open_document(recipe, store)
    recipe = replace(recipe, document=document)
    # What cannot be drawn is refused before the long work.
    check_drawable(recipe, surfaces)
    return Picture(recipe, surfaces, store, compute(document, surfaces, progress))


def figure_again(recipe: str | os.PathLike[str], progress: Progress | None = None) -> Picture:
    """The figure of a recipe's file, as `bihdist figure --recipe` draws it; BihdistError where it cannot be drawn.

    >>> import bihdist
    >>> first = bihdist.figure("hand", ["biharmonic"], source=12, size="200x200")
    >>> _ = first.save("hand.png")  # and hand.json, the recipe
    >>> again = bihdist.figure_again("hand.json")
    >>> bool((again.pixels == first.pixels).all())
    True
    """
    read = read_recipe(recipe)
    given = ArrayStore.read(read)
    document, surfaces = open_document(read, given)
    read = replace(read, document=document)
    check_drawable(read, surfaces)
    return Picture(read, surfaces, given, compute(document, surfaces, progress))
