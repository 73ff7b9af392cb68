"""The colours of the window, light and dark; the one place where they are defined, but for those of fields and curves,
which figures have, too.

Text has a contrast of at least 4.5 : 1 with each ground it stands on, except where it is disabled.
"""

from dataclasses import dataclass

from qtpy import QtGui

from ...scene.style import CURVES, CURVES_ON_DARK


@dataclass(frozen=True)
class Theme:
    """The colours of the window as #rrggbb.

    Attributes
    ----------
    window
        The ground of menus, bars and docks.
    canvas
        The ground of the panels, with their views.
    raised
        The ground of input fields, menus and buttons.
    border
        Lines between parts.
    strong
        Outlines of controls.
    quiet
        Text of minor importance.
    accent
        Focus, what is checked, progress and links.
    fill, on_fill
        The one button that is filled, and the text on it.
    selection
        The ground of what is chosen.
    label
        The ground of the label at the pointer.
    curves
        The curves of plots, in the order of panels.
    cells
        The cells of a matrix, from 0 to its largest value.
    """

    word: str
    window: str
    canvas: str
    raised: str
    border: str
    strong: str
    text: str
    quiet: str
    disabled: str
    hover: str
    pressed: str
    accent: str
    fill: str
    on_fill: str
    selection: str
    warning: str
    warning_ground: str
    error: str
    error_ground: str
    label: str
    label_text: str
    label_quiet: str
    curves: tuple[str, ...]
    cells: tuple[str, str]

    @property
    def is_dark(self) -> bool:
        """Whether the theme is dark."""
        return lightness(self.canvas) < 0.5


LIGHT = Theme(
    word="light",
    window="#F6F7F8",
    canvas="#FFFFFF",
    raised="#FFFFFF",
    border="#DFE3E7",
    strong="#C2C8CF",
    text="#1D2125",
    quiet="#5B626B",
    disabled="#8A9199",
    hover="#E9ECEF",
    pressed="#DDE1E5",
    accent="#0A7358",
    fill="#0A7358",
    on_fill="#FFFFFF",
    selection="#DDF0EA",
    warning="#7A4F00",
    warning_ground="#FFF2D1",
    error="#B3261E",
    error_ground="#FDECEA",
    label="#1D2125",
    label_text="#FFFFFF",
    label_quiet="#C3C9D0",
    curves=CURVES,
    cells=("#F6F7F8", "#CFD3D7"),
)

DARK = Theme(
    word="dark",
    window="#1E2125",
    canvas="#16181B",
    raised="#282C31",
    border="#30353B",
    strong="#4A5159",
    text="#E8EAED",
    quiet="#A6AEB7",
    disabled="#6F7780",
    hover="#2A2E33",
    pressed="#343A40",
    accent="#52CFA6",
    fill="#1F7F62",
    on_fill="#FFFFFF",
    selection="#20392F",
    warning="#F0C063",
    warning_ground="#3A3018",
    error="#FF8F86",
    error_ground="#402322",
    label="#F1F3F5",
    label_text="#16181B",
    label_quiet="#5B626B",
    curves=CURVES_ON_DARK,
    cells=("#1E2125", "#4A5159"),
)

THEMES = {theme.word: theme for theme in (LIGHT, DARK)}


def lightness(colour: str) -> float:
    """Return the relative luminance, 0 for black to 1 for white (WCAG 2)."""
    shares = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours, from 1 to 21 (WCAG 2)."""
    dark, light = sorted((lightness(one), lightness(other)))
    return (light + 0.05) / (dark + 0.05)


def between(ends: tuple[str, str], share: float) -> QtGui.QColor:
    """Return the colour at a fraction of the way from one to another."""
    first, last = (QtGui.QColor(end) for end in ends)
    pairs = ((getattr(first, part)(), getattr(last, part)()) for part in ("redF", "greenF", "blueF"))
    return QtGui.QColor.fromRgbF(*(a + (b - a) * share for a, b in pairs))


def palette(theme: Theme) -> QtGui.QPalette:
    """Return the palette for what Qt draws by itself."""
    found = QtGui.QPalette()
    role, group = QtGui.QPalette.ColorRole, QtGui.QPalette.ColorGroup
    for each, colour in {
        role.Window: theme.window,
        role.WindowText: theme.text,
        role.Base: theme.raised,
        role.AlternateBase: theme.window,
        role.ToolTipBase: theme.raised,
        role.ToolTipText: theme.text,
        role.PlaceholderText: theme.quiet,
        role.Text: theme.text,
        role.Button: theme.raised,
        role.ButtonText: theme.text,
        role.BrightText: theme.on_fill,
        role.Highlight: theme.selection,
        role.HighlightedText: theme.text,
        role.Link: theme.accent,
        role.LinkVisited: theme.accent,
        role.Light: theme.raised,
        role.Midlight: theme.border,
        role.Mid: theme.strong,
        role.Dark: theme.strong,
        role.Shadow: theme.border,
    }.items():
        found.setColor(each, QtGui.QColor(colour))
    for each in (role.WindowText, role.Text, role.ButtonText):
        found.setColor(group.Disabled, each, QtGui.QColor(theme.disabled))
    return found
