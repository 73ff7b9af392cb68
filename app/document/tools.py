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
    """One tool; names such as "dock:PinsDock" are of a module of its package and of something in that.

    A dot before a module is, as in imports, for a package further up.

    package: the tool's, by its full name.  word: by which documents know its dock.  title: of the dock; text: in menus,
    with an `&` before the letter of its key there; key: opens and closes the dock; tip: what it is for, in a few words;
    icon: a name of `assets/icons`; in_bar: whether it has a button of its own; synonyms: other words by which it is
    found.  dock: its `Instrument`, if it has one.  gesture: its `Gesture`, what clicks and drags mean.  commands:
    modules of commands, by their words.  quantities: subclasses of `Quantity` that panels can show.  parts:
    subclasses of `Part`, of documents.  options: a tuple of `Row`, what figures can be told of them.
    marks: a function from a `MarkedPanel` to what is marked there, primitives of `marks.primitives`.
    findings: a class of which each window has one, made with a `Context` once there are panels, that finds out beside
    the window's thread what is marked and shown.  panel_edits: a tuple of `PanelEdit`, for the menu over a panel.
    actions: a tuple of `Act`, what can be done by a menu or a key beside opening the dock.
    add_panel: a function from a document to that with more panels; None where it is one more panel, as usual.
    """

    package: str
    word: str
    title: str = ""
    text: str = ""
    key: str = ""
    tip: str = ""
    icon: str = ""
    in_bar: bool = False
    synonyms: str = ""
    dock: str = ""
    gesture: str = ""
    commands: Mapping[str, str] = field(default_factory=dict)
    quantities: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    options: str = ""
    marks: str = ""
    findings: str = ""
    panel_edits: str = ""
    actions: str = ""
    add_panel: str = ""

    def load(self, name: str) -> Any:
        """What a name such as "dock:PinsDock" means, or the module if there is no colon in it."""
        module, _, attribute = name.partition(":")
        found = import_module(f".{module}", self.package)
        return getattr(found, attribute) if attribute else found


@cache
def tools() -> tuple[Tool, ...]:
    """All tools: the program's own in the order of the tool bar, then those of installed packages."""
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
    """Those that have a dock, by its word, in the order of the menu."""
    return {tool.word: tool for tool in sorted(tools(), key=lambda tool: tool.word) if tool.dock}


@cache
def part_types() -> "tuple[type[Part], ...]":
    """The types of the parts of documents that are tools'."""
    return tuple(tool.load(name) for tool in tools() for name in tool.parts)
