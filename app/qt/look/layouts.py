"""Rows and columns of widgets, filled where they are made."""

from collections.abc import Callable, Sequence
from typing import TypeAlias, TypeVar

from qtpy import QtCore, QtWidgets

Part: TypeAlias = QtWidgets.QWidget | QtWidgets.QLayout | int | None
"""A widget, a layout, so many pixels of space, or None for what takes all that is left."""

Parts: TypeAlias = Part | tuple[Part, int] | tuple[Part, int, QtCore.Qt.AlignmentFlag]
"""A part by itself, or with its stretch and alignment."""

Box = TypeVar("Box", bound=QtWidgets.QBoxLayout)


def in_row(
    *parts: Parts,
    of: QtWidgets.QWidget | None = None,
    spacing: int = -1,
    margins: Sequence[int] = (0, 0, 0, 0),
) -> QtWidgets.QHBoxLayout:
    """Lay out parts from left to right, in a widget if one is given; a negative spacing is that of the style."""
    return _filled(QtWidgets.QHBoxLayout(), parts, of, spacing, margins)


def in_column(
    *parts: Parts,
    of: QtWidgets.QWidget | None = None,
    spacing: int = -1,
    margins: Sequence[int] = (0, 0, 0, 0),
) -> QtWidgets.QVBoxLayout:
    """Lay out parts one below the other, in a widget if one is given; a negative spacing is that of the style."""
    return _filled(QtWidgets.QVBoxLayout(), parts, of, spacing, margins)


def _filled(
    layout: Box, parts: Sequence[Parts], of: QtWidgets.QWidget | None, spacing: int, margins: Sequence[int]
) -> Box:
    if of is not None:
        of.setLayout(layout)
    layout.setSpacing(spacing)
    layout.setContentsMargins(*margins)
    add_parts(layout, parts)
    return layout


def add_parts(layout: QtWidgets.QBoxLayout, parts: Sequence[Parts]) -> None:
    """Add parts at the end of a row or a column."""
    for each in parts:
        part, *how = each if isinstance(each, tuple) else (each,)
        if part is None:
            layout.addStretch(1)
        elif isinstance(part, int):
            layout.addSpacing(part)
        elif isinstance(part, QtWidgets.QLayout):
            layout.addLayout(part, *how)
        else:
            layout.addWidget(part, *how)


def keep_room(widget: QtWidgets.QWidget) -> None:
    """Let a widget have its room in a row while it is hidden as well."""
    policy = widget.sizePolicy()
    policy.setRetainSizeWhenHidden(True)
    widget.setSizePolicy(policy)


# ---------------------------------------------------------------------- small widgets
def quiet_label(text: str = "", wraps: bool = False) -> QtWidgets.QLabel:
    """Return a label in the colour of secondary text."""
    label = QtWidgets.QLabel(text, wordWrap=wraps)
    label.setProperty("quiet", True)
    return label


def heading(text: str, tip: str = "") -> QtWidgets.QLabel:
    """Return the title of a section."""
    label = QtWidgets.QLabel(text, toolTip=tip)
    label.setProperty("heading", True)
    return label


def hairline() -> QtWidgets.QFrame:
    """Return a thin line between sections."""
    return QtWidgets.QFrame(objectName="hairline")


def push_button(text: str, do: Callable[..., object] | None = None, tip: str = "") -> QtWidgets.QPushButton:
    """Return a button that Enter in a box does not press."""
    button = QtWidgets.QPushButton(text, autoDefault=False, toolTip=tip)
    if do is not None:
        button.clicked.connect(do)
    return button
