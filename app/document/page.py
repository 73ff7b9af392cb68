"""A page for a document, and the two together: a recipe, from which a figure is drawn again."""

from dataclasses import dataclass, field

from bihdist_core.errors import ParameterError

from .camera import View, checked_view
from .document import Document
from .looks import one_of
from .tools import charted_tools

FORMATS = ("png", "pdf", "svg", "eps")
"""Of figures, as their files end."""

TITLES = ("heading", "caption", "none")
"""Over the panel, under its colour bar, or not at all."""

LAYOUTS = ("", "hemispheres")
"""The usual one, and lateral and medial views of each hemisphere in a row."""

ROWS = ("", "source", "mesh", "distance", "t", "alpha", "k", "method")
"""Rows of panels as they come; or one for each source, mesh, distance, or value of a parameter."""


@dataclass(frozen=True)
class Page:
    """The layout of a document on paper.

    Attributes
    ----------
    size
        The size as the user writes it, "" for the usual one.
    style
        The name of a style.
    format
        The format of the file, "" where there is none, as for a session.
    layout
        How pictures are arranged, one of LAYOUTS.
    views
        The pictures of each panel, side by side; the document's camera if empty.
    columns
        The number of panels side by side; None for all in one row.
    panel_letters
        Whether panels have letters: (a), (b), (c).
    hints
        Whether sentences under the headings say what to look for.
    transparent
        Whether the background is transparent.
    ground
        Whether there is a shadow on the ground.
    feature_edges
        Whether there are lines along sharp edges, whatever the style.
    crop
        Whether empty margins are cut off.
    title
        Where a panel's name stands, one of TITLES.
    font_family
        The font, "" for the usual one.
    font_size
        The size of labels, in points; None for the usual one.
    rows
        What each row of panels has of its own, one of ROWS: then rows and columns have headings, not panels.
    chart
        The chart at the end of each row, "" for none.
    anchor_values
        Whether anchors are labelled with their values.
    pin_names
        Whether pins that have names are labelled with these in place of their numbers.
    """

    size: str = ""
    style: str = "paper"
    format: str = ""
    layout: str = ""
    views: tuple[View, ...] = ()
    columns: int | None = None
    panel_letters: bool = False
    hints: bool = False
    transparent: bool = False
    ground: bool = False
    feature_edges: bool = False
    crop: bool = False
    title: str = "heading"
    font_family: str = ""
    font_size: float | None = None
    anchor_values: bool = False
    pin_names: bool = False
    rows: str = ""
    chart: str = ""

    def __post_init__(self) -> None:
        if self.format not in ("", *FORMATS):
            raise ParameterError(f"There is no format {self.format!r}; choose one of {', '.join(FORMATS)}.")
        if self.columns is not None and self.columns < 1:
            raise ParameterError(f"A figure has at least one column, not {self.columns}.")
        one_of(self.title, TITLES, "title")
        one_of(self.layout, LAYOUTS, "layout")
        one_of(self.rows, ROWS, "kind of row")
        one_of(self.chart, ("", *charted_tools()), "chart")
        if self.font_size is not None and not 2 <= self.font_size <= 72:
            raise ParameterError(f"The font size is 2 to 72 points, not {self.font_size:g}.")
        for view in self.views:
            checked_view(view)


@dataclass(frozen=True)
class Recipe:
    """A figure: a document on a page.

    Attributes
    ----------
    document, page
        What is drawn, and on which page.
    made_with
        The program that wrote it.
    arrays
        The archive of the arrays that the document has from Python, "" for none.
    """

    document: Document
    page: Page = Page()
    made_with: str = field(default="", compare=False)
    arrays: str = field(default="", compare=False)

    @property
    def views(self) -> tuple[View, ...]:
        """The pictures of each panel."""
        return self.page.views or (self.document.camera,)
