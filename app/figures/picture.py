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
from bihdist_core.applications.changes import Perturbation
from bihdist_core.arrays import ByteArray
from bihdist_core.distances.answers import Answer
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.document import COMPARISON, Document
from ..document.file import read_recipe
from ..document.looks import Isolines
from ..document.page import Page, Recipe
from ..document.quantities import Quantity
from ..session.array_store import ArrayStore, Mesh, comparison_of_arrays, with_second_mesh
from ..version import version
from .arguments import IsolineOptions, LayoutOptions, LookOptions, MarkOptions, ViewOptions, option_values
from .description import Figure
from .draw import draw_figure
from .export import Surfaces, check_drawable, compute, figure_of, open_document, write_figure
from .options import rows, with_options


class Picture:
    """A figure that is drawn when it is first looked at.

    Attributes
    ----------
    document : Document
        What it shows.
    answers : list of Answer
        For each panel the field (n,), its label, unit and accuracy, or why there is none.

    Examples
    --------
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
        """Save the figure, its recipe and arrays given from Python beside it.

        Parameters
        ----------
        path : str or path
            A .png, .pdf, .svg or .eps file.
        tex : bool
            Write a LaTeX snippet of the same name that includes the figure.

        Returns
        -------
        pathlib.Path
            The figure's file.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        answers = self.answers if tex else None
        write_figure(self._figure, self._recipe, self._given, os.fspath(path), version(), tex=answers)
        return Path(path)

    def save_movie(
        self,
        path: str | os.PathLike[str],
        turn: float | None = None,
        swing: bool = False,
        source_path: Sequence[int] = (),
        sweep: str = "",
        frames: int = 120,
        fps: float = 25.0,
        progress: Progress | None = None,
    ) -> Path:
        """Save a movie of the mesh turning, the source moving or a parameter changing, as `bihdist movie` draws it.

        Parameters
        ----------
        path : str or path
            A .gif, .mp4 or .webm file, or names for a .png file of each frame, such as ``"frames/%04d.png"``.
        turn : float, optional
            Angle in degrees by which the mesh turns, by default 360; 90 with `swing`, else 0 if the source moves or a
            parameter changes.
        swing : bool
            Turn back and forth, with the source in view.
        source_path : sequence of int
            Move the source along edges through these vertices.
        sweep : str
            Change a parameter of the distances: over a range, ``"t=4..1/60"``, or through values, ``"k=10,50,200"``.
        frames : int
            How many pictures.
        fps : float
            Frames per second.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        pathlib.Path
            The movie's file.

        Raises
        ------
        BihdistError
            If it cannot be drawn or written.
        """
        from .movie import Movie, write_movie

        movie = Movie(self._recipe, turn, swing, tuple(source_path), sweep, frames, fps)
        write_movie(movie, path, progress, self._given)
        return Path(path)

    @property
    def pixels(self) -> ByteArray:
        """The picture, (height, width, 3) uint8, or (height, width, 4) if it is transparent."""
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
    distances: Sequence[str | Quantity] | None = None,
    source: Source | str | Sequence[Source | str] | npt.NDArray[np.integer] | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike | os.PathLike[str]] | None = None,
    second_mesh: Mesh | None = None,
    areas: str = "voronoi",
    cut: str = "",
    merge: float | None = None,
    largest_component: bool = False,
    operator: str = "cotan",
    perturb: str | Perturbation = "",
    pairs: npt.ArrayLike | str = (),
    maps: Sequence[str] = (),
    predict: int | None = None,
    isolines: int | Isolines | IsolineOptions = 20,
    look: LookOptions | None = None,
    view: ViewOptions | None = None,
    marks: MarkOptions | None = None,
    layout: LayoutOptions | None = None,
    progress: Progress | None = None,
    **others: Any,
) -> Picture:
    """Draw distances on a mesh, as `bihdist figure` does.

    Parameters
    ----------
    mesh : str or MeshLike
        A file, the name of a sample, or the mesh itself.
    distances : sequence of str, optional
        The distances, a panel each, such as ``"diffusion(t=1/4)"`` or ``"biharmonic - geodesic"``; by default
        biharmonic, geodesic, or commute-time where there are no faces, and diffusion.
    source : int, str, Source or sequence of these, optional
        The vertex where distances start, by default the highest, or another source (``"12+40"``). Several sources get
        a row of panels each; with a second mesh, one source each mesh.
    fields : mapping of str to (n,) array_like or file, optional
        Your own fields by name, NaN where undefined, or files of them: ``"lh.thickness"``, ``"all.npz:curv"``.  Each
        has a panel, or is used in `distances` like a distance: ``"biharmonic - mine"``.
    second_mesh : str or MeshLike, optional
        Another mesh, with panels of its own.
    areas : {"voronoi", "barycentric"}
        Vertex areas.
    cut : str
        File with 1 for each vertex that stays and 0 for each that is cut out; ``{name}`` in it is the mesh's name.
    merge : float, optional
        Merge vertices that are no farther apart.
    largest_component : bool
        Keep only the connected component with most vertices.
    operator : {"cotan", "intrinsic-delaunay", "tufted"}
        The operator, see `Laplacian`.
    perturb : str
        A change to the mesh such as ``"noise=0.4,along=normals,seed=1"``: each distance before and after, and the
        difference.
    pairs : (k, 2) array_like of int or str
        Known pairs of corresponding vertices of both meshes, or a file of them.
    maps : sequence of str
        Draw where each vertex of the first mesh is on the second: ``"pairs"`` for the maps by pairs, or files of maps.
    predict : int, optional
        Draw where this vertex of the first mesh is on the second, by each distance from `pairs`.
    isolines : int or IsolineOptions
        About how many isolines, at round values; or which values have one, and how they look.
    look : LookOptions, optional
        Colours and shading of surfaces.
    view : ViewOptions, optional
        Camera, projection and insets.
    marks : MarkOptions, optional
        Marks on surfaces, such as pins, regions and paths.
    layout : LayoutOptions, optional
        Size, style and text of the page.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    **others
        Any other argument raises a TypeError, which suggests the one that was probably meant.

    Returns
    -------
    Picture
        The figure, which a notebook shows.

    Raises
    ------
    ParameterError
        If an argument makes no sense.
    BihdistError
        If something cannot be read, computed or drawn.

    Examples
    --------
    >>> import bihdist
    >>> picture = bihdist.figure(
    ...     "hand", ["biharmonic", "biharmonic - geodesic"], 12, look={"show_edges": True}, layout={"size": "400x200"}
    ... )
    >>> picture
    Picture(biharmonic, exact, biharmonic, exact − geodesic, exact, of hand.ply)
    >>> picture.pixels.shape
    (200, 400, 3)
    """
    own = {"areas": areas, "cut": cut, "merge": merge, "largest_component": largest_component, "operator": operator}
    of_tools = {"perturb": perturb, "pairs": pairs, "maps": maps, "predict": predict}
    groups = {"isolines": isolines, "look": look, "view": view, "marks": marks, "layout": layout}
    values = option_values("figure", rows(), {**own, **of_tools, **groups, **others})
    several = isinstance(source, Sequence | np.ndarray) and not isinstance(source, str)
    sources = tuple(source) if isinstance(source, Sequence | np.ndarray) and not isinstance(source, str) else (source,)
    if not sources:
        raise ParameterError("The list of sources is empty; name one, or None for the highest vertex.")
    second = None
    if second_mesh is not None and several:
        if len(sources) > 2:
            raise ParameterError(
                f"Two meshes have a source each, not {len(sources)}; give one of the first, then one of the second."
            )
        sources, second = sources[:1], sources[1] if len(sources) > 1 else None
    document, store = comparison_of_arrays(mesh, distances, {} if fields is None else fields, sources)
    columns = len(COMPARISON if distances is None else distances) if several and len(sources) > 1 else None

    def with_second(document: Document) -> Document:
        return document if second_mesh is None else with_second_mesh(document, store, second_mesh, second)

    recipe = with_options(Recipe(document, Page(columns=columns)), values, with_second, progress=progress)
    return _computed(recipe, store, progress)


def _computed(recipe: Recipe, store: ArrayStore, progress: Progress | None) -> Picture:
    document, surfaces = open_document(recipe, store)
    recipe = replace(recipe, document=document)
    # What cannot be drawn is refused before the long work.
    check_drawable(recipe, surfaces)
    return Picture(recipe, surfaces, store, compute(document, surfaces, progress))


def figure_again(recipe: str | os.PathLike[str], progress: Progress | None = None) -> Picture:
    """Draw the figure of a recipe again, as `bihdist figure --recipe` does.

    Parameters
    ----------
    recipe : str or path
        The .json file that was saved with a figure, or a session.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    Picture
        The figure.

    Raises
    ------
    BihdistError
        If the recipe cannot be read or drawn.

    Examples
    --------
    >>> import bihdist
    >>> first = bihdist.figure("hand", ["biharmonic"], source=12, layout={"size": "200x200"})
    >>> _ = first.save("hand.png")  # and hand.json, the recipe
    >>> again = bihdist.figure_again("hand.json")
    >>> bool((again.pixels == first.pixels).all())
    True
    """
    read = read_recipe(recipe)
    return _computed(read, ArrayStore.read(read), progress)
