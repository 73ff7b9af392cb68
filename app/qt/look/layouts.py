"""Rows and columns of widgets, filled where they are made."""

from collections.abc import Sequence
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
    """Parts from left to right; of: a widget whose layout it becomes; spacing: in pixels, the style's if negative."""
    return _filled(QtWidgets.QHBoxLayout(), parts, of, spacing, margins)


def in_column(
    *parts: Parts,
    of: QtWidgets.QWidget | None = None,
    spacing: int = -1,
    margins: Sequence[int] = (0, 0, 0, 0),
) -> QtWidgets.QVBoxLayout:
    """Parts one below the other; of: a widget whose layout it becomes; spacing: in pixels, the style's if negative."""
    return _filled(QtWidgets.QVBoxLayout(), parts, of, spacing, margins)


def _filled(
    layout: Box, parts: Sequence[Parts], of: QtWidgets.QWidget | None, spacing: int, margins: Sequence[int]
) -> Box:
    if of is not None:
        of.setLayout(layout)
    layout.setSpacing(spacing)
    layout.setContentsMargins(*margins)
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
    return layout


def quiet_label(text: str = "") -> QtWidgets.QLabel:
    """Words that stand back."""
    label = QtWidgets.QLabel(text)
    label.setProperty("quiet", True)
    return label
