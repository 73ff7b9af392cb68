"""A page for a document, and the two together: a recipe, from which a figure is drawn again."""

from dataclasses import dataclass, field

from bihdist_core.errors import ParameterError

from .camera import View, checked_view
from .document import Document
from .looks import one_of

FORMATS = ("png", "pdf", "svg", "eps")
"""Of figures, as their files end."""

TITLES = ("heading", "caption", "none")
"""Over the panel, under its colour bar, or not at all."""


@dataclass(frozen=True)
class Page:
    """How a document is put on paper.

    size: as it is written, "" for the usual one.  style: a word of the drawing's styles.  format: of the file, "" where
    there is none, as for a session.  views: pictures of each panel side by side, the document's camera if empty.
    columns: panels side by side, all in one row if None.  hints: what to look for, under the headings.  crop: without
    the empty margins.  title: where a panel's name stands, one of TITLES.  font: its family, "" for the usual one.
    text: the size of labels in points, the usual one if None.  anchor_values: whether they stand beside anchors.
    """

    size: str = ""
    style: str = "paper"
    format: str = ""
    views: tuple[View, ...] = ()
    columns: int | None = None
    hints: bool = False
    transparent: bool = False
    crop: bool = False
    title: str = "heading"
    font: str = ""
    text: float | None = None
    anchor_values: bool = False

    def __post_init__(self) -> None:
        if self.format not in ("", *FORMATS):
            raise ParameterError(f"There is no format {self.format!r}; choose one of {', '.join(FORMATS)}.")
        if self.columns is not None and self.columns < 1:
            raise ParameterError(f"A figure has at least one column, not {self.columns}.")
        one_of(self.title, TITLES, "title")
        if self.text is not None and not 2 <= self.text <= 72:
            raise ParameterError(f"Text has 2 to 72 points, not {self.text:g}.")
        for view in self.views:
            checked_view(view)


@dataclass(frozen=True)
class Recipe:
    """A figure: a document on a page.

    made_with: the program that wrote it.  arrays: the archive of what the document has from Python, if anything.
    """

    document: Document
    page: Page = Page()
    made_with: str = field(default="", compare=False)
    arrays: str = field(default="", compare=False)

    @property
    def views(self) -> tuple[View, ...]:
        """The pictures of each panel."""
        return self.page.views or (self.document.camera,)
