"""The arguments that `bihdist.figure`, `bihdist.page` and `bihdist.widget` share, in groups."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypedDict

import numpy.typing as npt

from bihdist_core.sources.source import SurfacePoint

from ..document.camera import View
from ..document.looks import Colours
from ..document.option import Option, Row
from ..document.synonyms import unknown_argument


class IsolineOptions(TypedDict, total=False):
    """Which values have an isoline, and how isolines look: the keys of ``isolines``.

    Attributes
    ----------
    count : int
        About how many isolines in each panel, at round values; 0 for none.
    equal : bool
        Put isolines at equal steps from 0 to the maximum instead.
    spacing : float
        Put isolines at multiples of this, in the field's unit.
    values : sequence of float
        Put isolines at these values.
    through : sequence of int
        Vertices that have one isoline more.
    bold : int
        Draw each of so many bolder; 0 for none.
    labels : bool
        Write the values on the lines.
    """

    count: int
    equal: bool
    spacing: float | None
    values: Sequence[float]
    through: Sequence[int]
    bold: int
    labels: bool


class LookOptions(TypedDict, total=False):
    """The colours and the shading of surfaces: the keys of ``look``.

    Attributes
    ----------
    cmap : str
        Colour map: ``"paper"``, ``"uniform"``, ``"ember"``, ``"safe"`` or ``"diverging"``, a Matplotlib name that is
        like one of these, or a file with a map.
    flip_scalars : bool
        Flip the direction of the colour map.
    bands : bool
        Use one colour from each isoline to the next.
    base : str
        Draw this in grey under isolines in the colours of the field: ``"curvature"``, or the name of a field.
    gradual_base : bool
        Draw the base in all greys, not in two where values have both signs.
    white_isolines : bool
        Draw isolines on a base in white, not in the field's colours.
    clim : str, float or sequence
        Where colour bars end: ``"own"`` maximum, ``"shared"`` by all panels of a unit, ``"fraction"`` (0 to 100 % of
        each maximum); a number, also as ``(0, end)``; one for each panel, None for its own; or a session or recipe
        whose limits are taken.
    smooth_shading : bool
        Shade smoothly; without, each face has one shade.
    split_sharp_edges : bool
        Keep sharp edges sharp; by default where the surface has some.
    feature_angle : float
        Angle in degrees from which on an edge is sharp.
    show_edges : bool
        Show the edges of the mesh.
    opacity : float
        Opacity of the surface, more than 0; below 1 what is behind it is seen.
    warp_factor : float
        Raise a flat mesh to a height field whose highest point is at this fraction of its extent.
    extrema : bool
        Mark maxima, and minima away from the source, whose persistence exceeds a thousandth of the range.
    """

    cmap: str | Colours
    flip_scalars: bool
    bands: bool
    base: str
    gradual_base: bool
    white_isolines: bool
    clim: str | float | Sequence[float | None]
    smooth_shading: bool
    split_sharp_edges: bool
    feature_angle: float
    show_edges: bool
    opacity: float
    warp_factor: float
    extrema: bool


class ViewOptions(TypedDict, total=False):
    """How surfaces are seen: the keys of ``view``.

    Attributes
    ----------
    cpos : str, Camera or sequence of these
        Camera position: the name of a standard view such as ``"front"``, or a camera; several stand side by side.
    camera : sequence of float
        The eleven numbers of a copied camera: position, focal point, up, and the width and height of what it sees.
    viewup : str
        Axis that points up, ``"z"`` or ``"-z"``; ``"auto"`` for a guess.
    parallel_projection : bool
        Draw without perspective.
    axes : bool
        Show in a corner where x, y and z point.
    scale_bar : bool
        Show a round length; exact everywhere in parallel projection only.
    unit : str
        Unit of the mesh's lengths, such as ``"mm"``.
    clip : str
        Plane beyond which the surface is cut away: ``"x"`` or ``"-y@0.3"``, an axis and the fraction to keep, or a
        normal, ``"0.2,0.1,0.9@0.4"``.
    insets : sequence of int or tuple
        Vertices whose places are enlarged; ``(vertex, factor)`` or ``(vertex, factor, isolines)`` say by how much, and
        with how many isolines.
    """

    cpos: View | Sequence[View]
    camera: Sequence[float]
    viewup: str
    parallel_projection: bool
    axes: bool
    scale_bar: bool
    unit: str
    clip: str
    insets: Sequence[int | tuple[int, float] | tuple[int, float, int]]


class MarkOptions(TypedDict, total=False):
    """Marks on surfaces: the keys of ``marks``.  Tools of other packages may add some.

    Attributes
    ----------
    pins : sequence of int, str or SurfacePoint, or mapping to str
        Vertices or points in faces that get a number, in their order, or a name each, with a line to it.
    anchors : mapping or sequence of int
        Vertices that are marked, perhaps each with a value.
    anchor_values : bool
        Write the values beside the anchors.
    exponent, smoothness : float
        Exponent and smoothness of the anchors' weights in interpolants.
    selections : sequence
        Ids (k,) of vertices that stand out together, or words such as ``"12+40-77"``, a colour each.
    regions : "all" or sequence of int
        Panels, from 1, that show lines around what is nearest to each pin.
    profile : bool or sequence
        True for the path through the pins, or the points that it goes through: vertices, points in faces, ``"source"``
        and ``"pin:1"``.
    way : str
        How the path goes from point to point: ``"auto"``, ``"exact"``, ``"edges"``, or by a ``"section"``,
        ``"section-longer"`` or ``"section-whole"``.
    across : sequence of float
        A direction (3,) that lies in a section's plane.
    hide : sequence of str
        Marks that are not drawn, such as ``"source"`` or ``"pins:2"``.
    """

    pins: Sequence[int | str | SurfacePoint] | Mapping[int | str | SurfacePoint, str] | npt.ArrayLike
    anchors: Mapping[int, float | None] | Sequence[int]
    anchor_values: bool
    exponent: float
    smoothness: float
    selections: Sequence[Any]
    regions: str | Sequence[int]
    profile: bool | Sequence[Any]
    way: str
    across: Sequence[float]
    hide: Sequence[str]


class LayoutOptions(TypedDict, total=False):
    """How panels are laid out on a page: the keys of ``layout``.

    Attributes
    ----------
    size : str
        ``"85mm"``, ``"3.5in"``, ``"1680x640"``, ``"160mm@300dpi"``, ``"column"`` (85 mm, cropped, and distances have
        one colour bar in percent unless `crop` and `clim` say otherwise), ``"double"`` (178 mm), ``"slide"``.
    style : str
        Style of the page: ``"paper"``, ``"uniform"``, ``"lines"``, ``"dark"`` or ``"cover"``.
    columns : int
        Number of panels side by side; by default all, or a row for each source.
    layout : str
        ``"hemispheres"``: lateral and medial views of each hemisphere in a row, a row for each distance.
    rows : str
        A row of panels for each ``"source"``, ``"mesh"``, ``"distance"``, or value of a parameter: ``"t"``,
        ``"alpha"``, ``"k"``, ``"method"``; rows and columns then have headings.
    chart : str
        A chart at the end of each row: ``"profile"`` of the marks' path, ``"scatter"``, ``"histogram"`` or
        ``"errors"`` of maps.
    title : str
        Write names as ``"heading"``, as ``"caption"`` at the colour bars, or ``"none"``.
    panel_letters : bool
        Write (a), (b), (c) over the panels.
    hints : bool
        Write under headings what to look for.
    font_family : str
        Font of all text.
    font_size : float
        Size of labels in points; other text is in proportion.
    transparent : bool
        Leave the background transparent.
    ground : bool
        Draw a soft shadow on the ground.
    feature_edges : bool
        Draw thin lines along sharp edges, as the style ``"cover"`` does.
    crop : bool
        Cut off empty margins.
    """

    size: str
    style: str
    columns: int | None
    layout: str
    rows: str
    chart: str
    title: str
    panel_letters: bool
    hints: bool
    font_family: str
    font_size: float | None
    transparent: bool
    ground: bool
    feature_edges: bool
    crop: bool


GROUPS: dict[str, type] = {
    "isolines": IsolineOptions,
    "look": LookOptions,
    "view": ViewOptions,
    "marks": MarkOptions,
    "layout": LayoutOptions,
}
"""What documents each group of arguments."""


def option_values(function: str, rows: Iterable[Row], arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of the options of some rows, by their names, that the arguments of a function say.

    Raises TypeError for an argument, or a key of a group, that is not known.
    """
    options = {option.argument: option for row in rows for option in row.options}
    said: dict[tuple[str, str], Any] = {}
    for name, value in arguments.items():
        if name not in GROUPS:
            said[name, ""] = value
        elif name == "isolines" and not isinstance(value, Mapping):
            said[name, "count"] = value
        else:
            said |= {(name, key): each for key, each in (value or {}).items()}
    for argument in said:
        if argument not in options:
            raise _unknown(function, argument, options)
    return {options[a].name: value for a, value in said.items() if not options[a].is_usual(value)}


def _unknown(function: str, argument: tuple[str, str], options: Mapping[tuple[str, str], Option]) -> TypeError:
    name, key = argument
    known = {option.word[2:]: _written(*each) for each, option in options.items()}
    known |= {(option.key or option.name).replace("_", "-"): _written(*each) for each, option in options.items()}
    return unknown_argument(function, key or name, known, name if key else "")


def _written(name: str, key: str) -> str:
    return f"{name}={{{key!r}: …}}" if key else f"{name}="
