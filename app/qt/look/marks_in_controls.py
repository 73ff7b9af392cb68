"""The check marks and arrows inside Qt's own controls: a style sheet takes pictures from files only.

The files are written into a folder of the process, in the colours they are used in.
"""

from pathlib import Path

from .own_folder import own_folder
from .theme import Theme

TURNED = {"check": ("check", 0), "down": ("chevron", 0), "up": ("chevron", 180), "right": ("chevron", -90)}
"""Marks that are icons: which, and by how many degrees it is turned."""

DRAWN = {
    "dot": '<circle cx="10" cy="10" r="3.75" fill="currentColor"/>',
    "dash": '<path d="M5.500 10h9" stroke="currentColor" stroke-width="1.5" stroke-linecap="round"/>',
}
"""The others, on a ground of 20 × 20."""


def mark_rules(theme: Theme, icons: Path) -> str:
    """Return the part of the style sheet that shows marks, drawn in the folder `icons`.

    It is empty where nothing can be written: Qt then draws its own.
    """

    def picture(mark: str, colour: str) -> str:
        return f'url("{_written(mark, colour, icons).as_posix()}")'

    try:
        dot, off_dot = picture("dot", theme.on_fill), picture("dot", theme.disabled)
        tick, off_tick = picture("check", theme.on_fill), picture("check", theme.disabled)
        partly, off_partly = picture("dash", theme.on_fill), picture("dash", theme.disabled)
        menu_tick, off_menu_tick = picture("check", theme.accent), picture("check", theme.disabled)
        down, off_down = picture("down", theme.quiet), picture("down", theme.disabled)
        up, off_up = picture("up", theme.quiet), picture("up", theme.disabled)
        right, off_right = picture("right", theme.quiet), picture("right", theme.disabled)
    except OSError:
        return ""
    return f"""
QRadioButton::indicator:checked {{ image: {dot}; }}
QRadioButton::indicator:checked:disabled {{ image: {off_dot}; }}
QCheckBox::indicator:checked {{ image: {tick}; }}
QCheckBox::indicator:indeterminate {{ image: {partly}; }}
QCheckBox::indicator:checked:disabled {{ image: {off_tick}; }}
QCheckBox::indicator:indeterminate:disabled {{ image: {off_partly}; }}
QAbstractItemView::indicator:checked {{ image: {tick}; }}
QMenu::indicator {{ width: 16px; height: 16px; left: 4px; }}
QMenu::indicator:checked {{ image: {menu_tick}; }}
QMenu::indicator:checked:disabled {{ image: {off_menu_tick}; }}
QMenu::right-arrow {{ image: {right}; width: 14px; height: 14px; }}
QMenu::right-arrow:disabled {{ image: {off_right}; }}
QComboBox::down-arrow {{ image: {down}; width: 16px; height: 16px; }}
QComboBox::down-arrow:disabled {{ image: {off_down}; }}
QAbstractSpinBox::up-arrow {{ image: {up}; width: 12px; height: 12px; }}
QAbstractSpinBox::up-arrow:disabled, QAbstractSpinBox::up-arrow:off {{ image: {off_up}; }}
QAbstractSpinBox::down-arrow {{ image: {down}; width: 12px; height: 12px; }}
QAbstractSpinBox::down-arrow:disabled, QAbstractSpinBox::down-arrow:off {{ image: {off_down}; }}
QToolButton[chevron="true"] {{ padding-right: 20px; }}
QPushButton[chevron="true"] {{ padding-right: 26px; }}
QPushButton[chevron="true"]:focus {{ padding-right: 25px; }}
QPushButton[chevron="true"]::menu-indicator {{ image: {down}; width: 14px; height: 14px;
  subcontrol-origin: border; subcontrol-position: right center; right: 8px; }}
QToolButton[chevron="true"]::menu-indicator {{ image: {down}; width: 14px; height: 14px;
  subcontrol-origin: border; subcontrol-position: right center; right: 4px; }}
QToolButton[chevron="true"]::menu-indicator:disabled {{ image: {off_down}; }}
QToolButton::menu-arrow {{ image: {down}; width: 14px; height: 14px; }}
"""


def _written(mark: str, colour: str, icons: Path) -> Path:
    """Return the file with a mark in a colour."""
    path = own_folder() / f"{mark}-{colour[1:]}.svg"
    if not path.exists():
        path.write_text(_drawing(mark, icons).replace("currentColor", colour), encoding="utf-8")
    return path


def _drawing(mark: str, icons: Path) -> str:
    if mark in DRAWN:
        return f'<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" viewBox="0 0 20 20">{DRAWN[mark]}</svg>'
    name, angle = TURNED[mark]
    whole = (icons / f"{name}.svg").read_text(encoding="utf-8")
    return whole.replace("<path ", f'<path transform="rotate({angle} 10 10)" ')
