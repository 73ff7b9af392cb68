"""The settings of the program, a row each: where a value lives, what it is called, and how it is chosen.

From a row follow the entry in a menu and its tick, the palette's entry, the option of the commands, the argument in
Python, the lines that are copied, and a preference's control in the dialog and its reader.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from operator import attrgetter
from types import MappingProxyType
from typing import Any

from .document import Document
from .edits import with_range
from .looks import MOST_ISOLINES
from .option import Row, attribute, with_attribute

NONE: Mapping[Any, str] = MappingProxyType({})


@dataclass(frozen=True)
class Setting:
    """A value that the user chooses.

    Parameters
    ----------
    path : str
        Where it lives: ``"document.axes"``, ``"preferences.turntable"``.
    label : str
        What menus call it, with ``&`` before the letter of its key there; the dialog of preferences, where it is only
        there.
    menu : str
        Which menu has its switch: "camera", "scale", "shading", "colours", "base" or "isolines".
    tip : str
        A sentence; without a capital it is the help of the option.
    keys : tuple of str
        Shortcuts, the first of which is shown.
    synonyms : str
        Other words by which the palette finds it.
    choices : mapping
        What menus and the dialog call the values, for other settings than switches.
    on, off : object
        The values of a switch.
    name, group, key : str
        The option and the argument, see `Option`; no option without a group.
    edit : callable
        From a document and a value to the next document.
    title : str
        What the dialog of preferences calls it, in which it is not without.
    most : int
        The largest of whole numbers, which begin at 0.
    unit : str
        What the dialog writes after a number.
    """

    path: str
    label: str = ""
    tip: str = ""
    keys: tuple[str, ...] = ()
    synonyms: str = ""
    choices: Mapping[Any, str] = field(default_factory=dict)
    on: Any = True
    off: Any = False
    name: str = ""
    group: str = ""
    key: str = ""
    edit: Callable[[Document, Any], Document] | None = None
    title: str = ""
    most: int = 0
    unit: str = ""
    menu: str = ""

    @property
    def word(self) -> str:
        """The name of its action, option and argument."""
        return self.name or self.path.rpartition(".")[2]

    @property
    def is_preference(self) -> bool:
        """Whether it is kept from one start to the next, and is no part of what is shown."""
        return self.path.startswith("preferences.")

    @property
    def row(self) -> Row:
        """The row of its option."""
        return attribute(self.path, self.tip[0].lower() + self.tip[1:], name=self.name, group=self.group, key=self.key)

    def value(self, holder: Any) -> Any:
        """Return its value in what has a document and preferences."""
        return attrgetter(self.path)(holder)

    def is_on(self, holder: Any) -> bool:
        """Return whether a switch is on."""
        return bool(self.value(holder) != self.off)

    def changed(self, document: Document, value: Any) -> Document:
        """Return the document with another value."""
        if self.edit is not None:
            return self.edit(document, value)
        edited: Document = with_attribute(document, self.path.partition(".")[2], value)
        return edited


SHOW_EDGES = Setting(
    "document.shading.show_edges", "Show &edges", "Show the edges of the mesh", ("W",), "wireframe triangles lines",
    menu="shading", group="look",
)  # fmt: skip
PARALLEL_PROJECTION = Setting(
    "document.parallel_projection", "Parallel pr&ojection", "Draw without perspective", ("O",), "orthographic",
    menu="camera", group="view",
)  # fmt: skip
AXES = Setting(
    "document.axes", "A&xes", "Show in a corner where x, y and z point", ("X",), "coordinates xyz gizmo",
    menu="scale", group="view",
)  # fmt: skip
SCALE_BAR = Setting(
    "document.scale_bar", "Scale bar", "Show a round length; exact everywhere in parallel projection only",
    menu="scale", group="view", synonyms="ruler length unit mm",
)  # fmt: skip
FLIP_SCALARS = Setting(
    "document.colours.reversed", "Reversed", "Flip the direction of the colour map", synonyms="flip", menu="colours",
    group="look", name="flip_scalars",
)  # fmt: skip
BANDS = Setting(
    "document.colours.bands", "Bands", "Use one colour from each isoline to the next", menu="colours", group="look"
)
GRADUAL_BASE = Setting(
    "document.base.gradual", "Gradual greys", "Draw the base in all greys, not in two where values have both signs",
    menu="base", group="look", name="gradual_base", synonyms="curvature sulci binarise threshold",
)  # fmt: skip
WHITE_ISOLINES = Setting(
    "document.base.white_isolines", "White isolines", "Draw isolines on a base in white, not in the field's colours",
    menu="base", group="look",
)  # fmt: skip
EQUAL_STEPS = Setting(
    "document.isolines.round", "Equal steps", "Put isolines at equal steps from 0 to each panel's maximum",
    menu="isolines", name="equal_isolines", on=False, off=True,
)  # fmt: skip
BOLD_ISOLINES = Setting(
    "document.isolines.bold", "Bold every fifth", menu="isolines", name="bold_isolines", on=5, off=0
)
ISOLINE_LABELS = Setting(
    "document.isolines.labels", "Labels", "Write their values on isolines", menu="isolines",
    name="isoline_labels", group="isolines", key="labels",
)  # fmt: skip
RANGE = Setting(
    "document.range",
    "Ran&ge",
    synonyms="scale limits clim maximum normalise compare colour bar colourbar legend clip",
    choices={
        "own": "Own maximum of each panel",
        "shared": "Shared by all panels of a unit",
        "fraction": "Fraction of the maximum: 0 to 100 %",
    },
    edit=with_range,
)
SHADING = Setting(
    "document.shading.normals",
    "S&hading",
    synonyms="light normals smooth flat sharp edges",
    choices={
        "auto": "Automatic: split at sharp edges, if there are any",
        "smooth": "Smooth",
        "creased": "Split at sharp edges",
        "flat": "Flat: one shade for each face",
    },
    name="shading",
)
SETTINGS = (
    *(SHOW_EDGES, PARALLEL_PROJECTION, AXES, SCALE_BAR, FLIP_SCALARS, BANDS, GRADUAL_BASE, WHITE_ISOLINES),
    *(EQUAL_STEPS, BOLD_ISOLINES, ISOLINE_LABELS),
    *(RANGE, SHADING),
)
"""Those of what is shown."""


# ---------------------------------------------------------------------- preferences
def _preference(default: Any, title: str = "", choices: Mapping[Any, str] = NONE, tip: str = "", **more: Any) -> Any:
    return field(default=default, metadata={"setting": Setting("", title=title, choices=choices, tip=tip, **more)})


@dataclass(frozen=True)
class Preferences:
    """The user's preferences, kept from one start to the next; each field has all that is to be said of it."""

    theme: str = _preference(
        "desktop",
        "&Theme",
        {"desktop": "Follow system", "light": "Light", "dark": "Dark"},
        "Colours of the window; figures keep their own",
        label="&Theme",
        synonyms="dark light mode appearance colours",
    )
    isolines: int = _preference(
        20, "&Isolines", tip="About how many a new mesh has, at round values; 0 for none", most=MOST_ISOLINES,
        unit="on new meshes",
    )  # fmt: skip
    wheel_reversed: bool = _preference(
        False,
        "&Wheel",
        {False: "Scroll up to zoom in", True: "Scroll up to zoom out"},
        "What scrolling up does",
    )
    turntable: bool = _preference(
        False,
        "&Rotation",
        {False: "Free", True: "Turntable"},
        "Keep the vertical axis upright while turning",
        label="Tur&ntable rotation",
        menu="camera",
        synonyms="rotate orbit trackball upright",
    )
    ambient_occlusion: bool = _preference(
        False,
        "&Ambient occlusion",
        {False: "None", True: "Darken folds"},
        "Darken what the rest of the shape hides from the light",
        label="Ambient &occlusion",
        menu="shading",
        synonyms="shadow light folds depth cavity",
    )
    snap: bool = _preference(
        True,
        "&Source",
        {True: "On vertices", False: "Anywhere in faces"},
        "Where clicks and drags put the source (V)",
    )
    geometry: bytes = b""
    """The window's place, in Qt's own form; empty if there is none."""
    last_folder: str = ""
    figure_format: str = ""
    figure_size: str = ""
    movie_format: str = ""
    movie_size: str = ""
    docks: str = ""
    """Words of those that were open, with commas between them."""


PREFERENCES = tuple(
    replace(each.metadata["setting"], path=f"preferences.{each.name}")
    for each in fields(Preferences)
    if "setting" in each.metadata
)
"""Those with a control in the dialog."""

THEME = next(each for each in PREFERENCES if each.word == "theme")

SWITCHES = tuple(each for each in (*SETTINGS, *PREFERENCES) if each.menu)
"""Those with a tick in a menu."""


def switches_in(menu: str) -> list[str]:
    """Return the words of the switches in a menu."""
    return [each.word for each in SWITCHES if each.menu == menu]
