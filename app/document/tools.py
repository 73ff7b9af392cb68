"""The tools of the program: what a click can do, a dock shows or a command computes, each in a folder of its own.

A tool is one row here, which says by names where its parts are: they are imported when they are needed, those that draw
only once they are.  The table of the program's own tools is `app/tools/__init__.py`; those of others join by the entry
point group `bihdist.tools`.
"""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .part import Part

GROUP = "bihdist.tools"
"""The entry points by which tools of others join; each names a `Tool`."""


@dataclass(frozen=True)
class Tool:
    """A tool of the window, of figures and of the command line.

    Names such as "dock:PinsDock" are of a module of the tool's package and of something in that module. As in imports,
    a dot before the module is for a package further up.

    Parameters
    ----------
    package
        The full name of the tool's package.
    word
        The name by which documents know its dock.
    title
        The title of the dock.
    text
        The entry in menus, with an `&` before the letter of its key there.
    key
        The key that opens and closes the dock.
    tip
        What the tool is for, in a few words.
    icon
        A name of `assets/icons`.
    menu
        The menu that it is in, "Tools" or "View".
    synonyms
        Other words by which it is found.
    dock
        Its `Instrument`, if it has one.
    gesture
        Its `Gesture`, which handles clicks and drags.
    commands
        Modules of commands, by the commands' names.
    quantities
        Subclasses of `Quantity` that panels can show.
    questions
        Modules that register the questions of these quantities (`session.questions.question_of`).
    parts
        Subclasses of `Part`, which documents hold.
    options
        A tuple of `Row`: the options of figures.
    marks
        A function from a `MarkedPanel` to the marks on it, primitives of `marks.primitives`.
    items
        A function from a document to the marks that the list of what is on the surface has, `SurfaceItem`s.
    findings
        A class of which each window makes one with a `Context` once there are panels; it computes, beside the window's
        thread, what is marked and shown.
    panel_edits
        A tuple of `PanelEdit`, for the context menu of a panel.
    actions
        A tuple of `Action`: what menus and keys do beside opening the dock.
    add_panel
        A function from a document to one with more panels; None where it adds one panel, as usual.
    needs_faces
        Whether its dock has nothing to show of points.
    charts
        Functions from a `figures.arrangement.ChartRow` to the charts beside a row of a figure, by their names.
    """

    package: str
    word: str
    title: str = ""
    text: str = ""
    key: str = ""
    tip: str = ""
    icon: str = ""
    menu: str = "Tools"
    synonyms: str = ""
    dock: str = ""
    gesture: str = ""
    commands: Mapping[str, str] = field(default_factory=dict)
    quantities: tuple[str, ...] = ()
    questions: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    options: str = ""
    marks: str = ""
    items: str = ""
    findings: str = ""
    panel_edits: str = ""
    actions: str = ""
    add_panel: str = ""
    needs_faces: bool = False
    charts: Mapping[str, str] = field(default_factory=dict)

    def load(self, name: str) -> Any:
        """Load what a name such as "dock:PinsDock" is of; the module if there is no colon in it."""
        module, _, attribute = name.partition(":")
        found = import_module(f".{module}", self.package)
        return getattr(found, attribute) if attribute else found


@cache
def tools() -> tuple[Tool, ...]:
    """Return all tools: the program's own in the order of the toolbar, then those of installed packages."""
    package = f"{__name__.rpartition('.document.')[0]}.tools"
    own = (import_module(f"{package}.{name}").TOOL for name in import_module(package).TOOLS)
    return (*own, *_tools_of_others())


def _tools_of_others() -> Iterator[Tool]:
    """A warning for each that cannot be loaded: the program is there without it."""
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        try:
            yield entry.load()
        except Exception as error:  # it is somebody else's
            warnings.warn(f"The tool {entry.name!r} of {entry.value} cannot be loaded: {error}.", stacklevel=1)


def docked_tools() -> dict[str, Tool]:
    """Return the tools with a dock, by its word, in the order of the menu."""
    return {tool.word: tool for tool in sorted(tools(), key=lambda tool: tool.word) if tool.dock}


def charted_tools() -> dict[str, Tool]:
    """Return the tools with charts for figures, by the charts' names."""
    return {name: tool for tool in tools() for name in tool.charts}


@cache
def part_types() -> "tuple[type[Part], ...]":
    """Return the types of the parts of documents that are tools'."""
    return tuple(tool.load(name) for tool in tools() for name in tool.parts)
