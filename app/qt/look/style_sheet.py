"""The style sheet of a window, for Qt's own widgets, with the pictures of marks and arrows that it refers to."""

from pathlib import Path

from ...samples import SAMPLES
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


ICONS = SAMPLES / "icons"


def style_sheet(theme: Theme, scale: float = 1.0) -> str:
    """Return the style sheet of a theme; `scale` is the font size as a multiple of the usual one."""
    usual, small, large = (round(size * scale) for size in (13, 12, 22))
    return f"""
QMainWindow, QDialog, QMessageBox {{ background: {theme.window}; color: {theme.text}; }}
QWidget {{ color: {theme.text}; font-size: {usual}px; }}
QDialogButtonBox {{ dialogbuttonbox-buttons-have-icons: 0; }}
QWidget:disabled {{ color: {theme.disabled}; }}
QToolTip {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; padding: 3px 6px; }}

QMenuBar {{ background: {theme.window}; color: {theme.text}; border: none; padding: 1px 6px; }}
QMenuBar::item {{ background: transparent; padding: 4px 8px; border-radius: 5px; }}
QMenuBar::item:selected {{ background: {theme.hover}; }}
QMenuBar::item:pressed {{ background: {theme.pressed}; }}
QMenu {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 8px;
  padding: 4px; }}
QMenu::item {{ padding: 5px 24px 5px 12px; border-radius: 5px; background: transparent; }}
QMenu::item:selected {{ background: {theme.selection}; color: {theme.text}; }}
QMenu::item:disabled {{ color: {theme.disabled}; }}
QMenu::separator {{ height: 1px; background: {theme.border}; margin: 4px 8px; }}
QMenu {{ icon-size: 20px; }}
QMenu::icon {{ padding-left: 8px; }}

QToolBar {{ background: {theme.window}; border: none; border-bottom: 1px solid {theme.border}; spacing: 4px;
  padding: 0px 8px; }}
QToolBar::separator {{ background: {theme.border}; width: 1px; margin: 4px 6px; }}
QToolButton {{ background: transparent; color: {theme.text}; border: 1px solid transparent; border-radius: 6px;
  padding: 4px; }}
QToolButton:hover {{ background: {theme.hover}; }}
QToolButton:pressed, QToolButton:open {{ background: {theme.pressed}; }}
QToolButton:checked {{ background: {theme.selection}; }}
QToolButton:disabled {{ color: {theme.disabled}; }}
QToolButton::menu-indicator {{ image: none; }}
QToolButton::menu-button {{ background: transparent; border: none; width: 18px; }}
QToolButton[keys="true"]:focus {{ border: 2px solid {theme.accent}; padding: 3px; }}

QPushButton {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 6px;
  padding: 5px 12px; min-height: 20px; icon-size: 20px; }}
QPushButton:hover {{ background: {theme.hover}; }}
QPushButton:pressed {{ background: {theme.pressed}; }}
QPushButton:checked {{ background: {theme.selection}; color: {theme.accent}; border-color: {theme.accent}; }}
QPushButton:focus {{ border: 2px solid {theme.accent}; padding: 4px 11px; outline: none; }}
QPushButton:disabled {{ color: {theme.disabled}; border-color: {theme.border}; }}
QPushButton:default, QPushButton#fill, QToolButton#fill {{ background: {theme.fill}; color: {theme.on_fill};
  border: 1px solid {theme.fill}; }}
QPushButton#fill, QToolButton#fill {{ font-weight: 600; }}
QPushButton:default:focus, QPushButton#fill:focus {{ border: 2px solid {theme.text}; }}
QPushButton#fill:disabled, QPushButton:default:disabled, QToolButton#fill:disabled {{ background: {theme.window};
  color: {theme.disabled}; border-color: {theme.border}; }}
QPushButton#link {{ background: transparent; border: none; color: {theme.accent}; padding: 2px; text-align: left; }}
QPushButton#link:hover {{ text-decoration: underline; }}
QPushButton#link:focus {{ border: 2px solid {theme.accent}; padding: 0px; border-radius: 4px; }}

QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, QPlainTextEdit, QTextEdit, QTextBrowser {{ background: {theme.raised};
  color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 5px; padding: 3px 6px;
  selection-background-color: {theme.selection}; selection-color: {theme.text}; }}
QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox {{ min-height: {round(20 * scale)}px; }}
QLineEdit[plain="true"] {{ background: transparent; border: 1px solid transparent; }}
QLineEdit[plain="true"]:hover {{ border: 1px solid {theme.strong}; }}
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus {{ border: 2px solid {theme.accent};
  padding: 2px 5px; }}
QLineEdit[wrong="true"] {{ border: 2px solid {theme.error}; padding: 2px 5px; }}
QLineEdit:disabled, QSpinBox:disabled, QComboBox:disabled {{ background: {theme.window}; color: {theme.disabled};
  border-color: {theme.border}; }}
QComboBox QLineEdit, QComboBox QLineEdit:focus, QAbstractSpinBox QLineEdit, QAbstractSpinBox QLineEdit:focus {{
  border: none; padding: 0px; background: transparent; }}
QComboBox::drop-down {{ border: none; width: 20px; }}
QComboBox {{ combobox-popup: 0; }}
QComboBox QAbstractItemView {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong};
  padding: 3px;
  selection-background-color: {theme.selection}; selection-color: {theme.text}; outline: none; }}

QSlider::groove:horizontal {{ height: 2px; background: {theme.strong}; border-radius: 1px; }}
QSlider::sub-page:horizontal {{ height: 2px; background: {theme.accent}; border-radius: 1px; }}
QSlider::groove:vertical {{ width: 2px; background: {theme.accent}; border-radius: 1px; }}
QSlider::sub-page:vertical {{ width: 2px; background: {theme.strong}; border-radius: 1px; }}
QSlider::sub-page:disabled, QSlider::groove:disabled {{ background: {theme.border}; }}
QSlider::handle:horizontal {{ width: 10px; height: 10px; margin: -5px 0; border-radius: 6px;
  background: {theme.canvas}; border: 1px solid {theme.accent}; }}
QSlider::handle:vertical {{ width: 10px; height: 10px; margin: 0 -5px; border-radius: 6px;
  background: {theme.canvas}; border: 1px solid {theme.accent}; }}
QSlider::handle:hover, QSlider::handle:focus {{ background: {theme.accent}; }}
QSlider::handle:disabled {{ background: {theme.window}; border-color: {theme.strong}; }}

QProgressBar {{ background: {theme.border}; border: none; border-radius: 2px; max-height: 4px; }}
QProgressBar::chunk {{ background: {theme.accent}; border-radius: 2px; }}
QStatusBar {{ background: {theme.window}; border-top: 1px solid {theme.border}; color: {theme.quiet}; }}
QStatusBar::item {{ border: none; }}
QScrollBar:vertical {{ background: transparent; width: 10px; margin: 0; }}
QScrollBar:horizontal {{ background: transparent; height: 10px; margin: 0; }}
QScrollBar::handle {{ background: {theme.strong}; border-radius: 4px; min-height: 24px; min-width: 24px; margin: 1px; }}
QScrollBar::add-line, QScrollBar::sub-line {{ width: 0; height: 0; }}
QScrollArea {{ background: transparent; border: none; }}
QHeaderView {{ background: {theme.window}; border: none; }}
QTableCornerButton::section {{ background: {theme.window}; border: none; }}
QHeaderView::section {{ font-weight: 400; background: {theme.window}; color: {theme.quiet}; border: none;
  border-bottom: 1px solid {theme.border}; padding: 4px 6px; font-size: {small}px; }}
QTableView, QTableWidget, QListView, QTreeView {{ background: {theme.raised}; color: {theme.text};
  border: 1px solid {theme.border}; gridline-color: {theme.border}; selection-background-color: {theme.selection};
  selection-color: {theme.text}; alternate-background-color: {theme.window}; outline: none; }}
QLabel {{ background: transparent; }}
QLabel[quiet="true"] {{ color: {theme.quiet}; }}
QLabel[small="true"] {{ font-size: {small}px; }}
QLabel[error="true"] {{ color: {theme.error}; }}
#activeLine {{ background: {theme.accent}; }}
#popUp {{ background: {theme.raised}; border: 1px solid {theme.strong}; }}
QLabel[refusal="true"] {{ background: {theme.error_ground}; color: {theme.error}; border-radius: 6px;
  padding: 8px 12px; }}
QLabel[warning="true"] {{ color: {theme.warning}; background: {theme.warning_ground}; border-radius: 9px;
  padding: 1px 8px; font-size: {small}px; }}
QLabel[heading="true"] {{ font-weight: 600; }}
QLabel#title {{ font-size: {large}px; font-weight: 600; }}

QCheckBox, QRadioButton {{ spacing: 8px; }}
QCheckBox::indicator, QRadioButton::indicator, QAbstractItemView::indicator {{ width: 14px; height: 14px;
  border: 1px solid {theme.strong}; background: {theme.raised}; }}
QCheckBox::indicator, QAbstractItemView::indicator {{ border-radius: 4px; }}
QRadioButton::indicator {{ border-radius: 8px; }}
QCheckBox::indicator:hover, QRadioButton::indicator:hover {{ border-color: {theme.quiet}; }}
QCheckBox::indicator:checked, QCheckBox::indicator:indeterminate, QRadioButton::indicator:checked,
QAbstractItemView::indicator:checked {{ background: {theme.fill}; border: 1px solid {theme.fill}; }}
QCheckBox:focus, QRadioButton:focus {{ outline: none; }}
QCheckBox::indicator:focus, QRadioButton::indicator:focus {{ border-color: {theme.accent}; }}
QCheckBox::indicator:disabled, QRadioButton::indicator:disabled {{ background: {theme.window};
  border-color: {theme.border}; }}

QPushButton[segment="first"], QPushButton[segment="middle"], QPushButton[segment="last"] {{ padding: 3px 12px;
  min-height: 18px; border-radius: 0px; }}
QPushButton[segment="middle"], QPushButton[segment="last"] {{ border-left: none; }}
QPushButton[segment="first"] {{ border-top-left-radius: 5px; border-bottom-left-radius: 5px; }}
QPushButton[segment="last"] {{ border-top-right-radius: 5px; border-bottom-right-radius: 5px; }}
QPushButton[segment]:checked {{ background: {theme.selection}; color: {theme.accent}; font-weight: 600;
  border-color: {theme.strong}; }}
QPushButton[segment]:focus {{ border: 2px solid {theme.accent}; }}

QAbstractSpinBox::up-button, QAbstractSpinBox::down-button {{ subcontrol-origin: border; width: 20px; border: none;
  background: transparent; }}
QAbstractSpinBox::up-button {{ subcontrol-position: top right; top: 1px; }}
QAbstractSpinBox::down-button {{ subcontrol-position: bottom right; bottom: 1px; }}
QGroupBox {{ border: none; margin-top: 22px; font-weight: 600; }}
QGroupBox::title {{ subcontrol-origin: margin; subcontrol-position: top left; }}
QTabBar {{ background: {theme.window}; qproperty-drawBase: 0; qproperty-elideMode: ElideNone;
  qproperty-usesScrollButtons: true; }}
QTabBar::tear {{ image: none; width: 0px; }}
QTabBar QToolButton {{ background: {theme.window}; border: none; border-radius: 0px; }}
QTabBar::tab {{ background: {theme.window}; color: {theme.quiet}; border: none; border-bottom: 2px solid transparent;
  padding: 7px 12px; }}
QTabBar::tab:hover {{ background: {theme.hover}; color: {theme.text}; }}
QTabBar::tab:selected {{ color: {theme.text}; border-bottom: 2px solid {theme.accent}; }}
QTabWidget::pane {{ border: none; border-top: 1px solid {theme.border}; }}
QMainWindow::separator {{ background: {theme.border}; width: 1px; height: 1px; }}
QSplitter::handle {{ background: {theme.border}; }}
QDockWidget {{ background: {theme.window}; color: {theme.text}; }}
QDockWidget::title {{ background: {theme.window}; color: {theme.text}; padding: 9px 12px; text-align: left;
  border-bottom: 1px solid {theme.border}; }}
QFrame#footer {{ border: none; border-top: 1px solid {theme.border}; background: {theme.window}; }}
QFrame#hairline {{ background: {theme.border}; border: none; max-height: 1px; min-height: 1px; }}
QRadioButton[row="true"] {{ border: 1px solid transparent; border-radius: 6px; padding: 5px 8px; spacing: 8px; }}
QRadioButton[row="true"]:hover {{ background: {theme.hover}; }}
QRadioButton[row="true"]:checked {{ background: {theme.selection}; font-weight: 600; }}
QRadioButton[row="true"]:focus {{ border-color: {theme.accent}; }}
QRadioButton[row="true"]::indicator {{ width: 12px; height: 12px; border: 1px solid {theme.strong};
  border-radius: 7px; background: {theme.raised}; }}
QRadioButton[row="true"]::indicator:checked {{ width: 6px; height: 6px; border: 4px solid {theme.fill};
  background: {theme.on_fill}; }}
QSpinBox[wrong="true"], QDoubleSpinBox[wrong="true"] {{ border: 2px solid {theme.error}; padding: 2px 5px; }}
{mark_rules(theme, ICONS)}"""
